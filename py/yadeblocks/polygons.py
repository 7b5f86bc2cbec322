# yade-blocks, GPL-2.0-or-later
"""Polygons: rings of corners (n, 2) [m], and shapely's.

Areas and senses need numpy alone; what cuts, joins and shrinks polygons needs shapely (Debian's python3-shapely)."""
import numpy as np

from ._kinds import wrong
from .plane import cross


def area(ring):
	"""Area of a polygon [m2], positive if it is counter-clockwise."""
	x, y = np.asarray(ring, float).T
	return (x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def counterClockwise(ring):
	"""The polygon as an (n, 2) array with material on the left [m]; ValueError if it has less than three corners or no area."""
	said = wrong('an outline', ring, 'polygon')
	if said: raise ValueError(str(said))
	ring = np.array(ring, float)
	if len(ring) > 3 and (ring[0] == ring[-1]).all(): ring = ring[:-1]
	size = area(ring)
	if not abs(size) > 0: raise ValueError('a polygon must have an area, got one of %g' % size)
	return ring if size > 0 else ring[::-1]


def region(name, outline, holes):
	"""A polygon of shapely's with holes; name: of the argument that is refused where they are not simple."""
	shapely = needShapely()
	found = shapely.geometry.Polygon(outline, holes)
	if not found.is_valid: raise ValueError(f'{name} must be a simple polygon that holds its holes: ' + shapely.validation.explain_validity(found))
	return found


def fromBelow(pieces):
	"""Polygons of shapely's in order of their centroids from below, then from the left."""
	return sorted(pieces, key=lambda piece: (round(piece.centroid.y, 9), piece.centroid.x))


def outlineOf(piece):
	"""The corners of a polygon of shapely's, the first one again at the end."""
	return np.array(piece.exterior.coords)


def holesOf(piece):
	"""The corners of the holes of a polygon of shapely's: a list of rings."""
	return [np.array(ring.coords)[:-1] for ring in piece.interiors]


def corners(ring):
	"""Corners of a ring of shapely's, those on straight sides left out, to the nanometre: neighbours' corners are then the same."""
	points = np.round(np.array(ring.coords)[:-1], 9)
	before, behind = points - np.roll(points, 1, axis=0), np.roll(points, -1, axis=0) - points
	bends = abs(cross(before, behind)) > 1e-9 * np.hypot(*before.T) * np.hypot(*behind.T)
	return points[bends]


def joinSmall(pieces, least):
	"""Polygons of shapely's of which those with less area than `least` [m2] have joined the neighbour with the longest side in common; how many."""
	shapely, merged = needShapely(), 0
	while True:
		small = min(pieces, key=lambda piece: piece.area)
		if small.area >= least or len(pieces) == 1: return pieces, merged
		side = lambda piece: small.intersection(piece).length if piece is not small else -1
		neighbour = max(pieces, key=side)
		if not side(neighbour) > 0: raise ValueError(f'a block of {small.area:g} m2 has no neighbour to join')
		pieces = [shapely.ops.unary_union([small, piece]) if piece is neighbour else piece for piece in pieces if piece is not small]
		merged += 1


def needShapely():
	"""The module shapely; ImportError with a sentence where it is not installed."""
	try:
		import shapely.geometry
		import shapely.ops
		import shapely.validation
	except ImportError as error:
		raise ImportError('this needs shapely: scripts/install.sh python3-shapely') from error
	return shapely
