# yade-blocks, GPL-2.0-or-later
"""A rocking block: a quarter of its period (Housner 1963).

A rigid block, tilted about one of its lower corners, is let go on a rigid floor and falls back; the time until it stands upright is a quarter of the
period. True masses, no damping, general contact.

	scripts/run.sh rocking [tilt=0.5] [key=value ...]        some seconds

Expected for small angles: T/4 = acosh(1 / (1 - tilt)) / p, with tilt by the slenderness angle atan(b / h) and p = sqrt(3 g / (4 R)) of a rectangle with half
diagonal R. The exact pendulum, integrated numerically, stands beside it.
"""
from math import acosh, atan2, cos, hypot, sin, sqrt

import numpy as np

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks import pictures, scenario
from yadeblocks.engines import loopList
from yadeblocks.recording import Recorder
from yadeblocks.scenario import Key
from yadeblocks.session import Session
from yadeblocks.specimen import rectangle

# ---- parameters (SI)

density, g, thickness = 2500., 9.81, 1.
p = scenario.parameters({
	**scenario.usualParameters(threads=1, tag=''), 'width': Key(0.1, 'width of the block', 'm',
									scenario.positive), 'height': Key(1., 'height of the block', 'm', scenario.positive),
	'tilt': Key(0.5, 'tilt at first by the angle at which it topples', rule=(lambda x: 0 < x < 1, 'must lie in (0, 1)')),
	'kn': Key(1e10, 'normal stiffness of the contact; half of it along it', 'Pa/m', scenario.positive)
})
slender, halfDiagonal = atan2(p.width, p.height), hypot(p.width, p.height) / 2
frequency = sqrt(3 * g / (4 * halfDiagonal))
housner = acosh(1 / (1 - p.tilt)) / frequency


def pendulum(steps=20000):
	"""Time until upright of theta'' = -frequency^2 sin(slender - theta), by the leapfrog [s]; its error falls with the square of the step."""
	theta, speed, dt = p.tilt * slender, 0., housner / steps
	speed -= dt / 2 * frequency**2 * sin(slender - theta)
	time = 0.
	while theta > 0:
		theta, time = theta + dt * speed, time + dt
		speed -= dt * frequency**2 * sin(slender - theta)
	return time


def build():
	"""The tilted block on its lower right corner, at x = 0."""
	O.reset()
	O.materials.append(BlockMat(label='stone', young=20e9, poisson=0.2, density=density))
	model = BlockModel(thickness=thickness)
	c, s = cos(p.tilt * slender), sin(p.tilt * slender)
	block = model.addRigid([(c * x + s * y, -s * x + c * y) for x, y in rectangle(-p.width, 0, 0, p.height)], 'stone')
	floor = model.addRigid(rectangle(-p.height, -0.2, p.height, 0), 'stone')
	model.bond([JointMat(material1='stone', material2='stone', kn=p.kn, ks=p.kn / 2, bonded=False, frictionAngle=1.2)])
	model.gravity((0, -g))
	model.insert()
	O.bodies[model.bodyOf(floor)].state.blockedDOFs = 'xyzXYZ'
	O.engines = loopList(contact=True, newton=dict(damping=0), quasiStatic=False, damping='none')
	return model, O.bodies[model.bodyOf(block)].state


# ---- running

with Session(p) as session:
	with session.run(1) as run:
		with run.stepping():
			model, state = build()
			record = Recorder(time=lambda: O.time, turned=lambda: state.rot()[2])
			O.run(1, True)
			O.engines += [record.engine(20)]
			while O.time < 1.5 * housner and abs(state.rot()[2]) < p.tilt * slender:
				O.run(100, True)
		time, turned = record['time'], abs(record['turned'])
		upright = np.interp(p.tilt * slender, turned, time)
		run.add('quarter_period', 's', upright, housner, 'Housner 1963')
		run.add('quarter_period_of_the_pendulum', 's', upright, pendulum(), 'rigid pendulum about the corner')
		run.curve(time_s=time, angle_rad=p.tilt * slender - turned)
		run.model(model, steps=O.iter)
	session.write()
	session.picture('cracks.png', pictures.drawCracks, model, title='Rocking block, upright again')
scenario.waitIfBatch()
