# yade-blocks, GPL-2.0-or-later
"""Sizes in units in which they are neither tiny nor huge."""
import numpy as np


def inUnit(most, unit):
	"""A size in a unit in which it is neither tiny nor huge, the factor of that unit, and its name."""
	prefixes = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"))
	factor, prefix = next(((factor, prefix) for factor, prefix in prefixes if most >= factor), (1, ""))
	return most / factor, factor, prefix + unit


def nearlyLargest(values):
	"""The size that only a hundredth of the values exceeds; that of the largest if most are nothing."""
	values = np.abs(values)
	return (np.percentile(values, 99) or values.max()) if len(values) else 0
