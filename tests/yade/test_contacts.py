# yade-blocks, GPL-2.0-or-later
"""General contact through YADE's collider and InteractionLoop. The formulation itself is tested in tests/kernel."""
import math

import numpy as np
import pytest

import yadeblocks # noqa: F401 (loads the plugin)
from scenes import *
from yade import *
from yadeblocks.engines import contactEngines, loopList
from yadeblocks.specimen import rectangle

g, mu = 9.81, 0.5
joint = dict(material1='rock', material2='rock', kn=1e9, ks=5e8, frictionAngle=math.atan(mu), bonded=False)


def scene(gap=1e-4, drop=True, gravity=(0, -g)):
	"""A square block of 0.1 m above a floor of three blocks with edges of 0.1 m, which is held; true masses, no damping."""
	O.reset()
	O.materials.append(BlockMat(label='rock', young=1e8, poisson=0.2, density=2000))
	model = BlockModel(thickness=0.1)
	for i in range(3):
		model.addRegion(rectangle(0.1 * i, -0.1, 0.1 * (i + 1), 0), 'rock', zoneSize=0.1)
	model.addRegion(rectangle(0.02, gap, 0.12, 0.1 + gap), 'rock', zoneSize=0.05)
	model.bond()
	model.drive('floor', range(model.firstNode[3]), 'xy')
	if gravity: model.gravity(gravity)
	model.insert()
	O.engines = [
		BlockContacts(label='contacts'),
		InsertionSortCollider([Bo1_Block_Aabb()], verletDist=0),
		InteractionLoop([Ig2_Block_Block_BlockGeom()], [Ip2_BlockMat_BlockMat_JointPhys(joints=[JointMat(**joint)])],
				[Law2_BlockGeom_JointPhys_MohrCoulomb()]),
		BlockTimeStepper(quasiStatic=False, safety=0.3),
		BlockForces(),
		BlockIntegrator(damping='none', rescueFile='')
	]
	return model


def top(model):
	"""Grid points of the upper block."""
	return slice(model.firstNode[3], model.firstNode[4])


def meanVelocity(model):
	return (model.mass[top(model), None] * model.velocity[top(model)]).sum(axis=0) / model.mass[top(model)].sum()


def test_aFallingBlockBouncesAndKeepsItsEnergy():
	model = scene(gap=2e-3)
	O.trackEnergy = True
	O.run(1, True)
	weight = model.mass[top(model)].sum() * g
	heights, sums = [], []
	for _ in range(400):
		O.run(50, True)
		heights.append(model.position[top(model), 1].min())
		sums.append(sum(value for _, value in O.energy.items()))
	fall = weight * 2e-3
	# the floor's stiffness: m v^2 / 2 = k d^2 / 2 with k = kn * width * thickness gives the static-free penetration of a rigid block
	depth = math.sqrt(2 * fall / (joint['kn'] * 0.1 * 0.1)) + weight / (joint['kn'] * 0.1 * 0.1)
	# the block deforms while it is stopped: its lowest corner goes to 1.75 of that (looked at every 5 steps)
	assert -2 * depth < min(heights) < 0 # it does touch, and does not pass
	first = next(i for i, height in enumerate(heights) if height < 0)
	assert max(heights[first:]) > 2e-4 # and comes up again, by more than vibration of the block leaves to chance
	# 1 % of the energy that is in the system is allowed; the balance of a frictionless bounce is of order (omega dt)^2
	assert max(abs(s - sums[0]) for s in sums) < 0.01 * fall


def test_frictionDecidesBetweenStickingAndSliding():
	"""Gravity along the floor of tan = mu -+ 2 %: below the block stays, above it slides with g (sin - mu cos)."""
	for tangent, slides in ((0.98 * mu, False), (1.3 * mu, True)):
		angle = math.atan(tangent)
		model = scene(gap=0, gravity=(g * math.sin(angle), -g * math.cos(angle)))
		O.engines = O.engines[:-1] + [BlockIntegrator(damping='local', alpha=0.5, rescueFile='')]
		O.run(3000, True)
		O.engines = O.engines[:-1] + [BlockIntegrator(damping='none', rescueFile='')]
		before, time = meanVelocity(model)[0], O.time
		O.run(6000, True)
		acceleration = (meanVelocity(model)[0] - before) / (O.time - time)
		expected = g * (math.sin(angle) - mu * math.cos(angle)) if slides else 0
		# the residual vibration of the block changes its mean velocity by less than this
		assert acceleration == pytest.approx(expected, abs=0.02 * g * math.sin(angle)), (tangent, acceleration)


def test_saveAndLoadInTheMiddleOfSliding(tmp_path):
	angle = math.atan(2 * mu)
	model = scene(gap=0, gravity=(g * math.sin(angle), -g * math.cos(angle)))
	O.run(2000, True)
	O.save(str(tmp_path / 'slide.yade.bz2'))
	O.run(1000, True)
	expected = np.array(model.position), np.array(model.velocity)
	assert meanVelocity(model)[0] > 0.01 # it slides
	O.load(str(tmp_path / 'slide.yade.bz2'))
	O.run(1000, True)
	loaded = O.bodies[3].shape.model
	assert np.array_equal(loaded.position, expected[0]) and np.array_equal(loaded.velocity, expected[1])


def test_theColliderSleepsUntilSomethingMoves():
	scene(gap=0)
	O.run(2000, True)
	assert contacts.colliderRuns <= 2
	end = [end for i in O.interactions if 3 in (i.id1, i.id2) for end in i.geom.ends]
	pressed = sum(-e['sigma'] * e['area'] for e in end)
	assert pressed > 0 and all(abs(e['normal'][1]) > 0.99 for e in end if e['area'] > 1e-6 * 0.1 * 0.1) # corners carry areas of rounding


def test_blocksThatPartAreForgotten():
	model = scene(gap=1e-4, gravity=(0, g)) # falls upwards
	O.run(50, True)
	assert [i for i in O.interactions if i.isReal and 3 in (i.id1, i.id2)] # near enough to be watched
	O.run(5000, True)
	assert model.position[top(model), 1].min() > 0.01
	assert not [i for i in O.interactions if i.isReal and 3 in (i.id1, i.id2)]


def test_aColliderWithoutBlockContactsIsRefused():
	"""Else blocks that meet would go through each other unseen."""
	scene(gap=1e-4)
	O.engines = O.engines[1:]
	with pytest.raises(RuntimeError, match='blocks 0 and 3 near each other: O.engines needs BlockContacts'):
		O.run(5, True)


def test_dilatedJointsBecomeFreeContactsAndAreSaved(tmp_path):
	"""Pressed and sheared until the joint has dilated to its limit: the blocks stay apart by that, and a saved run goes on with the same bits."""
	materials()
	m = column(heights=(0.2, 0.2), labels=('unit', 'unit'))
	upper = nodesWhere(m, lambda x, y: y > 0.4 - 1e-9)
	m.drive('low', nodesWhere(m, lambda x, y: y < 1e-9), 'xy')
	m.push('press', upper, 'y', force=-1e4, rampTime=0.1)
	m.drive('slide', upper, 'x', velocity=1e-3, startTime=0.2, rampTime=0.05)
	m.insert()
	limit, angle = 2e-5, 0.2
	O.dt = 1e-3
	joints = glued(cohesion=1e3, tension=1e3, frictionAngle=0.5, dilationAngle=angle, dilationLimitSlip=limit)
	O.engines = contactEngines() + engines(joints, alpha=0.8)
	O.run(200, True)
	before = m.position[upper, 1].mean()
	lifted = lambda: m.position[upper, 1].mean() - before
	O.run(400, True)
	assert m.segmentArea.all() # broken, but its edges of 0.2 m have not moved by 2 %
	assert lifted() == pytest.approx(limit * math.tan(angle), rel=0.1) # by the asperities; friction bends the blocks by some 1e-7 m
	O.run(4000, True)
	assert (m.segmentArea == 0).all() and O.interactions[0, 1].geom.ends
	assert lifted() == pytest.approx(limit * math.tan(angle), rel=0.1)
	O.save(str(tmp_path / 'dilated.yade'))
	O.run(200, True)
	expected = state(m)
	O.load(str(tmp_path / 'dilated.yade'))
	O.run(200, True)
	assert differences(expected, state(model())) == []


@pytest.mark.parametrize('native', [False, True])
def test_brokenJointsStayWithScaledMassesOnly(native):
	"""A column that is torn by 1 % of the length of its edges, which are 0.2 m long: joints still, until the run goes on with true masses."""
	materials()
	m = column(heights=(0.2, 0.2), labels=('unit', 'unit'))
	joints = glued(cohesion=1e4, tension=1e4)[:1] # unit to unit
	if not native: m.bond(joints)
	m.drive('low', nodesWhere(m, lambda x, y: y < 1e-9), 'xy')
	m.drive('top', nodesWhere(m, lambda x, y: y > 0.4 - 1e-9), 'y', velocity=5e-3)
	m.insert()
	O.dt = 1e-3
	O.engines = contactEngines() + engines(joints, alpha=0.5) if native else loopList(contact=True, alpha=0.5, rescueFile='')
	O.run(400, True)
	assert m.pointStatus.all() and (m.segmentArea > 0).all()
	assert m.freeContacts()['blocks'].size == 0
	next(e for e in O.engines if hasattr(e, 'quasiStatic')).quasiStatic = False
	O.run(2, True)
	assert (m.segmentArea == 0).all()
