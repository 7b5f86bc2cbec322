# yade-blocks, GPL-2.0-or-later
"""What has become of contact points: values of `model.pointStatus`."""
import numpy as np

intact, brokenInTension, brokenInShear, neverBonded, softening = range(5)

#: How a joint can break.
modes = {"tension": brokenInTension, "shear": brokenInShear}


def isBroken(status):
	"""Mask of the contact points that have broken, of `model.pointStatus`."""
	status = np.asarray(status)
	return (status == brokenInTension) | (status == brokenInShear)
