# yade-blocks, GPL-2.0-or-later
"""A measured number beside what it should be."""
import math
from dataclasses import dataclass
from typing import Optional

import numpy as np


@dataclass
class Quantity:
	"""A measured number, with what it should be. Several seeds: the mean and the sample standard deviation, `scatter`."""
	name: str
	unit: str
	measured: float
	expected: Optional[float] = None
	source: Optional[str] = None
	scatter: Optional[float] = None

	@property
	def error(self):
		"""(measured - expected) / expected, None without an expected value."""
		return (self.measured - self.expected) / self.expected if self.expected else None

	def asDict(self):
		entry = {"name": self.name, "unit": self.unit, "measured": self.measured, "expected": self.expected, "source": self.source, "error": self.error}
		return entry if self.scatter is None else {**entry, "scatter": self.scatter}


def meanOf(quantities, runs):
	"""One quantity for the samples of several runs. A sample that is missing or NaN makes the mean NaN: it would be one of other seeds."""
	first = quantities[0]
	for other in quantities[1:]:
		if (other.unit, other.expected, other.source) != (first.unit, first.expected, first.source):
			raise ValueError(f"quantity {first.name} must have one unit, expected value and source in all runs, got {first} and {other}")
	if runs == 1:
		return first
	samples = np.array([quantity.measured for quantity in quantities] + [math.nan] * (runs - len(quantities)))
	return Quantity(first.name, first.unit, samples.mean(), first.expected, first.source, samples.std(ddof=1))
