# yade-blocks, GPL-2.0-or-later
"""Blocks and joints against closed forms. Tolerances are those of the zones and steps that a case has, derived beside it."""
from math import atan, cos, pi, radians, sin, sqrt, tan

import numpy as np
import pytest

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks.engines import loopList
from yadeblocks.recording import runner
from yadeblocks.specimen import nodesWhere, rectangle

young, density = 20e9, 2500.


def begin(poisson=0.):
	O.reset()
	O.resetTime()
	O.materials.append(BlockMat(label='rock', young=young, poisson=poisson, density=density))


def strong(**properties):
	"""A joint that does not break, unless told otherwise."""
	return [JointMat(material1='rock', material2='rock', **{**dict(kn=1e12, ks=1e12, cohesion=1e15, tension=1e15), **properties})]


dynamic = dict(quasiStatic=False, damping='none', rescueFile='')


@pytest.mark.parametrize('zone, parts, steps, allowed', [(0.7, 50, 3000, 0.06), pytest.param(0.25, 100, 12000, 0.03, marks=pytest.mark.slow)])
def test_kirsch(zone, parts, steps, allowed, compare):
	"""A quarter of a plate of 40 x 40 radii with a hole, pulled along x. Zones of constant strain err with their size, which grows away from the hole:
	by 5 % with 2,000 zones, half of it with four times as many. The plate's end adds 0.8 % (Heywood: (2 + (1 - d/W)^3) / (1 - d/W), d/W = 0.05)."""
	begin(poisson=0.25)
	size, sigma = 20., 1e6
	arc = [(cos(pi / 2 * i / parts), sin(pi / 2 * i / parts)) for i in range(parts, -1, -1)]
	model = BlockModel(thickness=1, planeStress=True)
	model.addRegion(arc + [(size, 0), (size, size), (0, size)], 'rock', zoneSize=zone)
	model.bond()
	model.drive('left', nodesWhere(model, lambda x, y: x < 1e-9), 'x')
	model.drive('low', nodesWhere(model, lambda x, y: y < 1e-9), 'y')
	ends = model.reference[model.edgeNodes][:, :, 0]
	model.traction(np.flatnonzero((ends > size - 1e-9).all(axis=1)), (sigma, 0))
	model.insert()
	O.dt, O.engines = 1e-3, loopList(damping='local', alpha=0.7, rescueFile='')
	O.run(steps, True)
	at = lambda x, y: int(np.argmin(np.hypot(model.reference[:, 0] - x, model.reference[:, 1] - y)))
	top, next_, side = at(*arc[0]), at(*arc[1]), at(*arc[-1])
	edge = model.reference[next_] - model.reference[top]
	stretch = np.linalg.norm(edge + model.displacement[next_] -
					model.displacement[top]) / np.linalg.norm(edge) - 1 # along the wall, where stress is uniaxial
	source = 'Kirsch 1898'
	what = 'hole, %d zones: ' % model.zoneCount
	compare(what + 'stress at the wall by the far one', 3, young * stretch / sigma, allowed, source)
	compare(what + 'displacement of the wall along the pull [m]', 3 * sigma / young, model.displacement[side, 0], allowed, source)
	compare(what + 'displacement of the wall across it [m]', -sigma / young, model.displacement[top, 1], allowed, source)


def test_inclinedJoint(compare):
	"""A column of two blocks that move up and down only, with a joint at 50 degrees that slides under load, sticks as the load turns, slides back, and
	sticks again. Strains are uniform, so that zones are exact; what counts is rounding and what is left of the motion, below 1e-6, and that strains of 1e-5
	are not quite linear. Sliding back begins from where the column has swung a little too far and stuck: 3e-3 of that leg, less if it is slower."""
	begin()
	angle, friction, kn, ks, height, width = radians(50), radians(25), 1e11, 1e11, 2., 0.5
	slope = tan(angle)
	middle = height / 2 - slope * width / 2
	model = BlockModel(thickness=1)
	low, high = (0, middle), (width, middle + slope * width)
	model.addRegion([(0, 0), (width, 0), high, low], 'rock', zoneSize=0.5)
	model.addRegion([low, high, (width, height), (0, height)], 'rock', zoneSize=0.5)
	model.bond(strong(kn=kn, ks=ks, bonded=False, frictionAngle=friction))
	model.drive('straight', range(model.nodeCount), 'x')
	model.drive('low', nodesWhere(model, lambda x, y: y < 1e-9), 'y')
	model.drive('top', nodesWhere(model, lambda x, y: y > height - 1e-9), 'y', velocity=0)
	model.insert()
	O.dt, O.engines = 1e-3, loopList(damping='local', alpha=0.5, rescueFile='')
	states = []

	def go(path, steps=2000):
		"""Moves the top by so much and waits; the point of the curve that this is."""
		model.setTarget('top', -path / (steps * O.dt))
		O.run(steps, True)
		model.setTarget('top', 0)
		O.run(2000, True)
		states.append((-model.groupTravelled('top'), -model.groupForce('top') / width))

	c, s, t = cos(angle), sin(angle), tan(friction)
	column = lambda joint: 1 / (height / young + 1 / joint) # stress by the top's path [Pa/m]
	stick, slide, back = column((kn * c**2 + ks * s**2) / c), column(kn * c * (1 + t * slope)), column(kn * c * (1 - t * slope))
	for path in 2e-5, 1e-5, -2e-6, -2e-6, 2e-6, 1e-6: # the last leg only begins to reload
		go(path)
	stiffness = [(b[1] - a[1]) / (b[0] - a[0]) for a, b in zip(states, states[1:])]
	source = 'springs in a row'
	compare('inclined joint: stiffness of loading, sliding [Pa/m]', slide, stiffness[0], 1e-4, source)
	compare('inclined joint: of unloading, sticking [Pa/m]', stick, stiffness[1], 1e-4, source)
	compare('inclined joint: of reloading, sticking [Pa/m]', stick, stiffness[3], 1e-4, source)
	go(-2.55e-5, 4000), go(-2e-6, 4000) # sliding back begins where the joint has lost 56 % of its closure
	compare('inclined joint: of unloading, sliding back [Pa/m]', back, (states[-1][1] - states[-2][1]) / (states[-1][0] - states[-2][0]), 5e-3, source)


def bar(length, zone, **joint):
	"""Two halves, with a joint in the middle."""
	model = BlockModel(thickness=1)
	for x in 0, length / 2:
		model.addRegion(rectangle(x, 0, x + length / 2, zone), 'rock', zoneSize=zone, zoning='regular')
	model.bond(strong(**joint))
	return model


def passed(axis, ks, strength=None, zone=0.05):
	"""Velocity behind the joint, step by step, of a wave that comes along the bar, and what theory makes of the wave: dv/dt = 2 k / z (vi - v), which a
	slipping joint cuts off at its strength by the impedance z. Axis 0 is a P wave, 1 an S wave."""
	begin()
	length, wave, speed = 20., 2., 1e-3
	properties = dict(kn=ks, ks=ks)
	if strength is not None:
		properties.update(cohesion=strength, cohesionResidual=strength, frictionAngle=0, tension=1e15, tensionResidual=1e15)
	model = bar(length, zone, **properties)
	model.drive('straight', range(model.nodeCount), 'yx'[axis])
	model.insert()
	c = sqrt((young if axis == 0 else young / 2) / density)
	z = density * c
	shape = lambda x: np.where(abs(x - 7) < wave, speed * np.cos(pi / 2 * (x - 7) / wave)**2, 0) # half of it goes either way
	O.engines = loopList(**{**dynamic, 'safety': 0.5})
	O.run(1, True)
	model.velocity[:, axis] = shape(model.reference[:, 0])
	behind = nodesWhere(model, lambda x, y: abs(x - 10.5) < 1e-6)
	history = []
	O.engines = O.engines + [runner('look', lambda: history.append(model.velocity[behind, axis].mean()))]
	steps = int(6.3 / c / O.dt) # until the wave has gone by, before what the ends send back comes
	O.run(steps, True)
	fine, theory, v = 20, [], 0.
	for i in range(steps * fine):
		vi = shape(10.0 - c * (i + 0.5) * O.dt / fine) / 2
		v += O.dt / fine * 2 * ks / z * (vi - v)
		if strength is not None: v = min(v, strength / z)
		theory.append(float(v))
	return np.array(history), np.array(theory[::fine]), z, O.dt


@pytest.mark.parametrize('axis, name', [(0, 'P'), (1, 'S')])
def test_waveThroughAJoint(axis, name, compare):
	"""2 k / z by the wave's frequency: 0.5, 1 and 3. Numerical dispersion of 80 zones a wave: (pi h / l)^2 / 6 = 3e-4 in the arrival, which does not count
	in the peak, and as much of it in the peak."""
	begin()
	c = sqrt((young if axis == 0 else young / 2) / density)
	for ratio in 0.5, 1, 3:
		stiffness = ratio * density * c * (2 * pi * c / 4) / 2
		seen, theory, _, _ = passed(axis, stiffness)
		what = '%s wave through a joint, 2 k / (z omega) = %g: peak by the incoming' % (name, ratio)
		compare(what, theory.max() / 5e-4, seen.max() / 5e-4, 5e-3, 'Schoenberg 1980')


def test_slippingJoint(compare):
	"""A shear wave at a joint that slips at a third of its stress: it passes cut off, but for what zones ring where it is cut."""
	begin()
	c = sqrt(young / 2 / density)
	strength = density * c * 5e-4 / 3
	seen, theory, z, dt = passed(1, 1e12, strength)
	compare('slipping joint under a shear wave: velocity behind it [m/s]', strength / z, np.median(seen[seen > 0.8 * strength / z]), 0.01, 'Miller 1977')
	compare('slipping joint: what passes, the integral of velocity [m]', theory.sum() * dt, seen.sum() * dt, 0.02, 'Miller 1977')


def test_barFrequency(compare):
	"""A bar, held at one end, in its first mode: masses at grid points make it lower by (pi h / 4 l)^2 / 6 = 6e-5, the step by (omega dt)^2 / 24, less."""
	begin()
	length, zone = 4., 0.1
	model = BlockModel(thickness=1)
	model.addRegion(rectangle(0, 0, length, zone), 'rock', zoneSize=zone, zoning='regular')
	model.bond()
	model.drive('wall', nodesWhere(model, lambda x, y: x < 1e-9), 'xy')
	model.insert()
	O.engines = loopList(**dynamic)
	O.run(1, True)
	model.velocity[:, 0] = 1e-3 * np.sin(pi / 2 * model.reference[:, 0] / length)
	end, crossings, last = nodesWhere(model, lambda x, y: x > length - 1e-9), [], [0., 1e-3]

	def look():
		v = model.velocity[end, 0].mean()
		if v < 0 <= last[1] or v >= 0 > last[1]: crossings.append(last[0] + O.dt * last[1] / (last[1] - v))
		last[:] = O.time, v

	O.engines = O.engines + [runner('look', look)]
	period = 4 * length / sqrt(young / density)
	O.run(int(5.5 * period / O.dt), True)
	half = (crossings[-1] - crossings[0]) / (len(crossings) - 1)
	compare('bar, first longitudinal frequency [Hz]', 1 / period, 1 / (2 * half), 1e-3, 'c / 4 l')


def test_newmark(compare):
	"""A block on a base that swings by twice what friction passes on. Its contact is elastic, by mu rho g h / ks = 2e-7 m, and swings at 300 Hz about
	what is passed on: some 1e-3 of it."""
	begin()
	g, mu, frequency = 9.81, 0.3, 2.
	model = BlockModel(thickness=1)
	model.addRegion(rectangle(-2, -0.5, 2, 0), 'rock', zoneSize=0.5)
	model.addRegion(rectangle(-0.5, 0, 0.5, 0.5), 'rock', zoneSize=0.5)
	model.bond(strong(kn=2e10, ks=2e10, bonded=False, frictionAngle=atan(mu)))
	base, block = range(model.firstNode[1]), slice(model.firstNode[1], model.firstNode[2])
	model.drive('floor', base, 'y')
	model.drive('base', base, 'x')
	model.gravity((0, -g))
	model.insert()
	O.engines = loopList(contact=True, **{**dynamic, 'damping': 'local', 'alpha': 0.5})
	O.run(2000, True) # at rest
	O.engines[-1].damping = 'none'
	start, amplitude, omega = O.time, 2 * mu * g, 2 * pi * frequency
	velocity = lambda time: amplitude / omega * (1 - cos(omega * time))
	place = lambda: model.displacement[block, 0].mean() - model.groupTravelled('base')
	before, seen = place(), []
	shake = runner('shake', lambda: model.setTarget('base', velocity(O.time + O.dt / 2 - start)))
	look = runner('look', lambda: seen.append(place() - before))
	look.iterPeriod = 20
	O.engines = [shake] + O.engines + [look]
	O.run(int(2 / frequency / O.dt), True)
	fine, v, x, theory = 50000, 0., 0., []
	dt = (O.time - start) / fine
	for i in range(fine):
		vb = velocity((i + 1) * dt)
		v = min(max(vb, v - mu * g * dt), v + mu * g * dt)
		x += dt * (v - vb)
		theory.append(x)
	compare('block on a base that swings: largest slip in two cycles [m]', -min(theory), -min(seen), 0.01, 'Newmark 1965')


def leans(angle, blocks, mu=0.7):
	"""Whether a stack of blocks of 0.4 x 0.3 m goes over, or slides, when the ground is tilted so far."""
	begin()
	model = BlockModel(thickness=1)
	model.addRigid(rectangle(-0.5, -0.2, 0.5, 0), 'rock')
	for i in range(blocks):
		model.addRigid(rectangle(-0.2, 0.3 * i, 0.2, 0.3 * (i + 1)), 'rock')
	model.bond(strong(kn=1e11, ks=1e11, bonded=False, frictionAngle=atan(mu)))
	model.gravity((9.81 * sin(angle), -9.81 * cos(angle)))
	model.insert()
	O.bodies[0].state.blockedDOFs = 'xyzXYZ'
	O.engines = loopList(contact=True, newton=dict(damping=0.3), **dynamic)
	newton = next(e for e in O.engines if isinstance(e, NewtonIntegrator))
	O.run(300, True) # comes to rest on its springs
	newton.damping, top = 0, O.bodies[blocks]
	while O.time < 1.5:
		O.run(1000, True)
		if np.linalg.norm(top.state.pos - top.state.refPos) > 0.005: return True
	return False


@pytest.mark.slow
@pytest.mark.parametrize('blocks, theory, what', [(1, atan(0.7), 'slides'), (3, atan(0.4 / 0.9), 'topples')])
def test_tiltingStack(blocks, theory, what, compare):
	"""Bisection of the tilt to 0.5 %; where it just goes over it does so slowly, and a contact of two end points yields at its corner."""
	low, high = 0.8 * theory, 1.2 * theory
	assert not leans(low, blocks) and leans(high, blocks)
	while high - low > 0.005 * theory:
		middle = (low + high) / 2
		if leans(middle, blocks): high = middle
		else: low = middle
	compare('stack of %d, tilt at which it %s [rad]' % (blocks, what), theory, (low + high) / 2, 0.01, 'statics')
