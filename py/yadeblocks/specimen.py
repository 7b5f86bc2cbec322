# yade-blocks, GPL-2.0-or-later
"""Choosing and measuring: rectangles, grid points and edges by place, gauges across joints."""
import numpy as np

from ._door import door
from .readings.blocks import blockOfNodes


def addCells(model, cells, outline, material, **options):
	"""Fills an outline with blocks: cells is "voronoi" (BlockModel.addVoronoi) or "triangles" (addTriangles); what they return."""
	return {"voronoi": model.addVoronoi, "triangles": model.addTriangles}[cells](outline, material, **options)


@door('x0', 'y0', 'x1', 'y1')
def rectangle(x0, y0, x1, y1):
	"""Corners of a rectangle, counter-clockwise [m]."""
	return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


@door(model='model', rule='functionOfPlace', label='str')
def nodesWhere(model, rule, label=None):
	"""Indices of the grid points for which rule(x, y) holds in the reference state.

	rule gets two arrays [m] and returns a boolean array; label keeps to blocks of one material.
	An empty choice is a ValueError: a condition that reaches nothing is a mistake.
	"""
	x, y = model.reference.T
	chosen = np.array(rule(x, y))
	if chosen.dtype != bool or chosen.shape != x.shape:
		raise ValueError(
			'nodesWhere.rule must return True or False for each of %d grid points, got an array of %s, %r' % (len(x), chosen.dtype, chosen.shape)
		)
	if label is not None: chosen &= blocksOf(model, label)[blockOfNodes(model)]
	if not chosen.any(): raise ValueError('nodesWhere: no grid point is chosen by the rule')
	return np.flatnonzero(chosen)


@door(model='model', rule='functionOfPlace', label='str')
def edgesWhere(model, rule, label=None):
	"""Indices of the boundary edges both of whose ends are chosen by rule(x, y); see nodesWhere."""
	inside = np.zeros(model.nodeCount, dtype=bool)
	inside[nodesWhere(model, rule, label)] = True
	edges = np.flatnonzero(inside[model.edgeNodes].all(axis=1))
	if not len(edges): raise ValueError('edgesWhere: no boundary edge is chosen by the rule')
	return edges


@door(model='model', label='str')
def blocksOf(model, label):
	"""Boolean array over the blocks: which are of the material with this label."""
	labels = list(model.materialLabels)
	if label not in labels: raise ValueError('no material %r in the model; there are %s' % (label, ', '.join(labels)))
	return model.blockMaterial == labels.index(label)


class Gauge:
	"""Mean displacement of some grid points relative to others, as an LVDT across a joint reads it.

	>>> gauge = Gauge(model, below=nodesWhere(...), above=nodesWhere(...), axis='y')
	>>> gauge()  # [m]
	"""
	@door(model='model', below='nodes', above='nodes')
	def __init__(self, model, below, above, axis='y'):
		if axis not in ('x', 'y'): raise ValueError("Gauge: axis must be 'x' or 'y', got %r" % axis)
		self.model, self.below, self.above, self.axis = model, below, above, 'xy'.index(axis)

	def __call__(self):
		position, reference, axis = self.model.position, self.model.reference, self.axis
		displacement = lambda nodes: (position[nodes, axis] - reference[nodes, axis]).mean()
		return displacement(self.above) - displacement(self.below)
