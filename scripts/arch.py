# yade-blocks, GPL-2.0-or-later
"""A semicircular arch under its own weight: how thin it may be.

Rigid voussoirs without mortar between two rigid supports, friction high enough that nothing slides. The limit is the smallest ratio of thickness to radius
of the centre line at which the arch comes to rest, found by bisection; each trial is a new arch. A thinner one falls by hinges at crown, haunches
and springings.

	scripts/run.sh arch [voussoirs=N] [key=value ...]        about 10 s

Expected: 0.1075 (Milankovitch 1907), for joints wherever they are wanted. Hinges can only form where there are joints: an arch of few voussoirs may be thinner.
"""
from math import atan, pi

import numpy as np

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks import loading, pictures, scenario
from yadeblocks.bisection import bisect
from yadeblocks.engines import loopList
from yadeblocks.scenario import Key
from yadeblocks.session import Session
from yadeblocks.specimen import rectangle
from yadeblocks.voussoirs import arch

# ---- parameters (SI)

radius, thickness, density, g = 1., 0.5, 2000., 9.81 # of the centre line, out of plane
expected = 0.1075, 'Milankovitch 1907'

p = scenario.parameters({
	**scenario.usualParameters(threads=1, tag='', alpha=0.3), 'voussoirs': Key(40, 'number of voussoirs', rule=(lambda n: n >= 4, 'must be at least 4')),
	'friction': Key(2., 'friction coefficient',
			rule=scenario.positive), 'kn': Key(3e10, 'normal stiffness of the joints; half of it along them', 'Pa/m', scenario.positive),
	'precision': Key(2e-3, 'width of the last interval of the bisection, by the limit', rule=(lambda x: 1e-4 <= x < 0.1, 'must lie in [1e-4, 0.1)')),
	'most': Key(100000, 'time steps after which an arch that still moves has not held', rule=scenario.atLeastOne)
})
dt = 1e-4 # [s]; masses are scaled to suit


def build(ratio):
	"""The arch between its supports, centring gone."""
	O.reset()
	O.materials.append(BlockMat(label='stone', young=20e9, poisson=0.2, density=density))
	model = BlockModel(thickness=thickness)
	arch(radius, ratio * radius, p.voussoirs, chords=4).addTo(model, 'stone', rigid=True)
	supports = [model.addRigid(rectangle(x - 0.2, -0.2, x + 0.2, 0), 'stone') for x in (-radius, radius)]
	model.bond([JointMat(material1='stone', material2='stone', kn=p.kn, ks=p.kn / 2, bonded=False, frictionAngle=atan(p.friction))])
	model.gravity((0, -g))
	model.insert()
	for support in supports:
		O.bodies[model.bodyOf(support)].state.blockedDOFs = 'xyzXYZ'
	O.dt, O.engines = dt, loopList(newton=dict(damping=p.alpha), alpha=p.alpha)
	return model


def falls(ratio):
	"""Whether an arch of this thickness by radius does not come to rest."""
	model = trial['model'] = build(ratio)
	rests = loading.comesToRest(
		model, within=0.01 * ratio * radius, ratio=1e-6, floor=1e-3 * pi * radius * ratio * radius * thickness * density * g, maxSteps=p.most
	)
	moved = abs(model.displacement).max()
	trial['steps'] += O.iter
	trial['rows'].append((ratio, rests, moved, O.iter))
	print('thickness by radius %.5f: %s, moved by %.3g mm, %d steps' % (ratio, 'holds' if rests else 'falls', 1e3 * moved, O.iter), flush=True)
	return not rests


# ---- running

trial = dict(steps=0, rows=[])
with Session(p) as session:
	with session.run(1) as run:
		with run.stepping():
			low, high = bisect(falls, 0.08, 0.13, p.precision)
		run.add('limit_thickness_ratio', '1', (low + high) / 2, *expected)
		run.add('thickest_that_fell', '1', low)
		run.add('thinnest_that_held', '1', high)
		rows = np.array(trial['rows'], float)
		run.curve(thickness_by_radius=rows[:, 0], held=rows[:, 1], moved_mm=1e3 * rows[:, 2], steps=rows[:, 3])
		run.model(trial['model'], steps=trial['steps'])
	session.write()
	falls(low)
	session.picture('cracks.png', pictures.drawCracks, trial['model'], title='Arch of %d voussoirs that falls, t/R = %.4f' % (p.voussoirs, low))
scenario.waitIfBatch()
