# yade-blocks, GPL-2.0-or-later
"""What has broken in a model, by the kinds of joints."""
import math

import numpy as np

from .._door import door
from ..readings.names import pointNames
from ..readings.status import intact, isBroken, modes, neverBonded
from ..recording import known, runner


class Cracks:
	"""What has broken in a model, and what broke first: `look()` every now and then, the rest whenever it is wanted.

	To be made at the start of a run: areas count as they were bonded. Joints count under their names: those of the model (BlockModel.nameJoints), or
	names: name -> indices of joints; what has no name counts under that of its pair of materials. names={}: pairs of materials alone."""
	@door(model='model', names='mapping')
	def __init__(self, model, names=None):
		self.model = model
		self.pairs = pointNames(model, names)
		self.areas = np.repeat(model.segmentArea, 2)
		self.bonded = sorted(set(self.pairs[np.asarray(model.pointStatus) != neverBonded]))
		a, b = (np.asarray(model.reference)[np.asarray(model.segmentNodes)[:, end]] for end in (0, 1))
		along = np.abs(b - a)
		self.steep = (along[:, 1] > np.tan(np.pi / 3) * along[:, 0]).repeat(2)
		self.first, self.firstPoint = ((math.nan, math.nan), ""), -1
		self.highest, self.atPeak = -math.inf, {}

	@property
	def kept(self):
		"""What a checkpoint keeps."""
		return {
			"areas": self.areas.tolist(), "bonded": self.bonded, "first": [[float(x) for x in self.first[0]], self.first[1]],
			"firstPoint": int(self.firstPoint), "highest": self.highest, "atPeak": self.atPeak
		}

	@kept.setter
	def kept(self, kept):
		self.areas, self.bonded, self.highest, self.atPeak = np.array(kept["areas"]), kept["bonded"], kept["highest"], kept["atPeak"]
		self.first, self.firstPoint = (tuple(kept["first"][0]), kept["first"][1]), kept["firstPoint"]
		known('first crack', self._lookForFirst) # for the engine of the scene that was saved

	def noteStress(self, stress):
		"""Takes the present stress, so that `atPeak` are the `counts` of the moment at which it was highest."""
		if stress > self.highest: self.highest, self.atPeak = float(stress), self.counts()

	def look(self):
		"""The number of broken contact points now. The first time that there are any, `first` becomes (place [m], joint type) of one of
		them, and `firstPoint` its number; before, the place is NaN, the type empty, the number -1."""
		broken = isBroken(self.model.pointStatus)
		count = np.count_nonzero(broken)
		if count and not self.first[1]:
			self._note(np.flatnonzero(broken)[0])
		return count

	def engine(self):
		"""A PyRunner, for O.engines, that looks in every step until something has broken: `first` then is the first, not one of several."""
		return runner('first crack', self._lookForFirst, label='firstCrack')

	def _lookForFirst(self):
		from yade import O
		if self.look(): next(engine for engine in O.engines if engine.label == 'firstCrack').dead = True

	def began(self, points):
		"""Takes the contact points in the order of breaking from who knows it (`crackPoint` of `BlockModel.follow`)."""
		if len(points): self._note(points[0])

	def length(self, section):
		"""What is cracked, by its damage, over a section [m2]."""
		return (self.areas * self.model.pointDamage).sum() / section

	def _note(self, point):
		self.first, self.firstPoint = (tuple(np.asarray(self.model.contactPositions())[point]), self.pairs[point]), point

	def counts(self, which=True):
		"""Broken contact points by joint type and mode: {"unit-mortar": {"tension": 12, "shear": 3}, ...}, in alphabetical order.
		Every joint type that was bonded is there, also with zeros. which: a mask of the contact points that count; all."""
		status = np.where(which, self.model.pointStatus, intact)
		return {pair: {mode: np.count_nonzero((self.pairs == pair) & (status == value)) for mode, value in modes.items()} for pair in self.bonded}

	def share(self, pair):
		"""The share of a joint type in all that is cracked, by area: short edges, which break early and often, do not count more than
		they are. NaN without cracks."""
		cracked = self.areas * isBroken(self.model.pointStatus)
		return cracked[self.pairs == pair].sum() / cracked.sum() if cracked.any() else math.nan

	def steepShare(self, pair):
		"""The share of the cracked area of a joint type that is steeper than 60 degrees (in the reference state): a third if cracks
		run every way alike, near 1 if the blocks split vertically. NaN without cracks."""
		cracked = self.areas * (isBroken(self.model.pointStatus) & (self.pairs == pair))
		return cracked[self.steep].sum() / cracked.sum() if cracked.any() else math.nan
