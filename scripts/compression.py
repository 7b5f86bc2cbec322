# yade-blocks, GPL-2.0-or-later
"""Compression of a masonry prism (paper, section 3.3; experiment of Oliveira 2003).

Five bricks of 285 x 130 x 50 mm and four mortar joints of 10 mm, all made of Voronoi blocks, between smooth platens; the model is
the front view, 285 mm wide (the paper's Fig. 20d speaks of a lateral view: width=0.13). The top platen comes down at 0.01 mm/s. Stress is its
force by its area, strain its path by the height.

	scripts/run.sh compression [unitSize=0.01] [mortarSize=0.003] [residualFriction=zero|kept] [key=value ...]        about 20 s a seed

Expected: strength 27.5 N/mm2, modulus 4100 N/mm2 (fitted between 5 % and 33 % of the strength), vertical splitting of the bricks.
Size means the mean edge length, as in UDEC, unless sizeMeaning=sqrtArea. Tables 8 and 9 give a residual cohesion and no residual
friction: residualFriction=zero takes that literally, kept leaves the friction angle as it is.
joints=calibrated takes joints that soften, with `strengths` and `stiffnesses` times those of Tables 8 and 9 and fracture energies GfI and GfII [N/m], alike in
bricks and mortar (lastingShare: share of an opening that stays); the run then goes on until the stress has fallen to 20 % of its peak, and
`postpeak_energy` is stress times shortening from the peak to there. units=plain makes each brick one block that cannot crack.
cells=triangles fills the layers with triangular blocks; edgeSegments=n makes n joints of every edge, so that contact points lie inside edges too.
strengths, stiffnesses, unitStrengths, mortarStrengths (factors on those of the tables), unitFriction, mortarFriction [degrees], unitYoung and
mortarYoung [Pa] show what governs the result.
halfRate=true repeats every run at half the loading rate and reports the change of the strength.
solver=events goes from failure to failure (BlockModel.follow) as long as displacements are small, and in time steps from there on. It says where that was.
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

bricks, width, brickHeight, mortarHeight, thickness, stroke, brick, mortar = masonry.prism
height = bricks * brickHeight + (bricks - 1) * mortarHeight
moduli = scenario.usualParameters(unitYoung=brick['young'], mortarYoung=mortar['young'])
mortarJoint, brickJoint = dict(masonry.table8), dict(masonry.table9)
sets = {
	'paper': {'strengths': 1.0, 'stiffnesses': 1.0, 'GfI': 0.0, 'GfII': 0.0, 'lastingShare': 0.0},
	'calibrated': {'strengths': 0.44, 'stiffnesses': 0.93, 'GfI': 200.0, 'GfII': 2000.0, 'lastingShare': 0.0}
}
velocity = 0.01e-3 # [m/s]

common = scenario.commonParameters(sizeMeaning='edge', lloyd=3, steps=30000, alpha=0.2)
del common['size']
p = scenario.parameters({
	**common, **scenario.usualParameters(
		units='voronoi', cells='voronoi', edgeSegments=1, stroke=stroke, solver='steps', jump=True, servo=False, merge=0.1
	), 'unitSize': Key(
		0.01, 'size of the Voronoi cells of bricks, or of the zones of plain ones', 'm',
		(lambda s: 0 < s < brickHeight, 'must be positive and smaller than a brick')
	), 'mortarSize': Key(
		0.003, 'size of the Voronoi cells of mortar', 'm', (lambda s: 0 < s < mortarHeight, 'must be positive and smaller than a mortar joint')
	), 'residualFriction': Key('zero', 'friction of broken joints: none, or as before',
					rule=('zero', 'kept')), 'width': Key(width, 'width of the prism', 'm', scenario.positive),
	'joints': Key('paper', 'brittle joints of Tables 8 and 9, or joints that soften',
			rule=tuple(sets)), **softening.jointKeys(*sets['paper'], 'unitStrengths', 'mortarStrengths', 'unitFriction', 'mortarFriction'),
	**softening.scatterKeys, **moduli, **scenario.usualParameters(halfRate=False, vtk=True, frames=10, movie='none', sheets=True)
})
scenario.require(p.solver == 'steps' or not (p.halfRate or p.servo), 'compression: solver=events has no rate: servo and halfRate must be false')
if p.residualFriction == 'zero':
	mortarJoint['frictionAngleResidual'] = brickJoint['frictionAngleResidual'] = 0
for key, value in sets[p.joints].items():
	if getattr(p, key) == -1: setattr(p, key, value)
softening.takeScatter(p)
softens = p.GfI > 0
scenario.require(p.solver == 'steps' or not softens, 'compression: solver=events knows brittle joints only, got GfI=%g' % p.GfI)
for joint, strengths, friction in (mortarJoint, p.mortarStrengths, p.mortarFriction), (brickJoint, p.unitStrengths, p.unitFriction):
	if friction != -1: joint['frictionAngle'] = radians(friction)
	joint.update({name: p.strengths * (1 if strengths == -1 else strengths) * joint[name] for name in ('cohesion', 'cohesionResidual', 'tension')})
	joint.update({name: p.stiffnesses * joint[name] for name in ('kn', 'ks')}, GfI=p.GfI, GfII=p.GfII, lastingShare=p.lastingShare)
area, last = p.width * thickness, 0.2 if softens else 0.5 # a run ends at this share of the strength


def build(seed):
	"""The prism in the scene; every layer has a seed of its own."""
	O.reset()
	O.materials.append(BlockMat(label='unit', **{**brick, 'young': p.unitYoung}))
	O.materials.append(BlockMat(label='mortar', **{**mortar, 'young': p.mortarYoung}))
	model, y = BlockModel(thickness=thickness, planeStress=p.plane == 'stress'), 0
	for layer in range(2 * bricks - 1):
		label, size, thick = ('mortar', p.mortarSize, mortarHeight) if layer % 2 else ('unit', p.unitSize, brickHeight)
		outline = rectangle(0, y, p.width, y + thick)
		if label == 'unit' and p.units == 'plain': model.addRegion(outline, label, zoneSize=size)
		else:
			options = dict(lloyd=p.lloyd, seed=1000 * seed + layer, mergeFraction=p.merge, edgeSegments=p.edgeSegments)
			addCells(model, p.cells, outline, label, size=size, sizeMeaning=p.sizeMeaning, **options)
		y += thick
	joints = [
		JointMat(material1='unit', material2='unit', **brickJoint),
		JointMat(material1='mortar', material2='mortar', **mortarJoint),
		JointMat(material1='unit', material2='mortar', **mortarJoint)
	]
	model.bond(joints)
	softening.scatterStrengths(model, p, seed)
	bottom = nodesWhere(model, lambda x, y: y < 1e-9)
	model.drive('bottom', bottom, 'y')
	model.drive('centre', bottom[abs(model.reference[bottom, 0] - p.width / 2).argmin()], 'x') # keeps the prism from drifting sideways
	model.drive('platen', nodesWhere(model, lambda x, y: y > height - 1e-9), 'y', velocity=-velocity, rampTime=0.05 * p.stroke / velocity)
	model.insert()
	return model


def crush(stage, seed, steps):
	"""Presses until the stress has fallen to half the strength, or a fifth where joints soften. The model; the recorder of strain, stress [Pa], lateral
	strain of the middle brick, broken contact points and unbalanced ratio; the cracks."""
	model = stage.model or build(seed)
	middle = lambda x, y: abs(y - height / 2) < brickHeight / 2
	left, right = nodesWhere(model, lambda x, y: middle(x, y) & (x < 1e-9)), nodesWhere(model, lambda x, y: middle(x, y) & (x > p.width - 1e-9))
	floor, cracks = 1e-3 * mortarJoint['tension'] * area, Cracks(model)
	stop = loading.Stop(drop=last, displacement=(1.5 if softens else 1) * p.stroke)
	wider = Gauge(model, left, right, 'x')
	film = pictures.filmOf(p, model)
	pace = Pace(model, lambda: model.groupForce('platen'), lambda: model.groupForce('bottom'), stage.label)
	record = Recorder(
		strain=lambda: -model.groupTravelled('platen') / height, stress=lambda: -model.groupForce('platen') / area, lateral=lambda: wider() / p.width,
		broken=cracks.look, unbalanced=lambda: model.unbalancedRatio(floor=floor)
	)
	with Progress(steps, lambda: loadingLine(record.last.strain * height, record.last.stress, model, pace), label=stage.label) as progress:
		record.after(lambda row: film.look(-model.groupTravelled('platen') / p.stroke, row.stress, O.time))
		record.after(lambda row: cracks.noteStress(row.stress))
		record.after(lambda row: progress(int(-steps * model.groupTravelled('platen') / p.stroke)))
		record.after(lambda row: stop(-model.groupTravelled('platen'), row.stress, row.broken))
		record.after(lambda row: pace(row.broken))
		stage.keep(record=record, cracks=cracks, stop=stop)
		if not stage.model: begin(model, steps, floor, record, wider, cracks, stage.label)
		stage.run()
	return model, record, cracks, film


def begin(model, steps, floor, record, wider, cracks, label):
	"""The engines, and the way to the first crack."""
	servo = dict(groups=['platen'], floor=floor) if p.servo else None
	O.dt, O.trackEnergy = p.stroke / velocity / steps, softens
	O.engines = loopList(contact=True, servo=servo, damping=p.damping, alpha=p.alpha, safety=p.safety) # broken joints may slide on, part and meet again
	if p.solver == 'events':
		path = loading.follow(model, 'platen', label, gauges=[wider], release='cascade', displacement=p.stroke)
		record.take(
			strain=path['displacement'] / height, stress=path['force'] / area, lateral=path['gauges'][0] / p.width, broken=path['cracked'],
			unbalanced=path['residual']
		)
		cracks.began(path['crackPoint'])
		record()
	else:
		O.run(1, True)
		record()
		if p.jump:
			model.elasticJump()
			record()
	O.engines += [record.engine(max(1, min(50, steps // 400)))]


# ---- running

O.timingEnabled = True
with Session(p) as session:
	for seed in p.seedList:
		if session.wants(seed):
			with session.run(seed) as run:
				stage = session.stage('seed %d' % seed)
				with run.stepping():
					model, record, cracks, film = crush(stage, seed, p.steps)
				strain, stress, lateral, broken = (record[name] for name in ('strain', 'stress', 'lateral', 'broken'))
				strength, peak = curves.peak(strain, stress)
				elastic = (stress > 0.05 * strength) & (stress < 0.33 * strength) & (np.arange(len(stress)) < peak)
				run.add('compressive_strength', 'MPa', strength / 1e6, *experiments.compressiveStrength)
				slope = lambda column: np.polyfit(strain[elastic], column[elastic], 1)[0] if elastic.sum() > 1 else np.nan
				run.add('youngs_modulus', 'MPa', slope(stress) / 1e6, *experiments.youngsModulus)
				if softens:
					run.add(
						'postpeak_energy', 'N/mm', 1e-3 * curves.behindPeak(height * strain, stress, last),
						*experiments.compressiveFractureEnergy
					)
					energies.addDissipated(run, 'J')
				run.add('strain_at_peak', '1', strain[peak])
				run.add('lateral_strain_at_peak', '1', lateral[peak])
				run.add('lateral_by_vertical_strain', '1', slope(lateral))
				run.add('first_crack_stress', 'MPa', curves.atFirst(broken, stress) / 1e6)
				run.add('first_crack_height', 'mm', cracks.first[0][1] * 1e3)
				run.add(
					'first_crack_in_mortar', '1', cracks.first[1] != 'unit-unit' if cracks.first[1] else np.nan
				) # a mean over seeds is a share
				run.add('cracks_at_peak', '1', broken[peak])
				for pair, counts in cracks.atPeak.items():
					run.add('cracks_at_peak_' + pair, '1', sum(counts.values()))
				if p.units == 'voronoi':
					run.add('steep_share_unit-unit', '1', cracks.steepShare('unit-unit')) # a third if cracks ran every way alike
				run.add('steep_share_mortar-mortar', '1', cracks.steepShare('mortar-mortar'))
				run.curve(strain_permille=1e3 * strain, stress_MPa=stress / 1e6, lateral_permille=1e3 * lateral, broken=broken)
				run.model(model, steps=O.iter, **engineCosts(model, O.iter))
				run.quality(
					unbalanced_ratio_max=curves.largestBehindStart(record['unbalanced']), energy_error=energies.error() if softens else None
				)
			if seed == p.seed:
				pictures.drawRun(session, film, model, 'Prism in compression, seed %d' % seed)
		if p.halfRate and session.wants(seed, 'half_rate_change'):
			slow = crush(session.stage('seed %d, half rate' % seed), seed, 2 * p.steps)[1]
			strength = curves.peak(slow['strain'], slow['stress'])[0] / 1e6
			session.quality(seed, half_rate_change=strength / session.measured(seed, 'compressive_strength') - 1)
	session.write()
	session.picture(
		'curve.png', pictures.drawCurve, session.results.curves, 'strain_permille', 'stress_MPa', labels=('strain [‰]', 'compressive stress [N/mm²]'),
		title='Prism in compression', references=[pictures.Reference('strength, Oliveira 2003', experiments.compressiveStrength[0])]
	)
scenario.waitIfBatch()
