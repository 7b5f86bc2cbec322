# yade-blocks, GPL-2.0-or-later
"""Stability on stiff and extreme cases: what is expected, what was seen, pass or fail.

	scripts/stability.sh [case=NAME] [tag=TEXT]        about a minute; case=list names them, case=quick leaves out the long ones

Every case is a function below its name and expectation. It builds a scene, runs it and tells a `Look` what it saw. The energy
balance, external work = stored + kinetic + friction + fracture + damping, is taken from O.energy all along the run; its
largest error is stated as a share of what was turned over, and must stay below 1 % unless a case says less.
Results: a table on the terminal and in out/stability/table.md, all numbers in out/stability/result.json; exit code 1 if a case failed.
"""
import json
import math
import os
import sys
import tempfile
import time
from contextlib import contextmanager

import numpy as np

import yadeblocks
from yade import *
from yadeblocks import scenario
from yadeblocks.specimen import nodesWhere, rectangle

p = scenario.parameters({'case': 'all', 'tag': '', 'threads': 1})
eps = np.finfo(float).eps
young, density, g = 20e9, 2000, 9.81 # of most blocks: [Pa], [kg/m3]; [m/s2]

# ---- what cases are made of


def begin(**materials):
	"""An empty scene with materials by label: dictionaries of what is not as in most blocks. Poisson's ratio 0: bars and columns have closed forms."""
	O.reset()
	O.resetTime()
	O.trackEnergy = True
	for label, changes in (materials or {'rock': {}}).items():
		O.materials.append(BlockMat(label=label, **{**dict(young=young, poisson=0, density=density), **changes}))


def column(heights, width=0.2, zoneSize=0.1, labels=None, thickness=1):
	"""Rectangular blocks one upon the other."""
	model, y = BlockModel(thickness=thickness), 0
	for height, label in zip(heights, labels or ['rock'] * len(heights)):
		model.addRegion(rectangle(0, y, width, y + height), label, zoneSize=zoneSize, zoning='regular', conforming=False) # the same points anyway
		y += height
	model.bond()
	return model


def panel(size=0.25, width=1, height=0.6, seed=3):
	"""Voronoi blocks in a rectangle."""
	model = BlockModel(thickness=0.5)
	model.addVoronoi(rectangle(0, 0, width, height), 'rock', size=size, seed=seed)
	model.bond()
	return model


def level(model, y):
	"""Grid points at a height."""
	reach = 1e-9 * np.ptp(model.reference[:, 1])
	return nodesWhere(model, lambda _, height: abs(height - y) < reach)


def joints(kn, ks=None, labels=('rock', ), **properties):
	"""The same joint for all pairs of materials, so strong that nothing breaks unless strengths are given."""
	properties = {**dict(cohesion=1e30, tension=1e30), **properties} if properties.get('bonded', True) else properties
	return [JointMat(material1=a, material2=b, kn=kn, ks=ks or kn / 2, **properties) for i, a in enumerate(labels) for b in labels[i:]]


def engines(joints, stepper={}, contact=False, **integrator):
	"""The list of a time step; without a stepper (None) masses are true and O.dt is the case's."""
	before = [BlockContacts(), InsertionSortCollider([Bo1_Block_Aabb()], verletDist=0)] if contact else []
	return before + [InteractionLoop([Ig2_Block_Block_BlockGeom()], [Ip2_BlockMat_BlockMat_JointPhys(joints=joints)], [Law2_BlockGeom_JointPhys_MohrCoulomb()])] \
                              + ([] if stepper is None else [BlockTimeStepper(**stepper)]) + [BlockForces(), BlockIntegrator(**{'rescueFile': '', **integrator})]


dynamic = dict(quasiStatic=False) # true masses, O.dt from the stepper


def kick(model, amplitude, held=()):
	"""Random displacements of all grid points but those that are held [m]."""
	shifts = np.random.default_rng(1).uniform(-amplitude, amplitude, model.position.shape)
	for nodes in held:
		shifts[nodes] = 0
	model.displacement[:] += shifts


class Look:
	"""What a case saw: sentences, whether all was as expected, and the energy balance."""
	def __init__(self):
		self.sentences, self.passed, self.steps = [], True, 0
		self.energyError, self.energyLimit = None, 0.01
		self.forget()

	def true(self, rule, sentence):
		"""Something that must hold."""
		self.sentences.append(sentence if rule else sentence + ' (!)')
		self.passed &= bool(rule)

	def equal(self, what, measured, expected, tolerance):
		"""A number and what it should be, within a relative tolerance."""
		error = measured / expected - 1
		self.true(abs(error) <= tolerance, '%s %.6g (error %.1e, allowed %.1e)' % (what, measured, error, tolerance))

	def below(self, what, measured, limit):
		self.true(measured <= limit, '%s %.1e (allowed %.1e)' % (what, measured, limit))

	def run(self, steps, samples=20):
		"""Steps of the scene; the energy balance is looked at after the first one of a scene, and then now and again."""
		self.steps += steps
		if self.first is None:
			O.step()
			self.balance()
			steps -= 1
		for i in range(samples):
			for _ in range(steps * (i + 1) // samples - steps * i // samples):
				O.step()
			self.balance()

	def balance(self):
		entries = [value for _, value in O.energy.items()]
		if not entries: return
		if not np.isfinite(entries).all(): # max() passes over what is no number
			self.first, self.turnover, self.imbalance = 0, max(self.turnover, 1), math.inf
			return
		if self.first is None: self.first = sum(entries)
		self.turnover = max(self.turnover, sum(max(value, 0) for value in entries))
		self.imbalance = max(self.imbalance, abs(sum(entries) - self.first))
		if self.turnover > 0: self.runError = self.imbalance / self.turnover

	def forget(self):
		"""Before another scene: the balance of the one before is kept if it was worse."""
		if getattr(self, 'first', None) is not None and self.turnover > 0: self.energyError = max(self.energyError or 0, self.imbalance / self.turnover)
		self.first, self.turnover, self.imbalance = None, 0, 0


def energy(name):
	return dict(O.energy.items())['block' + name]


def settle(look, model, ratio, steps=200000):
	"""Runs until the unbalanced ratio is below a target; what it has come to."""
	for _ in range(steps // 500):
		look.run(500, samples=1)
		if model.unbalancedRatio() < ratio: break
	return model.unbalancedRatio()


@contextmanager
def messages():
	"""What YADE writes to the standard error stream meanwhile, as a list of one text."""
	texts = []
	sys.stderr.flush()
	kept = os.dup(2)
	with tempfile.TemporaryFile() as file:
		os.dup2(file.fileno(), 2)
		try:
			yield texts
		finally:
			os.dup2(kept, 2)
			os.close(kept)
			file.seek(0)
			texts.append(file.read().decode())


def outcome(run):
	"""'silent' if a run comes to its end, 'refused' by the check of the time step, or 'detected' by the watch, and the message."""
	try:
		run()
	except (RuntimeError, ValueError) as error:
		return ('detected' if 'unstable at step' in str(error) else 'refused'), str(error)
	return 'silent', ''


cases = [] # name, expectation, function, whether it takes longer than a second


def case(name, expected, slow=False):
	def enlist(function):
		cases.append((name, expected, function, slow))
		return function

	return enlist


# ---- stiffness and mass


def seriesAndKick(look, heights, moduli, kn):
	"""Statics of a column against springs in series, then an undamped vibration of it at the largest step."""
	labels = ['m%d' % i for i in range(len(heights))]
	height, stroke = sum(heights), 1e-4 * sum(heights)
	compliance = sum(h / E for h, E in zip(heights, moduli)) + (len(heights) - 1) / kn
	stress = stroke / compliance
	# a joint's stress comes in steps of kn x the rounding of a position; there are two joints, and sums of four points each
	rounding = 8 * eps * height * kn / stress

	def scene(velocity):
		begin(**{label: dict(young=E) for label, E in zip(labels, moduli)})
		model = column(heights, labels=labels)
		model.drive('low', level(model, 0), 'xy')
		model.drive('top', level(model, height), 'y', velocity=velocity, rampTime=velocity and 1)
		model.drive('aside', level(model, height), 'x')
		model.insert()
		return model

	model = scene(stroke / 1e3)
	O.dt = 1
	O.engines = engines(joints(kn, labels=labels), alpha=0.5)
	look.run(1000)
	model.setTarget('top', 0)
	unbalanced = settle(look, model, 1e-8)
	travelled = model.groupTravelled('top')
	look.equal('stress by springs in series', model.groupForce('top') / 0.2 / travelled * stroke, stress, 1e-6 + unbalanced * 10 + rounding)

	look.forget()
	model = scene(0)
	kick(model, 1e-4 * min(1e-5, *heights), held=(level(model, 0), level(model, height))) # strains of 1e-4 where zones are lowest
	O.engines = engines(joints(kn, labels=labels), dict(quasiStatic=False, safety=0.95), damping='none')
	look.run(20000)


for ratio in 1e-3, 1, 1e3, 1e6:

	@case('joint stiffness x%g' % ratio, 'springs in series; undamped at safety 0.95 for 20,000 steps the energy stays')
	def jointStiffness(look, ratio=ratio):
		seriesAndKick(look, [0.2] * 3, [young] * 3, ratio * young / 0.2)


@case('modulus ratio 1e6', 'springs in series; undamped at safety 0.95 for 20,000 steps the energy stays')
def modulusRatio(look):
	seriesAndKick(look, [0.2] * 3, [young, 1e-6 * young, young], young / 0.2)


@case('density ratio 1e6', 'a heavy block on a light one: the period of a mass on a spring')
def densityRatio(look):
	begin(light=dict(density=2), heavy=dict(density=2e6))
	model = column([0.2, 0.2], labels=['light', 'heavy'])
	model.drive('low', level(model, 0), 'xy')
	model.drive('sides', nodesWhere(model, lambda x, y: y > 1e-9), 'x')
	model.insert()
	heavy = np.arange(model.firstNode[1], model.firstNode[2])
	kn, mass = young / 0.2, model.mass[heavy].sum()
	O.engines = engines(joints(kn, labels=('light', 'heavy')), dict(quasiStatic=False, safety=0.7), damping='none')
	# Springs in series; of its own flexibility a third counts at the heavy block's inertia (Rayleigh), and of the light one's mass (1e-6) nothing.
	# Rayleigh's quotient errs by the square of what the shape errs by: (1/3 of the three compliances)^2 ~ 1e-2 of the part, below 1 % in all.
	stiffness = 0.2 / (0.2 / young + 1 / kn + 0.2 / young / 3)
	period = 2 * math.pi * math.sqrt(mass / stiffness)
	model.velocity[heavy, 1] = 1e-3
	O.step()
	steps = int(2.2 * period / O.dt)
	heights = []
	for _ in range(2200):
		look.run(max(1, steps // 2200), samples=1)
		heights.append((model.mass[heavy] * (model.position[heavy, 1] - model.reference[heavy, 1])).sum() / mass)
	heights = np.array(heights)
	down = np.flatnonzero((heights[:-1] > 0) & (heights[1:] <= 0))
	cross = [i + heights[i] / (heights[i] - heights[i + 1]) for i in down]
	look.equal('period', (cross[1] - cross[0]) * (steps // 2200) * O.dt, period, 0.01)


# ---- the time step


def trueLimit(model):
	"""2/omega of the fastest mode by power iteration on forces after small displacements; its relative uncertainty.

	The engines must not move anything. Some eigenvalue of M^-1 K is within |residual| of Rayleigh's quotient."""
	free = np.ones_like(model.position)
	mass, rest = model.mass[:, None], np.array(model.displacement)
	small = 1e-7 * np.ptp(model.reference) # linear: frames turn by so little; against rounding 1e-9 of it

	def forces(shift):
		model.displacement[:] = rest + shift
		O.step()
		return np.array(model.force)

	mode, square, residual = np.random.default_rng(1).normal(size=rest.shape), 0, math.inf
	for _ in range(5000):
		mode *= small / abs(mode).max()
		image = (forces(-mode) - forces(mode)) / 2 / mass
		norm = (mass * mode * mode).sum()
		square = (mass * mode * image).sum() / norm
		residual = math.sqrt((mass * (image - square * mode)**2).sum() / norm) / square
		if residual < 1e-4: break
		mode = image
	model.displacement[:] = rest
	return 2 / math.sqrt(square), residual / 2


def safetyCase(look, damping, alpha=0.3):
	joint = joints(young / 0.25, 0.8 * young / 0.25)
	begin()
	model = panel()
	model.insert()
	O.dt = 1e-9
	O.engines = engines(joint)[:1] + [BlockForces()]
	limit, uncertain = trueLimit(model)
	allowed = 0.95 / math.sqrt(1 + (alpha if damping == 'local' else 0))

	def attempt(stepper, dt):
		look.forget()
		begin()
		model = panel()
		model.insert()
		kick(model, 1e-7)
		O.dt, O.engines = dt, engines(joint, stepper, damping=damping, alpha=alpha)

		def run():
			look.run(1)
			look.start = sum(energy(e) for e in ('Kinetic', 'Zones', 'Joints')) # what the kick gave
			look.run(3000)

		found, message = outcome(run)
		if found != 'silent': return found
		# U (1 - s^2) of a mode is never more than what there was; s as a share of the true limit
		share = O.dt / limit if stepper is None else stepper['safety']
		return 'stable' if share < 1 and energy('Zones') + energy('Joints') <= look.start / (1 - share**2) * 1.01 else 'silent'

	safeties = [0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.98, 1.02, 1.1]
	byTrue = [attempt(None, s * limit) for s in safeties]
	byStepper = [attempt(dict(safety=s), 1e-3) for s in safeties]
	begin()
	model = panel()
	model.insert()
	O.dt, O.engines = 1e-9, engines(joint, dict(dynamic, safety=0.5))
	O.step()
	bound = O.engines[1].stableStep / limit
	look.below('power iteration uncertain by', uncertain, 1e-3)
	look.true(bound <= 1 + uncertain, 'bound %.3f of the true limit' % bound)
	for name, found, fits in (('O.dt', byTrue, lambda s: s <= allowed * bound), ('safety', byStepper, lambda s: s <= allowed)):
		stable = [s for s, f in zip(safeties, found) if f == 'stable']
		stopped = [s for s, f in zip(safeties, found) if f in ('refused', 'detected')]
		look.true(
			stable == [s for s in safeties if fits(s)] and len(stable) + len(stopped) == len(safeties) and min(stopped) < 1,
			'%s: stable %g to %g, refused from %g on' % (name, stable[0], stable[-1], min(stopped))
		)


for damping, alpha in ('none', 0), ('local', 0.3), ('local', 0.8), ('adaptive', 0):

	@case(
		'safety, damping %s' % damping + (' %g' % alpha if alpha else ''),
		'0.5 to 1.1 times the limit of power iteration: stable or refused, never silent'
	)
	def safety(look, damping=damping, alpha=alpha):
		safetyCase(look, damping, alpha or 0.3)


@case('joints stiffened x1e3 in the middle', 'the stepper follows; with O.dt kept the run is refused')
def stiffened(look):
	for stepper, expected in (dict(dynamic, safety=0.9), 'silent'), (None, 'refused'):
		look.forget()
		begin()
		model = panel()
		model.insert()
		kick(model, 1e-7)
		joint = joints(young / 0.25)
		O.engines = engines(joint, dict(dynamic, safety=0.9), damping='none')
		look.run(300)
		O.engines = engines(joint, stepper, damping='none')
		look.run(300)
		before = O.dt
		look.forget() # stiffening gives energy
		for i in O.interactions:
			i.phys.kn *= 1e3
		found, message = outcome(lambda: look.run(1000))
		look.true(found == expected, 'O.dt kept: ' + found if stepper is None else 'O.dt from %.2g to %.2g s' % (before, O.dt))


# ---- shapes


@case('sliver of 1e-6', 'springs in series; undamped at safety 0.95 for 20,000 steps the energy stays')
def sliver(look):
	seriesAndKick(look, [0.2, 0.2e-6, 0.2], [young] * 3, young / 0.2)


@case('edge of 1e-6', 'areas of joints add up; stress of springs in series; undamped the energy stays', slow=True)
def shortEdge(look):
	step = 0.2e-6

	def scene(velocity):
		begin()
		model = BlockModel(thickness=1)
		model.addRegion(rectangle(0, 0, 0.1, 0.2), 'rock', zoneSize=0.1)
		model.addRegion(rectangle(0.1, 0, 0.2, 0.2 + step), 'rock', zoneSize=0.1)
		model.addRegion([(0, 0.2), (0.1, 0.2), (0.1, 0.2 + step), (0.2, 0.2 + step), (0.2, 0.4), (0, 0.4)], 'rock', zoneSize=0.1)
		model.bond()
		model.drive('low', level(model, 0), 'xy')
		model.drive('top', level(model, 0.4), 'y', velocity=velocity, rampTime=velocity and 1)
		model.drive('aside', level(model, 0.4), 'x')
		model.insert()
		return model

	kn = young / 0.2
	model = scene(4e-5 / 1e3)
	look.equal('joint area', 2 * model.segmentArea.sum(), 0.2 + 0.2 + step, 1e-9)
	O.dt, O.engines = 1, engines(joints(kn), alpha=0.5)
	look.run(1000)
	model.setTarget('top', 0)
	unbalanced = settle(look, model, 1e-8)
	# the two halves differ by 1e-6, so that the stress is uniform up to that
	stress = model.groupTravelled('top') / (0.4 / young + 1 / kn)
	look.equal('stress by springs in series', model.groupForce('top') / 0.2, stress, 1e-5 + 10 * unbalanced)
	look.forget()
	model = scene(0)
	kick(model, 1e-4 * step, held=(level(model, 0), level(model, 0.4)))
	O.engines = engines(joints(kn), dict(quasiStatic=False, safety=0.95), damping='none')
	look.run(20000)


# ---- laws at their limits


def pull(look, steps=4000, strain=2e-4, **joint):
	"""Two blocks and a joint, torn apart; greatest stress, the last one, and the stress of one step."""
	begin()
	model = column([0.2, 0.2])
	model.drive('low', level(model, 0), 'xy')
	model.drive('top', level(model, 0.4), 'y', velocity=strain * 0.4 / steps, rampTime=steps / 10)
	model.insert()
	O.dt, O.engines = 1, engines(joints(young / 0.2, **joint), alpha=0.5)
	stresses = []
	for _ in range(steps // 10):
		look.run(10, samples=1)
		stresses.append(model.groupForce('top') / 0.2)
	return model, np.array(stresses)


elasticStress = 2e-4 * 0.4 / (0.4 / young + 0.2 / young) # of `pull` if nothing breaks, but for the ramp


@case('strength zero', 'no tension at all')
def strengthZero(look):
	model, stress = pull(look, cohesion=0, tension=0)
	# Both halves are free: what remains is the inertia of a block that is pulled up. Its mass, scaled: K dt^2/(4 s^2), K about 10 E b t/h.
	look.below('stress by that of intact joints', abs(stress[len(stress) // 2:]).max() / elasticStress, 1e-3)
	look.true((model.pointStatus == 1).all(), 'all points broken in tension')


@case('strength normal', 'peak is the tensile strength')
def strengthNormal(look):
	model, stress = pull(look, cohesion=1e6, tension=1e6, frictionAngle=0.6)
	# the stress is read every 10 of 4000 steps: 10/4000 of the elastic stress; waves of the ramp's start as much again
	look.equal('peak [Pa]', stress.max(), 1e6, 2 * 10 / 4000 * elasticStress / 1e6)
	look.below('after the peak, by the peak', abs(stress[-50:]).max() / 1e6, 0.01)


@case('strength x1e9', 'elastic to the end')
def strengthHuge(look):
	model, stress = pull(look, cohesion=1e15, tension=1e15, frictionAngle=0.6)
	look.true((model.pointStatus == 0).all(), 'all points intact')
	look.equal('stress [Pa]', stress[-1], model.groupTravelled('top') / (0.6 / young), 1e-3)


@case('tension above cohesion/tan(phi)', 'fails at the apex of the cone, in shear')
def apex(look):
	model, stress = pull(look, cohesion=1e6, tension=1e7, frictionAngle=math.atan(0.8))
	look.equal('peak [Pa]', stress.max(), 1e6 / 0.8, 2 * 10 / 4000 * elasticStress / 1.25e6)
	look.true((model.pointStatus == 2).all(), 'all points broken in shear')


def shear(look, slip, pressure=1e6, contact=False, kn=young / 0.2, **joint):
	"""A block pressed upon another and pushed sideways; both move as rigid platens but for the joint. Uplift [m] and shear stress [Pa] at the end."""
	begin()
	model = column([0.1, 0.1])
	model.drive('low', range(model.firstNode[1]), 'xy')
	top = range(model.firstNode[1], model.firstNode[2])
	model.push('weight', top, 'y', force=-pressure * 0.2, rampTime=500)
	model.drive('side', top, 'x', velocity=slip / 3000, startTime=2000, rampTime=300)
	model.insert()
	O.dt, O.engines = 1, engines(joints(kn, **joint), contact=contact, alpha=0.5)
	look.run(1500)
	first = model.groupTravelled('weight')
	look.run(500 + 3000 + 150)
	model.setTarget('side', 0)
	look.run(1000)
	return model.groupTravelled('weight') - first, model.groupForce('side') / 0.2


@case('friction zero', 'slides without shear stress, point joint and free contact')
def frictionZero(look):
	for contact in False, True:
		look.forget()
		_, tau = shear(look, 2e-4, contact=contact, bonded=False)
		# The contact's energy kn d^2 L/2 falls as its length L does: a force kn d^2/2 in the direction of sliding, d/(2 L) of the normal one.
		overlap = 1e6 / (young / 0.2)
		look.below('tau/sigma' + (' (free)' if contact else ' (joint)'), abs(tau) / 1e6, overlap / 0.2 if contact else 1e-12)


@case('friction 89 degrees', 'sticks, then slides at sigma tan(89 degrees), point joint and free contact')
def frictionSteep(look):
	tangent, ks = math.tan(math.radians(89)), young / 0.4
	for contact in False, True:
		where = ' (free)' if contact else ' (joint)'
		for slip, tau in (1e-4, 1e-4 * ks), (2e-3, 1e6 * tangent): # 5 MPa sticks; 57 MPa needs 1.1e-3 m
			look.forget()
			uplift, measured = shear(look, slip, contact=contact, bonded=False, frictionAngle=math.radians(89))
			# slip makes the overlap of 0.2 m shorter, and free contact turns by its moments
			look.equal('tau [Pa]' + where, measured, tau, 1e-3 + 2 * slip / 0.2)


@case('dilation at its limit', 'uplift is tan(psi) x the limit slip, no more, and none is lost on the way back')
def dilationLimit(look):
	psi, limit, ks = math.radians(10), 1e-4, young / 0.4
	begin()
	joint = dict(cohesion=0, tension=0, frictionAngle=0.6, dilationAngle=psi, dilationLimitSlip=limit)
	for slip in 0.5e-4, 5e-4:
		look.forget()
		uplift, tau = shear(look, slip, **joint)
		plastic = min(slip - abs(tau) / ks, limit)
		look.equal('uplift [m]', uplift, math.tan(psi) * plastic, 1e-3)


# ---- overlaps


def press(look, contact, overlaps, kn=young / 2):
	"""Loads a block upon another until they overlap by so much [m], one overlap after the other; what was said meanwhile, and the outcomes."""
	begin()
	model = column([0.1, 0.1], width=0.1, zoneSize=0.05)
	lower, upper = range(model.firstNode[1]), range(model.firstNode[1], model.firstNode[2])
	model.drive('low', lower, 'xy')
	model.drive('sides', upper, 'x')
	model.push('load', upper, 'y', force=0)
	model.insert()
	O.dt, O.engines = 1, engines(joints(kn, bonded=not contact), contact=contact, alpha=0.5)
	texts, ends, before = [], [], 0

	def load(overlap):
		for share in np.linspace(0, 1, 21)[1:]: # little by little: a sudden load would press twice as deep
			model.setTarget('load', -kn * 0.1 * (before + share * (overlap - before)))
			for _ in range(100):
				O.step()
			if overlap != overlaps[-1]: look.balance() # the last one is not to be computed

	for overlap in overlaps:
		with messages() as text:
			ends.append(outcome(lambda: load(overlap)))
		texts += text
		before = overlap
	return texts, ends


# Squares of 0.1 m, zones of 0.05 m: 10 % is 0.005 m. A free contact of such squares pushes with at most kn x 0.008 m; a greater load
# drives one through the other.
for contact, overlaps, expected, stopped in ((
	False, [0.002, 0.003, 0.0045, 0.0055], 'quiet at 4 % of a zone, one warning with blocks and numbers up to 10 %, refused beyond', 'joints overlap by'
), (
	True, [0.002, 0.003, 0.007,
		0.011], 'quiet at 4 % of a zone, one warning with blocks and numbers, refused where contact would be lost', 'has gone into block'
)):

	@case('precompression of ' + ('free contacts' if contact else 'joints'), expected)
	def precompression(look, contact=contact, overlaps=overlaps, stopped=stopped):
		(quiet, warned, again, _), ends = press(look, contact, overlaps)
		look.true('overlap' not in quiet and ends[0][0] == 'silent', 'quiet at 4 %')
		look.true(
			warned.count('overlap') == 1 and 'blocks 0 and 1' in warned and ends[1][0] == 'silent',
			'warned: "%s"' % warned.strip().split(': ', 3)[-1]
		)
		look.true('overlap' not in again and ends[2][0] == 'silent', 'only once')
		look.true(ends[3][0] == 'detected' and stopped in ends[3][1], 'stopped: "%s"' % ends[3][1].split(';')[0])


@case('contact too soft', 'a block that would go through another unseen is refused')
def tooSoft(look):
	model = collision(kn=1e9, velocity=100)
	found, message = outcome(lambda: look.run(4000, samples=400))
	look.true(found == 'detected' and 'has gone into block' in message, 'stopped: "%s"' % message.split(';')[0])


# ---- motion


def collision(kn, velocity, offset=0, gap=1e-4, poisson=0.2):
	"""Two squares of 0.1 m, the left one flying at the right one; true masses, no damping."""
	begin(rock=dict(poisson=poisson))
	model = BlockModel(thickness=1)
	model.addRegion(rectangle(0, 0, 0.1, 0.1), 'rock', zoneSize=0.025)
	model.addRegion(rectangle(0.1 + gap, offset, 0.2 + gap, 0.1 + offset), 'rock', zoneSize=0.025)
	model.bond()
	model.insert()
	O.engines = engines(joints(kn, bonded=False, frictionAngle=0.5), dict(quasiStatic=False, safety=0.7), contact=True, damping='none')
	model.velocity[:model.firstNode[1], 0] = velocity
	return model


@case('impact at 100 m/s', 'momentum stays to rounding, they part again, no part of either goes through the other')
def impact(look):
	for what, offset in ('face', 0), ('corner', 0.08):
		look.forget()
		model = collision(10 * young / 0.1, 100, offset)
		momentum = lambda: (model.mass[:, None] * model.velocity).sum(axis=0)
		spin = lambda: (model.mass * (model.position[:, 0] * model.velocity[:, 1] - model.position[:, 1] * model.velocity[:, 0])).sum()
		before, turning = momentum(), spin()
		look.run(4000)
		left, right = slice(model.firstNode[0], model.firstNode[1]), slice(model.firstNode[1], model.firstNode[2])
		mean = lambda block: (model.mass[block] * model.velocity[block, 0]).sum() / model.mass[block].sum()
		# 4000 steps, each with a few roundings of forces that sum to zero
		look.below('momentum lost (%s)' % what, abs(momentum() - before).max() / before[0], 4000 * 10 * eps)
		look.below('angular momentum lost', abs(spin() - turning) / (before[0] * 0.1), 4000 * 10 * eps)
		look.true(mean(right) > mean(left), 'part with %.1f m/s' % (mean(right) - mean(left)))


@case('spinning blocks', '1000 turns: angular momentum to rounding; when stopped no stress is left', slow=True)
def spinning(look):
	begin(rock=dict(poisson=0.2))
	model = column([0.1, 0.1], width=0.2, zoneSize=0.1)
	model.insert()
	O.engines = engines(joints(10 * young / 0.1), dict(quasiStatic=False, safety=0.7), damping='none')
	centre = np.array([0.1, 0.1])
	speed = 100.0 # at the rim; c is 3300 m/s, strains are (v/c)^2 = 1e-3
	rate = speed / 0.14
	away = model.position - centre
	model.velocity[:] = rate * np.stack([-away[:, 1], away[:, 0]], axis=1)
	spin = lambda: (model.mass * (model.position[:, 0] * model.velocity[:, 1] - model.position[:, 1] * model.velocity[:, 0])).sum()
	O.step()
	before, steps = spin(), int(1000 * 2 * math.pi / rate / O.dt)
	look.run(steps, samples=100)
	look.below('angular momentum lost', abs(spin() / before - 1), steps * eps)
	elastic = energy('Zones') + energy('Joints')
	look.balance()
	look.forget()
	model.velocity[:] = 0
	O.engines[-1].damping, O.engines[-1].alpha = 'local', 0.5
	for _ in range(20000):
		O.step()
	# what is left is rounding: strains of eps x some nodes x turned components against 1e-3, their square; 1e6 steps of it
	look.below('elastic energy left when stopped, by that of spinning', (energy('Zones') + energy('Joints')) / elastic, 1e-12)
	look.sentences.append('%d steps' % steps)


@case('1e6 steps at rest', 'nothing moves but by rounding; a dry block on a slope of half its friction does not creep', slow=True)
def atRest(look):
	for what in 'bonded', 'dry':
		look.forget()
		begin()
		model = column([0.1, 0.1], width=0.1, zoneSize=0.1)
		model.drive('low', level(model, 0) if what == 'bonded' else range(model.firstNode[1]), 'xy')
		model.gravity((0.25 * g, -g))
		model.insert()
		O.dt, O.engines = 1e-3, engines(joints(young / 0.1, frictionAngle=math.atan(0.5), bonded=what == 'bonded'), contact=what == 'dry', alpha=0.3)
		look.run(20000)
		before = np.array(model.position)
		O.run(1000000, True)
		look.balance()
		look.steps += 1000000
		# at worst one rounding of a coordinate a step, all in the same direction
		look.below('moved (%s) [m]' % what, abs(model.position - before).max(), 1e6 * eps * 0.2)
		look.below('kinetic by elastic energy', energy('Kinetic') / (energy('Zones') + energy('Joints')), 1e-12)


@case('crack opened and closed 100 times', 'as stiff at every closing as the springs in series; dissipation never falls', slow=True)
def reclosing(look):
	for contact in False, True:
		look.forget()
		begin()
		model = column([0.1, 0.1], width=0.1, zoneSize=0.1)
		model.drive('low', level(model, 0), 'xy')
		model.drive('top', level(model, 0.2), 'y')
		model.drive('aside', level(model, 0.2), 'x')
		model.insert()
		kn, stroke, steps = young / 0.1, 2e-5, 1000
		O.dt, O.engines = 1, engines(joints(kn, cohesion=1e6, tension=1e6, frictionAngle=0.6), contact=contact, alpha=0.5)
		closed, opened, lost = [], [], []

		def move(velocity):
			model.setTarget('top', velocity)
			look.run(steps, samples=2)
			model.setTarget('top', 0)
			look.run(400, samples=1) # waves die out
			return model.groupForce('top') / 0.1

		for cycle in range(100):
			opened.append(move(stroke / steps))
			move(-stroke / steps)
			closed.append(move(-stroke / steps))
			move(stroke / steps)
			lost.append(energy('Damping') + energy('Friction') + energy('Fracture'))
		expected = -stroke / (0.2 / young + 1 / kn)
		where = 'free' if contact else 'joint'
		look.true((model.pointStatus != 0).all(), '%s: broken' % where)
		# it is linear but for depths by lengths (1e-5/0.1, free) and rotations; waves are down to 0.5^(400/20)
		look.below('closing stress off by', abs(np.array(closed) / expected - 1).max(), 1e-3)
		look.below('scatter of closings', np.ptp(closed[1:]) / abs(expected), 1e-5)
		look.below('stress when open', abs(np.array(opened)).max() / abs(expected), 1e-5)
		look.true((np.diff(lost) >= -1e-9 * max(lost)).all(), 'dissipation never falls, energy error %.0e' % look.runError)


# ---- sizes


def couplet(look, scale):
	"""Peak stress and broken points of a small couplet in tension, all lengths times `scale`."""
	look.forget()
	begin(unit=dict(young=16.7e9, poisson=0.2, density=1900), mortar=dict(young=3e9, poisson=0.2, density=1250))
	box = lambda *corners: rectangle(*(scale * c for c in corners))
	model = BlockModel(thickness=0.05 * scale)
	model.addVoronoi(box(0, 0.01, 0.04, 0.02), 'mortar', size=6e-3 * scale, seed=3)
	model.addRegion(box(0, 0, 0.04, 0.01), 'unit', zoneSize=5e-3 * scale)
	model.addRegion(box(0, 0.02, 0.04, 0.03), 'unit', zoneSize=5e-3 * scale)
	model.bond()
	model.drive('low', level(model, 0), 'xy')
	model.drive('top', level(model, 0.03 * scale), 'y', velocity=8e-6 * scale, rampTime=0.075)
	model.insert()
	O.dt = 1.5 / 3000
	O.engines = engines(joints(400e9 / scale, labels=('unit', 'mortar'), cohesion=0.6e6, tension=0.6e6, frictionAngle=0.66, dilationAngle=0.07))
	stress = []
	for _ in range(300):
		look.run(10, samples=1)
		stress.append(model.groupForce('top') / (0.04 * 0.05 * scale**2))
	return max(stress), np.count_nonzero(model.pointStatus), np.array(stress)


@case('micrometre and kilometre', 'stresses and cracks of a couplet of 40 mm, to the last bit')
def sizes(look):
	peak, broken, curve = couplet(look, 1)
	look.sentences.append('40 mm: peak %.6g Pa, %d points broken' % (peak, broken))
	for name, scale in ('1.2 um', 2.0**-15), ('1.3 km', 2.0**15): # powers of two are rounded alike
		other, cracks, stress = couplet(look, scale)
		look.true((stress == curve).all() and cracks == broken, '%s: the same' % name)


@case('single block', 'falls as bodies fall; carries its weight')
def single(look):
	begin(rock=dict(poisson=0.2))
	model = column([0.2], zoneSize=0.1)
	model.gravity((0, -g))
	model.insert()
	O.engines = engines([], dynamic, damping='none')
	look.run(1000)
	# v = 0 half a step before the start: after n steps x = g dt^2 n (n + 1)/2; a coordinate of 0.2 m is rounded 1000 times
	fallen = (model.reference - model.position)[:, 1]
	look.equal('fallen [m]', fallen.mean(), g * O.dt**2 * 1000 * 1001 / 2, 1000 * eps * 0.2 / fallen.mean())
	look.forget()
	begin(rock=dict(poisson=0.2))
	model = column([0.2], zoneSize=0.1)
	model.drive('low', level(model, 0), 'xy')
	model.gravity((0, -g))
	model.insert()
	O.dt, O.engines = 1e-3, engines([], alpha=0.5)
	look.run(5000)
	look.equal('reaction by weight', model.groupForce('low') / (model.mass.sum() * g), 1, 1e-8)


@case('10,000 blocks', 'a block of 1 m pressed together, with the engines of general contact; energy balances', slow=True)
def tenThousand(look):
	begin(rock=dict(poisson=0.2))
	start = time.process_time()
	model = BlockModel(thickness=1)
	model.addVoronoi(rectangle(0, 0, 1, 1), 'rock', size=0.01, seed=1, lloyd=1)
	model.bond()
	model.drive('low', level(model, 0), 'y')
	model.drive('top', level(model, 1), 'y', velocity=-1e-6, rampTime=20)
	model.insert()
	built = time.process_time() - start
	O.dt, O.engines = 1, engines(joints(young / 0.01, cohesion=1e6, tension=1e5, frictionAngle=0.6), contact=True)
	start = time.process_time()
	look.run(300, samples=10)
	spent = time.process_time() - start
	look.true(
		abs(model.blockCount - 1e4) < 200,
		'%d blocks, %d zones, built in %.1f s, %.1f ms a step' % (model.blockCount, model.zoneCount, built, spent / 300 * 1e3)
	)
	look.true(np.isfinite(model.position).all(), '%d points broken' % np.count_nonzero(model.pointStatus))


# ---- the watch


def stepCost(build, watchPeriod, steps):
	"""CPU time of a step [s]: the least of three, alternately measured by the caller."""
	build()
	O.engines[-1].watchPeriod = watchPeriod
	O.trackEnergy = False
	O.run(20, True)
	start = time.process_time()
	O.run(steps, True)
	return (time.process_time() - start) / steps


@case('cost of the watch', 'on by default; a look every 100 steps costs less than 1 % of them', slow=True)
def watchCost(look):
	def bonded():
		begin()
		model = panel(size=0.05)
		model.insert()
		O.dt, O.engines = 1, engines(joints(young / 0.05))

	def loose():
		begin()
		model = panel(size=0.05)
		model.drive('low', level(model, 0), 'xy')
		model.gravity((0, -g))
		model.insert()
		O.dt, O.engines = 1e-3, engines(joints(young / 0.05, bonded=False, frictionAngle=0.6), contact=True)

	begin()
	look.true(BlockIntegrator().watchPeriod == 100, 'default watchPeriod %d' % BlockIntegrator().watchPeriod)
	for name, build in ('bonded', bonded), ('free contacts', loose):
		times = np.array([(stepCost(build, 0, 2000), stepCost(build, 1, 2000)) for _ in range(3)]).min(axis=0)
		look.below(
			'%s: a look takes %.2f of a step of %.0f us; share' % (name, times[1] / times[0] - 1, 1e6 * times[0]), (times[1] / times[0] - 1) / 100,
			0.01
		)


# ---- running


def shown(entry):
	balance = '' if entry['energy_error'] is None else '%.1e' % entry['energy_error']
	return '| %s | %s | %s | %s | %s |' % (entry['case'], entry['expected'], '; '.join(entry['seen']), balance, 'pass' if entry['passed'] else '**FAIL**')


names = [name for name, *_ in cases]
if p.case == 'list':
	print('\n'.join(names))
	sys.exit(0)
chosen = [c for c in cases if p.case == 'all' or p.case == 'quick' and not c[3] or p.case == c[0]]
if not chosen:
	print('stability.case must be all, quick or one of: %s; got %s' % (', '.join(names), p.case), file=sys.stderr)
	sys.exit(2)

entries = []
for name, expected, function, _ in chosen:
	look, start = Look(), time.process_time()
	try:
		function(look)
	except Exception as error: # a case that cannot even be run has failed, and the others go on
		look.true(False, '%s: %s' % (type(error).__name__, error))
	look.forget()
	if look.energyError is not None and not look.energyError <= look.energyLimit: look.true(False, 'energy does not balance')
	entries.append({
		'case': name, 'expected': expected, 'seen': look.sentences, 'energy_error': look.energyError, 'steps': look.steps,
		'cpu_s': time.process_time() - start, 'passed': look.passed
	})
	print(
		'%-4s %-36s %5.1f s  energy %s' %
		('ok' if look.passed else 'FAIL', name, entries[-1]['cpu_s'], 'none' if look.energyError is None else '%.1e' % look.energyError), flush=True
	)
	if not look.passed: print('     ' + '\n     '.join(look.sentences), flush=True)

failed = [entry['case'] for entry in entries if not entry['passed']]
lines = ['| case | expected | seen | energy error | |', '|---|---|---|---|---|'] + [shown(entry) for entry in entries]
print('\n' + '\n'.join(lines))
p.folder.mkdir(parents=True, exist_ok=True)
(p.folder / 'table.md').write_text('\n'.join(lines) + '\n')
(p.folder / 'result.json').write_text(json.dumps({'scenario': 'stability', 'parameters': p.asDict(), 'cases': entries, 'failed': failed}, indent='\t') + '\n')
print('\n%d of %d cases passed%s' % (len(entries) - len(failed), len(entries), ': failed ' + ', '.join(failed) if failed else ''))
sys.exit(1 if failed else 0)
