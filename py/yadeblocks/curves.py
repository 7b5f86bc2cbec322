# yade-blocks, GPL-2.0-or-later
"""Reading a stress curve, the same way for all models: what a peak is, and the stiffness before and the residual stress behind it."""
import math

import numpy as np

fall = 0.05 # share of the highest value by which y must fall behind it to have shown a peak
noise = 0.02 # share of the way to the peak over which `measure` takes means


def peak(x, y, smooth=0.0):
	"""The highest value of the running mean of y over `smooth` times the way x to the highest sample, and the index of that sample: (value, index).

	Without `smooth` it is the highest sample. Bonded spheres are so noisy that single samples are no strength; what compares models smooths all of them."""
	x, y = np.asarray(x, float), np.asarray(y, float)
	top = int(y.argmax())
	window = max(1, np.count_nonzero(x[:top + 1] >= (1 - smooth) * x[top])) if x[top] > 0 and smooth else 1
	return np.convolve(y, np.ones(window) / window, mode="valid").max(), top


def firstPeak(y):
	"""Index of the highest value before y falls by 5 % for the first time; what oscillates below half of the highest is no peak."""
	y = np.asarray(y, float)
	highest = np.maximum.accumulate(y)
	fallen = np.flatnonzero((y < (1 - fall) * highest) & (highest > y.max() / 2))
	return int(np.argmax(y[:fallen[0] if len(fallen) else len(y)]))


def hasPeak(y):
	"""Whether y falls by 5 % after its highest value; what only rises has not shown its peak."""
	y = np.asarray(y, float)
	return bool(np.isfinite(y).any() and y[np.nanargmax(y):].min() < (1 - fall) * np.nanmax(y))


def atFirst(happened, y):
	"""The value of y where something has happened for the first time, such as a crack; NaN if it has not."""
	happened = np.asarray(happened) > 0
	return np.asarray(y, float)[happened][0] if happened.any() else math.nan


def largestBehindStart(y):
	"""The largest value behind the first tenth of the samples."""
	return y[len(y) // 10:].max()


def behindPeak(x, y, share):
	"""The integral of y over x from the highest sample until y has fallen to `share` of it; NaN if it does not fall so far."""
	x, y = np.asarray(x, float), np.asarray(y, float)
	top = int(y.argmax())
	low = np.flatnonzero(y[top:] <= share * y[top])
	return np.trapz(y[top:top + low[0] + 1], x[top:top + low[0] + 1]) if len(low) else math.nan


def driven(x, y, samples=2000):
	"""A path with snap-back as a machine sees it that drives x upwards: where x goes back, it waits until the path comes by again, and the stress drops.
	Equidistant samples, (x, y), so that means over them are means over the way."""
	x, y = np.asarray(x, float), np.asarray(y, float)
	far, places, values = x[0], [x[0]], [y[0]]
	for i in range(1, len(x)):
		if x[i] <= far: continue
		back = (x[i] - far) / (x[i] - x[i - 1]) # the part of this piece that is new
		places += [far, x[i]]
		values += [y[i] + back * (y[i - 1] - y[i]), y[i]]
		far = x[i]
	even = np.linspace(x[0], far, samples)
	return even, np.interp(even, places, values)


def residual(x, y):
	"""The mean of y over the last quarter of the path x; NaN if there is no path."""
	x, y = np.asarray(x, float), np.asarray(y, float)
	return y[x > 0.75 * x[-1]].mean() if x[-1] > 0 else math.nan


def aboveResidual(x, y):
	"""The area between y and its residual value, from the start until y first falls to it; NaN if it does not."""
	x, y = np.asarray(x, float), np.asarray(y, float)
	low, top = residual(x, y), int(y.argmax())
	behind = np.flatnonzero(y[top:] <= low)
	if not len(behind): return math.nan
	last = top + behind[0] + 1
	return np.trapz(np.maximum(y[:last] - low, 0), x[:last])


class Peak:
	"""A peak that is watched while it comes: `passed` once the stress has fallen below `drop` times its highest value, after something has broken.

	Before, oscillations of a stress near zero are no peak."""
	def __init__(self, drop):
		self.drop, self.value, self.passed = drop, -math.inf, False

	@property
	def kept(self):
		"""What a checkpoint keeps."""
		return [self.value, self.passed]

	@kept.setter
	def kept(self, kept):
		self.value, self.passed = kept

	def look(self, stress, broken):
		"""Takes the present stress and number of broken contact points; whether the stress is below the drop now."""
		self.value = max(self.value, stress)
		below = bool(broken) and stress < self.drop * self.value
		self.passed = self.passed or below
		return below


def measure(experiment, x, y):
	"""The quantities of one stress curve: {name: (value, unit)}; x in mm (compression: strain in permille), y in N/mm2 = MPa.

	The peak is smoothed over the last 2 % of the way to it; stiffness is fitted below 0.3 of the peak (compression: from 0.05 to 0.33) or, where a curve
	jumps over that range, is the slope of the jump; the residual stress is that of `residual`."""
	x, y = np.asarray(x, float), np.asarray(y, float)
	strength, top = peak(x, y, noise)
	low, high = {"tension": (0.02, 0.3), "shear": (0.1, 0.4), "compression": (0.05, 0.33)}[experiment]
	elastic = np.flatnonzero((y > low * y[top]) & (y < high * y[top]) & (np.arange(len(y)) < top))
	slope = np.polyfit(x[elastic], y[elastic], 1)[0] if len(elastic) > 2 else _jump(x, y, low * y[top], high * y[top])
	if experiment == "tension":
		return {"peak_tensile_stress": (strength, "MPa"), "joint_stiffness": (slope, "N/mm3")}
	if experiment == "shear":
		return {"peak_shear_stress": (strength, "MPa"), "residual_shear_stress": (residual(x, y), "MPa"), "shear_stiffness": (slope, "N/mm3")}
	return {"compressive_strength": (strength, "MPa"), "youngs_modulus": (1e3 * slope, "MPa")}


def _jump(x, y, low, high):
	"""Slope from the last sample below `low` (the origin, if the curve begins above) to the first above `high`."""
	above = int(np.argmax(y >= high))
	below = np.flatnonzero(y[:above] <= low)
	x0, y0 = (x[below[-1]], y[below[-1]]) if len(below) else (0.0, 0.0)
	return (y[above] - y0) / (x[above] - x0) if x[above] > x0 and y[above] >= high > 0 else math.nan
