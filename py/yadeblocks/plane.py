# yade-blocks, GPL-2.0-or-later
"""Vectors in the plane.

Unit vectors and grids have the same bits on every processor: numpy's sine and cosine differ in the last bit where it has some for AVX-512 (math's do not)."""
import math

import numpy as np

_digits = 12 # of unit vectors; math's libraries may differ in the sixteenth


def cross(a, b):
	"""How far b lies to the left of a, times the length of a; vectors are the last axis of arrays."""
	return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def left(vectors):
	"""Vectors turned by a right angle, counter-clockwise; they are the last axis of an array."""
	return np.stack([-vectors[..., 1], vectors[..., 0]], axis=-1)


def unit(angles):
	"""Unit vectors at angles [rad], counter-clockwise from the x axis -> (2,) array, or (n, 2) of n angles."""
	angles = np.asarray(angles, float)
	return np.array([(math.cos(a), math.sin(a)) for a in angles.flat]).round(_digits).reshape(angles.shape + (2, ))


def onGrid(points, extent):
	"""Points [m] on a decimal grid of some 1e-10 of an extent [m], so that what rounding parted is one point."""
	return np.round(points, 10 - math.floor(math.log10(extent)) - 1)
