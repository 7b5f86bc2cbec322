# yade-blocks, GPL-2.0-or-later
"""Deformable blocks with joints that break, for YADE.

Where YADE is running, importing the package or one of its modules loads the plugin, if YADE has not done so itself. Elsewhere nothing is loaded: modules that
read, draw and check work under any Python, and the plugin follows as soon as YADE is imported."""
from . import _plugin

_plugin.follow()

_moved = { # modules that were here; `laboratory` is in the folder scripts and not installed
	**{name: f"laboratory.{name}" for name in ("calibration", "instructions", "jobs", "tradeoff", "tradeoffpicture")},
	"study": "laboratory.study and yadeblocks.provenance"
}


def __getattr__(name):
	"""Says where a module is that has moved; `import yadeblocks.jobs` is not asked here."""
	if name in _moved: raise ImportError(f"yadeblocks.{name} is {_moved[name]} now; laboratory is in the folder scripts, which is not installed")
	raise AttributeError(f"module 'yadeblocks' has no attribute {name!r}")
