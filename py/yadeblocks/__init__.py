# yade-blocks, GPL-2.0-or-later
"""Deformable blocks with joints that break, for YADE.

Where YADE is running, importing the package or one of its modules loads the plugin, if YADE has not done so itself. Elsewhere nothing is loaded: modules that
read, draw and check work under any Python, and the plugin follows as soon as YADE is imported."""
from . import _plugin

_plugin.follow()
