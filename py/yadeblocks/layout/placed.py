# yade-blocks, GPL-2.0-or-later
"""A layout in a model, and the names of its joints."""
import numpy as np

from .._door import door
from ..readings.joints import onEdge


class Placed:
	"""A Layout in a model. `blocks`: the index of each of its blocks; `layout`: whose it is; `outside`: name of joints with blocks that are not its own."""
	def __init__(self, layout, blocks, outside='platen'):
		self.layout, self.blocks, self.outside = layout, np.array(blocks), outside

	@door(kind='str')
	def of(self, kind):
		"""Indices of the blocks of this kind; ValueError if there is none."""
		chosen = self.blocks[np.array(self.layout.kinds) == kind]
		if not len(chosen): raise ValueError(f'no block of the kind {kind!r}; there are {", ".join(sorted(self.layout.counts))}')
		return chosen

	@door(model='model', joints='sequence')
	def bond(self, model, joints, **properties):
		"""BlockModel.bond(joints), names for the joints (BlockModel.nameJoints), and then other properties for joints of a name:
		bed=dict(cohesion=..., ...), as in BlockModel.setJoints. Returns the joints by name, as `joints` does. ValueError for a name that no joint
		has; the model is bonded then."""
		model.bond(joints)
		named = self.nameJoints(model)
		for name in properties:
			if name not in named: raise ValueError(f'Placed.bond: no joint has the name {name!r}; there are {", ".join(named)}')
		for name, values in properties.items():
			model.setJoints(named[name], **values)
		return named

	@door(model='model')
	def nameJoints(self, model):
		"""Gives the model's joints the builder's names, as `joints` returns them; after BlockModel.bond, for several layouts in one model."""
		named = self.joints(model)
		for name, some in named.items():
			model.nameJoints(name, some)
		return named

	@door(model='model')
	def joints(self, model):
		"""Joints by name, indices for BlockModel.setJoints: {'bed': array, 'head': array, ..., 'platen': array}, each of those with the builder's names
		that exists; 'platen' (`outside`) are those with blocks that are not of this layout. After bond(); RuntimeError before."""
		pairs = np.asarray(model.segmentBlocks)
		if not len(pairs): raise RuntimeError('Placed.joints: there are no joints; BlockModel.bond() makes them')
		place = np.full(max(pairs.max(), self.blocks.max()) + 1, -1)
		place[self.blocks] = np.arange(len(self.blocks))
		ours = place[pairs]
		within = (ours >= 0).all(axis=1)
		names = np.where((ours >= 0).any(axis=1), self.outside, '').astype(object)
		ends = onEdge(model, model.reference, 0)[within]
		pieces = self.layout.pieces[ours[within]]
		names[within] = self.layout.nameOf(np.asarray(model.normal)[within], ends, pieces[:, 0] == pieces[:, 1])
		return {name: np.flatnonzero(names == name) for name in sorted(set(names) - {''})}
