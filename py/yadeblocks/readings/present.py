# yade-blocks, GPL-2.0-or-later
"""What has not been removed."""
import numpy as np


class Present:
	"""What of a model has not been removed, as masks: `blocks`, `nodes`, `zones`, `joints` and `points` (contact points; those between two blocks that are
	there). everything: as before any removal."""
	def __init__(self, model, everything=False):
		self.blocks = np.ones(len(model.blockMaterial), bool)
		self.all = everything or not len(model.removedBlocks)
		if not self.all: self.blocks[model.removedBlocks] = False
		self.nodes = np.repeat(self.blocks, np.diff(model.firstNode))
		self.zones = np.repeat(self.blocks, np.diff(model.firstZone))
		self.joints = self.blocks[np.reshape(model.segmentBlocks, (-1, 2))].all(axis=1)
		self.points = np.repeat(self.joints, 2)
