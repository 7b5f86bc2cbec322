# yade-blocks, GPL-2.0-or-later
"""Limit analysis against limits on paper, published limits of walls and arches, and itself: equilibrium, strength, and the power of its mechanism."""
from math import atan, cos, nan, pi, sin

import numpy as np
import pytest

from scenes import *
from yadeblocks.brickwork import runningBond
from yadeblocks.limitanalysis import bodyForces, largestForce, largestMultiplier
from yadeblocks.pictures import drawMechanism
from yadeblocks.snapshot import Snapshot
from yadeblocks.specimen import nodesWhere, rectangle
from yadeblocks.voussoirs import arch

g, density = 9.81, 2000.


def standing(layout, *outlines, rigid=True, unit=1.0, **joint):
	"""Blocks of a layout on rigid supports, lengths times `unit`: the model and the supports."""
	O.reset()
	O.materials.append(BlockMat(label='stone', young=20e9, poisson=0.2, density=density))
	model = BlockModel(thickness=0.5)
	for outline in layout if isinstance(layout, list) else layout.outlines:
		scaled = (unit * np.asarray(outline)).tolist()
		model.addRigid(scaled, 'stone') if rigid else model.addRegion(scaled, 'stone', zoneSize=0.2 * unit)
	supports = [model.addRigid((unit * np.asarray(outline)).tolist(), 'stone') for outline in outlines]
	model.bond([JointMat(material1='stone', material2='stone', kn=1e10, ks=5e9, **joint)])
	return model, supports


def sideways(model, supports):
	return largestMultiplier(model, bodyForces(model, (g, 0)), bodyForces(model, (0, -g)), fixed=supports)


@pytest.mark.parametrize('width, friction, expected', [(0.3, 0.4, 0.3), (0.3, 0.2, 0.2), (2., 0.7, 0.7)])
def test_blockSlidesOrOverturns(width, friction, expected):
	"""The smaller of friction and width by height; it turns about its corner or does not turn at all."""
	model, base = standing([rectangle(0, 0, width, 1)], rectangle(-1, -0.5, 3, 0), bonded=False, frictionAngle=atan(friction))
	found = sideways(model, base)
	assert found.load == pytest.approx(expected, rel=1e-9)
	vx, vy, turns = found.mechanism[0]
	if expected == friction: assert turns == pytest.approx(0, abs=1e-9) and vy == pytest.approx(friction * vx, rel=1e-6) # associated: it dilates
	else: assert turns < 0 and vy == pytest.approx(-turns * width / 2, rel=1e-6) and vx == pytest.approx(-turns / 2, rel=1e-6)


@pytest.mark.parametrize('courses, expected', [(6, 0.64286), (10, 0.58000)])
@pytest.mark.parametrize('rigid, unit', [(True, 1.), (False, 1.), (True, 1e-3), (True, 1e3)])
def test_dryWallsOfFerrisAndTinLoi(courses, expected, rigid, unit):
	"""Rigid or meshed, in any unit of length."""
	model, base = standing(
		runningBond(5, courses, 0.4, 0.175, first='part'), rectangle(-0.2, -0.2, 2.2, 0), rigid=rigid, unit=unit, bonded=False,
		frictionAngle=atan(0.65)
	)
	assert sideways(model, base).load == pytest.approx(expected, abs=5e-6)


def test_archOfMilankovitch():
	"""Stands alone from 0.1075 of its radius on, and not below."""
	def load(ratio):
		model, supports = standing(
			arch(1, ratio, 40, chords=4), *[rectangle(x - 0.2, -0.2, x + 0.2, 0) for x in (-1, 1)], bonded=False, frictionAngle=atan(2)
		)
		return sideways(model, supports).load

	assert 0 < load(0.1076) < 0.001 < load(0.11)
	with pytest.raises(ValueError, match='cannot hold the constant forces, whatever the load'):
		load(0.1070)


def pulled(at=None, **joint):
	"""Two bricks one upon the other, glued, the upper one held by a group from above."""
	O.reset()
	O.materials.append(BlockMat(label='stone', young=20e9, poisson=0.2, density=density))
	model = BlockModel(thickness=0.5)
	for y in (0, 0.1):
		model.addRegion(rectangle(0, y, 0.2, y + 0.1), 'stone', zoneSize=0.1)
	model.bond([JointMat(material1='stone', material2='stone', kn=1e10, ks=5e9, **joint)])
	model.drive('base', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
	model.drive('top', nodesWhere(model, lambda x, y: (y > 0.2 - 1e-9) & (at is None or abs(x - at) < 1e-9)), 'y')
	return model


def test_gluedBricksPulledAndSheared():
	"""Tensile strength by area; eccentric: half of it, turning about the far end; cohesion by area along, more when pressed."""
	joint = dict(cohesion=2e6, tension=1e6, frictionAngle=atan(0.8), GfI=500, GfII=5000)
	area = 0.2 * 0.5
	found = largestForce(pulled(**joint), 'top', (0, 3))
	assert found.load == pytest.approx(1e6 * area, rel=1e-9) and found.sigma == pytest.approx(1e6)
	assert largestForce(pulled(at=0., **joint), 'top', (0, 1)).load == pytest.approx(1e6 * area / 2, rel=1e-9)
	for sign in (1, -1):
		model, base = standing([rectangle(0, 0, 100, 0.1)], rectangle(-1, -0.5, 101, 0), cohesion=2e6, tension=1e6, frictionAngle=atan(0.8))
		load = largestMultiplier(model, [[sign, 0], [0, 0]], [[0, -5e7], [0, 0]], fixed=base).load
		assert load == pytest.approx(2e6 * 50 + 0.8 * 5e7, rel=1e-9)


@pytest.mark.parametrize('push', [0., 3e5])
def test_pushedGroupsPushAndHoldNothing(push):
	"""A platen on two bricks: friction under its force and the weight; the upper brick topples about its corner, which the platen, held flat, resists."""
	mu = 0.4
	O.reset()
	O.materials.append(BlockMat(label='stone', young=20e9, poisson=0.2, density=density))
	model = BlockModel(thickness=0.5)
	for y in (0, 0.1):
		model.addRegion(rectangle(0, y, 0.2, y + 0.1), 'stone', zoneSize=0.1)
	model.bond([JointMat(material1='stone', material2='stone', kn=1e10, ks=5e9, bonded=False, frictionAngle=atan(mu))])
	model.drive('base', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
	model.push('platen', nodesWhere(model, lambda x, y: y > 0.2 - 1e-9), 'y', -push)
	weight, side = bodyForces(model, (0, -g)), [[0, 0], [1, 0]]
	found = largestMultiplier(model, side, weight)
	assert found.load == pytest.approx(mu * (push - weight[1, 1]), rel=1e-9) and found.mechanism[1, 2] == pytest.approx(0, abs=1e-9)
	assert largestForce(model, 'platen', (0, 1), weight).load == pytest.approx(-weight[1, 1], rel=1e-9) # lifts the upper brick


def test_stackOnATiltedPlane():
	"""Bricks one upon the other: of the stacks above each joint the first to slide or to topple, by statics."""
	for width, count, mu in ((0.3, 3, 0.7), (0.3, 5, 0.1), (0.5, 2, 0.24)):
		stack = [rectangle(0, 0.25 * i, width, 0.25 * (i + 1)) for i in range(count)]
		model, base = standing(stack, rectangle(-1, -0.5, 2, 0), bonded=False, frictionAngle=atan(mu))
		assert sideways(model, base).load == pytest.approx(min(mu, width / (0.25 * count)), rel=1e-9)


def test_archOfThreeBlocksUnderAPointLoad():
	"""Three thick voussoirs that do not slide. Down on the middle one: a straight thrust line to either springing stays within them, so any load is held.
	Upwards: less than the weight of all."""
	model, supports = standing(arch(1, 0.3, 3, chords=1), *[rectangle(x - 0.3, -0.2, x + 0.3, 0) for x in (-1, 1)], bonded=False, frictionAngle=atan(2))
	middle = np.argmax([np.asarray(model.reference)[model.firstNode[i]:model.firstNode[i + 1], 1].mean() for i in range(3)])
	down = np.zeros((model.blockCount, 2))
	down[middle, 1] = -1
	with pytest.raises(ValueError, match='no load is too large'):
		largestMultiplier(model, down, fixed=supports)
	weight = bodyForces(model, (0, -g))
	assert largestMultiplier(model, -down, weight, fixed=supports).load < -weight[:3, 1].sum()


def test_limitIsConsistent():
	"""A wall of glued bricks that stands askew, weights and a group besides: stresses within the strength, blocks in equilibrium, and the mechanism's
	power: what the joints dissipate is what the load and the constant forces put in."""
	c, ft, mu = 0.05e6, 0.02e6, 0.7
	O.reset()
	O.materials.append(BlockMat(label='stone', young=20e9, poisson=0.2, density=density))
	model = BlockModel(thickness=0.5)
	placed = runningBond(3, 5, 0.4, 0.175).turned(0.2).addTo(model, 'stone', zoneSize=0.2)
	joints = placed.bond(model, [JointMat(material1='stone', material2='stone', kn=1e10, ks=5e9, cohesion=c, tension=ft, frictionAngle=atan(mu))])
	assert set(joints) == {'bed', 'head'}
	x, y = np.asarray(model.reference).T
	model.drive('foot', np.flatnonzero(y * cos(0.2) - x * sin(0.2) < 1e-9).tolist(), 'xy')
	weight, push = bodyForces(model, (0, -g)), bodyForces(model, (g, 0))
	assert weight[:, 1].sum() == pytest.approx(-3 * 0.4 * 5 * 0.175 * 0.5 * density * g, rel=1e-12)
	found = largestMultiplier(model, push, weight)
	assert found.load > 0 and (found.sigma <= ft * (1 + 1e-6)).all() and (abs(found.tau) <= (c - mu * found.sigma) * (1 + 1e-6) + 1).all()
	normal = np.repeat(model.normal, 2, axis=0)
	along, areas = np.column_stack([-normal[:, 1], normal[:, 0]]), np.repeat(model.segmentArea, 2)
	force = areas[:, None] * (found.sigma[:, None] * normal + found.tau[:, None] * along)
	pairs, places = np.repeat(model.segmentBlocks, 2, axis=0), np.asarray(model.contactPositions())
	centroids = np.array([ring.mean(axis=0) for ring in placed.layout.outlines]) # of rectangles
	resultant = weight + found.load * push
	moment = np.zeros(model.blockCount)
	for side, sign in ((0, 1), (1, -1)):
		np.add.at(resultant, pairs[:, side], sign * force)
		arm = places - centroids[pairs[:, side]]
		np.add.at(moment, pairs[:, side], sign * (arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0]))
	free = np.array([(ring @ [-sin(0.2), cos(0.2)]).min() > 1e-9 for ring in placed.layout.outlines]) # what no group holds
	assert free.sum() == placed.layout.counts['whole'] + placed.layout.counts['part'] - 3
	scale = abs(weight).sum()
	assert abs(resultant[free]).max() < 1e-7 * scale and abs(moment[free]).max() < 1e-7 * scale
	v, w = found.mechanism[:, :2], found.mechanism[:, 2]
	assert (push * v).sum() == pytest.approx(1, rel=1e-9)
	at = lambda side: v[pairs[:, side]] + w[pairs[:, side], None] * (places - centroids[pairs[:, side]]) @ np.array([[0, 1], [-1, 0]])
	jump = at(1) - at(0)
	opens, slides = (jump * normal).sum(axis=1), (jump * along).sum(axis=1)
	assert (opens >= mu * abs(slides) - 1e-9 * abs(jump).max()).all() # associated
	dissipated = (areas * (c * abs(slides) + ft * (opens - mu * abs(slides)))).sum()
	assert found.load + (weight * v).sum() == pytest.approx(dissipated, rel=1e-5)


def test_turnedWallIsTheSameWall():
	"""Forces turned with it: the same limit; joints of the same names."""
	limits = []
	for angle in (0, 0.7, pi / 2):
		O.reset()
		O.materials.append(BlockMat(label='stone', young=20e9, poisson=0.2, density=density))
		model = BlockModel(thickness=0.5)
		placed = runningBond(3, 4, 0.4, 0.175).turned(angle, about=(0.3, -2)).addTo(model, 'stone', rigid=True)
		joints = placed.bond(
			model, [JointMat(material1='stone', material2='stone', kn=1e10, ks=5e9, cohesion=1e4, tension=1e4, frictionAngle=atan(0.6))]
		)
		turned = lambda x, y: bodyForces(model, (x * cos(angle) - y * sin(angle), x * sin(angle) + y * cos(angle)))
		limits.append(
			(largestMultiplier(model, turned(g, 0), turned(0, -g), fixed=placed.blocks[:3]).load, *[len(joints[name]) for name in ('bed', 'head')])
		)
	assert limits[1] == pytest.approx(limits[0], rel=1e-9) and limits[2] == pytest.approx(limits[0], rel=1e-9)


def test_refusals():
	model, base = standing([rectangle(0, 0, 1, 1)], rectangle(-1, -0.5, 3, 0), bonded=False, frictionAngle=0.5)
	weight = bodyForces(model, (0, -g))
	with pytest.raises(ValueError, match='no load is too large'):
		largestMultiplier(model, weight, fixed=base) # downwards
	with pytest.raises(ValueError, match='cannot hold the constant forces, whatever the load'):
		largestMultiplier(model, bodyForces(model, (g, 0)), -weight, fixed=base)
	with pytest.raises(ValueError, match='growing must have a force for each of 2 blocks, got 1'):
		largestMultiplier(model, weight[:1], fixed=base)
	with pytest.raises(ValueError, match=r'fixed must be blocks of the model, 0 to 1, got \[2\]'):
		largestMultiplier(model, weight, fixed=[2])
	with pytest.raises(TypeError, match='growing must be a list of points'):
		largestMultiplier(model, 3.)
	with pytest.raises(ValueError, match='direction must not be across the axes y'):
		largestForce(pulled(), 'top', (1, 0))
	with pytest.raises(ValueError, match='largestForce.group must be one of none: there are no groups, got'):
		largestForce(model, 'roof', (0, 1))
	with pytest.raises(TypeError, match='largestMultiplier.model must be a BlockModel, got <yadeblocks.snapshot'):
		largestMultiplier(Snapshot(model), weight)
	for wrong, error in (([[0, 0, nan]] * 2, ValueError), (3., TypeError), ([[0, 1]] * 2, TypeError)):
		with pytest.raises(error, match=r'drawMechanism.mechanism must be a list of motions \(vx, vy, rotation\), got'):
			drawMechanism('none.png', model, wrong)
	bare = BlockModel(thickness=1)
	bare.addRigid(rectangle(0, 0, 1, 1), 'stone')
	with pytest.raises(RuntimeError, match=r'there are no joints; BlockModel.bond\(\) makes them'):
		largestMultiplier(bare, [[0, 1]])


def test_modelsThatHaveMovedOrLostBlocks():
	model = pulled(bonded=False, frictionAngle=0.5)
	model.insert()
	assert largestForce(model, 'top', (0, 1)).load == 0 # as it was built
	model.displacement[:] += 1e-3
	with pytest.raises(RuntimeError, match='must be as it was built; grid points have moved by up to 0.001 m'):
		largestMultiplier(model, bodyForces(model, (g, 0)))
	model = pulled(bonded=False, frictionAngle=0.5)
	model.insert()
	model.release('top')
	model.remove([1])
	with pytest.raises(RuntimeError, match=r'no block must have been taken out, got \[1\]'):
		largestMultiplier(model, bodyForces(model, (g, 0)))
