# yade-blocks, GPL-2.0-or-later
"""Dry walls under horizontal forces: the limit multiplier (Ferris and Tin-Loi 2001).

A wall of rigid blocks, 0.4 x 0.175 m, in running bond without mortar on a rigid base, friction coefficient 0.65; odd courses begin and end with half
blocks. First it takes its weight, then a horizontal force alpha W on every block of weight W. The limit is the largest alpha under which the wall comes to
rest, found by bisection; each trial begins anew and brings the force on gradually.

	scripts/run.sh drywall [courses=6|10] [dilation=true|false] [key=value ...]        about 10 s

Expected with dilation equal to friction (associated flow, where the limit is unique): 0.64286 (5 blocks by 6 courses) and 0.58000 (5 by 10), from a linear
programme. Without dilation published answers are about 0.640 and 0.560 to 0.564; the associated limit is an upper bound of all of them.
"""
from math import atan

import numpy as np

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks import loading, pictures, scenario
from yadeblocks.bisection import bisect
from yadeblocks.brickwork import runningBond
from yadeblocks.engines import loopList
from yadeblocks.scenario import Key
from yadeblocks.session import Session
from yadeblocks.specimen import rectangle

# ---- parameters (SI)

length, height, thickness, bricks = 0.4, 0.175, 0.1, 5 # [m]
friction, density, g = 0.65, 2000., 9.81
expected = { # courses, dilation -> (limit multiplier, source)
	(6, True): (0.64286, 'linear programme, associated flow'), (10, True): (0.58000, 'linear programme, associated flow'),
	(6, False): (0.640, 'Ferris and Tin-Loi 2001, without dilation'), (10, False): (0.560, 'Ferris and Tin-Loi 2001, without dilation')}

p = scenario.parameters({
	**scenario.usualParameters(threads=1, tag='', alpha=0.5), 'courses': Key(6, 'courses of the wall', rule=(6, 10)),
	'dilation': Key(True, 'dilation angle equal to the friction angle, or none'),
	'kn': Key(2e10, 'normal stiffness of the joints; half of it along them', 'Pa/m', scenario.positive),
	'precision': Key(2e-3, 'width of the last interval of the bisection, by the limit', rule=(lambda x: 1e-4 <= x < 0.1, 'must lie in [1e-4, 0.1)')),
	'steps': Key(4000, 'time steps in which the horizontal force comes on',
			rule=scenario.atLeastOne), 'most': Key(60000, 'time steps after which a wall that still moves has not held', rule=scenario.atLeastOne)
})
dt = 1e-4 # [s]; masses are scaled to suit


def build():
	"""The wall on its base, at rest under its weight."""
	O.reset()
	O.materials.append(BlockMat(label='unit', young=10e9, poisson=0.2, density=density))
	model = BlockModel(thickness=thickness)
	placed = runningBond(bricks, p.courses, length, height, first='part').addTo(model, 'unit', rigid=True)
	base = model.addRigid(rectangle(-0.2, -0.2, bricks * length + 0.2, 0), 'unit')
	phi = atan(friction)
	model.bond([
		JointMat(material1='unit', material2='unit', kn=p.kn, ks=p.kn / 2, bonded=False, frictionAngle=phi, dilationAngle=phi if p.dilation else 0)
	])
	model.gravity((0, -g))
	model.insert()
	O.bodies[model.bodyOf(base)].state.blockedDOFs = 'xyzXYZ'
	O.dt, O.engines = dt, loopList(newton=dict(damping=p.alpha), alpha=p.alpha)
	return model, placed


def holds(multiplier):
	"""Whether the wall comes to rest under this share of its weight from the side."""
	model, placed = trial['model'], trial['placed'] = build()
	weight = bricks * length * p.courses * height * thickness * density * g
	O.run(2000, True)
	parts = 40
	for _ in range(parts):
		model.gravity((multiplier * g / parts, 0))
		O.run(p.steps // parts, True)
	held = loading.comesToRest(model, within=0.02 * height, floor=1e-3 * weight, maxSteps=p.most)
	moved = abs(model.displacement).max()
	trial['steps'] += O.iter
	trial['rows'].append((multiplier, held, moved, O.iter))
	print('multiplier %.5f: %s, moved by %.3g mm, %d steps' % (multiplier, 'holds' if held else 'does not hold', 1e3 * moved, O.iter), flush=True)
	return held


# ---- running

trial = dict(steps=0, rows=[])
with Session(p) as session:
	with session.run(1) as run:
		with run.stepping():
			low, high = bisect(holds, 0.5, 0.66, p.precision)
		run.add('limit_multiplier', '1', (low + high) / 2, *expected[p.courses, p.dilation])
		run.add('last_that_held', '1', low)
		run.add('first_that_did_not', '1', high)
		rows = np.array(trial['rows'], float)
		run.curve(multiplier=rows[:, 0], held=rows[:, 1], moved_mm=1e3 * rows[:, 2], steps=rows[:, 3])
		run.model(trial['model'], steps=trial['steps'])
	session.write()
	holds(high)
	session.picture('cracks.png', pictures.drawCracks, trial['model'], title='Dry wall of %d courses, multiplier %.4f' % (p.courses, high))
scenario.waitIfBatch()
