# yade-blocks, GPL-2.0-or-later
# needs: python3-shapely
"""Shear wall J4D (Raijmakers and Vermeltfoort 1992): pressed, then driven sideways; curve and cracks against the laboratory's.

990 x 1000 x 100 mm, bricks of 210 x 52 mm with joints of 10 mm, 4.5 bricks a course, 18 courses of which the lowest and the highest are clamped in steel.
After a precompression of 0.30 N/mm2 the upper one is held at its height, horizontal, and driven sideways.

	scripts/run.sh wall [detail=interface] [key=value ...]        about half a minute
	scripts/run.sh wall detail=mortar [key=value ...]             about five CPU minutes

detail=interface: bricks grow by half a joint, bed and head joints have no thickness and soften, and so does a possible crack in the middle of each brick
(crack=false: none). Joints: kn 82, ks 36 N/mm3, tension 0.25, cohesion 0.35 N/mm2, friction 0.75, GfI 18, GfII 125 N/m; cap 10.5 N/mm2 with Css 9, peak at
0.09 mm and 5 N/mm (Lourenco and Rots 1997; the cap from memory; cap=false: none). Cracks in bricks: 2.0 N/mm2, GfI 80 N/m; cohesion 2.8 N/mm2, friction 1 and
GfII 500 N/m are ours. Their stiffness, 1e6 N/mm3 in the source, is 1e4 here, sixty times half a brick's: more only makes scaled masses heavier.
detail=mortar: bricks have their size, mortar is made of Voronoi blocks whose joints have the same strengths and energies and no cap; its modulus is the one
with which a layer between two bricks is as stiff as kn says. Local damping holds back what moves steadily by alpha times the unbalanced forces, and there are
many grid points: with alpha=0.4 the base feels a tenth less than the top, at a quarter of the speed, too. So alpha is 0.1 here, and the start is slow.

Expected: two readings of the measured peak are in circulation, about 50 and 57 +- 8 kN; one digitised curve is drawn. Friction alone would be 22.3 kN. The
laboratory's wall cracked in tension at two opposite corners, in the bed joints, then along a stepped diagonal through bed and head joints and bricks.
"""
from math import atan

import numpy as np

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks import brickwork, curves, experiments, loading, masonry, pictures, scenario
from yadeblocks.engines import find, loopList
from yadeblocks.layout import Mortared
from yadeblocks.pace import Pace
from yadeblocks.progress import Progress, loadingLine
from yadeblocks.readings.blocks import blockOfNodes
from yadeblocks.recording import Recorder
from yadeblocks.results import Cracks
from yadeblocks.scenario import Key
from yadeblocks.session import Session

# ---- parameters (SI)

bricks, courses = 4.5, 18
length, height, gap, thickness, friction, brick, joint = masonry.j4d
mortarJoint = {**joint, **masonry.stiffnesses}
brickCrack = dict(tension=2e6, cohesion=2.8e6, frictionAngle=atan(1.), GfI=80., GfII=500.)
cap = dict(capStrength=10.5e6, capFirst=3.5e6, capResidual=1.5e6, capPeakClosure=0.09e-3, capEnergy=5e3, capShear=9.)
measured = np.array(experiments.wallCurve) # [mm], [kN]

p = scenario.parameters({
	**scenario.usualParameters(
		threads=1, tag='', seed=1, seeds=1, checkpoint=0., resume=False, damping='local', sigma=0.3e6, vtk=True, frames=10, movie='none', sheets=True
	), 'alpha': Key(
		-1., 'coefficient of local damping while the wall is driven (-1: 0.4, or 0.1 with mortar in detail)', '',
		(lambda a: a == -1 or 0 <= a < 1, 'must lie in [0, 1), or be -1')
	), 'stroke': Key(0., 'path of the top at which the run ends (0: 4e-3, or 2e-3 with mortar in detail)', 'm', scenario.notNegative),
	'steps': Key(0, 'time steps for the whole stroke (0: 20,000 a millimetre)', '', (lambda n: n == 0 or n >= 1000, 'must be at least 1000, or 0')),
	'detail': Key('interface', 'mortar joints without thickness, or mortar of Voronoi blocks',
			rule=('interface', 'mortar')), 'crack': Key(True, 'possible cracks in the middle of the bricks'),
	'crackStiffness': Key(1e13, 'stiffness of these', 'Pa/m', scenario.positive), 'cap': Key(True, 'joints can be crushed, with detail=interface'),
	'held': Key(True, 'the upper course is held at its height, or goes on carrying the precompression'),
	'zone': Key(0.06, 'size of the zones in bricks', 'm', (lambda s: 0 < s <= length, 'must be positive and at most a brick\'s length')),
	'size': Key(6e-3, 'size of the mortar\'s blocks, sqrt(area), with detail=mortar', 'm',
			(lambda s: 0 < s < gap, 'must be positive and below a joint')), **scenario.usualParameters(lloyd=2, merge=0.1)
})
if p.alpha == -1 and p.damping == 'local': p.alpha = 0.4 if p.detail == 'interface' else 0.1
if p.stroke == 0: p.stroke = 4e-3 if p.detail == 'interface' else 2e-3
if p.steps == 0: p.steps = max(1000, round(2e7 * p.stroke))
dt, pressSteps = 1e-4, 2000 # [s]; masses are scaled to suit
width, rise = bricks * (length + gap), courses * (height + gap)
load = p.sigma * width * thickness


def mortarModulus():
	"""Young's modulus with which a layer of Voronoi blocks between two bricks has the stiffness kn [Pa]: 1/kn = h/E' + h/(0.92 kj s) + 1/kj."""
	kj, nu = mortarJoint['kn'], 0.2
	return gap * (1 - nu**2) / (1 / joint['kn'] - gap / (0.92 * kj * p.size) - 1 / kj)


def build(seed):
	"""The wall at rest under its precompression. Its joints have names: bed, head and unit, or unit alone with mortar in detail."""
	O.reset()
	O.materials.append(BlockMat(label='unit', **brick))
	model = BlockModel(thickness=thickness, planeStress=True)
	wall = brickwork.runningBond(bricks, courses, length, height, gap, crack=p.crack)
	if p.detail == 'interface':
		placed = wall.addTo(model, 'unit', zoneSize=p.zone)
		crushed = {name: cap for name in ('bed', 'head') if p.cap}
		placed.bond(model, [JointMat(material1='unit', material2='unit', **joint)], **crushed)
		if p.crack: model.setJoints('unit', kn=p.crackStiffness, ks=p.crackStiffness, **brickCrack)
	else:
		O.materials.append(BlockMat(label='mortar', young=mortarModulus(), poisson=0.2, density=1800))
		placed = Mortared(wall, gap).addTo(model, 'unit', 'mortar', p.zone, p.size, lloyd=p.lloyd, seed=seed, mergeFraction=p.merge)
		cracks = JointMat(material1='unit', material2='unit', kn=p.crackStiffness, ks=p.crackStiffness, **brickCrack)
		model.bond([JointMat(material1=a, material2='mortar', **mortarJoint) for a in ('unit', 'mortar')] + [cracks] * p.crack)
		if p.crack: model.nameJoints('unit', placed.joints(model)['unit']) # others go by their pair of materials
	clamped, top = (endCourse(model, placed, course) for course in (0, courses - 1))
	model.drive('base', clamped, 'xy')
	model.push('press', top, 'y', force=-load, rampTime=pressSteps * dt)
	model.drive('side', top, 'x')
	model.insert()
	O.dt, O.engines = dt, loopList(contact=True, alpha=0.4)
	O.run(1, True)
	loading.settle(model, floor=1e-2 * load)
	motion = find('BlockMotion') # from now on all that moves steadily is held back by alpha times the unbalanced forces: the base feels less than the top
	motion.damping = p.damping
	if p.damping == 'local': motion.alpha = p.alpha
	if p.held:
		model.release('press')
		model.velocity[top] = 0
		model.drive('press', top, 'y')
	return model


def endCourse(model, placed, course):
	"""Grid points of the lowest or the highest course, with those of the mortar between its bricks."""
	blocks = placed.blocks[placed.layout.notes['courseOf'] == course]
	own = np.isin(blockOfNodes(model), blocks)
	if p.detail == 'interface': return np.flatnonzero(own)
	y, edge = model.reference[:, 1], model.reference[own, 1]
	return np.flatnonzero(own | (y > edge.min() + 1e-9 if course else y < edge.max() - 1e-9))


def nearDiagonal(model):
	"""The share of the damage within the free courses, by area, that lies within two courses of the diagonal along which the wall is pressed."""
	x, y = np.asarray(model.contactPositions()).T
	course = height + gap
	high = rise - 2 * course # of the free courses
	away = abs(x * high + (y - rise + course) * width) / np.hypot(width, high)
	damage = np.repeat(model.segmentArea, 2) * model.pointDamage * (abs(y - rise / 2) < high / 2 - course / 4)
	return damage[away < 2 * course].sum() / damage.sum() if damage.any() else np.nan


def shear(stage, seed):
	"""The model; the recorder of displacement [m], forces at the top and the base and normal force [N] and cracked contact points; the film."""
	model = stage.model or build(seed)
	cracks, film, stop = Cracks(model), pictures.filmOf(p, model), loading.Stop(displacement=p.stroke)
	record = Recorder(
		displacement=lambda: model.groupTravelled('side'), force=lambda: model.groupForce('side'), base=lambda: -model.groupForce('base', axis='x'),
		normal=lambda: -model.groupForce('press'), broken=cracks.look, unbalanced=lambda: model.unbalancedRatio(floor=1e-2 * load),
		kinetic=model.kineticEnergy
	)
	pace = Pace(model, lambda: model.groupForce('side'), lambda: model.groupForce('base', axis='x'), stage.label)
	if not stage.model: model.setTarget('side', p.stroke / (p.steps * dt), rampTime=(0.1 if p.detail == 'interface' else 0.5) * p.steps * dt)
	with Progress(
		p.steps, lambda: loadingLine(record.last.displacement, record.last.force / (width * thickness), model, pace), label=stage.label
	) as progress:
		record.after(lambda row: film.look(row.displacement / p.stroke, row.force, O.time))
		record.after(lambda row: progress(int(p.steps * row.displacement / p.stroke)))
		record.after(lambda row: pace((model.pointDamage > 0.1).any()))
		record.after(lambda row: stop(row.displacement, row.force, row.broken))
		stage.keep(record=record, cracks=cracks, stop=stop)
		if not stage.model: O.engines += [record.engine(max(1, p.steps // 800))]
		stage.run()
	return model, record, cracks, film


# ---- running

with Session(p) as session:
	for seed in filter(session.wants, p.seedList):
		with session.run(seed) as run:
			with run.stepping():
				model, record, cracks, film = shear(session.stage('seed %d' % seed), seed)
			force, displacement = record['force'], record['displacement']
			strength, peak = curves.peak(displacement, force)
			run.add('peak_shear_force', 'kN', strength / 1e3, *experiments.wallForce)
			first = curves.firstPeak(force)
			run.add('first_peak_force', 'kN', force[first] / 1e3, *experiments.wallForce)
			run.add('displacement_at_first_peak', 'mm', 1e3 * displacement[first], 1.0, 'the digitised curve')
			run.add('base_by_top_at_first_peak', '1', record['base'][first] / force[first], 1.0, 'equilibrium: inertia and damping take the rest')
			run.add('displacement_at_peak', 'mm', 1e3 * displacement[peak], 1.0, 'the digitised curve')
			at = lambda x: np.interp(x, 1e3 * displacement, force) / 1e3
			for x in (0.2, 2.0, 3.0):
				if 1e3 * p.stroke >= x: run.add('force_at_%g_mm' % x, 'kN', at(x), float(np.interp(x, *measured)), 'the digitised curve')
			run.curve(
				displacement_mm=1e3 * displacement, force_kN=force / 1e3, base_kN=record['base'] / 1e3, normal_kN=record['normal'] / 1e3,
				broken=record['broken'], kinetic_J=record['kinetic']
			)
			run.add('damage_near_the_diagonal', '1', nearDiagonal(model))
			run.model(model, steps=O.iter)
			run.quality(unbalanced_ratio_max=curves.largestBehindStart(record['unbalanced']))
		if seed == p.seed:
			pictures.drawRun(session, film, model, 'Shear wall J4D')
	session.write()
	session.picture(
		'curve.png', pictures.drawCurve, session.results.curves, 'displacement_mm', 'force_kN',
		labels=('displacement of the top [mm]', 'shear force [kN]'), title='Shear wall J4D, precompression %g N/mm²' % (p.sigma / 1e6), references=[
			pictures.Reference('laboratory (Raijmakers and Vermeltfoort 1992)', measured[1], measured[0]),
			pictures.Reference('the two readings of its peak', experiments.wallForceReadings),
			pictures.Reference('friction alone', friction * load / 1e3)
		]
	)
scenario.waitIfBatch()
