# yade-blocks, GPL-2.0-or-later
"""A region cut into blocks by sets of joints and by single cracks, as rock and rubble are.

	sets = [JointSet('bedding', dip=20, spacing=0.5), JointSet('cross', dip=-70, spacing=0.8, persistence=0.7, scatter=0.2, seed=3)]
	rock = cut(rectangle(0, 0, 10, 5), sets, cracks={'fault': [(0, 1), (10, 4)]})
	placed = rock.addTo(model, 'rock', zoneSize=0.4)

Joints are named as their set or crack (see layout.Placed.joints). Needs shapely (Debian's python3-shapely)."""
import math
from collections import namedtuple

import numpy as np

from ._door import door
from ._kinds import shown, wrong
from .layout import Layout
from .plane import left, onGrid, unit
from .polygons import fromBelow, holesOf, joinSmall, needShapely, outlineOf, region

#: Parallel joints. dip: angle of the traces with the x axis, counter-clockwise [degrees]; spacing: normal distance [m]; persistence: share of a trace that is
#: joint, the rest is rock; length: mean length of the joints in a trace that is not persistent [m], 0: three spacings; scatter: standard deviation of spacing
#: and lengths by their means (a lognormal law) and of the dip by a radian; seed: of the random numbers; through: a point on the first trace [m], or
#: whole spacings from it where it is beyond the polygon.
JointSet = namedtuple('JointSet', 'name dip spacing persistence length scatter seed through', defaults=(1.0, 0.0, 0.0, 1, (0.0, 0.0)))

_most = 100000 # so many joints of a set at most


@door('least', outline='polygon', sets='sequence', cracks='mapping', holes='polygons')
def cut(outline, sets=(), cracks={}, holes=(), least=0.0):
	"""Cuts a polygon [m] -> layout.Layout with blocks of the kind 'block'.

	sets: JointSets; cracks: name -> points of a polyline [m]; holes: polygons that are left out; least: blocks with less area [m2] join the neighbour with
	which they have the longest side in common.

	A joint that ends within a block does not part it and is left out, as in UDEC. notes: `traces`, name -> list of (2, 2) arrays [m];
	`lostLength`: of what was left out [m]; `merged`: how many blocks joined a neighbour.
	Errors: ValueError for impossible sets, cracks and polygons, TypeError for what is of a wrong kind."""
	if isinstance(sets, JointSet): raise TypeError(f'cut.sets must be a list of JointSets, got {shown(sets)}')
	for joints in sets:
		if not isinstance(joints, JointSet): raise TypeError(f'cut.sets must be a list of JointSets, and one is {shown(joints)}')
		_requireKinds(joints)
	if least < 0: raise ValueError(f'cut.least must not be negative, got {least!r}')
	shapely, whole = needShapely(), region('cut.outline', outline, holes)
	traces = {}
	for joints in sets:
		if joints.name in traces: raise ValueError(f'cut: the name {joints.name!r} must be given once')
		traces[joints.name] = _tracesOf(joints, whole.bounds)
	for name, points in cracks.items():
		said = wrong('cut.cracks: a name', name, 'str') or wrong(f'cut.cracks: {name!r}', points, 'points')
		if said: raise said
		if name in traces: raise ValueError(f'cut: the name {name!r} must be given once')
		points = np.asarray(points, float)
		if len(points) < 2 or not np.hypot(*np.diff(points, axis=0).T).all():
			raise ValueError(f'cut.cracks: {name!r} must have at least two points, each away from the one before, got {shown(points.tolist())}')
		if not shapely.geometry.LineString(points).intersects(whole):
			raise ValueError(f'cut.cracks: {name!r} must reach the polygon, got {shown(points.tolist())}')
		traces[name] = list(np.stack([points[:-1], points[1:]], axis=1))
	lines = [shapely.geometry.LineString(trace) for of in traces.values() for trace in of]
	inside = [part for line in lines for part in _lines(line.intersection(whole))]
	pieces = _polygons(shapely, whole, inside)
	pieces, merged = joinSmall(pieces, least)
	between = sum(piece.length for piece in pieces) - whole.length # every side within is counted twice
	lost = sum(line.length for line in inside) - between / 2
	return Layout([outlineOf(piece) for piece in pieces], ['block'] * len(pieces), np.arange(len(pieces)), _namer(traces),
			[holesOf(piece) for piece in pieces], traces=traces, lostLength=max(0.0, lost), merged=merged)


def _requireKinds(joints):
	kinds = {**dict.fromkeys(JointSet._fields, 'finite'), 'name': 'str', 'seed': 'whole', 'through': 'point'}
	for word, kind in kinds.items():
		said = wrong(f'JointSet.{word}', getattr(joints, word), kind, f' in {joints.name!r}')
		if said: raise said


def _tracesOf(joints, bounds):
	"""Segments of a set that cover a box."""
	for name, value, fulfilled, rule in (('spacing', joints.spacing, joints.spacing > 0,
						'be positive'), ('persistence', joints.persistence, 0 < joints.persistence <= 1,
									'lie in (0, 1]'), ('length', joints.length, joints.length >= 0, 'not be negative'),
						('scatter', joints.scatter, 0 <= joints.scatter < 1,
							'lie in [0, 1)'), ('seed', joints.seed, joints.seed >= 0, 'not be negative')):
		if not fulfilled: raise ValueError(f'JointSet.{name} must {rule}, got {value!r} in {joints.name!r}')
	random = np.random.default_rng(int(joints.seed))
	width = math.log1p(joints.scatter**2)**0.5
	vary = lambda mean: mean if not joints.scatter else mean * random.lognormal(-width**2 / 2, width)
	x0, y0, x1, y1 = bounds
	corners, through = np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)]), np.asarray(joints.through, float)
	along = unit(math.radians(joints.dip))
	across = left(along)
	far, reach = (corners - through) @ across, np.hypot(x1 - x0, y1 - y0)
	middle = (corners.mean(axis=0) - through) @ along
	joint = joints.length or 3 * joints.spacing
	count = np.ptp(far) / joints.spacing * (1 if joints.persistence == 1 else 1 + 2 * reach * joints.persistence / joint)
	if count > _most:
		raise ValueError(f'JointSet.spacing and length must be so large that there are {_most} joints at most, got {count:.3g} in {joints.name!r}')
	start = np.clip(0.0, joints.spacing * np.floor(far.min() / joints.spacing), joints.spacing * np.ceil(far.max() / joints.spacing))
	above, below = [start], [start]
	while above[-1] < far.max():
		above.append(above[-1] + vary(joints.spacing))
	while below[-1] > far.min():
		below.append(below[-1] - vary(joints.spacing))
	places = below[:0:-1] + above
	traces = []
	for place in places:
		turn = joints.scatter * random.standard_normal() if joints.scatter else 0
		direction = unit(turn) @ (along, across)
		foot, s = through + place * across + middle * along, -reach
		if joints.persistence == 1:
			traces.append(foot + np.outer((-reach, reach), direction))
			continue
		s -= random.uniform(0, joint / joints.persistence)
		while s < reach:
			length = vary(joint)
			traces.append(foot + np.outer((s, s + length), direction))
			s += length + vary(joint * (1 / joints.persistence - 1))
	return traces


def _lines(shape):
	"""The line strings in what an intersection gave."""
	return [part for part in getattr(shape, 'geoms', [shape]) if part.geom_type == 'LineString' and part.length > 0]


def _polygons(shapely, whole, lines):
	"""The pieces of a polygon between lines, in order."""
	x0, y0, x1, y1 = whole.bounds
	network = shapely.ops.unary_union([*lines, whole.boundary])
	# where a line meets a corner, or two others where they cross, rounding parts what is one point
	parts = [onGrid(part.coords, max(x1 - x0, y1 - y0)) for part in _lines(network)]
	network = shapely.ops.unary_union([shapely.geometry.LineString(points) for points in parts if np.ptp(points, axis=0).any()])
	return fromBelow(piece for piece in shapely.ops.polygonize(network) if whole.contains(piece.representative_point()))


def _namer(traces):
	names = np.array([name for name, of in traces.items() for _ in of] or ['none'], dtype=object)
	all_ = np.array([trace for of in traces.values() for trace in of]).reshape(-1, 2, 2)

	def nameOf(normals, ends, samePiece):
		a, b = all_[:, 0], all_[:, 1]
		direction = (b - a) / np.hypot(*(b - a).T)[:, None]
		across = left(direction)
		offset = abs(np.einsum('sekd,kd->sek', ends[:, :, None] - a, across)).max(axis=1) # of the farther end from the line of each trace
		s = np.einsum('sekd,kd->sek', ends[:, :, None] - a, direction).mean(axis=1) # of the middle along it
		beyond = np.maximum(0, np.maximum(-s, s - np.hypot(*(b - a).T)))
		return names[(offset + beyond).argmin(axis=1)]

	return nameOf
