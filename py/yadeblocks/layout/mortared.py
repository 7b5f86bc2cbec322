# yade-blocks, GPL-2.0-or-later
"""Mortar between the blocks of a layout."""
import numpy as np

from .._door import door
from ..polygons import corners, counterClockwise, needShapely
from .layout import Layout
from .placed import Placed


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
