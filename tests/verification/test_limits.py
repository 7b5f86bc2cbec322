# yade-blocks, GPL-2.0-or-later
"""What the method does not do: numbers that the manual gives (py/manual/limits.md), each as it was measured."""
from math import atan2, cos, sin, sqrt

import numpy as np
import pytest

import yadeblocks # noqa: F401 (loads the plugin)
from test_exact import begin, density, dynamic, strong, young
from yade import *
from yadeblocks.engines import loopList
from yadeblocks.recording import runner
from yadeblocks.specimen import nodesWhere, rectangle
from yadeblocks.voussoirs import arch


def cantilever(parts, poisson):
	"""Tip deflection of a beam of 4 x 1 m under a shear traction at its end, so many zones' edges over its height, by Timoshenko's."""
	begin(poisson)
	length, height, load = 4., 1., 1e4
	model = BlockModel(thickness=1)
	model.addRegion(rectangle(0, 0, length, height), 'rock', zoneSize=height / parts, zoning='regular')
	model.bond()
	model.drive('wall', nodesWhere(model, lambda x, y: x < 1e-9), 'xy')
	ends = model.reference[model.edgeNodes][:, :, 0]
	model.traction(np.flatnonzero((ends > length - 1e-9).all(axis=1)), (0, -load / height))
	model.insert()
	O.dt, O.engines = 1e-3, loopList(damping='local', alpha=0.3, rescueFile='')
	O.run((600 * parts + 1500) * (6 if poisson > 0.4 else 1), True) # soft modes are slow beside a stiff volume
	inertia, shear = height**3 / 12, young / (2 * (1 + poisson))
	theory = load * length**3 * (1 - poisson**2) / (3 * young * inertia) + 6 / 5 * load * length / (shear * height)
	tip = nodesWhere(model, lambda x, y: x > length - 1e-9)
	return -model.displacement[tip, 1].mean() / theory


slow = lambda *values: pytest.param(*values, marks=pytest.mark.slow)


@pytest.mark.parametrize(
	'poisson, parts, seen', [(0.2, 2, 0.62), (0.2, 4, 0.86),
					slow(0.2, 8, 0.96),
					slow(0.2, 16, 0.99), (0.49, 4, 0.83),
					slow(0.49, 8, 0.92),
					slow(0.49, 16, 0.95)]
)
def test_locking(poisson, parts, seen, compare):
	"""Zones of constant strain are too stiff in bending, and more so where they cannot change their volume (plane strain)."""
	what = "limit: cantilever, nu %g, zones of h/%d, deflection by Timoshenko's" % (poisson, parts)
	compare(what, seen, cantilever(parts, poisson), 0.03, 'as measured; 1 would be right')


@pytest.mark.parametrize('width, kn, seen', [(0.35, 1e10, 0.90), (0.35, 1e11, 0.90), (0.2, 1e10, 0.97)])
def test_rockingRestitution(width, kn, seen, compare):
	"""A rocking block hardly loses anything on a floor without damping, where Housner's lands with all its momentum about the new corner."""
	begin()
	height, g = 1., 9.81
	slender = atan2(width, height)
	model = BlockModel(thickness=1)
	tilt = 0.5 * slender
	c, s = cos(tilt), sin(tilt)
	block = model.addRigid([(c * x + s * y, -s * x + c * y) for x, y in rectangle(-width, 0, 0, height)], 'rock')
	floor = model.addRigid(rectangle(-height, -0.2, height, 0), 'rock')
	model.bond(strong(kn=kn, ks=kn / 2, bonded=False, frictionAngle=1.2))
	model.gravity((0, -g))
	model.insert()
	O.bodies[floor].state.blockedDOFs = 'xyzXYZ'
	O.engines = loopList(contact=True, newton=dict(damping=0), **dynamic)
	state, energy = O.bodies[block].state, lambda angle: cos(slender - angle) - cos(slender)
	angles = [tilt]
	while O.time < 1.5:
		O.run(200, True)
		axis = state.ori.toAxisAngle()
		angles.append(tilt + axis[1] * (1 if axis[0][2] > 0 else -1) * -1)
	other = -min(angles)
	what = 'limit: rocking, kn %.0e, restitution (Housner: %.2f)' % (kn, 1 - 1.5 * sin(slender)**2)
	compare(what, seen, sqrt(energy(other) / energy(tilt)), 0.03, 'as measured')


def fallingArch(**motion):
	"""A semicircle of 40 deformable voussoirs, 0.10 of its radius thick, where 0.1075 is the least (Milankovitch): it falls. Gravity is there at once."""
	O.reset()
	O.materials.append(BlockMat(label='rock', young=20e9, poisson=0.2, density=density))
	model = BlockModel(thickness=1)
	arch(1, 0.10, 40).addTo(model, 'rock', zoneSize=0.2)
	supports = [model.addRigid(rectangle(x - 0.2, -0.2, x + 0.2, 0), 'rock') for x in (-1, 1)]
	model.bond([JointMat(material1='rock', material2='rock', kn=3e10, ks=1.5e10, bonded=False, frictionAngle=atan2(2, 1))])
	model.gravity((0, -9.81))
	model.insert()
	for support in supports:
		O.bodies[model.bodyOf(support)].state.blockedDOFs = 'xyzXYZ'
	O.dt, O.engines = 1e-4, loopList(contact=True, newton=dict(damping=0), **motion)
	return model


def test_collapseWithScaledMasses(compare):
	"""Masses that suit the stiffest springs make a mechanism of whole blocks heavy. How far it goes in a step does not depend on O.dt then.
	Which of its two diagonals parts a voussoir into zones is decided by rounding, and moves the result by a quarter either way."""
	model = fallingArch(damping='local', alpha=0.3, rescueFile='')
	O.run(30000, True)
	compare('limit: arch that must fall, 30,000 steps with scaled masses, sunk [mm]', 0.54, -1e3 * model.displacement[:, 1].min(), 0.35, 'as measured')
	model = fallingArch(**dynamic)
	O.run(1, True)
	while model.displacement[:, 1].min() > -0.5 and O.time < 1.5:
		O.run(int(0.01 / O.dt), True)
	compare('limit: the same arch, true masses, its time until it is down by half its radius [s]', 0.56, O.time, 0.05, 'as measured')


def couplet(steps, alpha):
	"""Strength [Pa] of two bricks with a layer of Voronoi mortar, 0.04 x 0.03 m, pulled by 0.024 mm in so many steps; it breaks at half of them."""
	O.reset()
	O.resetTime()
	for label, modulus in ('unit', 16.7e9), ('mortar', 3e9):
		O.materials.append(BlockMat(label=label, young=modulus, poisson=0.2, density=1900))
	model = BlockModel(thickness=0.05)
	model.addVoronoi(rectangle(0, 0.01, 0.04, 0.02), 'mortar', size=6e-3, seed=3)
	for y in 0, 0.02:
		model.addRegion(rectangle(0, y, 0.04, y + 0.01), 'unit', zoneSize=5e-3)
	pairs = ('unit', 'unit'), ('unit', 'mortar'), ('mortar', 'mortar')
	model.bond([JointMat(material1=a, material2=b, kn=400e9, ks=200e9, frictionAngle=0.66, cohesion=0.6e6, tension=0.6e6) for a, b in pairs])
	model.drive('bottom', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
	model.drive('top', nodesWhere(model, lambda x, y: y > 0.03 - 1e-9), 'y', velocity=0.024e-3 / 1.5, rampTime=0.075)
	model.insert()
	forces = []
	O.dt, O.engines = 1.5 / steps, loopList(alpha=alpha, rescueFile='') + [runner('force', lambda: forces.append(model.groupForce('top')))]
	O.run(int(0.8 * steps), True)
	return max(forces) / (0.04 * 0.05)


@pytest.mark.parametrize('alpha, fast', [(0.3, {500: 1.118, 1000: 1.049, 2000: 1.018}), (0.8, {500: 1.63, 1000: 1.125, 2000: 1.079, 5000: 1.011})])
def test_loadingThatIsTooFast(alpha, fast, compare):
	"""Against 20,000 steps, which 80,000 change by less than 0.3 %."""
	strength = couplet(20000, alpha)
	for steps, seen in fast.items():
		compare(
			'limit: strength in tension, alpha %g, %d steps by 20,000' % (alpha, steps), seen,
			couplet(steps, alpha) / strength, 0.01, 'as measured'
		)
