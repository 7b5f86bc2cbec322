# yade-blocks, GPL-2.0-or-later
"""Shear of a masonry couplet under precompression (paper, section 3.2; experiment of Van der Pluijm 1993, wire-cut bricks, 1:2:9 mortar).

Two clay bricks, 200 x 50 x 50 mm, and a mortar joint of 15 mm made of Voronoi blocks of 3.5 mm. The bottom is held; the top edge is pressed
down by sigma, staying parallel as under a stiff platen, and then moves sideways at 0.2 mm/s. Stress is the horizontal force on the
top edge by its area, displacement the mean slip across the mortar layer.

	scripts/run.sh shear [sigma=0.1e6|0.5e6|1e6] [key=value ...]        about 7 s a seed

Expected: peak 0.87 + 1.01 sigma, residual 0.73 sigma (N/mm2): the experiment's cohesion, friction and residual friction.
joints=measured takes joints that soften with what was measured and nothing fitted (yadeblocks.softening). joints=calibrated is a set that was fitted to
the three peaks with the tensile strength as measured, and joints within the mortar three times as strong (scripts/calibrated-softening.json has the search).
scatter= is the coefficient of variation of the joints' strengths, scatterLength= [m] their field's correlation length.

Size means sqrt(mean area) unless sizeMeaning=edge. Loading starts at the first crack (jump) and is a fifth as fast as said (approach) until the peak is passed;
servo=true lets the unbalanced force set the speed instead. kn, ks, cohesion, tension, friction, residualFriction, dilation (angles in degrees), GfI and
GfII [N/m], lastingShare and mortarStrengths (factor on the strengths of joints within the mortar) show what governs the result; what is not given is that of
the joints' set, Table 5 by default.
units=voronoi makes bricks of blocks, with edges of brickZone, that could crack; plain ones are one elastic block with zones of that size.
cells=triangles fills the layers with triangular blocks; edgeSegments=n makes n joints of every edge, so that contact points lie inside edges too.
halfRate=true repeats every run at half the loading rate and reports the change of the peak.
solver=events goes from failure to failure up to the peak (BlockModel.follow), which is the strength, and in time steps from there on; they may rise above
it where `steps` are few. afterPeak=false ends behind the peak (events: with the path), without a residual.
contact=false leaves out general contact: blocks meet in their joints alone, as events see them.
release=cascade is what a machine sees that holds its displacement while cracks run, and what slow steps come down to.
"""
from math import atan, degrees, radians

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

bricks, length, brickHeight, mortarHeight, thickness, stroke, brick, mortar = masonry.shearCouplet
moduli = scenario.usualParameters(unitYoung=brick['young'], mortarYoung=mortar['young'])
residualFriction = degrees(atan(experiments.residualFriction))
table5, shared = masonry.table5, dict(masonry.stiffnesses, dilation=0.)
measured = {name: softening.measured[name] for name in ('kn', 'ks', 'cohesion', 'tension', 'GfI', 'GfII', 'GfIIPressure', 'lastingShare')}
sets = { # angles in degrees
	'paper': dict(
		shared, cohesion=table5['cohesion'], tension=table5['tension'], friction=degrees(table5['frictionAngle']),
		residualFriction=degrees(table5['frictionAngleResidual']), GfI=0., GfII=0., GfIIPressure=0., lastingShare=0., mortarStrengths=1.
	),
	'measured': dict(
		measured, friction=degrees(softening.measured['frictionAngle']), residualFriction=residualFriction, dilation=0., mortarStrengths=1.
	),
	'calibrated': dict(
		shared, cohesion=1e6, tension=1e6 * experiments.tensileStrength[0], friction=50., residualFriction=residualFriction, GfI=20., GfII=150.,
		GfIIPressure=0., lastingShare=1., mortarStrengths=3.
	),
}
velocity = 0.2e-3 # [m/s]
pressSteps = 2000

p = scenario.parameters({
	**scenario.commonParameters(sizeMeaning='sqrtArea', lloyd=1, steps=32000, alpha=0.2), **scenario.usualParameters(
		sigma=0.5e6, stroke=stroke, approach=0.2, solver='steps', release='path', jump=True, servo=False, units='plain', cells='voronoi', edgeSegments=1
	), 'afterPeak': Key(True, 'go on behind the peak, to the residual stress'), 'contact': Key(True, 'blocks that share no joint may meet'),
	'size': Key(3.5e-3, 'size of the Voronoi cells', 'm', (lambda s: 0 < s < mortarHeight, 'must be positive and smaller than the mortar layer')),
	'joints': Key('paper', 'brittle joints of Table 5, or joints that soften',
			rule=tuple(sets)), **softening.jointKeys(*sets['paper'], 'mortarStrengths'), **softening.scatterKeys, **moduli,
	**scenario.usualParameters(brickZone=8e-3, merge=0.1, halfRate=False, vtk=True, frames=10, movie='none', sheets=True)
})
scenario.require(p.solver == 'steps' or not (p.halfRate or p.servo), 'shear: solver=events has no rate: servo and halfRate must be false')
for key, value in sets[p.joints].items():
	if getattr(p, key) == -1: setattr(p, key, value)
softening.takeScatter(p)
softens = p.GfI > 0
scenario.require(p.solver == 'steps' or not softens, 'shear: solver=events knows brittle joints only, got GfI=%g' % p.GfI)
joint = dict(
	kn=p.kn, ks=p.ks, frictionAngle=radians(p.friction), frictionAngleResidual=radians(p.residualFriction), dilationAngle=radians(p.dilation),
	cohesion=p.cohesion, tension=p.tension, GfI=p.GfI, GfII=p.GfII, GfIIPressure=p.GfIIPressure, lastingShare=p.lastingShare
)
area, low, high = length * thickness, brickHeight, brickHeight + mortarHeight
peakExpected, residualExpected = experiments.peakShearStress(p.sigma), experiments.residualShearStress(p.sigma)


def build(seed, dt):
	"""The couplet in the scene."""
	O.reset()
	O.materials.append(BlockMat(label='unit', **{**brick, 'young': p.unitYoung}))
	O.materials.append(BlockMat(label='mortar', **{**mortar, 'young': p.mortarYoung}))
	model = BlockModel(thickness=thickness, planeStress=p.plane == 'stress')
	options = dict(lloyd=p.lloyd, seed=seed, mergeFraction=p.merge, edgeSegments=p.edgeSegments)
	addCells(model, p.cells, rectangle(0, low, length, high), 'mortar', size=p.size, sizeMeaning=p.sizeMeaning, **options)
	for number, outline in enumerate((rectangle(0, 0, length, low), rectangle(0, high, length, high + brickHeight))):
		if p.units == 'plain': model.addRegion(outline, 'unit', zoneSize=p.brickZone)
		else: model.addVoronoi(outline, 'unit', size=p.brickZone, lloyd=3, seed=1000 * seed + number, edgeSegments=p.edgeSegments)
	joints = [
		JointMat(material1='mortar', material2='mortar', **softening.stronger(joint, p.mortarStrengths)),
		JointMat(material1='unit', material2='mortar', **joint)
	]
	if p.units == 'voronoi': joints.append(JointMat(material1='unit', material2='unit', **masonry.brickJoint))
	model.bond(joints)
	softening.scatterStrengths(model, p, seed)
	top = nodesWhere(model, lambda x, y: y > high + brickHeight - 1e-9)
	model.drive('bottom', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
	model.push('press', top, 'y', force=-p.sigma * area, rampTime=pressSteps * dt)
	model.drive('shear', top, 'x', rampTime=pressSteps * dt) # held while the press comes down
	model.insert()
	return model


def shear(stage, seed, steps):
	"""Presses, then shears over the whole stroke. The model; the recorder of displacement [m], stress [Pa], uplift [m], broken contact points,
	those that are not elastic any more, and unbalanced ratio; the cracks."""
	dt = p.stroke / velocity / steps
	model = stage.model or build(seed, dt)
	below, above = nodesWhere(model, lambda x, y: abs(y - low) < 1e-9, 'unit'), nodesWhere(model, lambda x, y: abs(y - high) < 1e-9, 'unit')
	floor, cracks = 1e-3 * max(p.sigma, joint['tension']) * area, Cracks(model)
	slip, uplift = Gauge(model, below, above, 'x'), Gauge(model, below, above, 'y')
	film = pictures.filmOf(p, model)
	record = Recorder(
		displacement=slip, stress=lambda: model.groupForce('shear') / area, uplift=uplift, broken=cracks.look,
		yielded=lambda: np.count_nonzero(model.pointStatus), unbalanced=lambda: model.unbalancedRatio(floor=floor), exact=lambda: 0
	)
	if not stage.model: press(model, dt, floor)
	approach = None if p.servo else loading.Approach(model, 'shear', p.approach, growth=1.03 if softens else 1.1) # one of them sets the speed
	stop = loading.Stop(drop=None if p.afterPeak else 0.8, displacement=p.stroke)
	pace = Pace(model, lambda: model.groupForce('shear'), lambda: model.groupForce('bottom', axis='x'), stage.label)
	with Progress(steps, lambda: loadingLine(record.last.displacement, record.last.stress, model, pace), label=stage.label) as progress:
		record.after(lambda row: film.look(model.groupTravelled('shear') / p.stroke, row.stress, O.time))
		if approach: record.after(lambda row: approach(row.stress, row.yielded))
		record.after(lambda row: stop(model.groupTravelled('shear'), row.stress, row.broken))
		record.after(lambda row: progress(int(steps * model.groupTravelled('shear') / p.stroke)))
		if p.solver == 'steps': record.after(lambda row: pace(row.yielded))
		stage.keep(record=record, cracks=cracks, approach=approach, stop=stop)
		if not stage.model:
			if p.solver == 'events':
				path = loading.follow(
					model, 'shear', stage.label, gauges=[slip, uplift], peak=True, drop=0.5, displacement=p.stroke, release=p.release
				)
				top = path['force'].argmax()
				up = slice(top + 1 if p.afterPeak else None) # the model is at the peak again; steps go on from there
				record.take(
					displacement=path['gauges'][0][up], stress=path['force'][up] / area, uplift=path['gauges'][1][up],
					broken=path['cracked'][up], yielded=path['cracked'][up], unbalanced=path['residual'], exact=1
				)
				cracks.began(path['crackPoint'])
				film.look(1, path['force'][top] / area, O.time)
				if not p.afterPeak: return model, record, cracks, film
			record()
			if p.solver == 'steps' and p.jump:
				model.elasticJump()
				record()
				if not softens: O.engines += [cracks.engine()]
			O.engines += [record.engine(max(1, min(50, steps // 400)))]
		stage.run()
	return model, record, cracks, film


def press(model, dt, floor):
	"""The engines, the precompression, and the top edge set in motion."""
	servo = dict(groups=['shear'], floor=floor) if p.servo else None
	O.dt, O.trackEnergy = dt, softens
	# with contact, what is broken may slide on, part and meet again
	O.engines = loopList(contact=p.contact, servo=servo, damping=p.damping, alpha=p.alpha, safety=p.safety)
	if p.solver == 'steps':
		O.run(1, True)
		if not p.jump: loading.settle(model, floor=floor)
	model.setTarget('shear', velocity, rampTime=0 if p.jump else pressSteps * dt)


# ---- running

O.timingEnabled = True
with Session(p) as session:
	for seed in p.seedList:
		if session.wants(seed):
			with session.run(seed) as run:
				stage = session.stage('seed %d' % seed)
				with run.stepping():
					model, record, cracks, film = shear(stage, seed, p.steps)
				displacement, stress, uplift, broken = (record[name] for name in ('displacement', 'stress', 'uplift', 'broken'))
				exact = record['exact'] > 0 # what faster steps reach behind the path is no strength
				path = exact if exact.any() else slice(None)
				strength, peak = curves.peak(displacement[path], stress[path])
				run.add('peak_shear_stress', 'MPa', strength / 1e6, *peakExpected)
				if p.afterPeak: run.add('residual_shear_stress', 'MPa', curves.residual(displacement, stress) / 1e6, *residualExpected)
				run.add('first_crack_stress', 'MPa', curves.atFirst(broken, stress) / 1e6)
				run.add('first_crack_point', '1', cracks.firstPoint if cracks.first[1] else np.nan) # its number in the model
				run.add('displacement_at_peak', 'um', displacement[peak] * 1e6)
				run.add('first_crack_place', 'mm', cracks.first[0][0] * 1e3) # from the left end
				run.add('cracks_at_peak', '1', broken[peak])
				run.add('crack_share_unit-mortar', '1', cracks.share('unit-mortar'))
				run.add('uplift', 'mm', uplift[-1] * 1e3)
				if softens:
					run.add('fracture_energy', 'N/m', energies.spent() / area) # friction included
					run.add('energy_above_residual', 'N/m', curves.aboveResidual(displacement, stress))
					run.add('crack_length', '1', cracks.length(area)) # by damage, over the section
					energies.addDissipated(run, 'N/m', area)
				ofPath = {'exact': record['exact']} if exact.any() else {}
				run.curve(displacement_mm=1e3 * displacement, stress_MPa=stress / 1e6, uplift_mm=1e3 * uplift, broken=broken, **ofPath)
				run.model(model, steps=O.iter, **engineCosts(model, O.iter))
				run.quality(
					unbalanced_ratio_max=curves.largestBehindStart(record['unbalanced']), energy_error=energies.error() if softens else None
				)
			if seed == p.seed:
				title = 'Couplet in shear, precompression %g N/mm², seed %d' % (p.sigma / 1e6, seed)
				pictures.drawRun(session, film, model, title)
		if p.halfRate and session.wants(seed, 'half_rate_change'):
			slow = shear(session.stage('seed %d, half rate' % seed), seed, 2 * p.steps)[1]
			strength = curves.peak(slow['displacement'], slow['stress'])[0] / 1e6
			session.quality(seed, half_rate_change=strength / session.measured(seed, 'peak_shear_stress') - 1)
	session.write()
	session.picture(
		'curve.png', pictures.drawCurve, session.results.curves, 'displacement_mm', 'stress_MPa',
		labels=('slip across the mortar layer [mm]', 'shear stress [N/mm²]'), title='Couplet in shear, precompression %g N/mm²' % (p.sigma / 1e6),
		references=[
			pictures.Reference(name + ', Van der Pluijm 1993', value or 0)
			for name, value in (('peak', peakExpected[0]), ('residual', residualExpected[0]))[:1 + p.afterPeak]
		]
	)
scenario.waitIfBatch()
