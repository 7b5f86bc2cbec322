# yade-blocks, GPL-2.0-or-later
"""Blocks that a builder has laid out, and the names of the joints between them.

	wall = runningBond(bricks=5, courses=6, length=0.4, height=0.175)      # a Layout: nothing is in a model yet
	placed = wall.addTo(model, 'unit', zoneSize=0.1)                       # or rigid=True
	model.bond([JointMat(...)])
	joints = placed.joints(model)                                          # {'bed': array, 'head': array, ...}
	model.setJoints(joints['bed'], cohesion=0.35e6)

Builders: brickwork, voussoirs, jointsets; their outlines are plain arrays, so that whatever can make polygons is one."""
from collections import Counter

import numpy as np


def area(ring):
	"""Area of a polygon [m2], positive if it is counter-clockwise."""
	x, y = np.asarray(ring, float).T
	return (x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def counterClockwise(ring):
	"""The polygon as an (n, 2) array with material on the left [m]; ValueError if it has less than three corners or no area."""
	ring = np.array(ring, float)
	if ring.ndim != 2 or ring.shape[1] != 2 or len(ring) < 3: raise ValueError(f'a polygon needs at least three points (x, y), got shape {ring.shape}')
	if len(ring) > 3 and (ring[0] == ring[-1]).all(): ring = ring[:-1]
	size = area(ring)
	if not abs(size) > 0: raise ValueError('a polygon must have an area, got one of %g' % size)
	return ring if size > 0 else ring[::-1]


class Layout:
	"""What a builder returns.

	outlines: a list of (n, 2) arrays, counter-clockwise [m]; kinds: a word for each block ('whole', 'half', ...); pieces: a number for each block, the same
	for those that are parts of one brick; nameOf(normals, ends, samePiece): see `Placed.joints`; notes: what else the builder has to say, by name."""
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

	def addTo(self, model, material, zoneSize=None, rigid=False, **region):
		"""Adds all blocks to a BlockModel -> Placed. material: a label; zoneSize [m] and further arguments as in BlockModel.addRegion, or
		rigid=True."""
		if rigid == (zoneSize is not None): raise ValueError('Layout.addTo: either zoneSize or rigid=True')
		if rigid and region: raise ValueError(f'Layout.addTo: rigid blocks have no {", ".join(region)}')
		add = lambda ring, holes: model.addRigid(ring.tolist(), material, holes=holes
								) if rigid else model.addRegion(ring.tolist(), material, zoneSize, holes=holes, **region)
		return Placed(self, [add(ring, [np.asarray(hole).tolist() for hole in holes]) for ring, holes in zip(self.outlines, self.holes)])


class Placed:
	"""A Layout in a model. `blocks`: the index of each of its blocks; `layout`: whose it is."""
	def __init__(self, layout, blocks):
		self.layout, self.blocks = layout, np.array(blocks)

	def of(self, kind):
		"""Indices of the blocks of this kind; ValueError if there is none."""
		chosen = self.blocks[np.array(self.layout.kinds) == kind]
		if not len(chosen): raise ValueError(f'no block of the kind {kind!r}; there are {", ".join(sorted(self.layout.counts))}')
		return chosen

	def joints(self, model):
		"""Joints by name, indices for BlockModel.setJoints: {'bed': array, 'head': array, ..., 'platen': array}, each of those with the
		builder's names that
		exists; 'platen' are those with blocks that are not of this layout. After bond(); RuntimeError before."""
		pairs = np.asarray(model.segmentBlocks)
		if not len(pairs): raise RuntimeError('Placed.joints: there are no joints; BlockModel.bond() makes them')
		place = np.full(max(pairs.max(), self.blocks.max()) + 1, -1)
		place[self.blocks] = np.arange(len(self.blocks))
		ours = place[pairs]
		within = (ours >= 0).all(axis=1)
		names = np.where((ours >= 0).any(axis=1), 'platen', '').astype(object)
		ends = np.asarray(model.reference)[np.asarray(model.segmentNodes)[within, :2]]
		t = np.asarray(model.segmentParameters)[within, :2, None]
		ends = (1 - t) * ends[:, :1] + t * ends[:, 1:]
		pieces = self.layout.pieces[ours[within]]
		names[within] = self.layout.nameOf(np.asarray(model.normal)[within], ends, pieces[:, 0] == pieces[:, 1])
		return {name: np.flatnonzero(names == name) for name in sorted(set(names) - {''})}
