# yade-blocks, GPL-2.0-or-later
"""What stability cases are made of: scenes, and a `Look` that says what it sees. Each case is one test with a name and an expectation, see `case`."""
import math
import os
import sys
import tempfile
from contextlib import contextmanager

import numpy as np
import pytest

import yadeblocks # noqa: F401 (loads the plugin)
from yade import *
from yadeblocks.engines import engineList
from yadeblocks.specimen import nodesWhere, rectangle

eps = np.finfo(float).eps
young, density, g = 20e9, 2000, 9.81 # of most blocks: [Pa], [kg/m3]; [m/s2]


def case(name, expected, slow=False):
	"""Marks a test as a stability case; {parameter} in the name and the expectation stands for what parametrize gives. slow: longer than a second."""
	return pytest.mark.case(name, expected, slow)


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
	"""The list of a time step; without a stepper (None) masses are true and O.dt is the case's. Nothing is written where cases are run."""
	return engineList(joints, contact, stepper, **{'rescueFile': '', **integrator})


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
