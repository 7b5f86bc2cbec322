# yade-blocks, GPL-2.0-or-later
"""Blocks: which a grid point is of, which are rigid, and what they are as polygons."""
import numpy as np

from .._door import door
from ..plane import cross


def blockOfNodes(model):
	"""The block of every grid point."""
	return np.repeat(np.arange(len(model.firstNode) - 1), np.diff(model.firstNode))


def rigidBlocks(model):
	"""Indices of the rigid blocks, which have no zones."""
	return np.flatnonzero(np.diff(model.firstZone) == 0)


@door(model='model')
def areasAndCentroids(model):
	"""Of every block, holes left out, from its boundary (Green) [m2, m]."""
	ends = np.asarray(model.reference)[np.asarray(model.edgeNodes)]
	owner = np.repeat(np.arange(model.blockCount), np.diff(model.firstEdge))
	origin = ends[np.asarray(model.firstEdge)[:-1], 0][owner]
	a, b = ends[:, 0] - origin, ends[:, 1] - origin
	twice = cross(a, b)
	sums = lambda values: np.bincount(owner, values, model.blockCount)
	areas = sums(twice) / 2
	middle = np.column_stack([sums(twice * (a[:, axis] + b[:, axis])) for axis in range(2)]) / (6 * areas[:, None])
	return areas, middle + ends[np.asarray(model.firstEdge)[:-1], 0]


def blockOutlines(model):
	"""The boundary of every block: a list of rings per block, each an array of node indices, material on the left (holes clockwise)."""
	outlines = []
	for first, last in zip(model.firstEdge[:-1], model.firstEdge[1:]):
		following = dict(np.asarray(model.edgeNodes[first:last]).tolist())
		rings = []
		while following:
			node, end = following.popitem()
			ring = [node]
			while end != ring[0]:
				ring.append(end)
				end = following.pop(end)
			rings.append(np.array(ring))
		outlines.append(rings)
	return outlines
