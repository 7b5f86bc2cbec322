# yade-blocks, GPL-2.0-or-later
"""Reading a stress curve, the same way for all models, and what the laboratory says."""
import math

import numpy as np


def measure(experiment, x, y):
	"""The quantities of one stress curve: {name: (value, unit)}; x in mm (compression: strain in permille), y in N/mm2 = MPa.

	A peak is the highest value of the running mean over the samples of the last 2 % of the way to the highest one, so that noise does
	not count as strength; stiffness is fitted below 0.3 of the peak (compression: from 0.05 to 0.33) or, where a curve jumps over that range, is the
	slope of the jump; the residual stress is the mean over the last quarter of the path."""
	x, y = np.asarray(x, float), np.asarray(y, float)
	top = int(y.argmax())
	window = max(1, np.count_nonzero(x[:top + 1] >= 0.98 * x[top])) if x[top] > 0 else 1
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
	"""What the laboratory (for the stiffness across the joint in tension: theory) says: {name: (value, source)}; sigma [Pa].

	The stiffness is that of blocks with edges of 2 mm; a scenario with others says so itself."""
	if experiment == "tension":
		side = 1.61 * 2e-3 # square root of the area of a block [m]
		layer = 15e-3 * (1 - 0.2**2) / 2.974e9 + 15e-3 / (0.92 * 400e9 * side) + 1 / 400e9 # mortar, joints within, one more joint [m/Pa]
		return {"peak_tensile_stress": (0.35, "Van der Pluijm 1992"), "joint_stiffness": (1e-9 / layer, "series of mortar and joints")}
	if experiment == "shear":
		return {
			"peak_shear_stress": (0.87 + 1.01 * sigma / 1e6, "Van der Pluijm 1993"),
			"residual_shear_stress": (0.73 * sigma / 1e6 or None, "Van der Pluijm 1993")
		}
	return {"compressive_strength": (27.5, "Oliveira 2003"), "youngs_modulus": (4100., "Oliveira 2003")}
