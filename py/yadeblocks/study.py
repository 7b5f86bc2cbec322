# yade-blocks, GPL-2.0-or-later
"""Error against run time: how a curve is read, how runs are kept, what is worth its price.

Everything here is plain Python with numpy, for the driver scripts/benchmark.py as for scripts that run inside YADE.
"""
import ast
import hashlib
import json
import math
from pathlib import Path

import numpy as np

# ---- reading a curve, the same way for all models


def measure(experiment, x, y):
	"""The quantities of one stress curve: {name: (value, unit)}; x in mm (compression: strain in permille), y in N/mm2 = MPa.

	A peak is the highest value of the running mean over 2 % of the way to the highest sample, so that noise does not count as
	strength; stiffness is fitted below 0.3 of the peak (compression: from 0.05 to 0.33) or, where a curve jumps over that range, is the
	slope of the jump; the residual stress is the mean over the last quarter of the path."""
	x, y = np.asarray(x, float), np.asarray(y, float)
	top = int(y.argmax())
	window = max(1, round(0.02 * top))
	peak = np.convolve(y, np.ones(window) / window, mode="valid").max()
	low, high = {"tension": (0.02, 0.3), "shear": (0.1, 0.4), "compression": (0.05, 0.33)}[experiment]
	elastic = np.flatnonzero((y > low * y[top]) & (y < high * y[top]) & (np.arange(len(y)) < top))
	slope = np.polyfit(x[elastic], y[elastic], 1)[0] if len(elastic) > 2 else _jump(x, y, low * y[top], high * y[top])
	if experiment == "tension":
		return {"peak_tensile_stress": (peak, "MPa"), "joint_stiffness": (slope, "N/mm3")}
	if experiment == "shear":
		residual = y[x > 0.75 * x[-1]].mean() if x[-1] > 0 else math.nan
		return {"peak_shear_stress": (peak, "MPa"), "residual_shear_stress": (residual, "MPa"), "shear_stiffness": (slope, "N/mm3")}
	return {"compressive_strength": (peak, "MPa"), "youngs_modulus": (1e3 * slope, "MPa")}


def _jump(x, y, low, high):
	"""Slope from the last sample below `low` (the origin, if the curve begins above) to the first above `high`."""
	above = int(np.argmax(y >= high))
	below = np.flatnonzero(y[:above] <= low)
	x0, y0 = (x[below[-1]], y[below[-1]]) if len(below) else (0.0, 0.0)
	return (y[above] - y0) / (x[above] - x0) if x[above] > x0 and y[above] >= high > 0 else math.nan


def expectations(experiment, sigma=0.0):
	"""What the laboratory (for the stiffness across the joint in tension: theory) says: {name: (value, source)}; sigma [Pa]."""
	if experiment == "tension":
		return {"peak_tensile_stress": (0.35, "Van der Pluijm 1992"), "joint_stiffness": (36.07, "series of mortar and joints")}
	if experiment == "shear":
		return {
		        "peak_shear_stress": (0.87 + 1.01 * sigma / 1e6, "Van der Pluijm 1993"),
		        "residual_shear_stress": (0.73 * sigma / 1e6 or None, "Van der Pluijm 1993")
		}
	return {"compressive_strength": (27.5, "Oliveira 2003"), "youngs_modulus": (4100., "Oliveira 2003")}


def calibratedParameters(path, model, experiment):
	"""Micro-parameters of a sphere model from scripts/calibrated.json; an empty dictionary if it was not calibrated for this."""
	return json.loads(Path(path).read_text()).get(f"{model} {experiment}", {}).get("parameters", {})


# ---- runs that are kept


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
			waiting += [file for file in (Path(package) / f"{name}.py",) if file.exists()]
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
