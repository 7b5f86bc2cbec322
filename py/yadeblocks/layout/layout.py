# yade-blocks, GPL-2.0-or-later
"""Blocks that a builder has laid out."""
from collections import Counter

import numpy as np

from .._door import door
from ..plane import unit
from ..polygons import area, counterClockwise
from .placed import Placed


class Layout:
	"""What a builder returns.

	outlines: a list of (n, 2) arrays, counter-clockwise [m]; kinds: a word for each block ('whole', 'half', ...); pieces: a number for each block, the same
	for those that are parts of one brick; nameOf(normals, ends, samePiece): see `Placed.joints`; notes: what else the builder has to say, by name."""
	@door(outlines='sequence', kinds='sequence', pieces='sequence', nameOf='function', holes='sequence')
	def __init__(self, outlines, kinds, pieces, nameOf, holes=None, **notes):
		self.outlines, self.kinds, self.pieces = [counterClockwise(ring) for ring in outlines], list(kinds), np.asarray(pieces)
		self.holes = holes or [[] for _ in self.outlines]
		self.nameOf, self.notes = nameOf, notes
		if not len(self.outlines) == len(self.kinds) == len(self.pieces) == len(self.holes):
			raise ValueError('Layout: a kind and a piece for every outline')
		if not self.outlines: raise ValueError('Layout: there is no block')

	@property
	def counts(self):
		"""Number of blocks of each kind."""
		return dict(Counter(self.kinds))

	@property
	def areas(self):
		"""Areas of the blocks [m2]."""
		return np.array([area(ring) - sum(abs(area(hole)) for hole in holes) for ring, holes in zip(self.outlines, self.holes)])

	@property
	def bounds(self):
		"""x0, y0, x1, y1 [m]."""
		points = np.vstack(self.outlines)
		return (*points.min(axis=0), *points.max(axis=0))

	@door('angle', about='point')
	def turned(self, angle, about=(0.0, 0.0)):
		"""The same blocks, turned counter-clockwise by an angle [rad] about a point [m] -> Layout. Joints have the names that they had. Notes are left
		behind, since they may tell places."""
		about, (cos, sin) = np.asarray(about, float), unit(angle)
		turn = np.array([[cos, sin], [-sin, cos]]) # of rows
		moved = lambda ring: (np.asarray(ring, float) - about) @ turn + about
		nameOf = lambda normals, ends, samePiece: self.nameOf(normals @ turn.T, (ends - about) @ turn.T + about, samePiece)
		return Layout([moved(ring) for ring in self.outlines], self.kinds, self.pieces, nameOf, [[moved(hole) for hole in some] for some in self.holes])

	@door('zoneSize', model='model', material='str', rigid='flag')
	def addTo(self, model, material, zoneSize=None, rigid=False, **region):
		"""Adds all blocks to a BlockModel -> Placed. material: a label; zoneSize [m] and further arguments as in BlockModel.addRegion, or
		rigid=True."""
		if rigid == (zoneSize is not None):
			raise ValueError(f'Layout.addTo must be given either zoneSize or rigid=True, got zoneSize={zoneSize!r} and rigid={rigid!r}')
		if rigid and region: raise ValueError(f'Layout.addTo: rigid blocks have no {", ".join(region)}')
		add = lambda ring, holes: model.addRigid(ring.tolist(), material, holes=holes
								) if rigid else model.addRegion(ring.tolist(), material, zoneSize, holes=holes, **region)
		return Placed(self, [add(ring, [np.asarray(hole).tolist() for hole in holes]) for ring, holes in zip(self.outlines, self.holes)])
