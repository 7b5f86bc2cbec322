# yade-blocks, GPL-2.0-or-later
"""The code that a script depends on, and a hash of it."""
import ast
import hashlib
import json
from pathlib import Path


def sourcesOf(script, package):
	"""The Python files that a script depends on: itself and the modules of yadeblocks that it imports, and those that they import.

	script: its path; package: the folder py/yadeblocks. Read from the import statements, so nothing is executed."""
	found, waiting = set(), [Path(script)]
	while waiting:
		path = waiting.pop()
		if path in found:
			continue
		found.add(path)
		for name in _imported(path, inside=path.parent == Path(package)):
			waiting += [file for file in (Path(package) / f"{name}.py", ) if file.exists()]
	return sorted(found)


def _imported(path, inside):
	"""Names of modules of yadeblocks imported by this file; `inside` the package imports may be relative."""
	for node in ast.walk(ast.parse(path.read_text())):
		if isinstance(node, ast.Import):
			for alias in node.names:
				if alias.name.split(".")[0] == "yadeblocks":
					yield from ["__init__"] + alias.name.split(".")[1:2]
		elif isinstance(node, ast.ImportFrom):
			parts = (node.module or "").split(".")
			if node.level and inside:
				yield from [parts[0]] if parts[0] else [alias.name for alias in node.names]
			elif not node.level and parts[0] == "yadeblocks":
				yield from ["__init__"] + (parts[1:2] or [alias.name for alias in node.names])


def fingerprint(paths, *more):
	"""A hash of the contents of files, and of any further values that json can write. Names count only where contents are equal."""
	digest = hashlib.sha256(json.dumps(more, sort_keys=True).encode())
	for path in sorted(Path(path) for path in paths):
		digest.update(f"\0{path.name}\0".encode())
		digest.update(hashlib.sha256(path.read_bytes()).digest())
	return digest.hexdigest()
