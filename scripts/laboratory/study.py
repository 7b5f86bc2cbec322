# yade-blocks, GPL-2.0-or-later
"""What a run of the study is: its settings as text, and what its code means."""
import ast
from pathlib import Path


def meaning(path):
	"""The code of a Python file as text that comments, docstrings and layout leave as it is."""
	tree = ast.parse(Path(path).read_text())
	for node in ast.walk(tree):
		if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(node) is not None:
			del node.body[0]
	return ast.dump(tree)


def settingsKey(settings):
	"""Settings as text, in one order, however they were given: "alpha=0.3 steps=40000"; 4e4, 40000.0 and 40000 are the same."""
	return " ".join(f"{key}={plain(value)}" for key, value in sorted(settings.items()))


def plain(value):
	"""A value as the command line takes it."""
	if isinstance(value, bool):
		return str(value).lower()
	if isinstance(value, float):
		return repr(int(value)) if value.is_integer() and abs(value) < 1e15 else repr(value)
	return str(value)


def inWords(settings):
	"""A setting in a few words: what it is in mm, thousands of steps, and so on."""
	words = {
		"steps": lambda n: f"{n / 1000:g}k steps", "size": lambda x: f"{1e3 * x:g} mm", "unitSize": lambda x: f"{1e3 * x:g}",
		"joints": lambda which: f"{which} joints", "tail": lambda x: f"to {100 * x:g} %", "mortarSize": lambda x: f"/ {1e3 * x:g} mm",
		"radius": lambda x: f"r {1e3 * x:.3g} mm", "plane": lambda x: f"plane {x}", "units": lambda x: f"{x} units", "solver": lambda x: x,
		"release": lambda x: f"{x}s", "damping": lambda x: f"{x} damping", "servo": lambda on: "servo"
		if on else "no servo", "afterPeak": lambda on: "on behind the peak" if on else "to the peak", "jump": lambda on: "jump" if on else "no jump"
	}
	return " ".join(words.get(key, lambda x: f"{key} {x}")(value) for key, value in settings.items())
