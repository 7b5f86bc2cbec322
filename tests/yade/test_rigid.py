# yade-blocks, GPL-2.0-or-later
"""Rigid blocks: platens and supports that move by YADE's own means."""
import math

import pytest

from scenes import *
from yade.minieigenHP import Vector3
from yadeblocks.recording import runner

g = 9.81
held = 'xyzXYZ'


def movers(joints, contacts=False, newton={}, more=[], stepper={}, **integrator):
	"""The engines of a scene with rigid blocks."""
	front = [BlockContacts(), InsertionSortCollider([Bo1_Block_Aabb()], verletDist=0)] if contacts else []
	loop, step, forces, motion = engines(joints, stepper, **integrator)
	return [ForceResetter(), *front, loop, step, forces, *more, NewtonIntegrator(**newton), motion]


def rigidMaterials(**block):
	"""'unit' deforms, 'steel' is for rigid blocks."""
	materials(**block)
	O.materials.append(BlockMat(label='steel', young=200e9, poisson=0.3, density=7800))


def between(**joint):
	"""One joint for all pairs of 'unit' and 'steel'."""
	return [JointMat(**{**glue, 'material1': a, 'material2': b, **joint}) for a, b in (('unit', 'unit'), ('unit', 'steel'), ('steel', 'steel'))]


def pressed(joints, **arguments):
	"""A block of 0.4 x 0.5 x 0.2 m between two rigid platens, the lower one held: model, bodies of the lower and the upper platen."""
	model = BlockModel(thickness=0.2)
	model.addRegion(rectangle(0, 0, 0.4, 0.5), 'unit', zoneSize=0.25, zoning='regular')
	low = model.addRigid(rectangle(-0.1, -0.1, 0.5, 0), 'steel')
	high = model.addRigid([(0, 0.5), (0.4, 0.5), (0.3, 0.6), (0.1, 0.6)], 'steel')
	model.bond()
	model.insert()
	low, high = O.bodies[model.bodyOf(low)], O.bodies[model.bodyOf(high)]
	low.state.blockedDOFs = held
	O.dt, O.engines = 1e-3, movers(joints, **arguments)
	return model, low, high


def entries():
	"""The energies of blocks; NewtonIntegrator's own repeat part of them."""
	return {name: value for name, value in O.energy.items() if name.startswith('block')}


area, height = 0.4 * 0.2, 0.5
firm = dict(cohesion=1e15, tension=1e15, dilationAngle=0)


def test_whatInsertMakes():
	"""An L-shaped plate with a hole: mass, centroid and moment of inertia from rectangles."""
	rigidMaterials()
	model = BlockModel(thickness=0.3)
	model.addRegion(rectangle(10, 0, 11, 1), 'unit', zoneSize=1)
	block = model.addRigid([(0, 0), (2, 0), (2, 1), (1, 1), (1, 3), (0, 3)], 'steel', holes=[rectangle(0.25, 1.5, 0.75, 2.5)[::-1]])
	model.addRegion(rectangle(12, 0, 13, 1), 'unit', zoneSize=1)
	with pytest.raises(RuntimeError, match='bodyOf'):
		model.bodyOf(block)
	model.insert()
	parts = [(2, 1, 1, 0.5, 1), (1, 2, 0.5, 2, 1), (0.5, 1, 0.5, 2, -1)] # width, height, centre, sign
	A = sum(s * b * h for b, h, x, y, s in parts)
	cx, cy = sum(s * b * h * x for b, h, x, y, s in parts) / A, sum(s * b * h * y for b, h, x, y, s in parts) / A
	I = sum(s * b * h * ((b * b + h * h) / 12 + (x - cx)**2 + (y - cy)**2) for b, h, x, y, s in parts)
	state = O.bodies[model.bodyOf(block)].state
	assert model.bodyOf(block) == model.firstBody + 1 and state.blockedDOFs == 'zXY'
	assert state.mass == pytest.approx(A * 0.3 * 7800, rel=1e-14) and tuple(state.pos) == pytest.approx((cx, cy, 0), rel=1e-14)
	assert state.inertia[2] == pytest.approx(I * 0.3 * 7800, rel=1e-13) # differences of numbers ten times as large
	assert not model.mass[model.firstNode[1]:model.firstNode[2]].any() and list(np.diff(model.firstZone) > 0) == [True, False, True]


@pytest.mark.parametrize('means', ['ForceEngine', 'permF'])
def test_pushedByYadesForces(means):
	"""The elastic answer of springs in a row, u = F/A (h/E + 2/kn); below, the reaction."""
	rigidMaterials(poisson=0)
	push = [ForceEngine(force=(0, -7e4, 0), ids=[2])] if means == 'ForceEngine' else []
	model, low, high = pressed(between(**firm), more=push, newton=dict(damping=0.5), alpha=0.5)
	if means == 'permF': O.forces.setPermF(high.id, (0, -7e4, 0))
	O.run(4000, True)
	assert model.unbalancedRatio() < 1e-10
	# displacements of 3e-6 m, places of 0.5 m known to 1e-16
	assert high.state.pos[1] - high.state.refPos[1] == pytest.approx(-7e4 / area * (height / brick['young'] + 2 / glue['kn']), rel=1e-8)
	assert tuple(O.forces.f(low.id)) == pytest.approx((0, -7e4, 0), abs=1e-4)
	assert tuple(O.forces.f(high.id)) == pytest.approx((0, 0, 0), abs=1e-4) # at rest: all that acts on it
	# x and turning are free: nothing but rounding moves them; the torque about the lower platen's centroid, at x = 0.2 as the force, is none
	assert abs(high.state.pos[0] - 0.2) < 1e-12 and abs(high.state.ori[2]) < 1e-12 and abs(O.forces.t(low.id)[2]) < 1e-4
	assert tuple(low.state.pos) == tuple(low.state.refPos)


def test_drivenByItsVelocity():
	"""Between platens without friction: nominal stress = E/(1-nu^2) strain, springs in a row with the joints."""
	rigidMaterials()
	model, low, high = pressed(between(**firm, bonded=False, frictionAngle=0), newton=dict(damping=0), alpha=0.5)
	high.state.blockedDOFs, high.state.vel = held, (0, -1e-4, 0)
	O.run(500, True)
	high.state.vel = (0, 0, 0)
	assert high.state.pos[1] - high.state.refPos[1] == pytest.approx(-5e-5, rel=1e-8)
	O.run(4000, True)
	stress = 5e-5 / (height * (1 - brick['poisson']**2) / brick['young'] + 2 / glue['kn'])
	assert O.forces.f(high.id)[1] == pytest.approx(stress * area, rel=1e-8) and O.forces.f(low.id)[1] == pytest.approx(-stress * area, rel=1e-8)
	assert abs(O.forces.f(high.id)[0]) < 1e-4
	# grid points of the platen have gone with it
	top = model.firstNode[2]
	np.testing.assert_allclose(model.position[top:, 1] - model.reference[top:, 1], -5e-5, rtol=1e-8) # 500 roundings of 0.6 m


def test_tiltedPlatenCarriesItsMoment():
	"""A force beside the middle: force and moment on the held platen below balance it, about its centroid (0.2, -0.05)."""
	rigidMaterials(poisson=0)
	model, low, high = pressed(between(**firm), newton=dict(damping=0.5), alpha=0.5)
	O.forces.setPermF(high.id, (1e3, -7e4, 0))
	O.forces.setPermT(high.id, (0, 0, 5e2))
	O.run(12000, True)
	x, y = high.state.pos[0] - 0.2, high.state.pos[1] + 0.05
	assert model.unbalancedRatio() < 1e-8
	assert tuple(O.forces.f(low.id)) == pytest.approx((1e3, -7e4, 0), abs=1e-2)
	assert O.forces.t(low.id)[2] == pytest.approx(x * -7e4 - y * 1e3 + 5e2, abs=1e-2)


def test_rigidUponRigidIsTheJointAlone():
	"""Glued to a held block and loaded beside the middle: u = F/(A k), theta = M/(kn T W^3/4) since a segment's two points are at its ends."""
	rigidMaterials()
	W, T, h = 0.4, 0.2, 0.15
	model = BlockModel(thickness=T)
	low = model.addRigid(rectangle(-0.1, -0.1, 0.5, 0), 'steel')
	high = model.addRigid(rectangle(0, 0, W, 2 * h), 'steel')
	model.bond()
	model.insert()
	low, high = (O.bodies[model.bodyOf(b)] for b in (low, high))
	low.state.blockedDOFs = held
	O.dt, O.engines = 1e-3, movers(between(**firm), newton=dict(damping=0.5))
	force, torque = np.array((3e4, -7e4)), 2e3
	O.forces.setPermF(high.id, (*force, 0))
	O.forces.setPermT(high.id, (0, 0, torque))
	O.run(2000, True)
	turn = (torque - force[0] * h) / (glue['kn'] * T * W**3 / 4)
	u = np.array(high.state.pos)[:2] - (W / 2, h)
	# what the displacement of 5e-6 m adds to the moment: 7e4 N x 5e-6 m against 2500 N m
	assert 2 * high.state.ori[2] == pytest.approx(turn, rel=1e-4) and turn < 0
	assert tuple(u) == pytest.approx((force[0] / (glue['ks'] * T * W) - turn * h, force[1] / (glue['kn'] * T * W)), rel=1e-4)
	assert tuple(O.forces.f(low.id))[:2] == pytest.approx(tuple(force), rel=1e-6)
	assert O.forces.t(low.id)[2] == pytest.approx(torque - force[0] * (h + 0.05), rel=1e-4) # about its own centroid, 0.05 below the joint
	assert model.unbalancedRatio() < 1e-8


@pytest.mark.parametrize('damping', [0, 0.3])
@pytest.mark.parametrize('free', [False, True])
def test_energyBalance(free, damping):
	"""Zones, joints, kinetic energy, damping and work from outside sum to zero; the work is force by way."""
	rigidMaterials()
	O.trackEnergy = True
	model, low, high = pressed(between(**firm), newton=dict(damping=damping), damping='local' if damping else 'none', alpha=0.3)
	model.smallStrain = True
	trueMass = 7800 * 0.2 * 0.03 # a trapezium of (0.4 + 0.2)/2 x 0.1
	model.gravity((0, -2 * g))
	if free: O.forces.setPermF(high.id, (1e3, -7e4, 0)), O.forces.setPermT(high.id, (0, 0, 5e2))
	else: high.state.blockedDOFs, high.state.vel, high.state.angVel = held, (2e-5, -1e-4, 0), (0, 0, 1e-6)
	forces, motions, weights = [], [], []

	def note(): # between BlockForces and NewtonIntegrator: forces of now, motion of the last half step
		forces.append(np.array((1e3, -7e4, 5e2)) if free else -np.array((O.forces.f(high.id)[0], O.forces.f(high.id)[1], O.forces.t(high.id)[2])))
		motions.append(np.array((high.state.vel[0], high.state.vel[1], high.state.angVel[2])))
		ways = model.position[:, 1] - model.reference[:, 1]
		weights.append(-2 * g * (model.mass @ ways + trueMass * (high.state.pos[1] - high.state.refPos[1])))

	O.engines = O.engines[:4] + [runner('look', note, initRun=True)] + O.engines[4:]
	O.run(600, True)
	e = entries()
	scale = e['blockZones'] + e['blockJoints']
	assert scale > 0.01 and e['blockJoints'] > 0.01 * scale
	# linear but for the turning of frames (slip by edge, 1e-5) and of the platen (1e-6): second order in a motion of hundreds of steps
	assert abs(sum(e.values())) < 1e-6 * scale, e
	if damping: assert e['blockDamping'] > 1e-3 * scale
	else: assert abs(e['blockDamping']) < 1e-9 * scale
	# work from outside, up to the last time of forces: half of each force's with the motion before it, half with that after; and the weights
	motions[0] *= 0 # at rest before
	byHand = O.dt / 2 * (sum(f @ v for f, v in zip(forces, motions)) + sum(f @ v for f, v in zip(forces, motions[1:])))
	if not free: # the platen itself had to be set in motion
		byHand += (high.state.mass * high.state.vel.squaredNorm() + high.state.inertia[2] * high.state.angVel[2]**2) / 2
	assert -e['blockWork'] == pytest.approx(byHand + weights[-1], rel=1e-8)
	assert abs(weights[-1]) > 1e-4 * scale


def incline(angle, mu=0.5, size=0.1, kn=1e9):
	"""A rigid square upon an inclined rigid support; true masses. The body of the square."""
	rigidMaterials()
	model = BlockModel(thickness=0.1)
	c, s = math.cos(angle), math.sin(angle)
	turned = lambda points: [(c * x - s * y, s * x + c * y) for x, y in points]
	support = model.addRigid(turned(rectangle(-0.7, -0.1, 0.4, 0)), 'steel')
	block = model.addRigid(turned(rectangle(0.1, 0, 0.1 + size, size)), 'steel')
	model.gravity((0, -g))
	model.insert()
	O.bodies[model.bodyOf(support)].state.blockedDOFs = held
	joint = JointMat(material1='steel', material2='steel', kn=kn, ks=kn / 2, frictionAngle=math.atan(mu), bonded=False)
	O.engines = movers([joint], contacts=True, newton=dict(damping=0.7, label='newton'), stepper=dict(quasiStatic=False, safety=0.6), damping='none')
	O.dt = 1e-5
	return model, O.bodies[model.bodyOf(block)]


def test_inclineHoldsAndLetsGo():
	"""At 1 degree below and above the angle of friction: g (sin - mu cos)."""
	mu, limit = 0.5, math.atan(0.5)
	for angle in limit - math.radians(1), limit + math.radians(1):
		model, block = incline(angle, mu)
		O.run(3000, True) # at rest, or sliding slowly
		newton.damping = 0
		along = lambda v: -(v[0] * math.cos(angle) + v[1] * math.sin(angle)) # down the slope
		before, place, time = along(block.state.vel), along(block.state.pos), O.time
		O.run(3000, True)
		acceleration = (along(block.state.vel) - before) / (O.time - time)
		if angle < limit:
			assert abs(along(block.state.pos) - place) < 1e-6 and abs(along(block.state.vel)) < 1e-5 # springs of 1e-6 m
		else:
			# what is left of the landing's bouncing is of this order
			assert acceleration == pytest.approx(g * (math.sin(angle) - mu * math.cos(angle)), abs=1e-3 * g * math.sin(angle))
			force = O.forces.f(0) - Vector3(0, -g * O.bodies[0].state.mass, 0) # of the block on the support
			normal = force[0] * math.sin(angle) - force[1] * math.cos(angle)
			assert -along(force) / normal == pytest.approx(-mu, rel=1e-6)
			assert along(block.state.pos) - place > 1e-3
		assert block.state.ori.toAxisAngle()[1] == pytest.approx(0, abs=1e-4)


def test_whoIsHeldDoesNotLimitTheStep():
	"""Real masses: the stable step is that of the blocks that may move, as soon as they may."""
	model, block = incline(math.atan(0.2))
	stepper = next(e for e in O.engines if isinstance(e, BlockTimeStepper))
	O.run(100, True)
	free, step = stepper.stableStep, O.dt
	assert math.isfinite(free) and O.dt == pytest.approx(0.6 * free / 2, rel=1e-12) # only contacts limit it, and count four times
	block.state.blockedDOFs, block.state.vel, block.state.angVel = held, (0, 0, 0), (0, 0, 0)
	O.run(2, True)
	assert stepper.stableStep == math.inf and O.dt == step # nothing limits it: it stays
	block.state.blockedDOFs = 'zXYZ'
	O.run(2, True)
	assert free < stepper.stableStep < math.inf # without rotation, and what couples with it
	O.bodies[0].state.blockedDOFs = 'zXY'
	block.state.blockedDOFs = 'zXY'
	O.run(2, True)
	assert stepper.stableStep <= free


def test_aKickAndWhatAContactMakesOfIt():
	"""Quasi-static: a rigid block falls at its true mass. Where it meets others, its mass is scaled, and it keeps its momentum, not its energy times a
	thousand."""
	rigidMaterials()
	model = BlockModel(thickness=0.1)
	floor = model.addRigid(rectangle(-1, -0.2, 1, 0), 'steel')
	block = model.addRigid(rectangle(0, 0.2, 0.1, 0.3), 'steel')
	model.insert()
	O.bodies[model.bodyOf(floor)].state.blockedDOFs = held
	O.trackEnergy = True
	O.dt, O.engines = 1e-3, movers(between(bonded=False), contacts=True, newton=dict(damping=0))
	state = O.bodies[model.bodyOf(block)].state
	state.vel = (0, -1, 0)
	O.run(50, True)
	assert state.mass == pytest.approx(7.8, rel=1e-12) and state.vel[1] == -1 and state.pos[1] == pytest.approx(0.2, rel=1e-12)
	while state.mass < 8:
		O.run(1, True)
	assert state.pos[1] > 0.05 and state.mass > 100 * 7.8 # before it touches
	assert state.mass * state.vel[1] == pytest.approx(-7.8, rel=1e-12)
	e = entries()
	assert e['blockKinetic'] == pytest.approx(7.8 / 2 * 7.8 / state.mass, rel=1e-12)
	assert sum(e.values()) == pytest.approx(7.8 / 2, rel=1e-12) # what it had at the start


@pytest.mark.parametrize('tilt', [0, 0.3])
def test_freeFallAndBounceKeepTheEnergy(tilt):
	"""A trapezium falls upon a rigid floor without friction, flat or on its corner, and comes up again with all its energy."""
	rigidMaterials()
	model = BlockModel(thickness=0.1)
	floor = model.addRigid(rectangle(-1, -0.2, 1, 0), 'steel')
	c, s = math.cos(tilt), math.sin(tilt)
	shape = [(c * x - s * y, s * x + c * y + 0.05) for x, y in [(0, 0), (0.12, 0), (0.1, 0.07), (0.02, 0.07)]]
	block = model.addRigid(shape, 'steel')
	model.gravity((0, -g))
	model.insert()
	O.bodies[model.bodyOf(floor)].state.blockedDOFs = held
	state = O.bodies[model.bodyOf(block)].state
	O.trackEnergy = True
	joint = JointMat(material1='steel', material2='steel', kn=1e9, ks=5e8, frictionAngle=0, bonded=False)
	O.engines = movers([joint], contacts=True, newton=dict(damping=0), stepper=dict(quasiStatic=False, safety=0.3), damping='none')
	O.dt = 2e-5
	start = state.pos[1]
	mechanical = lambda: state.mass * state.vel.squaredNorm() / 2 + state.inertia[2] * state.angVel[2]**2 / 2 + state.mass * g * (state.pos[1] - start)
	scale = state.mass * g * 0.05
	O.run(2000, True)
	n, fall = O.iter, start - state.pos[1]
	if O.dt == 2e-5: assert fall == pytest.approx(g * O.dt**2 * n * (n + 1) / 2, rel=1e-9) # the scheme's own answer
	sums, bottoms, after = [], [], []

	def note():
		sums.append(sum(entries().values()))
		bottoms.append(model.position[model.firstNode[1]:, 1].min())
		if min(bottoms) < 0 and bottoms[-1] > 1e-4: after.append(mechanical())

	O.engines = O.engines + [runner('look', note, 20)]
	O.run(16000, True)
	lowest = min(bottoms)
	assert -1e-3 < lowest < 0 and len(after) > 20
	assert max(abs(x) for x in sums) < 0.01 * scale
	assert max(abs(x) for x in after) < 0.01 * scale # v is half a step old: 1e-5 of it
	assert abs(state.angVel[2]) > 1 if tilt else abs(state.angVel[2]) < 1e-6


def test_toppling():
	"""A block of b/h = 1/3 upon a rough floor, gravity 1 degree below and above atan(b/h)."""
	for off, falls in ((-1, False), (1, True)):
		rigidMaterials()
		model = BlockModel(thickness=0.1)
		floor = model.addRigid(rectangle(-1, -0.2, 1, 0), 'steel')
		block = model.addRigid(rectangle(0, 0, 0.05, 0.15), 'steel')
		angle = math.atan(1 / 3) + math.radians(off)
		model.gravity((g * math.sin(angle), -g * math.cos(angle)))
		model.insert()
		O.bodies[model.bodyOf(floor)].state.blockedDOFs = held
		joint = JointMat(material1='steel', material2='steel', kn=1e11, ks=5e10, frictionAngle=math.atan(1), bonded=False)
		O.engines = movers([joint], contacts=True, newton=dict(damping=0.3), stepper=dict(quasiStatic=False, safety=0.5), damping='none')
		O.dt = 1e-5
		time = 0.3
		while O.time < time:
			O.run(2000, True)
		turned = -2 * O.bodies[model.bodyOf(block)].state.ori[2]
		# about the corner: I theta'' = m g R sin(1 degree + theta): grows as cosh(t sqrt(3 g / (4 R))) - 1, by a factor of some 3 in 0.3 s
		if falls: assert turned > 0.01
		else: assert abs(turned) < 1e-4


def test_irregularSupport():
	"""A square block stands on its corner in a notch, a rigid weight is glued to one side of it: the support carries both, with their moment."""
	rigidMaterials()
	model = BlockModel(thickness=0.1)
	support = model.addRigid([(-0.3, -0.2), (0.25, -0.15), (0.35, 0.2), (0.2, 0.2), (0, 0), (-0.2, 0.2), (-0.3, 0.2)], 'steel')
	stone = model.addRegion([(0, 0), (0.2, 0.2), (0, 0.4), (-0.2, 0.2)], 'unit', zoneSize=0.1)
	weight = model.addRigid([(0, 0.4), (0.2, 0.2), (0.25, 0.5), (0.1, 0.6)], 'steel')
	model.bond()
	model.gravity((0, -g))
	model.insert()
	low, high = O.bodies[model.bodyOf(support)].state, O.bodies[model.bodyOf(weight)].state
	low.blockedDOFs = held
	masses = [model.mass.sum(), high.mass]
	O.dt, O.engines = 1e-3, movers(between(**firm), newton=dict(damping=0.5), alpha=0.5)
	O.run(6000, True)
	assert model.unbalancedRatio() < 1e-6
	x, y = np.array(model.reference[model.firstNode[support]:model.firstNode[support + 1]]).T
	own = 7800 * 0.1 * g * (x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
	load = g * np.array(masses)
	force, torque = O.forces.f(model.bodyOf(support)), O.forces.t(model.bodyOf(support))
	assert tuple(force)[:2] == pytest.approx((0, -load.sum() - own), abs=1e-5 * load.sum())
	places = [O.bodies[model.bodyOf(stone)].state.pos[0], high.pos[0]]
	assert torque[2] == pytest.approx(-(load * (np.array(places) - low.pos[0])).sum(), rel=1e-5)
	assert high.mass != masses[1] # it was scaled, yet weighs what it weighed


def scene():
	"""A driven platen shears and presses a wall of Voronoi blocks upon a rigid base; a rigid block falls on it. Quasi-static, unbonded."""
	rigidMaterials()
	model = BlockModel(thickness=0.1)
	base = model.addRigid(rectangle(-0.1, -0.1, 0.5, 0), 'steel')
	model.addVoronoi(rectangle(0, 0, 0.4, 0.2), 'unit', size=0.08, seed=3)
	platen = model.addRigid([(0, 0.2), (0.2, 0.2), (0.2, 0.3), (0, 0.25)], 'steel')
	loose = model.addRigid([(0.25, 0.205), (0.33, 0.201), (0.35, 0.3)], 'steel')
	model.bond()
	model.gravity((0, -g))
	model.insert()
	O.bodies[model.bodyOf(base)].state.blockedDOFs = held
	driven = O.bodies[model.bodyOf(platen)].state
	driven.blockedDOFs, driven.vel, driven.angVel = held, (2e-4, -1e-4, 0), (0, 0, -2e-4)
	push = ForceEngine(force=(30, -500, 0), ids=[model.bodyOf(loose)])
	O.trackEnergy = True
	O.dt, O.engines = 1e-3, movers(between(tension=2e5, cohesion=2e5, dilationAngle=0), contacts=True, more=[push], newton=dict(damping=0.3), alpha=0.3)
	return model


def stateOfAll(model):
	out = state(model)
	for name in 'vel angVel ori inertia'.split():
		out[name] = np.array([tuple(getattr(b.state, name)) for b in O.bodies])
	out['mass'] = np.array([b.state.mass for b in O.bodies])
	out['forces'] = np.array([tuple(O.forces.f(b.id)) + tuple(O.forces.t(b.id)) for b in O.bodies])
	out['energy'] = np.array([value for name, value in sorted(entries().items())])
	return out


@pytest.mark.parametrize('ending', ['.xml', '.yade.bz2'])
def test_saveAndLoad(ending, tmp_path):
	whole = scene()
	O.run(700, True)
	expected = stateOfAll(whole)
	assert np.count_nonzero(whole.pointStatus) > 0 and np.isfinite(expected['vel']).all()
	scene()
	O.run(430, True)
	file = str(tmp_path / ('half' + ending))
	O.save(file)
	O.reset()
	O.load(file)
	O.run(270, True)
	assert differences(stateOfAll(model()), expected) == []


def test_sameBitsOnOneThreadAndTwo(tmp_path):
	script = 'import sys\nsys.path.insert(0, %r)\nfrom test_rigid import *\nimport hashlib\nm = scene()\nO.run(500, True)\n' % os.path.dirname(
		os.path.abspath(__file__)
	)
	script += "print('bits', *(name + ':' + hashlib.sha256(value.tobytes()).hexdigest()[:16] for name, value in stateOfAll(m).items()))\n"
	bits = []
	for threads in 1, 2:
		run = runYade(script, threads=threads, cwd=tmp_path)
		bits.append([line for line in run.stdout.splitlines() if line.startswith('bits')])
		assert bits[-1], run.stdout[-1000:] + run.stderr[-2000:]
	assert bits[0] == bits[1]


def test_theLastGoodStateHoldsBodiesToo():
	model = scene()
	O.run(320, True)
	model.velocity[model.firstNode[1]] = float('nan')
	with pytest.raises(RuntimeError, match='unstable'):
		O.run(300, True)
	assert O.iter == 300
	for b in O.bodies:
		first, last = model.firstNode[b.id], model.firstNode[b.id + 1]
		low, high = model.position[first:last].min(axis=0), model.position[first:last].max(axis=0)
		assert (low < tuple(b.state.pos)[:2]).all() and (high > tuple(b.state.pos)[:2]).all()
	O.run(200, True)
	assert np.isfinite(model.position).all()


def test_bodiesAreWhereTheLastGoodStateHadThem():
	model = scene()
	O.run(300, True)
	names = 'pos', 'vel', 'angVel', 'ori'
	at300 = [tuple(getattr(b.state, name)) for b in O.bodies for name in names]
	O.run(20, True)
	assert at300 != [tuple(getattr(b.state, name)) for b in O.bodies for name in names]
	model.velocity[model.firstNode[1]] = float('nan')
	with pytest.raises(RuntimeError, match='of step 300, is put back'):
		O.run(300, True)
	rigid = [b for b in O.bodies if model.firstZone[b.id] == model.firstZone[b.id + 1]]
	assert len(rigid) > 1
	assert [tuple(getattr(b.state, name)) for b in rigid for name in names] == [x for b in rigid for x in at300[4 * b.id:4 * b.id + 4]]


# ---- what is refused


def refusal(action=lambda: O.run(3, True)):
	with pytest.raises((ValueError, RuntimeError)) as caught:
		action()
	return str(caught.value)


def says(text, *words):
	assert not [word for word in words if word not in text], text


def without(*names):
	O.engines = [e for e in O.engines if type(e).__name__ not in names]


def test_missingEngines():
	rigidMaterials()
	model, low, high = pressed(between())
	full = list(O.engines)
	without('ForceResetter')
	says(refusal(), 'ForceResetter', 'BlockForces')
	O.engines = full[1:4] + [full[0]] + full[4:]
	says(refusal(), 'ForceResetter', 'before BlockLoop or BlockForces')
	O.engines = full
	without('NewtonIntegrator')
	says(refusal(), 'NewtonIntegrator', 'rigid block 2 (body 2)', 'xyzXYZ')
	full[4].dead = True
	O.engines = full
	says(refusal(), 'NewtonIntegrator', 'rigid block 2')
	full[4].dead = False
	O.engines = full[:4] + [full[5], full[4]]
	says(refusal(), 'NewtonIntegrator', 'between', 'late')
	high.state.blockedDOFs = held # then nobody need move it
	O.engines = full[:4] + full[5:]
	O.run(3, True)
	high.state.vel = (0, -1, 0)
	says(refusal(), 'NewtonIntegrator')


def test_otherGravityMassPlaneGroups():
	rigidMaterials()
	model, low, high = pressed(between(), newton=dict(gravity=(0, 0, 1)))
	says(refusal(), 'NewtonIntegrator.gravity', 'BlockModel.gravity')
	O.engines[4].gravity = (0, 0, 0)
	O.run(3, True)
	O.engines[4].damping = 0.9 # 0.7 of the stable step is too much for it
	says(refusal(lambda: O.run(200, True)), 'NewtonIntegrator.damping', 'O.dt')
	O.engines[4].damping = 0.2
	O.run(200, True)
	high.state.mass *= 2
	says(refusal(), 'state.mass', 'rigid block 2')
	model, low, high = pressedAgain()
	high.state.blockedDOFs, high.state.angVel = 'Z', (1, 0, 0)
	says(refusal(), 'x-y plane', 'rigid block 2')
	model, low, high = pressedAgain()
	high.state.blockedDOFs, high.state.vel = 'Z', (0, 0, 1)
	says(refusal(), 'x-y plane', 'rigid block 2')
	model, low, high = pressedAgain()
	says(refusal(lambda: model.drive('top', nodesWhere(model, lambda x, y: y > 0.55), 'y')), '"top"', 'rigid block')


def pressedAgain():
	rigidMaterials()
	return pressed(between())


def test_outlines():
	rigidMaterials()
	model = BlockModel()
	for outline in [(0, 0), (2, 2), (2, 0), (0, 1)], rectangle(0, 0, 1, 1)[::-1], [(0, 0), (1, 0)], [(0, 0), (1, 0), (float('nan'), 1)]:
		refusal(lambda: model.addRigid(outline, 'steel'))
	says(refusal(lambda: model.addRigid(rectangle(0, 0, 1, 1), 'clay')), '"clay"')
	refusal(lambda: model.addRigid(rectangle(0, 0, 1, 1), 'steel', holes=[rectangle(0.5, 0.5, 1.5, 0.7)]))
	model.addRigid(rectangle(0, 0, 1, 1), 'steel')
	says(refusal(lambda: model.addRigid(rectangle(0.5, 0.5, 1.5, 1.5), 'steel')), 'overlap')
	says(refusal(lambda: model.addRegion(rectangle(0.5, 0.5, 1.5, 1.5), 'unit', zoneSize=1)), 'overlap')
	assert model.blockCount == 1
	model.insert()
	says(refusal(lambda: model.addRigid(rectangle(2, 0, 3, 1), 'steel')), 'BlockModel.addRigid', 'insert')
	says(refusal(lambda: model.bodyOf(1)), 'bodyOf', '1')


def test_erased():
	rigidMaterials()
	model, low, high = pressed(between())
	O.run(2, True)
	O.bodies.erase(high.id)
	says(refusal(), '2', 'erased')


@pytest.mark.parametrize('shape', ['wall', 'facet', 'box', 'sphere'])
def test_otherShapes(shape):
	from yade import utils
	rigidMaterials()
	model, low, high = pressed(between(), contacts=True)
	O.run(2, True)
	O.materials.append(FrictMat(label='other'))
	body = dict(
		wall=lambda: utils.wall(-1, axis=1), facet=lambda: utils.facet([(0, -1, -1), (1, -1, -1), (0, -1, 1)]),
		box=lambda: utils.box((0, -2, 0), (1, 1, 1)), sphere=lambda: utils.sphere((0, -5, 0), 1)
	)[shape]()
	body.mask = 2
	O.bodies.append(body)
	O.run(2, True) # it has nothing to do with blocks
	other = utils.sphere((0, -9, 0), 1) if shape == 'sphere' else body.__class__()
	if shape != 'sphere': other.shape, other.state, other.material = body.shape, body.state, body.material
	O.bodies.append(other)
	says(refusal(), 'body 4', type(body.shape).__name__, 'addRigid')


# ---- pictures


def test_picturesAndExport(tmp_path):
	from yadeblocks.export import BlocksExport
	from yadeblocks.pictures import drawCracks
	import meshio
	model = scene()
	O.run(50, True)
	export = BlocksExport(tmp_path)
	export.write(model, O.time)
	drawCracks(tmp_path / 'cracks.png', model)
	assert (tmp_path / 'cracks.png').stat().st_size > 1000
	mesh = meshio.read(tmp_path / 'blocks_0000.vtu')
	rigid = np.flatnonzero(np.diff(model.firstZone) == 0)
	triangles, blocks = mesh.cells[0].data[model.zoneCount:], mesh.cell_data['block'][0][model.zoneCount:]
	assert len(mesh.cells) == 1 and blocks.tolist() == np.repeat(rigid, (2, 2, 1)).tolist() # two rectangles, a wedge
	assert all(model.firstNode[block] <= node < model.firstNode[block + 1] for block, nodes in zip(blocks, triangles) for node in nodes)
	velocity = mesh.point_data['velocity']
	assert velocity[model.firstNode[rigid[1]]][0] == pytest.approx(2e-4, rel=0.2) # the driven platen's grid points move


def test_rigidBlocksAreDrawnWithTheirHoles():
	O.materials.append(BlockMat(label='steel', young=200e9, poisson=0.3, density=7800))
	model = BlockModel(thickness=1)
	notched = model.addRigid([(0, 0), (4, 0), (4, 4), (2, 3), (0, 4)], 'steel', holes=[[(1, 1), (1, 2), (2, 2)], [(3, 1), (3, 2), (3.5, 1)]])
	(x0, y0), (x1, y1), (x2, y2) = np.moveaxis(model.reference[model.cornerTriangles(notched)], (1, 2), (0, 1))
	areas = ((x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)) / 2
	assert (areas > 0).all() and areas.sum() == pytest.approx(16 - 2 - 0.5 - 0.25)
	for wrong in (-1, 1):
		says(str(pytest.raises(ValueError, model.cornerTriangles, wrong).value), 'BlockModel.cornerTriangles', 'block', str(wrong))


@pytest.mark.parametrize('quasiStatic, said', [(False, True), (True, False)])
def test_nothingLimitsTheTimeStep(tmp_path, quasiStatic, said):
	"""A rigid block alone: O.dt stays YADE's 1e-8 s, which must not go unnoticed."""
	run = runYade(
		"""
import yadeblocks
from yade import *
from yadeblocks.specimen import rectangle
O.materials.append(BlockMat(label='steel', young=200e9, poisson=0.3, density=7800))
model = BlockModel(thickness=1)
model.addRigid(rectangle(0, 0, 1, 1), 'steel')
model.insert()
O.engines = [ForceResetter(), BlockTimeStepper(quasiStatic=%s), BlockForces(), NewtonIntegrator(), BlockIntegrator(rescueFile='')]
O.run(5, True)
print('dt', O.dt)
""" % quasiStatic, cwd=tmp_path
	)
	assert 'dt 1e-08' in run.stdout and run.returncode == 0, run.stdout + run.stderr
	assert ((run.stdout + run.stderr).count('nothing limits the time step') == 1) == said
