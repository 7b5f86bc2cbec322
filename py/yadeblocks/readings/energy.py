# yade-blocks, GPL-2.0-or-later
"""Elastic energy of a model, from its stresses."""
import numpy as np

from .materials import ofMaterials, ofZones


def strainEnergy(model, known=None):
	"""Elastic energy of zones and joints that are no free contacts, from their stresses [J]; YADE must run. Costs no O.trackEnergy.

	known: a dictionary that keeps moduli and stiffnesses from one call to the next of the same model."""
	known = {} if known is None else known
	if "E" not in known: known.update(_stiffnesses(model))
	sxx, syy, sxy = np.asarray(model.zoneStress()).T
	young, nu = known["E"], known["nu"]
	if model.planeStress: zones = (sxx**2 + syy**2 - 2 * nu * sxx * syy + 2 * (1 + nu) * sxy**2) / (2 * young)
	else: zones = (1 + nu) * ((1 - nu) * (sxx**2 + syy**2) - 2 * nu * sxx * syy + 2 * sxy**2) / (2 * young)
	joints = np.repeat(model.segmentArea, 2) * (np.asarray(model.pointSigma)**2 / known["kn"] + np.asarray(model.pointTau)**2 / known["ks"]) / 2
	return float(zones @ model.zoneVolume) + float(joints.sum())


def _stiffnesses(model):
	of = lambda name: ofZones(model, ofMaterials(model, name))
	properties = model.jointProperties
	return dict(E=of("young"), nu=of("poisson"), kn=np.repeat(properties["kn"], 2), ks=np.repeat(properties["ks"], 2))
