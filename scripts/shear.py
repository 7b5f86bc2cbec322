# yade-blocks, GPL-2.0-or-later
"""Shear of a masonry couplet under precompression (paper, section 3.2; experiment of Van der Pluijm 1993, wire-cut bricks, 1:2:9 mortar).

Two clay bricks, 200 x 50 x 50 mm, and a mortar joint of 15 mm made of Voronoi blocks of 3.5 mm. The bottom is held; the top edge is pressed
down by sigma, staying parallel as under a stiff platen, and then moves sideways at 0.2 mm/s. Stress is the horizontal force on the
top edge by its area, displacement the mean slip across the mortar layer.

	scripts/run.sh shear [sigma=0.1e6|0.5e6|1e6] [key=value ...]        about 7 s a seed

Expected: peak 0.87 + 1.01 sigma, residual 0.73 sigma (N/mm2): the experiment's cohesion, friction and residual friction.
Size means sqrt(mean area) unless sizeMeaning=edge. Loading starts at the first crack (jump) and is a fifth as fast as said (approach) until the peak is passed;
servo=true lets the unbalanced force set the speed instead. kn, ks, cohesion, tension, friction and residualFriction (Table 5) show what governs the result.
units=voronoi makes bricks of blocks, with edges of brickZone, that could crack; plain ones are one elastic block with zones of that size.
halfRate=true repeats every run at half the loading rate and reports the change of the peak.
"""
from math import radians

import numpy as np

import yadeblocks
from yade import *
from yadeblocks import loading, pictures, scenario
from yadeblocks.export import BlocksExport
from yadeblocks.progress import Progress, loadingLine
from yadeblocks.results import Cracks, Results, engineCosts
from yadeblocks.specimen import Gauge, nodesWhere, rectangle

# ---- parameters (SI)

length, brickHeight, thickness, mortarHeight = 0.2, 0.05, 0.05, 0.015 # [m]
brick = dict(young=16.7e9, poisson=0.2, density=1900) # Table 4
mortar = dict(young=2.974e9, poisson=0.2, density=3250)
jointDefaults = {
	'kn': 400e9, 'ks': 200e9, 'cohesion': 3e6, 'tension': 1.5e6, 'friction': 45.0, 'residualFriction': 36.0
} # Table 5, all joints; angles in degrees
brickJoint = dict(
	kn=1260e9, ks=630e9, frictionAngle=radians(20), cohesion=15e6, tension=7.5e6
) # with units=voronoi; Table 9, since none is given for these bricks
velocity = 0.2e-3 # [m/s]
pressSteps = 2000

p = scenario.parameters({
	**scenario.commonParameters(size=3.5e-3, sizeMeaning='sqrtArea', lloyd=1, steps=32000, alpha=0.2), 'sigma': 0.5e6, 'stroke': 1e-3, 'approach': 0.2,
	'jump': True, 'servo': False, 'units': 'plain', 'brickZone': 8e-3, 'merge': 0.1, **jointDefaults, 'halfRate': False, 'vtk': True
}, {
	'sigma': scenario.notNegative, 'stroke': scenario.positive, 'approach': scenario.Rule(lambda f: 0 < f <= 1,
												'must lie in (0, 1]'), 'units': ('plain', 'voronoi'),
	'brickZone': scenario.positive, 'size': scenario.Rule(lambda s: 0 < s < mortarHeight, 'must be positive and smaller than the mortar layer'),
	'merge': scenario.Rule(lambda f: 0 <= f < 1, 'must lie in [0, 1)'), 'kn': scenario.positive, 'ks': scenario.positive, 'cohesion': scenario.notNegative,
	'tension': scenario.notNegative, **dict.fromkeys(('friction', 'residualFriction'),
								scenario.Rule(lambda angle: 0 <= angle < 90, 'must lie in [0, 90) degrees'))
})
joint = dict(kn=p.kn, ks=p.ks, frictionAngle=radians(p.friction), frictionAngleResidual=radians(p.residualFriction), cohesion=p.cohesion, tension=p.tension)
area, low, high = length * thickness, brickHeight, brickHeight + mortarHeight
peakExpected, residualExpected = 0.87 + 1.01 * p.sigma / 1e6, 0.73 * p.sigma / 1e6


def build(seed, dt):
	"""The couplet in the scene."""
	O.reset()
	O.materials.append(BlockMat(label='unit', **brick))
	O.materials.append(BlockMat(label='mortar', **mortar))
	model = BlockModel(thickness=thickness, planeStress=p.plane == 'stress')
	model.addVoronoi(rectangle(0, low, length, high), 'mortar', size=p.size, sizeMeaning=p.sizeMeaning, lloyd=p.lloyd, seed=seed, mergeFraction=p.merge)
	for number, outline in enumerate((rectangle(0, 0, length, low), rectangle(0, high, length, high + brickHeight))):
		if p.units == 'plain': model.addRegion(outline, 'unit', zoneSize=p.brickZone)
		else: model.addVoronoi(outline, 'unit', size=p.brickZone, lloyd=3, seed=1000 * seed + number)
	model.bond()
	top = nodesWhere(model, lambda x, y: y > high + brickHeight - 1e-9)
	model.drive('bottom', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
	model.push('press', top, 'y', force=-p.sigma * area, rampTime=pressSteps * dt)
	model.drive('shear', top, 'x', rampTime=pressSteps * dt) # held while the press comes down
	model.insert()
	return model


def shear(seed, steps, label):
	"""Presses, then shears over the whole stroke. The model; the columns displacement [m], stress [Pa], uplift [m], broken
	contact points, unbalanced ratio; the cracks."""
	dt = p.stroke / velocity / steps
	model = build(seed, dt)
	below, above = nodesWhere(model, lambda x, y: abs(y - low) < 1e-9, 'unit'), nodesWhere(model, lambda x, y: abs(y - high) < 1e-9, 'unit')
	slip, uplift = Gauge(model, below, above, 'x'), Gauge(model, below, above, 'y')
	floor = 1e-3 * max(p.sigma, joint['tension']) * area
	cracks, history = Cracks(model), []

	def record():
		history.append((slip(), model.groupForce('shear') / area, uplift(), cracks.look(), model.unbalancedRatio(floor=floor)))
		stress, broken = history[-1][1], history[-1][3]
		if approach: approach(stress, broken)
		stop(model.groupTravelled('shear'), stress, broken)
		progress(int(steps * model.groupTravelled('shear') / p.stroke))

	withinBricks = [JointMat(material1='unit', material2='unit', **brickJoint)] * (p.units == 'voronoi')
	O.dt = dt
	O.engines = [
		BlockContacts(),                                           # broken joints may slide on, part and meet again
		InsertionSortCollider([Bo1_Block_Aabb()], verletDist=0),   # woken where something moved far enough
		InteractionLoop([Ig2_Block_Block_BlockGeom()],            # opening and slip
		[Ip2_BlockMat_BlockMat_JointPhys(joints=[ # joint properties
		JointMat(material1='mortar', material2='mortar', **joint),
		JointMat(material1='unit', material2='mortar', **joint)] + withinBricks)],
		[Law2_BlockGeom_JointPhys_MohrCoulomb()]), # joint stresses, failure
		BlockTimeStepper(safety=p.safety),                         # scaled masses
		BlockForces(),                                             # zones and joints, gathered node by node
		BlockIntegrator(damping=p.damping, alpha=p.alpha)]         # motion
	if p.servo: O.engines = O.engines[:-1] + [BlockServo(groups=['shear'], floor=floor)] + O.engines[-1:] # as slow as the blocks want it
	globals()['record'] = record
	with Progress(steps, lambda: loadingLine(history[-1][0], history[-1][1], model), label=label) as progress:
		O.run(1, True)
		if not p.jump: loading.settle(model, floor=floor)
		model.setTarget('shear', velocity, rampTime=0 if p.jump else pressSteps * dt)
		approach = None if p.servo else loading.Approach(model, 'shear', p.approach) # one of them sets the speed
		stop = loading.Stop(displacement=p.stroke)
		record()
		if p.jump:
			model.elasticJump()
			record()
		O.engines += [PyRunner(command='record()', iterPeriod=max(1, min(50, steps // 400)))]
		O.run()
		O.wait()
	return model, np.array(history).T, cracks


# ---- running

results = Results(p)
O.timingEnabled = True
for seed in p.seedList:
	with results.run(seed) as run:
		with run.stepping():
			model, (displacement, stress, uplift, broken, unbalanced), cracks = shear(seed, p.steps, 'seed %d' % seed)
		peak = stress.argmax()
		run.add('peak_shear_stress', 'MPa', stress[peak] / 1e6, peakExpected, 'Van der Pluijm 1993: 0.87 + 1.01 sigma')
		run.add(
			'residual_shear_stress', 'MPa', stress[displacement > 0.75 * displacement[-1]].mean() / 1e6, residualExpected or None,
			'Van der Pluijm 1993: 0.73 sigma'
		)
		run.add('first_crack_stress', 'MPa', stress[broken > 0][0] / 1e6 if broken.any() else np.nan)
		run.add('displacement_at_peak', 'um', displacement[peak] * 1e6)
		run.add('first_crack_place', 'mm', cracks.first[0][0] * 1e3) # from the left end
		run.add('cracks_at_peak', '1', broken[peak])
		run.add('crack_share_unit-mortar', '1', cracks.share('unit-mortar'))
		run.add('uplift', 'mm', uplift[-1] * 1e3)
		run.curve(displacement_mm=1e3 * displacement, stress_MPa=stress / 1e6, uplift_mm=1e3 * uplift, broken=broken)
		run.model(model, steps=O.iter, **engineCosts(model, O.iter))
		run.quality(unbalanced_ratio_max=unbalanced[len(unbalanced) // 10:].max())
	if seed == p.seed:
		if p.vtk: BlocksExport(p.folder).write(model, O.time)
		pictures.drawCracks(p.folder / 'cracks.png', model, title='Couplet in shear, precompression %g N/mm², seed %d' % (p.sigma / 1e6, seed))
	if p.halfRate:
		slow = shear(seed, 2 * p.steps, 'seed %d, half rate' % seed)[1][1].max()
		run.quality(half_rate_change=slow / stress[peak] - 1)

results.write()
pictures.drawCurve(
	p.folder / 'curve.png', results.curves, 'displacement_mm', 'stress_MPa', labels=('slip across the mortar layer [mm]', 'shear stress [N/mm²]'),
	title='Couplet in shear, precompression %g N/mm²' % (p.sigma / 1e6),
	references=[pictures.Reference('peak, Van der Pluijm 1993', peakExpected),
			pictures.Reference('residual, Van der Pluijm 1993', residualExpected)]
)
scenario.waitIfBatch()
