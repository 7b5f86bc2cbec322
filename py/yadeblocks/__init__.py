"""Deformable blocks with joints that break, for YADE."""
from . import _plugin
