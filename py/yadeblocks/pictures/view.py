# yade-blocks, GPL-2.0-or-later
"""Where everything is drawn: deformed shapes, how much they are magnified, and the window on them."""
import math

import numpy as np

from ..readings.present import Present


class View:
	"""What a picture shows of a model: the grid points in their deformed shape, `shown`, magnified by `magnification`, between `low` and `high` [m];
	`there`: what has not been removed."""
	def __init__(self, model, magnification, window):
		self.model, reference = model, np.asarray(model.reference)
		self.there, self.displacement = Present(model), model.position - reference
		self.carried = np.median(self.displacement[self.there.nodes], axis=0) # what the whole has moved by
		displacement = self.displacement - self.carried
		self.magnification = visible(
			np.ptp(reference[self.there.nodes], axis=0).max(), displacement[self.there.nodes]
		) if magnification is None else magnification
		self.shown = reference + self.magnification * displacement
		self.low, self.high = windowAround(reference, self.shown, self.there.nodes) if window is None else cornersOf(window)

	@property
	def size(self):
		"""Width and height of the window [m]."""
		return self.high - self.low


def visible(size, displacement):
	"""The round magnification, at least 1, by which nearly all displacements become 2 % of the specimen's size at most."""
	largest = np.percentile(np.hypot(*displacement.T), 98)
	return max(1, roundDown(0.02 * size / largest)) if largest > 1e-9 * size else 1


def windowAround(reference, shown, there=True):
	"""Corners of a view of all that is shown: the deformed shape, and the undeformed one of the same blocks; fragments count that are within the specimen's
	size of it. there: a mask of the grid points of blocks that have not been removed."""
	kept = reference[np.broadcast_to(there, len(reference))]
	low, high = kept.min(axis=0), kept.max(axis=0)
	size = (high - low).max()
	near = ((shown > low - size) & (shown < high + size)).all(axis=1) & there
	low, high = np.minimum(low, shown[near].min(axis=0, initial=np.inf)), np.maximum(high, shown[near].max(axis=0, initial=-np.inf))
	margin = 0.015 * (high - low).max()
	return low - margin, high + margin


def cornersOf(window):
	"""Lower left and upper right corner of a window (x0, y0, x1, y1)."""
	low, high = np.reshape(window, (2, 2))
	if not (low < high).all(): raise ValueError(f"window must have x0 < x1 and y0 < y1, got {window!r}")
	return low, high


def roundDown(number):
	"""The next 1, 2 or 5 times a power of ten that is not larger."""
	power = 10.0**math.floor(math.log10(number))
	return max(factor for factor in (1, 2, 5) if factor * power <= number * (1 + 1e-12)) * power
