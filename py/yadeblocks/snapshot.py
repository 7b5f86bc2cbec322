# yade-blocks, GPL-2.0-or-later
"""A model as it was at a moment, for pictures and files that are made later; and those of a run, its peak among them.

	film = Film(model, frames=10)
	record.after(lambda row: film.look(path() / stroke, row.stress, O.time))
	film.peak, film.states()     # Snapshots: at the highest stress so far; all frames and the peak, in order of time"""
import math

import numpy as np

from ._calls import door

_lasting = (
	"thickness", "planeStress", "reference", "zoneNodes", "firstNode", "firstZone", "firstEdge", "edgeNodes", "blockMaterial", "materialLabels",
	"segmentNodes", "segmentBlocks", "segmentParameters"
)
_passing = "position velocity segmentArea normal pointOpening pointSlip pointSigma pointTau pointStatus pointDamage removedBlocks".split()


class Snapshot:
	"""A copy of what pictures and exports read of a model, with the same names: `position`, `pointSigma`, `zoneStress()`, ... ; `time`: when it
	was taken [s].

	like: a Snapshot of the same model, whose arrays that never change are shared. `poisson`: Poisson's ratio of every material of materialLabels."""
	@door(model='model', time='float', like='model')
	def __init__(self, model, time=math.nan, like=None):
		for name in _lasting:
			value = getattr(like or model, name)
			setattr(self, name, np.array(value) if isinstance(value, np.ndarray) and not like else value)
		for name in _passing:
			setattr(self, name, np.array(getattr(model, name)))
		self.jointNames, self.segmentName = list(getattr(model, "jointNames", ())), np.array(getattr(model, "segmentName", ()))
		self.lawColumns = {name: np.array(column) for name, column in getattr(model, "lawColumns", {}).items()}
		self.time = float(time)
		self._stress = np.array(model.zoneStress())
		self._contacts = {name: np.array(column) for name, column in model.freeContacts().items()} if hasattr(model, "freeContacts") else {}
		self.reactions = reactionsOf(model)
		self.poisson = like.poisson if like else poissonOf(model)
		self._corners = like._corners if like else {
			block: np.array(model.cornerTriangles(block)) for block in np.flatnonzero(np.diff(model.firstZone) == 0).tolist()
		}

	def zoneStress(self):
		"""sxx, syy, sxy of every zone, tension positive, (zones, 3) [Pa]."""
		return self._stress

	def freeContacts(self):
		"""As BlockModel.freeContacts."""
		return self._contacts

	def cornerTriangles(self, block):
		"""As BlockModel.cornerTriangles, of rigid blocks."""
		return self._corners[block]


def poissonOf(model):
	"""Poisson's ratio of every material in model.materialLabels: a Snapshot's own, of a model that of the scene."""
	if hasattr(model, "poisson"): return model.poisson
	from yade.wrapper import Omega
	known = {material.label: material for material in Omega().materials}
	return np.array([known[label].poisson for label in model.materialLabels])


def reactionsOf(model):
	"""What holds, drives and presses a model: a list of (name, place [m], force on the blocks [N]) of its groups and of held rigid
	blocks. A Snapshot's own."""
	if not hasattr(model, "groupNodes"): return getattr(model, "reactions", [])
	found = []
	for name in model.groups:
		force = [model.groupForce(name, axis=axis) if axis in model.groupAxes(name) else 0.0 for axis in "xy"]
		found.append((name, np.asarray(model.position)[model.groupNodes(name)].mean(axis=0), np.array(force)))
	return found + _heldBlocks(model)


def _heldBlocks(model):
	rigid = np.flatnonzero(np.diff(model.firstZone) == 0).tolist()
	if not rigid or model.firstBody < 0: return []
	from yade.wrapper import Omega
	O, found = Omega(), []
	for block in rigid:
		body = O.bodies[model.bodyOf(block)]
		if not {"x", "y"} & set(body.state.blockedDOFs): continue
		place = np.asarray(model.position)[model.firstNode[block]:model.firstNode[block + 1]].mean(axis=0)
		found.append((f"block {block}", place, -np.array(O.forces.f(body.id))[:2]))
	return found


class Film:
	"""Snapshots of a run. frames: how many in equal parts of the way, 0 for the peak alone. They stay in memory until they are written."""
	@door(model='model', frames='whole')
	def __init__(self, model, frames=0):
		if frames < 0: raise ValueError(f"Film.frames must not be negative, got {frames!r}")
		self.model, self.count, self.frames, self.peak, self.highest = model, frames, [], None, -math.inf

	def look(self, share, stress, time):
		"""Takes the present state where it is due. share: of the way, 0 to 1; stress: the highest makes the peak; time [s]."""
		due, higher = self.count and share * self.count >= len(self.frames), stress > self.highest
		if not due and not higher: return
		now = Snapshot(self.model, time, like=self.peak)
		if higher: self.peak, self.highest = now, stress
		if due: self.frames.append(now)

	@door(iterPeriod='whole')
	def engine(self, iterPeriod):
		"""An engine for O.engines that takes a frame every so many steps."""
		from .recording import runner

		def take():
			from yade.wrapper import Omega
			self.frames.append(Snapshot(self.model, Omega().time, like=self.frames[-1] if self.frames else self.peak))

		return runner("film", take, iterPeriod)

	def states(self):
		"""All frames and the peak, each once, in order of time."""
		all_ = {snapshot.time: snapshot for snapshot in [*self.frames, *([self.peak] if self.peak else [])]}
		return [all_[time] for time in sorted(all_)]
