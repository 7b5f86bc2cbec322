# yade-blocks, GPL-2.0-or-later
"""A copy of a model."""
import math

import numpy as np

from .._door import door
from ..readings.blocks import rigidBlocks
from ..readings.materials import poissonOf
from ..readings.reactions import reactionsOf

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
		self._corners = like._corners if like else {block: np.array(model.cornerTriangles(block)) for block in rigidBlocks(model).tolist()}

	def zoneStress(self):
		"""sxx, syy, sxy of every zone, tension positive, (zones, 3) [Pa]."""
		return self._stress

	def freeContacts(self):
		"""As BlockModel.freeContacts."""
		return self._contacts

	def cornerTriangles(self, block):
		"""As BlockModel.cornerTriangles, of rigid blocks."""
		return self._corners[block]
