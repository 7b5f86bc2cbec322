# yade-blocks, GPL-2.0-or-later
"""What scenarios there are and what they can be told; works before anything is built.

	python3 -m yadeblocks.help scripts                # one line for each scenario
	python3 -m yadeblocks.help scripts/shear.py       # what it says of itself, and its keys
	python3 -m yadeblocks.help scripts/shear.py size=0.003    # nothing, or what is wrong with these keys, and code 2
"""
import ast
import signal
import sys
from pathlib import Path


def scenarios(folder):
	"""Name and first line of the docstring of every scenario in a folder, in alphabetical order. A script that has a command of its own beside it
	(benchmark.sh) is none."""
	folder = Path(folder)
	return {path.stem: _words(path).partition("\n")[0] for path in sorted(folder.glob("*.py")) if not path.with_suffix(".sh").exists()}


def listing(folder):
	"""The scenarios as a table of text."""
	known = scenarios(folder)
	width = max(map(len, known), default=0)
	return "\n".join(f"  {name:<{width}}  {line}".rstrip() for name, line in known.items())


def explain(path):
	"""Prints what a scenario says of itself and its keys with defaults, units and meanings.

	The script is run up to its scenario.parameters(...), which prints the keys and ends it, without its imports of YADE, which is not needed until
	then."""
	path = Path(path)
	print(_words(path) or path.stem, end="\n\n")
	if not _hasParameters(path): return print("It has no keys.")
	_runToItsKeys(path, "help")


def check(path, *words):
	"""Ends with code 2 and a sentence on stderr where a scenario refuses these words, key=value; scripts that want YADE itself before their keys are not
	looked into. A script that reads no words at all has no keys: threads= alone is known then, which is YADE's own."""
	if not _hasParameters(Path(path)):
		unknown = [word for word in words if not word.startswith("threads=")]
		if not unknown or "argv" in Path(path).read_text(): return
		print(f"{Path(path).stem} has no keys, got {unknown[0]}", file=sys.stderr)
		sys.exit(2)
	from . import scenario
	parameters = scenario.parameters

	def only(*given, **named):
		parameters(*given, **named)
		sys.exit(0)

	scenario.parameters = only
	try:
		_runToItsKeys(path, *words)
	except Exception: # a script of one's own that wants more of YADE before its keys: it will say itself what is wrong
		return
	finally:
		scenario.parameters = parameters


def _runToItsKeys(path, *words):
	code, before = compile(_WithoutYade().visit(_parsed(path)), str(path), "exec"), sys.argv
	sys.argv = [str(path), *words]
	try:
		exec(code, {"__name__": "__main__", "__file__": str(path)})
	except SystemExit as end:
		if end.code: raise
	finally:
		sys.argv = before


class _WithoutYade(ast.NodeTransformer):
	"""Leaves out a script's imports of YADE."""
	def visit_Import(self, node):
		node.names = [alias for alias in node.names if not _isYade(alias.name)]
		return node if node.names else ast.copy_location(ast.Pass(), node)

	def visit_ImportFrom(self, node):
		return ast.copy_location(ast.Pass(), node) if not node.level and _isYade(node.module) else node


def _isYade(module):
	return module.split(".")[0] == "yade"


def _parsed(path):
	return ast.parse(Path(path).read_text())


def _words(path):
	return ast.get_docstring(_parsed(path)) or ""


def _hasParameters(path):
	called = [node.func for node in ast.walk(_parsed(path)) if isinstance(node, ast.Call)]
	return any(getattr(function, "attr", getattr(function, "id", "")) == "parameters" for function in called)


if __name__ == "__main__":
	signal.signal(signal.SIGPIPE, signal.SIG_DFL) # quiet where the reader (head, say) has had enough
	keys = [word for word in sys.argv[1:] if "=" in word]
	for place in map(Path, (word for word in sys.argv[1:] if "=" not in word)):
		if place.is_dir(): print(listing(place))
		elif keys: check(place, *keys)
		else: explain(place)
