# yade-blocks, GPL-2.0-or-later
"""Tension and shear of the couplet with YADE's own polyhedra and mortar law, for comparison.

Law2_ScGeom_MortarPhys_Lourenco on rigid polyhedra (Ig2_Polyhedra_Polyhedra_ScGeom): the cells of tension.py and shear.py with
units=voronoi, a bond of the joint's area for every pair that shares edges. YADE takes the line between centroids for the normal of such a
contact, and a bond that breaks leaves no contact behind: there is no residual stress here, and nothing for a prism that is crushed.

	scripts/run.sh polyhedra experiment=tension|shear [key=value ...]

kn [Pa/m], ks (0: half of it), tension and cohesion [Pa] and friction [degrees] are those of the paper's joints unless given; scripts/calibrated.json
holds what scripts/benchmark.sh found (mode=calibrate). Bonds within bricks are unitStiffness times as stiff and do not break. Masses are
scaled for the stable step.
"""
from math import degrees, radians

import numpy as np

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yade import log, utils
from yadeblocks import curves, loading, masonry, running, scenario
from yadeblocks.experiments import expected
from yadeblocks.progress import Progress
from yadeblocks.recording import Recorder, runner
from yadeblocks.scenario import Key
from yadeblocks.session import Session
from yadeblocks.specimen import rectangle

# ---- parameters (SI)

# Specimen, its joints, size and what it means, steps.
experiments = {
	'tension': dict(couplet=masonry.tensionCouplet, joint=masonry.table3, size=2e-3, sizeMeaning='edge', lloyd=0, merge=0.2, steps=20000),
	'shear': dict(couplet=masonry.shearCouplet, joint=masonry.table5, size=3.5e-3, sizeMeaning='sqrtArea', lloyd=1, merge=0.1, steps=8000)
}
unitSize = 8e-3 # [m]

p = scenario.parameters(
	{
		**scenario.usualParameters(seed=1, seeds=1, threads=1, tag='', alpha=0.4, sigma=0.5e6, pressSteps=2000, approach=0.25), 'experiment': Key(
			'tension', 'which experiment', rule=tuple(experiments)
		), 'steps': Key(0, 'time steps for the whole stroke; 0: of the experiment', rule=scenario.notNegative),
		'safety': Key(0.8, 'time step as a fraction of the stable one',
				rule=(lambda f: 0 < f < 1, 'must lie in (0, 1)'
					)), 'unitStiffness': Key(4.0, 'stiffness of bonds within bricks by that in mortar',
								rule=scenario.positive), **{
									key: Key(
										0.0, f'{meaning} of the bonds; 0: of the experiment', unit, scenario.notNegative
									) for key, meaning, unit in (('kn', 'normal stiffness', 'Pa/m'), (
														'ks', 'shear stiffness (0: half of kn)', 'Pa/m'
													), ('tension', 'tensile strength', 'Pa'), (
														'cohesion', 'cohesion', 'Pa'
													), ('friction', 'friction angle', 'degrees'))
								}
	}
)
specimen = experiments[p.experiment]
couplet, joint = specimen['couplet'], specimen['joint']
usual = dict(joint, steps=specimen['steps'], friction=degrees(joint['frictionAngle']))
for key in ('steps', 'kn', 'tension', 'cohesion', 'friction'): # 0: of the experiment
	if not getattr(p, key): setattr(p, key, usual[key])
p.ks = p.ks or p.kn / 2
thickness, low, high = couplet.thickness, couplet.brickHeight, couplet.brickHeight + couplet.mortarHeight
area = couplet.width * thickness


def cells(seed):
	"""The couplet's cells, never inserted."""
	O.reset()
	for label, material in (('unit', couplet.unit), ('mortar', couplet.mortar)):
		O.materials.append(BlockMat(label=label, density=material['density']))
	model = BlockModel(thickness=thickness)
	model.addVoronoi(
		rectangle(0, low, couplet.width, high), 'mortar', size=specimen['size'], sizeMeaning=specimen['sizeMeaning'], lloyd=specimen['lloyd'],
		seed=seed, mergeFraction=specimen['merge'], zoning='corners'
	)
	for number, y in enumerate((0, high)):
		model.addVoronoi(
			rectangle(0, y, couplet.width, y + couplet.brickHeight), 'unit', size=unitSize, lloyd=3, seed=1000 * seed + number, zoning='corners'
		)
	model.bond()
	return model


class Specimen:
	"""Polyhedra in the scene, a bond for every pair of cells that share edges."""
	def __init__(self, seed):
		model = cells(seed)
		self.unit = np.array(model.materialLabels)[model.blockMaterial] == 'unit'
		outlines = [np.asarray(model.reference)[a:b] for a, b in zip(model.firstNode[:-1], model.firstNode[1:])]
		pairs, which = np.unique(np.asarray(model.segmentBlocks), axis=0, return_inverse=True)
		areas = np.bincount(which.ravel(), np.asarray(model.segmentArea) * 2)
		O.reset()
		made = [
			MortarMat(
				label=label, density=material['density'], young=1, poisson=0.5, frictionAngle=radians(p.friction), tensileStrength=p.tension,
				cohesion=p.cohesion, compressiveStrength=1e12, ellAspect=1
			) for label, material in (('unit', couplet.unit), ('mortar', couplet.mortar))
		]
		for mat in made:
			O.materials.append(mat)
		from yade import polyhedra_utils
		for outline, unit in zip(outlines, self.unit):
			corners = [(x, y, z) for x, y in outline for z in (-thickness / 2, thickness / 2)]
			body = polyhedra_utils.polyhedra(made[0 if unit else 1], v=corners)
			body.state.blockedDOFs, body.state.refPos, body.state.refOri = 'xyzXYZ', body.state.pos, body.state.ori
			O.bodies.append(body)
		self.centres = np.array([body.state.pos for body in O.bodies])[:, :2]
		self.pairs, self.areas = pairs, areas
		y = [outline[:, 1] for outline in outlines]
		self.bottom, self.top = ([i for i in range(len(y)) if abs(y[i] - plane).min() < 1e-9] for plane in (0, low + high))
		across = [(a, b) if self.centres[a, 1] < self.centres[b, 1] else (b, a) for a, b in pairs if self.unit[a] != self.unit[b]]
		beds = np.array(across)
		self.below, self.above = np.unique(beds[self.unit[beds[:, 0]],
							0]).tolist(), np.unique(beds[self.unit[beds[:, 1]], 1]).tolist() # bricks' cells along the bed planes

	def bond(self, geometry, dt):
		"""A bond for every pair, free of force as it is. YADE finds a pair only where the polyhedra, blown up, overlap."""
		self.lost, along, around = 0, np.zeros(len(O.bodies)), np.zeros(len(O.bodies))
		for (a, b), area in zip(self.pairs.tolist(), self.areas):
			for geometry.interactionDetectionFactor in (1.02, 1.05, 1.1, 1.2, 1.5, 2, 3):
				try:
					made = utils.createInteraction(a, b)
				except RuntimeError:
					continue
				break
			else:
				self.lost += 1
				continue
			distance = np.linalg.norm(np.subtract(O.bodies[a].state.pos, O.bodies[b].state.pos))
			factor = distance / (made.geom.refR1 + made.geom.refR2)
			made.geom.refR1 *= factor
			made.geom.refR2 *= factor
			stiffer = p.unitStiffness if self.unit[a] and self.unit[b] else 1
			made.phys.kn, made.phys.ks, made.phys.crossSection = stiffer * p.kn * area, stiffer * p.ks * area, area
			made.phys.neverDamage = bool(self.unit[a] and self.unit[b])
			made.phys.normalForce = (0, 0, 0)
			for body, reach in ((a, made.geom.refR1), (b, made.geom.refR2)):
				along[body] += made.phys.kn
				around[body] += made.phys.ks * reach**2
		for body, k, turning in zip(
			O.bodies, along, around
		): # masses as they may be scaled in quasi-static loading; YADE's own scaling knows spheres only
			body.state.mass, body.state.inertia = k * (dt / p.safety)**2, 3 * (turning * (dt / p.safety)**2, )

	def movement(self, axis):
		"""Of the upper brick's lowest cells relative to the lower brick's highest ones [m]."""
		displacement = lambda cells: np.mean([O.bodies[i].state.displ()[axis] for i in cells])
		return displacement(self.above) - displacement(self.below)

	def setThrottle(self, group, factor):
		"""Of the loading, for loading.Approach."""
		self.throttle = factor

	def hold(self):
		"""What the machine holds; in shear the top row is a stiff platen that may rise."""
		for body in O.bodies:
			body.state.blockedDOFs = 'zXY'
		for row in self.bottom + self.top:
			O.bodies[row].state.blockedDOFs = 'xyzXYZ'
		if p.experiment == 'shear':
			self.platen = O.bodies.clump(self.top)
			O.bodies[self.platen].state.blockedDOFs = 'xzXYZ'


def run(seed):
	"""Loads until the stress has fallen to half its peak. The specimen and the columns: displacement [m], stress [Pa]."""
	made = Specimen(seed)
	geometry = Ig2_Polyhedra_Polyhedra_ScGeom()
	dt = 1e-6 # of scaled masses, as in our scenarios: only displacement per step counts
	O.engines = [
		ForceResetter(),
		InteractionLoop([geometry], [Ip2_MortarMat_MortarMat_MortarPhys(cohesiveThresholdIter=2)], [Law2_ScGeom_MortarPhys_Lourenco()]),
		NewtonIntegrator(damping=p.alpha)
	]
	O.dt = dt
	made.bond(geometry, dt)
	axis, press = (0, p.pressSteps) if p.experiment == 'shear' else (1, 0)
	velocity = couplet.stroke / (p.steps * dt)
	made.hold()
	start = O.iter
	approach = loading.Approach(made, 'top', p.approach if press else 1)
	travelled = lambda: abs(np.mean([O.bodies[i].state.displ()[axis] for i in made.top]))

	def load():
		step = O.iter - start
		if press and step <= press: O.forces.setPermF(made.platen, (0, -p.sigma * area * min(1, step / (0.7 * press)), 0))
		speed = 0 if step < press else velocity * made.throttle * min(1, (step - press) / (0.05 * p.steps))
		for i in [made.platen] if press else made.top:
			now = O.bodies[i].state.vel
			now[axis] = speed
			O.bodies[i].state.vel = now

	def react(row):
		loaded = travelled() > 0.01 * couplet.stroke # what comes before is noise
		approach(row.stress, loaded)
		stop(travelled(), row.stress, loaded)
		progress(travelled() / couplet.stroke * p.steps)

	record = Recorder(moved=lambda: made.movement(axis), stress=lambda: -sum(O.forces.f(i)[axis] for i in made.top) / area).after(react)
	O.engines += [runner('load', load, max(1, p.steps // 250)), record.engine(max(1, p.steps // (800 if p.experiment == 'tension' else 400)))]
	load()
	stop = loading.Stop(drop=0.5, displacement=couplet.stroke)
	with Progress(p.steps, lambda: 'stress %.3f MPa' % (record.last.stress / 1e6), label='seed %d' % seed) as progress:
		running.run()
	return made, record['moved'], record['stress']


# ---- running

log.setLevel('NewtonIntegrator', log.ERROR)
with Session(p) as session:
	for seed in p.seedList:
		with session.run(seed) as result:
			with result.stepping():
				made, displacement, stress = run(seed)
			x, y = displacement * 1e3, stress / 1e6
			for name, (value, unit) in curves.measure(p.experiment, x, y).items():
				if name != 'residual_shear_stress': result.add(name, unit, value, *expected(p.experiment, p.sigma).get(name, (None, None)))
			result.curve(displacement_mm=x, stress_MPa=y)
			result.costs.update(steps=O.iter, polyhedra=len(made.unit), bonds=len(made.pairs), contacts=O.interactions.countReal(), lost=made.lost)
	session.write()
scenario.waitIfBatch()
