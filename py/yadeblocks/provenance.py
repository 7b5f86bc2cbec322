# yade-blocks, GPL-2.0-or-later
"""The code that a script depends on, and a hash of it."""
import ast
import hashlib
import json
from pathlib import Path


def sourcesOf(script, package):
	"""The Python files that a script depends on: itself and the modules of yadeblocks that it imports, and those that they import.

	script: its path; package: the folder py/yadeblocks. Read from the import statements, so nothing is executed."""
	found, waiting, package = set(), [Path(script)], Path(package)
	while waiting:
		path = waiting.pop()
		if path in found:
			continue
		found.add(path)
		inside = path.relative_to(package).parent.parts if package in path.parents else None
		for names in _imported(path, inside):
			waiting += _filesOf(package, names)
	return sorted(found)


def _imported(path, inside):
	"""Modules of yadeblocks that this file imports, as names from the package on; the last one may be a function.

	inside: the names of the folder that a file of the package lies in, where imports may be relative; None elsewhere."""
	for node in ast.walk(ast.parse(path.read_text())):
		if isinstance(node, ast.Import):
			for alias in node.names:
				first, *names = alias.name.split(".")
				if first == "yadeblocks": yield names
		elif isinstance(node, ast.ImportFrom):
			names = node.module.split(".") if node.module else []
			if node.level and inside is not None: names = [*inside[:len(inside) + 1 - node.level], *names]
			elif node.level or names[0] != "yadeblocks": continue
			else: names = names[1:]
			yield from ([*names, alias.name] for alias in node.names)


def _filesOf(package, names):
	"""The file of a module, and those of the packages that it lies in."""
	places = [package.joinpath(*names[:count]) for count in range(len(names) + 1)]
	files = [place / "__init__.py" for place in places] + [place.with_suffix(".py") for place in places[1:]]
	return [file for file in files if file.is_file()]


def fingerprint(paths, *more):
	"""A hash of the contents of files, and of any further values that json can write. Names count only where contents are equal."""
	digest = hashlib.sha256(json.dumps(more, sort_keys=True).encode())
	for path in sorted(Path(path) for path in paths):
		digest.update(f"\0{path.name}\0".encode())
		digest.update(hashlib.sha256(path.read_bytes()).digest())
	return digest.hexdigest()
