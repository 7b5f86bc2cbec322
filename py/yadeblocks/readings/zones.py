# yade-blocks, GPL-2.0-or-later
"""Stresses and strains of zones."""
import numpy as np

from .materials import ofZones, poissonOf


def principalStresses(stress):
	"""(Z, 3) of sxx, syy, sxy -> (Z, 2): the larger and the smaller principal stress in the plane, in the unit of `stress`."""
	sxx, syy, sxy = np.asarray(stress).T
	mean, radius = (sxx + syy) / 2, np.hypot((sxx - syy) / 2, sxy)
	return np.column_stack([mean + radius, mean - radius])


def zoneStrains(model):
	"""exx, eyy, exy of every zone, (Z, 3): U - 1 of the deformation gradient F = R U, in the axes of the reference state."""
	corners = np.asarray(model.zoneNodes)
	if not len(corners): return np.zeros((0, 3))
	edges = lambda place: np.stack([place[corners[:, 1]] - place[corners[:, 0]], place[corners[:, 2]] - place[corners[:, 0]]], axis=2)
	F = edges(np.asarray(model.position)) @ np.linalg.inv(edges(np.asarray(model.reference)))
	C = np.swapaxes(F, 1, 2) @ F
	root = np.sqrt(np.linalg.det(C))
	U = (C + root[:, None, None] * np.eye(2)) / np.sqrt(np.trace(C, axis1=1, axis2=2) + 2 * root)[:, None, None] # of a 2 x 2 matrix
	return np.column_stack([U[:, 0, 0] - 1, U[:, 1, 1] - 1, U[:, 0, 1]])


def outOfPlaneStress(model, stress):
	"""szz of every zone [Pa]: nu (sxx + syy) in plane strain, 0 in plane stress. stress: (Z, 3) of sxx, syy, sxy."""
	if model.planeStress: return np.zeros(len(stress))
	return ofZones(model, poissonOf(model)) * (stress[:, 0] + stress[:, 1])


def vonMises(stress, szz):
	"""Equivalent stress of von Mises, in the unit of `stress`, (Z, 3) of sxx, syy, sxy."""
	sxx, syy, sxy = np.asarray(stress).T
	return np.sqrt(((sxx - syy)**2 + (syy - szz)**2 + (szz - sxx)**2) / 2 + 3 * sxy**2)
