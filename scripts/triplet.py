# yade-blocks, GPL-2.0-or-later
"""Shear of a triplet (EN 1052-3): cohesion and friction of bed joints.

Three bricks with two bed joints without thickness, lying on their side: the outer ones stand on supports near the joints, the middle one is pressed down
between them, under a precompression across the joints. The peak of the mean shear stress of both joints, at three precompressions, gives a straight line.

	scripts/run.sh triplet [joints=softening|brittle] [key=value ...]        about 10 s

Expected: the cohesion and friction that the joints were given, if both joints broke everywhere at once. Joints that soften nearly do: before the first point
has lost its cohesion, all have reached it. Brittle ones break one after the other, since stresses are uneven, and what comes out is lower. The difference is
what this test tells. Joint properties are those of the wall J4D (Raijmakers and Vermeltfoort 1992, Lourenco and Rots 1997).
"""
from math import atan

import numpy as np

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks import curves, loading, masonry, pictures, picturesfields, scenario, softening
from yadeblocks.engines import loopList
from yadeblocks.pace import Pace
from yadeblocks.readings.blocks import blockOfNodes
from yadeblocks.recording import Recorder
from yadeblocks.results import Cracks
from yadeblocks.scenario import Key
from yadeblocks.session import Session
from yadeblocks.specimen import nodesWhere, rectangle

# ---- parameters (SI)

length, height, gap, thickness, friction, brick, joint = masonry.j4d # its length is upright here
sigmas = (0.2e6, 0.6e6, 1.0e6) # [Pa], EN 1052-3 for units stronger than 10 N/mm2
p = scenario.parameters({
	**scenario.usualParameters(threads=1, tag='', alpha=0.3, stroke=0.3e-3), 'joints': Key(
		'softening', 'joints that soften, or brittle ones', rule=('softening', 'brittle')
	), **softening.jointKeys('GfI', 'GfII'), 'cohesion': Key(joint['cohesion'], 'cohesion of the joints', 'Pa', scenario.positive),
	'friction': Key(friction, 'friction coefficient of the joints',
			rule=scenario.positive), 'tension': Key(joint['tension'], 'tensile strength of the joints', 'Pa', scenario.positive),
	'kn': Key(joint['kn'], 'normal stiffness of the joints', 'Pa/m',
			scenario.positive), 'ks': Key(joint['ks'], 'shear stiffness of the joints', 'Pa/m', scenario.positive),
	'zone': Key(0.013, 'size of the zones', 'm', (lambda s: 0 < s <= height, 'must be positive and at most a brick\'s height')),
	'steps': Key(10000, 'time steps for the whole stroke', rule=scenario.atLeastOne)
})
for key in ('GfI', 'GfII'):
	if getattr(p, key) == -1: setattr(p, key, joint[key] if p.joints == 'softening' else 0.)
dt = 1e-4 # [s]; masses are scaled to suit
area = 2 * length * thickness # of both joints


def build(sigma):
	"""The triplet under its precompression, at rest."""
	O.reset()
	O.materials.append(BlockMat(label='unit', **brick))
	model = BlockModel(thickness=thickness, planeStress=True)
	for number in range(3):
		model.addRegion(rectangle(number * height, 0, (number + 1) * height, length), 'unit', zoneSize=p.zone, zoning='regular')
	strengths = dict(cohesion=p.cohesion, tension=p.tension, frictionAngle=atan(p.friction), GfI=p.GfI, GfII=p.GfII)
	model.bond([JointMat(material1='unit', material2='unit', kn=p.kn, ks=p.ks, **strengths)])
	near = 0.3 * height # the supports, beside the joints
	outer = lambda x, y: (y < 1e-9) & (((x < height + 1e-9) & (x > height - near)) | ((x > 2 * height - 1e-9) & (x < 2 * height + near)))
	feet = nodesWhere(model, outer)
	model.drive('supports', feet[blockOfNodes(model)[feet] != 1], 'y')
	middle = np.arange(model.firstNode[1], model.firstNode[2])
	model.drive('ram', middle[model.reference[middle, 1] > length - 1e-9], 'y', velocity=0)
	model.drive('wall', nodesWhere(model, lambda x, y: x < 1e-9), 'x')
	model.push('press', nodesWhere(model, lambda x, y: x > 3 * height - 1e-9), 'x', force=-sigma * length * thickness, rampTime=500 * dt)
	model.insert()
	O.dt, O.engines = dt, loopList(contact=True, alpha=p.alpha)
	O.run(1, True)
	loading.settle(model, floor=1e-2 * sigma * length * thickness)
	return model


def shear(sigma):
	"""The model; the recorder of path [m], mean shear stress [Pa] and broken contact points."""
	model = build(sigma)
	cracks = Cracks(model)
	stop = loading.Stop(drop=0.9, displacement=p.stroke)
	record = Recorder(path=lambda: -model.groupTravelled('ram'), stress=lambda: -model.groupForce('ram') / area, broken=cracks.look)
	pace = Pace(model, lambda: model.groupForce('ram'), lambda: model.groupForce('supports'), 'at %g N/mm²' % (sigma / 1e6))
	record.after(lambda row: pace(row.broken)).after(lambda row: stop(row.path, row.stress, row.broken))
	model.setTarget('ram', -p.stroke / (p.steps * dt), rampTime=0.05 * p.steps * dt)
	O.engines += [record.engine(20)]
	O.run(2 * p.steps, True)
	return model, record


# ---- running

with Session(p) as session:
	with session.run(1) as run:
		peaks, columns, steps = [], dict(sigma_MPa=[], displacement_mm=[], shear_MPa=[], broken=[]), 0
		with run.stepping():
			for sigma in sigmas:
				model, record = shear(sigma)
				steps += O.iter
				peaks.append(curves.peak(record['path'], record['stress'])[0])
				for name, values in zip(
					columns, (np.full(len(record), sigma / 1e6), 1e3 * record['path'], record['stress'] / 1e6, record['broken'])
				):
					columns[name].extend(values)
		friction, cohesion = np.polyfit(sigmas, peaks, 1)
		run.add('cohesion', 'MPa', cohesion / 1e6, p.cohesion / 1e6, 'given to the joints')
		run.add('friction', '1', friction, p.friction, 'given to the joints')
		for sigma, peak in zip(sigmas, peaks):
			run.add('peak_at_%g' % (sigma / 1e6), 'MPa', peak / 1e6, (p.cohesion + p.friction * sigma) / 1e6, 'uniform stress')
		run.curve(**columns)
		run.model(model, steps=steps)
	session.write()
	session.picture('cracks.png', pictures.drawCracks, model, title='Triplet, precompression %g N/mm²' % (sigmas[-1] / 1e6))
	session.picture('sheet.png', picturesfields.drawSheet, model, title='Triplet, precompression %g N/mm²' % (sigmas[-1] / 1e6))
scenario.waitIfBatch()
