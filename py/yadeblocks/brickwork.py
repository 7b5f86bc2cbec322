# yade-blocks, GPL-2.0-or-later
"""Walls of bricks whose mortar joints have no thickness: bricks grow by half a joint on every side, bed and head joints are joints of the model.

	wall = runningBond(bricks=4.5, courses=16, length=0.21, height=0.052, joint=0.01, crack=True)
	wall.counts                                                       # {'half': 160, ...}
	placed = wall.addTo(model, 'unit', zoneSize=0.055)

Joints are named 'bed', 'head' and, between the parts of one brick, 'unit' (see layout.Placed.joints)."""
import math

import numpy as np

from ._door import door
from ._kinds import fits, shown
from .layout import Layout
from .specimen import rectangle


@door('bricks', 'courses', 'length', 'height', 'joint', 'offset', first='str')
def runningBond(bricks, courses, length, height, joint=0.0, first='whole', offset=0.5, **more):
	"""Courses in turn without and with an offset (a fraction of a brick; 1/3: third bond).

	bricks: length of the wall in bricks, a multiple of a half (of the offset); length, height of a brick and thickness of the joints [m];
	first: whether the lowest course begins with a 'whole' brick or with a 'part' of one; more: as in `brickwork`."""
	if not 0 < offset < 1: raise ValueError('runningBond.offset must lie in (0, 1), got %r' % offset)
	if first not in ('whole', 'part'): raise ValueError("runningBond.first must be 'whole' or 'part', got %r" % first)
	shifts = [0, offset] if first == 'whole' else [offset, 0]
	return brickwork(bricks * (length + joint), courses, height, [(length, shift) for shift in shifts], joint, **more)


@door('bricks', 'courses', 'length', 'height', 'joint')
def stackBond(bricks, courses, length, height, joint=0.0, **more):
	"""Head joints above each other; arguments as in `runningBond`."""
	return brickwork(bricks * (length + joint), courses, height, [(length, 0)], joint, **more)


@door('bricks', 'courses', 'width', 'height', 'joint')
def headerBond(bricks, courses, width, height, joint=0.0, **more):
	"""Bricks of which one sees the head, `width` wide, half a head shifted from course to course; other arguments as in `runningBond`."""
	return runningBond(bricks, courses, width, height, joint, **more)


@door('bricks', 'courses', 'length', 'width', 'height', 'joint')
def englishBond(bricks, courses, length, width, height, joint=0.0, **more):
	"""Courses of stretchers and of headers in turn, from the bottom, with a quarter of a stretcher between their head joints."""
	return brickwork(bricks * (length + joint), courses, height, [(length, 0), (width, 0.5)], joint, **more)


@door('width', 'courses', 'height', 'joint', 'least', pattern='sequence', origin='point', crack='flag', openings='boxes')
def brickwork(width, courses, height, pattern, joint=0.0, origin=(0.0, 0.0), crack=False, openings=(), least=0.2):
	"""A wall of any such bond -> layout.Layout with blocks of the kinds 'whole', 'part' (cut at an end or an opening) and 'half' (with crack).

	width of the wall with its joints, height of a brick [m]; pattern: a brick's length [m] and the fraction of it (with its joint) by which the course
	begins shorter, for each course, repeated from below; joint: thickness [m], half of which goes to each brick; origin: lower left corner [m]; crack: a
	joint in the middle of every whole brick; openings: rectangles (x0, y0, x1, y1) [m] that begin and end at bed joints; least: pieces shorter than this
	fraction of a brick are refused. notes: `coursing` [m], the height of a course with its joint, and `courseOf`, the course of each block from below.

	Errors: ValueError, and TypeError for what is of a wrong kind, which name the argument, the rule and the value."""
	_require('width', width, width > 0, 'be positive')
	_require('courses', courses, courses >= 1 and courses == int(courses), 'be a whole number > 0')
	_require('height', height, height > 0, 'be positive')
	_require('joint', joint, joint >= 0, 'not be negative')
	_require('least', least, 0 < least < 1, 'lie in (0, 1)')
	if not len(pattern): raise ValueError('brickwork.pattern must have at least one course')
	if not fits(pattern, 'points'):
		raise TypeError(f'brickwork.pattern must be a list of pairs of numbers, length and shift of a course, got {shown(pattern)}')
	coursing, (left, bottom) = height + joint, origin
	holes = [_opening(box, origin, coursing, width, int(courses)) for box in openings]
	outlines, kinds, pieces, courseOf, number = [], [], [], [], 0
	for course in range(int(courses)):
		length, shift = pattern[course % len(pattern)]
		_require('pattern length', length, length > 0, 'be positive')
		_require('pattern shift', shift, 0 <= shift < 1, 'lie in [0, 1)')
		unit, low = length + joint, bottom + course * coursing
		for x0, x1 in _bricks(width, unit, shift):
			for a, b in _outside(x0, x1, [(h0, h1) for h0, h1, c0, c1 in holes if c0 <= course < c1]):
				if b - a < least * unit * (1 - 1e-9):
					raise ValueError(
						f'brickwork: course {course} has a piece of {1e3 * (b - a):.4g} mm at x = {left + a:.4g} m, '
						f'less than {least:g} of a brick'
					)
				whole = b - a > (1 - 1e-9) * unit
				parts = [(a, (a + b) / 2), ((a + b) / 2, b)] if crack and whole else [(a, b)]
				for c, d in parts:
					outlines.append(rectangle(left + c, low, left + d, low + coursing))
					kinds.append('half' if len(parts) == 2 else 'whole' if whole else 'part')
					pieces.append(number)
					courseOf.append(course)
				number += 1
	if not outlines: raise ValueError(f'brickwork.openings must leave something of the wall, got {shown(openings)}')
	return Layout(outlines, kinds, pieces, _nameOf, coursing=coursing, courseOf=np.array(courseOf))


def _nameOf(normals, ends, samePiece):
	return np.where(samePiece, 'unit', np.where(abs(normals[:, 1]) > abs(normals[:, 0]), 'bed', 'head'))


def _bricks(width, unit, shift):
	"""Where the bricks of a course begin and end."""
	ends, x = [0.0], (1 - shift) * unit
	while x < width - 1e-9 * unit:
		ends.append(x)
		x += unit
	return zip(ends, [*ends[1:], width])


def _outside(x0, x1, holes):
	"""The parts of (x0, x1) that lie in no hole."""
	parts, tiny = [(x0, x1)], 1e-9 * (x1 - x0)
	for h0, h1 in holes:
		parts = [part for a, b in parts for part in ((a, min(b, h0)), (max(a, h1), b)) if part[1] - part[0] > tiny]
	return parts


def _opening(box, origin, coursing, width, courses):
	"""x0, x1 from the left end [m] and the courses it spans: first, last + 1."""
	x0, y0, x1, y1 = (value - origin[i % 2] for i, value in enumerate(box))
	c0, c1 = y0 / coursing, y1 / coursing
	if not (math.isclose(c0, round(c0), abs_tol=1e-6) and math.isclose(c1, round(c1), abs_tol=1e-6)):
		raise ValueError(f'brickwork.openings must begin and end at bed joints, every {coursing:g} m, got {tuple(box)}')
	if not (x0 < x1 and 0 <= round(c0) < round(c1) <= courses and x1 > 0 and x0 < width):
		raise ValueError(f'brickwork.openings must lie in the wall, with x0 < x1 and y0 < y1, got {tuple(box)}')
	return x0, x1, round(c0), round(c1)


def _require(name, value, fulfilled, rule):
	if not fulfilled: raise ValueError(f'brickwork.{name} must {rule}, got {value!r}')
