# yade-blocks, GPL-2.0-or-later
"""Rubble: irregular (Voronoi) stones that fill a polygon, with joints without thickness or, by layout.Mortared, with mortar between them.

	stones = rubble(rectangle(0, 0, 2, 1), size=0.25, seed=1)             # a Layout
	placed = stones.addTo(model, 'stone', zoneSize=0.1)                    # joints are named 'stone'
	placed = Mortared(stones, 0.02).addTo(model, 'stone', 'mortar', zoneSize=0.1, size=0.01)

Needs shapely (Debian's python3-shapely)."""
import numpy as np

from ._door import door
from .layout import Layout
from .polygons import fromBelow, holesOf, joinSmall, needShapely, outlineOf, region


@door('size', 'seed', 'lloyd', 'flatness', outline='polygon', holes='polygons')
def rubble(outline, size, seed=1, lloyd=2, flatness=1.0, holes=()):
	"""Voronoi stones -> layout.Layout with blocks of the kind 'stone'.

	outline, holes: polygons [m]; size: root of the stones' mean area [m]; seed: of the random points; lloyd: iterations towards regular stones;
	flatness: mean width by height of the stones, 2 for flat ones as they are laid. Stones that a hole or a corner cuts in two become two;
	what is less than a twentieth of the mean joins a neighbour.
	Errors: ValueError, and TypeError for what is no number or polygon, which name the argument, the rule and the value."""
	for name, value, fulfilled, rule in (('size', size, size > 0, 'be positive'),
						('lloyd', lloyd, lloyd >= 0
							and lloyd == int(lloyd), 'be a whole number >= 0'), ('flatness', flatness, flatness > 0, 'be positive'),
						('seed', seed, seed >= 0 and seed == int(seed), 'be a whole number >= 0')):
		if not fulfilled: raise ValueError(f'rubble.{name} must {rule}, got {value!r}')
	shapely, whole = needShapely(), region('rubble.outline', outline, holes)
	stretch = np.array([1 / flatness**0.5, flatness**0.5]) # in which stones are as wide as high
	flat = lambda shape, by: shapely.ops.transform(lambda x, y: (np.asarray(x) * by[0], np.asarray(y) * by[1]), shape)
	even = flat(whole, stretch)
	count = max(2, round(whole.area / size**2))
	points = _inside(shapely, even, count, np.random.default_rng(int(seed)))
	for _ in range(int(lloyd) + 1):
		cells = [cell.intersection(even) for cell in shapely.ops.voronoi_diagram(shapely.geometry.MultiPoint(points), envelope=even).geoms]
		cells = [part for cell in cells for part in getattr(cell, 'geoms', [cell]) if part.geom_type == 'Polygon' and part.area > 0]
		points = [cell.centroid for cell in cells]
	cells = joinSmall(cells, size**2 / 20)[0]
	stones = fromBelow(flat(cell, 1 / stretch) for cell in cells)
	return Layout([outlineOf(stone) for stone in stones], ['stone'] * len(stones), np.arange(len(stones)),
			lambda normals, ends, samePiece: np.full(len(normals), 'stone'), [holesOf(stone) for stone in stones])


def _inside(shapely, polygon, count, random):
	"""Random points in a polygon."""
	x0, y0, x1, y1 = polygon.bounds
	points = []
	while len(points) < count:
		point = shapely.geometry.Point(random.uniform(x0, x1), random.uniform(y0, y1))
		if polygon.contains(point): points.append(point)
	return points
