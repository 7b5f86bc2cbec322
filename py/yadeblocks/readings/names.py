# yade-blocks, GPL-2.0-or-later
"""Names of joints: those that a model has been given (BlockModel.nameJoints), else those of their pairs of materials."""
import numpy as np

from .._kinds import wrong


def pairName(model, first, second):
	"""The joint type between two blocks, from the labels of their materials: alphabetical, mortar last ("unit-mortar")."""
	labels = (model.materialLabels[model.blockMaterial[block]] for block in (first, second))
	return "-".join(sorted(labels, key=lambda label: (label == "mortar", label)))


def pointNames(model, names=None):
	"""For every contact point the name of its joint, an array of str objects; others have that of their pair of materials. names: name -> indices of
	joints; by default those of the model (BlockModel.nameJoints), {}: pairs alone."""
	found = np.array([pairName(model, *blocks) for blocks in model.segmentBlocks], dtype=object)
	for name, joints in (jointNames(model) if names is None else names).items():
		found[np.asarray(joints)] = name
	return found.repeat(2)


def jointNames(model):
	"""Names of joints that a model or Snapshot has (BlockModel.nameJoints): name -> indices of joints."""
	return {name: np.flatnonzero(model.segmentName == number) for number, name in enumerate(getattr(model, "jointNames", ()))}


def pointsOf(model, joints):
	"""Mask of the contact points of some joints: names (one, or a list of them; of a pair of materials, too), indices, or None: all. ValueError for a name
	that no joint has."""
	chosen = np.ones(len(model.pointStatus), bool)
	if joints is None: return chosen
	said = wrong("joints", joints, "joints")
	if said: raise said
	wanted = [joints] if isinstance(joints, str) else list(joints)
	if not all(isinstance(name, str) for name in wanted):
		chosen[:] = False
		most = len(chosen) // 2
		beyond = [joint for joint in wanted if not 0 <= joint < most]
		if beyond: raise ValueError(f"joints: indices must lie in [0, {most}), got {beyond[0]}")
		chosen.reshape(-1, 2)[np.asarray(wanted)] = True
		return chosen
	named = pointNames(model)
	for name in wanted:
		if name not in named: raise ValueError(f"no joint has the name {name!r}; there are {', '.join(sorted(set(named)))}")
	return np.isin(named, wanted)
