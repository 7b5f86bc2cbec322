# yade-blocks, GPL-2.0-or-later
"""Blocks that a builder has laid out, and the names of the joints between them.

	wall = runningBond(bricks=5, courses=6, length=0.4, height=0.175)      # a Layout: nothing is in a model yet
	placed = wall.addTo(model, 'unit', zoneSize=0.1)                       # or rigid=True
	joints = placed.bond(model, [JointMat(...)], head=dict(tension=0))     # {'bed': array, 'head': array, ...}
	model.setJoints('bed', cohesion=0.35e6)                                # also later: the names are the model's
	Cracks(model), pictures.drawCracks(path, model)                        # results and pictures by name

Builders: brickwork, voussoirs, jointsets; their outlines are plain arrays, so that whatever can make polygons is one."""
from collections import Counter

import numpy as np

from ._calls import door
from .plane import unit
from .polygons import area, corners, counterClockwise, needShapely
from .readings.joints import onEdge


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


class Mortared:
	"""A Layout whose blocks stand back by half a joint, and the mortar between them.

	walls = Mortared(runningBond(bricks=4.5, courses=18, length=0.21, height=0.052, joint=0.01), 0.01)
	placed = walls.addTo(model, 'unit', 'mortar', zoneSize=0.06, size=5e-3, seed=1)       # mortar of Voronoi blocks

	layout: of blocks that touch; gap: thickness of the mortar [m]. Sides at the outside and at openings stay where they are, and so do those between parts
	of one piece (a possible crack in mid-brick). `blocks`: a Layout; `mortar`: a list of (outline, holes) [m]. Needs shapely (Debian's python3-shapely).
	Errors: ValueError where a block is too thin for its mortar."""
	@door('gap', layout='layout')
	def __init__(self, layout, gap):
		if not gap > 0: raise ValueError(f'Mortared.gap must be positive, got {gap!r}')
		shapely = needShapely()
		self.layout, self.gap = layout, gap
		shapes = [shapely.geometry.Polygon(ring, holes) for ring, holes in zip(layout.outlines, layout.holes)]
		region = shapely.ops.unary_union(shapes)
		around = shapely.geometry.box(*region.bounds).buffer(4 * gap, join_style=2)
		outside = around.difference(region)
		within = around.buffer(-2 * gap, join_style=2) # the frame's own rim is eroded, too
		pieces = {piece: shapely.ops.unary_union([shapes[i] for i in np.flatnonzero(layout.pieces == piece)]) for piece in set(layout.pieces.tolist())}
		smaller = {
			piece: shapely.ops.unary_union([shape, outside]).buffer(-gap / 2, join_style=2, mitre_limit=10).intersection(within)
			for piece, shape in pieces.items()
		}
		stones = [shape.intersection(smaller[piece]) for shape, piece in zip(shapes, layout.pieces.tolist())]
		for number, stone in enumerate(stones):
			if stone.geom_type != 'Polygon' or stone.area <= 0:
				raise ValueError(
					f'Mortared.gap must leave something of every block, got {gap!r} for block {number} of {shapes[number].area:g} m2'
				)
		self.blocks = Layout([corners(stone.exterior) for stone in stones], layout.kinds, layout.pieces, layout.nameOf,
					[[corners(ring) for ring in stone.interiors] for stone in stones], **layout.notes)
		solid = [shapely.geometry.Polygon(ring, holes) for ring, holes in zip(self.blocks.outlines, self.blocks.holes)]
		region = shapely.geometry.Polygon(corners(region.exterior), [corners(ring) for ring in region.interiors])
		rest = region.difference(shapely.ops.unary_union(solid))
		self.mortar = [(corners(part.exterior), [corners(ring) for ring in part.interiors]) for part in getattr(rest, 'geoms', [rest]) if part.area > 0]

	@door('zoneSize', 'size', model='model', material='str', mortar='str')
	def addTo(self, model, material, mortar, zoneSize, size, **voronoi):
		"""Adds Voronoi blocks of the material `mortar` and the blocks of `material` to a BlockModel -> Placed.

		zoneSize: in the blocks; size and what follows: of the mortar, as in BlockModel.addVoronoi. Joints of blocks with mortar (and with all else)
		are named 'mortar' by Placed.joints; those within the mortar have no name."""
		for outline, holes in self.mortar:
			model.addVoronoi(counterClockwise(outline).tolist(), mortar, size=size, holes=[ring.tolist() for ring in holes], **voronoi)
		return Placed(self.blocks, self.blocks.addTo(model, material, zoneSize=zoneSize).blocks, outside='mortar')
