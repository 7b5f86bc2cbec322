# yade-blocks, GPL-2.0-or-later
"""Properties of the materials of a model."""
import numpy as np


def poissonOf(model):
	"""Poisson's ratio of every material in model.materialLabels: a Snapshot's own, of a model that of the scene."""
	if hasattr(model, "poisson"): return model.poisson
	from yade.wrapper import Omega
	known = {material.label: material for material in Omega().materials}
	return np.array([known[label].poisson for label in model.materialLabels])
