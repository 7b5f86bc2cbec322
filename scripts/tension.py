# yade-blocks, GPL-2.0-or-later
"""Direct tension of a masonry couplet (paper, section 3.1; experiment of Van der Pluijm 1992, wire-cut bricks, 1:1:6 mortar).

Two clay bricks, 100 x 50 x 50 mm, and a mortar joint of 15 mm made of Voronoi blocks are pulled apart, the top moving up at
0.02 mm/s. Stress is the force on the loaded edge by its area, displacement the mean opening across the mortar layer.

	scripts/run.sh tension [case=TT1|TT2|TT2b|TT3] [key=value ...]        about 4 s a seed

	TT1   mortar joints stronger (Table 2) than those between brick and mortar (Table 3); cracks run along the bricks
	TT2   Table 3 for all joints, 2 mm: 0.35 N/mm2; cracks in the mortar and along the bricks
	TT2b  Table 2 for all joints: the other way to make them equal, about 0.5 N/mm2
	TT3   TT2 with blocks of 6 mm: 0.43 N/mm2

	joints=measured      joints that soften, all alike, with what was measured and nothing fitted (yadeblocks.softening)
	joints=calibrated    the same with strengths that scatter by 20 %, and the tensile strength fitted to 0.35 with 2 and 6 mm (sqrt(area))

With them, the case only says the size, and the run goes on until the stress has fallen to 1 % of its peak (tail=), or to an opening of 0.9 mm, so that
`fracture_energy`, work less what is stored and kinetic, is that of the section. alpha is 0.3 then: local damping of rattling blocks is a drag that does not
vanish with the rate. With 0.8 it took 9 N/m of 28, and held the stress behind the peak up.
scatter= is the strengths' coefficient of variation, scatterLength= [m] their field's correlation length; kn, ks, tension, cohesion, GfI, GfII [SI],
friction, dilation [degrees], lastingShare, mortarStrengths (factor on those within the mortar), unitYoung and mortarYoung [Pa] show what governs the result.

Size means the mean edge, as in UDEC, unless sizeMeaning=sqrtArea. The stiffness across the layer should be that of the series
1/K = h/E' + h/(0.92 kn s) + 1/kn, with s = sqrt(mean area) = 1.61 edges and E' = E/(1 - nu^2) in plane strain.

Once the peak is passed the crack runs by itself, whatever the rate: inertia, which is that of scaled masses, limits its speed, and what
oscillates behind it tears mortar joints beside its path. alpha=0.8 keeps that down (0.3 moves 8 % of TT1's cracks into the mortar).
units=voronoi makes bricks of blocks, with edges of brickZone, that could crack; plain ones are one elastic block with zones of that size.
cells=triangles fills the layers with triangular blocks; edgeSegments=n makes n joints of every edge, so that contact points lie inside edges too.
halfRate=true repeats every run at half the loading rate and reports the change of the peak.
solver=events goes from failure to failure instead of in time steps (BlockModel.follow): no rate, damping or mass.
release=cascade is what a machine sees that holds its displacement while cracks run, and what slow steps come down to.
"""
from math import radians

import numpy as np

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks import curves, energies, experiments, loading, masonry, pictures, scenario, softening
from yadeblocks.engines import loopList
from yadeblocks.pace import Pace
from yadeblocks.progress import Progress, loadingLine
from yadeblocks.recording import Recorder
from yadeblocks.results import Cracks, engineCosts
from yadeblocks.scenario import Key
from yadeblocks.session import Session
from yadeblocks.specimen import Gauge, addCells, nodesWhere, rectangle

# ---- parameters (SI)

bricks, length, brickHeight, mortarHeight, thickness, stroke, brick, mortar = masonry.tensionCouplet
moduli = scenario.usualParameters(unitYoung=brick['young'], mortarYoung=mortar['young'])
cases = { # mortar-mortar joints, unit-mortar joints, size [m], expected peak [MPa], its source
	'TT1': (masonry.table2, masonry.table3, 2e-3, *experiments.tensileStrength),
	'TT2': (masonry.table3, masonry.table3, 2e-3, *experiments.tensileStrengthOfPaper[2e-3]),
	'TT2b': (masonry.table2, masonry.table2, 2e-3, None, None),
	'TT3': (masonry.table3, masonry.table3, 6e-3, *experiments.tensileStrengthOfPaper[6e-3]),
}
softeningSets = {'measured': softening.measured, 'calibrated': dict(softening.measured, tension=0.39e6)} # all joints alike
scatterOfSets = {'calibrated': 0.2}
velocity = 0.02e-3 # [m/s]
faster, growth = 20, 1.004 # behind the peak, where joints soften: up to so many times as fast, by so much from look to look

p = scenario.parameters({
	**scenario.commonParameters(lloyd=0), **scenario.usualParameters(
		units='plain', cells='voronoi', edgeSegments=1, brickZone=8e-3, merge=0.2, solver='steps', release='path', jump=True, servo=False
	), 'size': Key(
		0.0, 'size of the Voronoi cells; 0: of the case', 'm',
		(lambda s: 0 <= s < mortarHeight, 'must not be negative and must be smaller than the mortar layer')
	), 'case': Key('TT2', 'properties of brittle joints, see above',
			rule=tuple(cases)), 'joints': Key('paper', 'brittle joints of the case, or joints that soften', rule=('paper', *softeningSets)),
	**softening.jointKeys('kn', 'ks', 'tension', 'cohesion', 'friction', 'dilation', 'GfI', 'GfII', 'lastingShare', 'mortarStrengths'), 'alpha': Key(
		-1.0, 'coefficient of local damping; -1: 0.8, or 0.3 where joints soften', rule=(lambda a: a == -1 or 0 <= a < 1, 'must lie in [0, 1)')
	), 'steps': Key(
		0, 'time steps for the first 0.03 mm; 0: 40000, or 10000 where joints soften', rule=(lambda n: n == 0 or n >= 1000, 'must be at least 1000')
	), 'tail': Key(0.01, 'share of the peak at which a run with joints that soften ends', rule=(lambda s: 0 < s < 1, 'must lie in (0, 1)')),
	**softening.scatterKeys, **moduli, **scenario.usualParameters(halfRate=False, vtk=True, frames=10, movie='none', sheets=True)
})
scenario.require(p.solver == 'steps' or not (p.halfRate or p.servo), 'tension: solver=events has no rate: servo and halfRate must be false')
scenario.require(p.solver == 'steps' or p.joints == 'paper', 'tension: solver=events knows brittle joints only, got joints=' + p.joints)
mortarJoint, unitJoint, caseSize, expectedPeak, source = cases[p.case]
softens = p.joints != 'paper'
if softens:
	mortarJoint = unitJoint = dict(softeningSets[p.joints])
	expectedPeak, source = experiments.tensileStrength
given = {key: getattr(p, key) for key in ('kn', 'ks', 'tension', 'cohesion', 'GfI', 'GfII', 'lastingShare') if getattr(p, key) != -1}
given.update({name: radians(getattr(p, key)) for key, name in (('friction', 'frictionAngle'), ('dilation', 'dilationAngle')) if getattr(p, key) != -1})
mortarJoint, unitJoint = softening.stronger({**mortarJoint, **given}, p.mortarStrengths), {**unitJoint, **given}
softening.takeScatter(p, scatterOfSets.get(p.joints, 0.0))
p.size = p.size or caseSize
if p.alpha == -1: p.alpha = 0.3 if softens else 0.8
p.steps = p.steps or (10000 if softens else 40000)
area, duration = length * thickness, stroke / velocity


def build(seed):
	"""The couplet in the scene."""
	O.reset()
	O.materials.append(BlockMat(label='unit', **{**brick, 'young': p.unitYoung}))
	O.materials.append(BlockMat(label='mortar', **{**mortar, 'young': p.mortarYoung}))
	low, high = brickHeight, brickHeight + mortarHeight
	model = BlockModel(thickness=thickness, planeStress=p.plane == 'stress')
	options = dict(lloyd=p.lloyd, seed=seed, mergeFraction=p.merge, edgeSegments=p.edgeSegments)
	addCells(model, p.cells, rectangle(0, low, length, high), 'mortar', size=p.size, sizeMeaning=p.sizeMeaning, **options)
	for number, outline in enumerate((rectangle(0, 0, length, low), rectangle(0, high, length, high + brickHeight))):
		if p.units == 'plain': model.addRegion(outline, 'unit', zoneSize=p.brickZone)
		else: model.addVoronoi(outline, 'unit', size=p.brickZone, lloyd=3, seed=1000 * seed + number, edgeSegments=p.edgeSegments)
	joints = [JointMat(material1='mortar', material2='mortar', **mortarJoint), JointMat(material1='unit', material2='mortar', **unitJoint)]
	if p.units == 'voronoi': joints.append(JointMat(material1='unit', material2='unit', **masonry.brickJoint))
	model.bond(joints)
	softening.scatterStrengths(model, p, seed)
	model.drive('bottom', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
	model.drive('top', nodesWhere(model, lambda x, y: y > high + brickHeight - 1e-9), 'y', velocity=velocity, rampTime=0.05 * duration)
	model.insert()
	return model


def pull(stage, seed, steps):
	"""Loads until the stress has fallen to half the peak, or to `tail` of it where joints soften: then up to 20 times as fast once the peak is passed.
	The model; the recorder of displacement [m], stress [Pa], broken contact points, those that are not elastic any more, unbalanced ratio; the cracks."""
	model = stage.model or build(seed)
	low, high = brickHeight, brickHeight + mortarHeight
	gauge = Gauge(
		model, below=nodesWhere(model, lambda x, y: abs(y - low) < 1e-9, 'unit'), above=nodesWhere(model, lambda x, y: abs(y - high) < 1e-9, 'unit')
	)
	floor, cracks = 1e-3 * unitJoint['tension'] * area, Cracks(model)
	stop = loading.Stop(drop=p.tail, displacement=30 * stroke) if softens else loading.Stop(drop=0.5, displacement=2 * stroke)
	film = pictures.filmOf(p, model)
	record = Recorder(
		displacement=gauge, stress=lambda: model.groupForce('top') / area, broken=cracks.look, yielded=lambda: np.count_nonzero(model.pointStatus),
		unbalanced=lambda: model.unbalancedRatio(floor=floor)
	)
	pace = Pace(model, lambda: model.groupForce('top'), lambda: model.groupForce('bottom', axis='y'), stage.label)
	record.after(lambda row: film.look(model.groupTravelled('top') / stroke, row.stress, O.time))
	with Progress(steps, lambda: loadingLine(record.last.displacement, record.last.stress, model, pace), label=stage.label) as progress:
		record.after(lambda row: progress(O.iter))
		record.after(lambda row: stop(model.groupTravelled('top'), row.stress, row.yielded if softens else row.broken))
		if p.solver == 'events':
			path = loading.follow(model, 'top', stage.label, gauges=[gauge], displacement=2 * stroke, release=p.release)
			record.take(
				displacement=path['gauges'][0], stress=path['force'] / area, broken=path['cracked'], yielded=path['cracked'],
				unbalanced=path['residual']
			)
			cracks.began(path['crackPoint'])
			film.look(1, 0, O.time)
			return model, record, cracks, film
		if not stage.model: begin(model, steps, floor)
		approach = loading.Approach(model, 'top', 1 / faster, growth=growth) if softens and not p.servo else None # one of them sets the speed
		if approach: record.after(lambda row: approach(row.stress, row.yielded))
		record.after(lambda row: pace(row.yielded))
		stage.keep(record=record, cracks=cracks, approach=approach, stop=stop)
		if not stage.model: leap(model, steps, record, cracks)
		stage.run()
	return model, record, cracks, film


def begin(model, steps, floor):
	"""The engines."""
	O.dt, O.trackEnergy = duration / steps, softens
	O.engines = loopList(servo=dict(groups=['top'], floor=floor) if p.servo else None, damping=p.damping, alpha=p.alpha, safety=p.safety)
	O.run(1, True)
	if softens and not p.servo: model.setTarget('top', faster * velocity, rampTime=0 if p.jump else 0.05 * duration)


def leap(model, steps, record, cracks):
	"""The way to the first crack."""
	record()
	if p.jump:
		model.elasticJump()
		record()
		if not softens: O.engines += [cracks.engine()]
	O.engines += [record.engine(max(1, min(50, steps // 1600)))]


def seriesStiffness():
	"""Stiffness across the layer per area [Pa/m]."""
	side = p.size * (experiments.edgeToSide if p.sizeMeaning == 'edge' else 1)
	return experiments.seriesStiffness(mortarHeight, p.mortarYoung, mortar['poisson'], unitJoint['kn'], side, p.plane == 'strain')


def addEnergies(run, cracks):
	"""By the section [N/m]."""
	run.add('fracture_energy', 'N/m', energies.spent() / area)
	run.add('crack_length', '1', cracks.length(area)) # by damage, over the section
	energies.addDissipated(run, 'N/m', area)


# ---- running

title = 'Couplet in tension, %s' % (p.joints if softens else p.case)
O.timingEnabled = True
with Session(p) as session:
	for seed in p.seedList:
		if session.wants(seed):
			with session.run(seed) as run:
				stage = session.stage('seed %d' % seed)
				with run.stepping():
					model, record, cracks, film = pull(stage, seed, p.steps)
				displacement, stress, broken, yielded = (record[name] for name in ('displacement', 'stress', 'broken', 'yielded'))
				strength, peak = curves.peak(displacement, stress)
				if p.solver == 'events': elastic = np.arange(len(stress)) <= np.argmax(broken > 0) # the first to break is still whole there
				else: elastic = (yielded == 0) & ((stress > 0.1 * strength) | p.jump) # from where a smooth start is over

				run.add('peak_tensile_stress', 'MPa', strength / 1e6, expectedPeak, source)
				run.add('first_crack_stress', 'MPa', curves.atFirst(broken, stress) / 1e6)
				run.add('first_crack_point', '1', cracks.firstPoint if cracks.first[1] else np.nan) # its number in the model
				slope = np.polyfit(displacement[elastic], stress[elastic], 1)[0]
				run.add('joint_stiffness', 'N/mm3', slope / 1e9, seriesStiffness() / 1e9, 'series of mortar and joints')
				run.add('displacement_at_peak', 'um', displacement[peak] * 1e6)
				run.add('crack_share_unit-mortar', '1', cracks.share('unit-mortar'))
				if softens: addEnergies(run, cracks)
				run.curve(displacement_mm=1e3 * displacement, stress_MPa=stress / 1e6, broken=broken)
				run.model(model, steps=O.iter, **engineCosts(model, O.iter))
				run.quality(
					unbalanced_ratio_max=curves.largestBehindStart(record['unbalanced']), energy_error=energies.error() if softens else None
				)
			if seed == p.seed:
				pictures.drawRun(session, film, model, '%s, seed %d' % (title, seed))
		if p.halfRate and session.wants(seed, 'half_rate_change'):
			slow = pull(session.stage('seed %d, half rate' % seed), seed, 2 * p.steps)[1]
			strength = curves.peak(slow['displacement'], slow['stress'])[0] / 1e6
			session.quality(seed, half_rate_change=strength / session.measured(seed, 'peak_tensile_stress') - 1)
	session.write()
	session.picture(
		'curve.png', pictures.drawCurve, session.results.curves, 'displacement_mm', 'stress_MPa',
		labels=('mean opening across the mortar layer [mm]', 'tensile stress [N/mm²]'), title=title,
		references=[pictures.Reference('strength, ' + source, expectedPeak)] if expectedPeak else []
	)
scenario.waitIfBatch()
