# yade-blocks, GPL-2.0-or-later
"""Properties of the materials of a model."""
import numpy as np


def ofMaterials(model, name):
	"""A property of the scene's materials, in the order of model.materialLabels: an array."""
	from yade.wrapper import Omega
	known = {material.label: material for material in Omega().materials}
	return np.array([getattr(known[label], name) for label in model.materialLabels])


def ofZones(model, values):
	"""Values of materials, in the order of model.materialLabels, for every zone."""
	return np.repeat(np.asarray(values)[model.blockMaterial], np.diff(model.firstZone))


def poissonOf(model):
	"""Poisson's ratio of every material in model.materialLabels: a Snapshot's own, of a model that of the scene."""
	if hasattr(model, "poisson"): return model.poisson
	return ofMaterials(model, "poisson")
