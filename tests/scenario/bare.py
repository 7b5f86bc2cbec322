# yade-blocks, GPL-2.0-or-later
"""Modules of yadeblocks without the plugin, which importing their package would load."""
import importlib
import sys
import types
from pathlib import Path

package = Path(__file__).parents[2] / "py" / "yadeblocks"


def modules(*names):
	"""These modules, in this order; the real package, which other tests want, stays what it is."""
	ours = lambda: [name for name in sys.modules if name.partition(".")[0] == "yadeblocks"]
	before = {name: sys.modules.pop(name) for name in ours()}
	sys.modules["yadeblocks"] = types.ModuleType("yadeblocks")
	sys.modules["yadeblocks"].__path__ = [str(package)]
	found = [importlib.import_module("yadeblocks." + name) for name in names]
	for name in ours():
		del sys.modules[name]
	sys.modules.update(before)
	return found
