# yade-blocks, GPL-2.0-or-later
# needs: python3-scipy
"""The three experiments of tension.py, shear.py and compression.py with YADE's own bonded spheres, for comparison.

The same specimens, loading and quantities; a monolayer of spheres (z blocked), each brick and mortar layer a packing of its own.

	scripts/run.sh spheres experiment=tension|shear|compression model=jcfpm|jcfpmSmooth|cohfrict|cpm|lourenco [key=value ...]

	jcfpm        JointedCohesiveFrictionalPM: bonds that break in tension or shear, then friction
	jcfpmSmooth  the same, with its smooth joints on the bed planes (the only planes that are known beforehand)
	cohfrict     CohesionMoment: fragile bonds with bending moments
	cpm          ConcretePM: bonds with damage in tension
	lourenco     MortarMat: brittle bonds in a hexagonal packing, since it knows no state free of force but touching

Stress is force by length and layer thickness (two radii). Micro-parameters are the user's to calibrate: scripts/calibrated.json
holds those that scripts/benchmark.sh found (mode=calibrate), with the number of runs that took; they are the defaults here.
steps is, as in our scenarios, the number of steps for the whole stroke; the velocity follows from the stable time step. CohFrict in shear
is calibrated for steps=32000: in the usual 8000 it is about twice as strong.
"""
import json
import sys
from math import radians
from pathlib import Path

import numpy as np

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yade import log, utils
from yadeblocks import curves, loading, masonry, packing, running, scenario
from yadeblocks.experiments import expected
from yadeblocks.progress import Progress
from yadeblocks.recording import Recorder, runner
from yadeblocks.scenario import Key
from yadeblocks.session import Session

# ---- specimens (SI), as in the scenarios of the same name

experiments = { # specimen; radius of the spheres in mortar [m], how much larger they are in bricks, steps
	'tension': dict(of=masonry.tensionCouplet, radius=1.5e-3, coarser=2, steps=20000),
	'shear': dict(of=masonry.shearCouplet, radius=2e-3, coarser=2, steps=8000),
	'compression': dict(of=masonry.prism, radius=2.5e-3, coarser=1.5, steps=10000),
}
models = ('jcfpm', 'jcfpmSmooth', 'cohfrict', 'cpm', 'lourenco')
micro = { # what calibration moves; 0: of the calibration
	'unitYoung': ('modulus of the bonds in bricks', 'Pa'), 'mortarYoung': ('modulus of the bonds in mortar', 'Pa'),
	'poisson': ('tangential by normal stiffness', ''), 'unitStrength': ('strength of the bonds in bricks', 'Pa'),
	'tension': ('tensile strength of the bonds in mortar', 'Pa'), 'cohesion': ('cohesion of the bonds in mortar', 'Pa'),
	'friction': ('friction angle', 'degrees'), 'residualFriction': ('friction angle of broken bonds', 'degrees'),
	'jointTension': ('tensile strength on the bed planes', 'Pa'), 'jointCohesion': ('cohesion on the bed planes', 'Pa'),
	'jointFriction': ('friction angle on the bed planes', 'degrees'), 'jointStiffness': ('stiffness on the bed planes', 'Pa/m'),
	'ductility': ('strain at full damage by that at the peak', '')}
p = scenario.parameters({
	**scenario.usualParameters(seed=1, seeds=1, threads=1, tag='', alpha=0.4, sigma=0.5e6, pressSteps=2000, approach=0.25), 'experiment': Key(
		'tension', 'which experiment', rule=tuple(experiments)
	), 'model': Key('jcfpm', 'model of the bonds, see above',
			rule=models), 'radius': Key(0.0, 'radius of the spheres in mortar; 0: of the experiment', 'm', scenario.notNegative),
	'unitRadius': Key(0.0, 'radius of the spheres in bricks; 0: of the experiment', 'm',
				scenario.notNegative), 'steps': Key(0, 'time steps for the whole stroke; 0: of the experiment', rule=scenario.notNegative),
	'reach': Key(1.3, 'distance within which spheres are bonded, by the sum of their radii', rule=(lambda f: 1 <= f <= 2, 'must lie in [1, 2]')),
	'safety': Key(0.8, 'time step as a fraction of the stable one', rule=(lambda f: 0 < f < 1, 'must lie in (0, 1)')), **{
		key: Key(0.0, meaning + '; 0: calibrated', unit, scenario.notNegative) for key, (meaning, unit) in micro.items()
	}
})
usual = experiments[p.experiment]
specimen = usual['of']
p.radius, p.steps = p.radius or usual['radius'], p.steps or usual['steps']
p.unitRadius = p.unitRadius or p.radius * (usual['coarser'] if p.model != 'lourenco' else 1) # bricks that stay elastic need fewer spheres
calibrated = json.loads((Path(sys.argv[0]).parent / 'calibrated.json').read_text()).get(f'{p.model} {p.experiment}', {}).get('parameters', {})
for key in micro: # 0: of the calibration
	if not getattr(p, key): setattr(p, key, calibrated.get(key, 0.0))

width, thickness = specimen.width, 2 * p.radius
layers = [('mortar', specimen.mortarHeight) if i % 2 else ('unit', specimen.brickHeight) for i in range(2 * specimen.bricks - 1)]
height = sum(thick for _, thick in layers)
area = width * thickness

# ---- materials and laws


def materials():
	"""Of bricks and mortar. Bricks are stronger by unitStrength; where materials meet, the mortar's strength counts (see bond)."""
	made = {}
	for label, young, density, factor in (('unit', p.unitYoung, specimen.unit['density'], p.unitStrength),
						('mortar', p.mortarYoung, specimen.mortar['density'], 1)):
		elastic = dict(label=label, young=young, poisson=p.poisson, density=density, frictionAngle=radians(p.friction))
		if p.model in ('jcfpm', 'jcfpmSmooth'):
			joint = dict(
				jointNormalStiffness=p.jointStiffness, jointShearStiffness=p.jointStiffness /
				2, jointTensileStrength=p.jointTension, jointCohesion=p.jointCohesion, jointFrictionAngle=radians(p.jointFriction)
			) if p.model == 'jcfpmSmooth' else {}
			made[label] = JCFpmMat(
				type=1, tensileStrength=factor * p.tension, cohesion=factor * p.cohesion, residualFrictionAngle=radians(p.residualFriction),
				**elastic, **joint
			)
		elif p.model == 'cohfrict':
			made[label] = CohFrictMat(
				normalCohesion=1e30, shearCohesion=1e30, fragile=True, momentRotationLaw=True, **elastic
			) # strengths: see bond
		elif p.model == 'cpm':
			made[label] = CpmMat(sigmaT=factor * p.cohesion, epsCrackOnset=factor * p.tension / young, relDuctility=p.ductility, **elastic)
		else:
			made[label] = MortarMat(
				tensileStrength=factor * p.tension, cohesion=factor * p.cohesion, compressiveStrength=1e3 * factor * p.tension, ellAspect=1,
				**elastic
			)
		O.materials.append(made[label])
	return made


def functors():
	"""Ig2, Ip2 and Law2 of the model."""
	geometry = Ig2_Sphere_Sphere_ScGeom6D if p.model == 'cohfrict' else Ig2_Sphere_Sphere_ScGeom
	reach = 1 if p.model == 'lourenco' else p.reach
	laws = {
		'jcfpm': lambda: (Ip2_JCFpmMat_JCFpmMat_JCFpmPhys(cohesiveTresholdIteration=1), Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM()),
		'jcfpmSmooth': lambda:
		(Ip2_JCFpmMat_JCFpmMat_JCFpmPhys(cohesiveTresholdIteration=1), Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM(smoothJoint=True)),
		'cohfrict': lambda: (Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True), Law2_ScGeom6D_CohFrictPhys_CohesionMoment()), 'cpm': lambda:
		(Ip2_CpmMat_CpmMat_CpmPhys(cohesiveThresholdIter=1), Law2_ScGeom_CpmPhys_Cpm(omegaThreshold=0.999)), 'lourenco': lambda:
		(Ip2_MortarMat_MortarMat_MortarPhys(cohesiveThresholdIter=2), Law2_ScGeom_MortarPhys_Lourenco())
	}
	return Bo1_Sphere_Aabb(aabbEnlargeFactor=1.001 * reach), geometry(interactionDetectionFactor=1.001 * reach), *laws[p.model]()


def bond():
	"""After the first step, which made the bonds: their state is the one free of force, and across the bed planes the mortar is what breaks."""
	for interaction in O.interactions:
		labels, phys = {O.bodies[i].material.label for i in (interaction.id1, interaction.id2)}, interaction.phys
		factor = p.unitStrength if labels == {'unit'} else 1
		if p.model == 'cohfrict': # knows no initial distance; without this, bonds across a gap would break at once
			smaller = min(interaction.geom.refR1, interaction.geom.refR2)
			phys.unp = interaction.geom.penetrationDepth
			phys.normalAdhesion, phys.shearAdhesion = factor * p.tension * smaller**2, factor * p.cohesion * smaller**2
			phys.shearForce = (0, 0, 0)
		if p.model == 'cpm' and len(labels) == 2: # it would take means
			phys.undamagedCohesion, phys.epsCrackOnset = p.cohesion, p.tension / phys.E


# ---- specimen and loading


class Specimen:
	"""The spheres of a specimen in the scene: layers of bricks and mortar, their lowest and highest rows in the grip of the machine."""
	def __init__(self, seed):
		O.reset()
		made, y = materials(), 0
		centres, radii, labels = [], [], []
		for i, (label, thick) in enumerate(layers):
			layer = packing.randomPacking(width, thick, p.radius if label == 'mortar' else p.unitRadius, 100 * seed + i)
			centres.append(layer[0] + (0, y))
			radii.append(layer[1])
			labels += [label] * len(layer[1])
			y += thick
		if p.model == 'lourenco': centres, radii, labels = self.touching(seed)
		self.centres, self.radii, self.labels = np.vstack(centres), np.concatenate(radii), np.array(labels)
		for (x, y), radius, label in zip(self.centres, self.radii, labels):
			sphere = utils.sphere((x, y, 0), radius, material=made[label])
			sphere.state.blockedDOFs = 'xyzXYZ' # until hold()
			O.bodies.append(sphere)
		x, y = self.centres.T
		low, high = y.min(), y.max()
		self.bottom, self.top = (np.flatnonzero(rows).tolist() for rows in (y < low + p.unitRadius, y > high - p.unitRadius))
		if p.model == 'jcfpmSmooth': self.markPlanes()

	def touching(self, seed):
		"""One hexagonal packing for the whole specimen, so that spheres touch across the bed planes as well."""
		centres, radii = packing.hexagonalPacking(width, height, p.radius, seed)
		planes = np.cumsum([0] + [thick for _, thick in layers])
		layer = np.clip(np.searchsorted(planes, centres[:, 1]) - 1, 0, len(layers) - 1)
		return [centres], [radii], [layers[i][0] for i in layer]

	def markPlanes(self):
		"""Spheres on either side of a bed plane know its normal: bonds between them are smooth joints."""
		plane = 0
		for _, thick in layers[:-1]:
			plane += thick
			distance = self.centres[:, 1] - plane
			for sphere in np.flatnonzero(abs(distance) < 1.2 * p.reach * np.where(self.labels == 'unit', p.unitRadius, p.radius)):
				state = O.bodies[int(sphere)].state
				state.onJoint, state.joint = True, state.joint + 1
				setattr(state, 'jointNormal%d' % state.joint, (0, float(np.sign(distance[sphere])), 0))

	def movement(self, axis):
		"""Of the spheres above the first mortar layer relative to those below [m]."""
		low, high = specimen.brickHeight, specimen.brickHeight + specimen.mortarHeight
		y, unit = self.centres[:, 1], self.labels == 'unit'
		displacement = lambda rows: np.mean([O.bodies[int(i)].state.displ()[axis] for i in np.flatnonzero(rows & unit)])
		reach = 2 * p.unitRadius
		return displacement((y > high) & (y < high + reach)) - displacement((y < low) & (y > low - reach))

	def setThrottle(self, group, factor):
		"""Of the loading, for loading.Approach."""
		self.throttle = factor

	def force(self, axis):
		"""On the top row by the specimen [N]."""
		return sum(O.forces.f(i)[axis] for i in self.top)


def run(seed):
	"""Loads until the stress has fallen to half its peak (shear: over the whole stroke). The specimen; displacement [m] (compression: strain);
	stress [Pa]."""
	made = Specimen(seed)
	box, geometry, properties, law = functors()
	dt = 1e-6 # of scaled masses, as in our scenarios: only displacement per step counts
	newton = NewtonIntegrator(damping=p.alpha)
	stepper = GlobalStiffnessTimeStepper(dead=True, densityScaling=True, targetDt=dt, timestepSafetyCoefficient=p.safety, timeStepUpdateInterval=100)
	O.engines = [
		ForceResetter(),
		InsertionSortCollider([box], verletDist=0.1 * p.radius), stepper,
		InteractionLoop([geometry], [properties], [law]), newton
	]
	O.dt = dt
	O.step() # makes the bonds; nothing moves yet
	bond()
	for interaction in O.interactions:
		interaction.phys.normalForce = 1e-12 * interaction.geom.normal # the time stepper passes over bonds without any
	box.aabbEnlargeFactor = geometry.interactionDetectionFactor = 1 # new contacts are those of spheres that touch
	made.bonds = O.interactions.countReal()

	axis = 0 if p.experiment == 'shear' else 1
	press = p.pressSteps if p.experiment == 'shear' else 0
	velocity = specimen.stroke / (p.steps * dt)
	hold(made)
	stepper.dead = False
	newton.densityScaling = True # reaches it only while the stepper is in O.engines, and says so
	start = O.iter
	approach = loading.Approach(made, 'top', p.approach if press else 1)
	travelled = lambda: abs(np.mean([O.bodies[i].state.displ()[axis] for i in made.top]))

	def load():
		step = O.iter - start
		if press and step <= press: O.forces.setPermF(made.platen, (0, -p.sigma * area * min(1, step / (0.7 * press)), 0))
		if step < press: speed = 0
		else: speed = velocity * made.throttle * min(1, (step - press) / (0.05 * p.steps))
		for i in [made.platen] if press else made.top:
			now = O.bodies[i].state.vel
			now[axis] = -speed if p.experiment == 'compression' else speed
			O.bodies[i].state.vel = now

	def moved():
		if p.experiment == 'compression': return -np.mean([O.bodies[i].state.displ()[1] for i in made.top]) / height
		return made.movement(axis)

	def react(row):
		loaded = travelled() > 0.01 * specimen.stroke # what comes before is noise
		approach(row.stress, loaded)
		stop(travelled(), row.stress, loaded)
		progress(travelled() / specimen.stroke * p.steps)

	record = Recorder(moved=moved, stress=lambda: made.force(axis) / area * (1 if p.experiment == 'compression' else -1)).after(react)
	O.engines += [runner('load', load, max(1, p.steps // 1000)), record.engine(max(1, p.steps // (1600 if p.experiment == 'tension' else 400)))]
	load()
	stop = loading.Stop(drop=None if press else 0.5, displacement=specimen.stroke)
	with Progress(p.steps, lambda: 'stress %.3f MPa' % (record.last.stress / 1e6), label='seed %d' % seed) as progress:
		running.run()
	return made, record['moved'], record['stress']


def hold(made):
	"""What the machine holds: tension and shear grip the rows, compression lets them slide sideways; in shear the top row is a stiff platen that
	may rise."""
	for sphere in O.bodies:
		sphere.state.blockedDOFs = 'zXY'
	for row in made.bottom + made.top:
		O.bodies[row].state.blockedDOFs = 'yzXY' if p.experiment == 'compression' else 'xyzXYZ'
	if p.experiment == 'shear':
		made.platen = O.bodies.clump(made.top)
		O.bodies[made.platen].state.blockedDOFs = 'xzXYZ'


# ---- running

missing = [key for key in ('unitYoung', 'mortarYoung', 'poisson', 'unitStrength', 'tension', 'cohesion') if not getattr(p, key)]
if missing: raise SystemExit('spheres: %s is not calibrated for %s: give %s' % (p.model, p.experiment, ' '.join(missing)))
log.setLevel('NewtonIntegrator', log.ERROR)
with Session(p) as session:
	for seed in p.seedList:
		with session.run(seed) as result:
			with result.stepping():
				made, displacement, stress = run(seed)
			x, y = displacement * 1e3, stress / 1e6
			for name, (value, unit) in curves.measure(p.experiment, x, y).items():
				result.add(name, unit, value, *expected(p.experiment, p.sigma).get(name, (None, None)))
			intact = sum(1 for i in O.interactions if i.isReal)
			result.curve(**{'strain_permille' if p.experiment == 'compression' else 'displacement_mm': x, 'stress_MPa': y})
			result.costs.update(steps=O.iter, spheres=len(made.radii), bonds=made.bonds, contacts=intact)
	session.write()
scenario.waitIfBatch()
