# yade-blocks, GPL-2.0-or-later
"""Direct tension of a masonry couplet (paper, section 3.1; experiment of Van der Pluijm 1992, wire-cut bricks, 1:1:6 mortar).

Two clay bricks, 100 x 50 x 50 mm, and a mortar joint of 15 mm made of Voronoi blocks are pulled apart, the top moving up at
0.02 mm/s. Stress is the force on the loaded edge by its area, displacement the mean opening across the mortar layer.

	scripts/run.sh tension [case=TT1|TT2|TT2b|TT3] [key=value ...]        about 4 s a seed

	TT1   mortar joints stronger (Table 2) than those between brick and mortar (Table 3); cracks run along the bricks
	TT2   Table 3 for all joints, 2 mm: 0.35 N/mm2; cracks in the mortar and along the bricks
	TT2b  Table 2 for all joints: the other way to make them equal, about 0.5 N/mm2
	TT3   TT2 with blocks of 6 mm: 0.43 N/mm2

Size means the mean edge, as in UDEC, unless sizeMeaning=sqrtArea. The stiffness across the layer should be that of the series
1/K = h/E' + h/(0.92 kn s) + 1/kn, with s = sqrt(mean area) = 1.61 edges and E' = E/(1 - nu^2) in plane strain.

Once the peak is passed the crack runs by itself, whatever the rate: inertia, which is that of scaled masses, limits its speed, and what
oscillates behind it tears mortar joints beside its path. alpha=0.8 keeps that down (0.3 moves 8 % of TT1's cracks into the mortar).
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

length, brickHeight, thickness, mortarHeight = 0.1, 0.05, 0.05, 0.015 # [m]
brick = dict(young=16.7e9, poisson=0.2, density=1900) # Table 1
mortar = dict(young=2.974e9, poisson=0.2, density=1250)
table2 = dict(kn=400e9, ks=200e9, frictionAngle=radians(38), cohesion=0.75e6, tension=0.75e6, dilationAngle=radians(4))
table3 = dict(table2, cohesion=0.60e6, tension=0.60e6)
brickJoint = dict(
	kn=1260e9, ks=630e9, frictionAngle=radians(20), cohesion=15e6, tension=7.5e6
) # with units=voronoi; Table 9, since none is given for these bricks
cases = { # mortar-mortar joints, unit-mortar joints, size [m], expected peak [MPa], its source
	'TT1': (table2, table3, 2e-3, 0.35, 'Van der Pluijm 1992'),
	'TT2': (table3, table3, 2e-3, 0.35, 'paper, Fig. 10'),
	'TT2b': (table2, table2, 2e-3, None, None),
	'TT3': (table3, table3, 6e-3, 0.43, 'paper, Fig. 10'),
}
stroke, velocity = 0.03e-3, 0.02e-3 # [m], [m/s]

p = scenario.parameters({
	**scenario.commonParameters(size=0.0, sizeMeaning='edge', lloyd=0, alpha=0.8, steps=40000), 'case': 'TT2', 'units': 'plain', 'brickZone': 8e-3,
	'merge': 0.2, 'jump': True, 'servo': False, 'halfRate': False, 'vtk': True
}, {
	'case': tuple(cases), 'size': scenario.Rule(lambda s: 0 <= s < mortarHeight, 'must be positive and smaller than the mortar layer (0: of the case)'),
	'units': ('plain', 'voronoi'), 'brickZone': scenario.positive, 'merge': scenario.Rule(lambda f: 0 <= f < 1, 'must lie in [0, 1)')
})
mortarJoint, unitJoint, caseSize, expectedPeak, source = cases[p.case]
p.size = p.size or caseSize
area, duration = length * thickness, stroke / velocity


def build(seed):
	"""The couplet in the scene."""
	O.reset()
	O.materials.append(BlockMat(label='unit', **brick))
	O.materials.append(BlockMat(label='mortar', **mortar))
	low, high = brickHeight, brickHeight + mortarHeight
	model = BlockModel(thickness=thickness, planeStress=p.plane == 'stress')
	model.addVoronoi(rectangle(0, low, length, high), 'mortar', size=p.size, sizeMeaning=p.sizeMeaning, lloyd=p.lloyd, seed=seed, mergeFraction=p.merge)
	for number, outline in enumerate((rectangle(0, 0, length, low), rectangle(0, high, length, high + brickHeight))):
		if p.units == 'plain': model.addRegion(outline, 'unit', zoneSize=p.brickZone)
		else: model.addVoronoi(outline, 'unit', size=p.brickZone, lloyd=3, seed=1000 * seed + number)
	model.bond()
	model.drive('bottom', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
	model.drive('top', nodesWhere(model, lambda x, y: y > high + brickHeight - 1e-9), 'y', velocity=velocity, rampTime=0.05 * duration)
	model.insert()
	return model


def pull(model, steps, progressLabel):
	"""Loads until the stress has fallen to half the peak. Columns: displacement [m], stress [Pa], broken contact points, unbalanced ratio."""
	low, high = brickHeight, brickHeight + mortarHeight
	gauge = Gauge(
		model, below=nodesWhere(model, lambda x, y: abs(y - low) < 1e-9, 'unit'), above=nodesWhere(model, lambda x, y: abs(y - high) < 1e-9, 'unit')
	)
	floor, cracks, history = 1e-3 * unitJoint['tension'] * area, Cracks(model), []
	stop = loading.Stop(drop=0.5, displacement=2 * stroke)

	def record():
		history.append((gauge(), model.groupForce('top') / area, cracks.look(), model.unbalancedRatio(floor=floor)))
		progress(O.iter)
		stop(model.groupTravelled('top'), history[-1][1], history[-1][2])

	withinBricks = [JointMat(material1='unit', material2='unit', **brickJoint)] * (p.units == 'voronoi')
	O.dt = duration / steps
	O.engines = [
		InteractionLoop([Ig2_Block_Block_BlockGeom()],            # opening and slip
		[Ip2_BlockMat_BlockMat_JointPhys(joints=[ # joint properties
		JointMat(material1='mortar', material2='mortar', **mortarJoint),
		JointMat(material1='unit', material2='mortar', **unitJoint)] + withinBricks)],
		[Law2_BlockGeom_JointPhys_MohrCoulomb()]), # joint stresses, failure
		BlockTimeStepper(safety=p.safety),                         # scaled masses
		BlockForces(),                                             # zones and joints, gathered node by node
		BlockIntegrator(damping=p.damping, alpha=p.alpha)]         # motion
	if p.servo: O.engines = O.engines[:-1] + [BlockServo(groups=['top'], floor=floor)] + O.engines[-1:] # as slow as the blocks want it
	globals()['record'] = record
	with Progress(steps, lambda: loadingLine(history[-1][0], history[-1][1], model), label=progressLabel) as progress:
		O.run(1, True)
		record()
		if p.jump:
			model.elasticJump()
			record()
		O.engines += [PyRunner(command='record()', iterPeriod=max(1, steps // 1600))]
		O.run()
		O.wait()
	return np.array(history).T, cracks


def seriesStiffness():
	"""Stiffness across the layer per area [Pa/m]."""
	s = p.size * (1.61 if p.sizeMeaning == 'edge' else 1) # hexagon-like cells
	modulus = mortar['young'] / (1 - mortar['poisson']**2 if p.plane == 'strain' else 1)
	kn = unitJoint['kn']
	return 1 / (mortarHeight / modulus + mortarHeight / (0.92 * kn * s) + 1 / kn)


# ---- running

results = Results(p)
O.timingEnabled = True
for seed in p.seedList:
	with results.run(seed) as run:
		model = build(seed)
		if seed == p.seed and p.vtk:
			export = BlocksExport(p.folder)
			export.write(model, O.time)
		with run.stepping():
			(displacement, stress, broken, unbalanced), cracks = pull(model, p.steps, 'seed %d' % seed)
		peak = stress.argmax()
		elastic = (broken == 0) & ((stress > 0.1 * stress[peak]) | p.jump) # from where a smooth start is over

		run.add('peak_tensile_stress', 'MPa', stress[peak] / 1e6, expectedPeak, source)
		run.add('first_crack_stress', 'MPa', stress[broken > 0][0] / 1e6 if broken.any() else np.nan)
		run.add(
			'joint_stiffness', 'N/mm3',
			np.polyfit(displacement[elastic], stress[elastic], 1)[0] / 1e9,
			seriesStiffness() / 1e9, 'series of mortar and joints'
		)
		run.add('displacement_at_peak', 'um', displacement[peak] * 1e6)
		run.add('crack_share_unit-mortar', '1', cracks.share('unit-mortar'))
		run.curve(displacement_mm=1e3 * displacement, stress_MPa=stress / 1e6, broken=broken)
		run.model(model, steps=O.iter, **engineCosts(model, O.iter))
		run.quality(unbalanced_ratio_max=unbalanced[len(unbalanced) // 10:].max())
	if seed == p.seed:
		if p.vtk: export.write(model, O.time)
		pictures.drawCracks(p.folder / 'cracks.png', model, title='Couplet in tension, %s, seed %d' % (p.case, seed))
	if p.halfRate:
		slow = pull(build(seed), 2 * p.steps, 'seed %d, half rate' % seed)[0][1].max()
		run.quality(half_rate_change=slow / stress[peak] - 1)

results.write()
pictures.drawCurve(
	p.folder / 'curve.png', results.curves, 'displacement_mm', 'stress_MPa', labels=('mean opening across the mortar layer [mm]', 'tensile stress [N/mm²]'),
	title='Couplet in tension, %s' % p.case
)
scenario.waitIfBatch()
