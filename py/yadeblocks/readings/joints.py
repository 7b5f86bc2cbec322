# yade-blocks, GPL-2.0-or-later
"""Contact points of joints: where they are, and how far they have opened and slipped."""
import numpy as np

from ..plane import cross


def contactLines(model, position):
	"""The part of a joint that belongs to each contact point, from the point to the middle of its segment: (2S, 2, 2) [m].

	It lies midway between the two blocks. position: (N, 2), where the nodes shall be [m]."""
	a1, b1, a2, b2 = np.moveaxis(np.asarray(position)[model.segmentNodes], 1, 0)[:, :, None] # (S, 1, 2) each
	s1, s2 = np.asarray(model.segmentParameters).reshape(-1, 2, 2, 1).swapaxes(0, 1) # of both points, (S, 2, 1) each
	points = ((1 - s1) * a1 + s1 * b1 + (1 - s2) * a2 + s2 * b2) / 2
	middles = np.broadcast_to(points.mean(axis=1, keepdims=True), points.shape)
	return np.stack([points, middles], axis=2).reshape(-1, 2, 2)


def jointMotion(model):
	"""Opening and slip of every contact point, from where the blocks are now [m]: also of joints that have become free contacts, whose columns rest."""
	ends = np.asarray(model.position)[np.asarray(model.segmentNodes)]
	t = np.asarray(model.segmentParameters)
	host = lambda side: np.stack([(1 - t[:, i, None]) * ends[:, 2 * side] + t[:, i, None] * ends[:, 2 * side + 1]
					for i in (2 * side, 2 * side + 1)], axis=1)
	apart, normal = (host(1) - host(0)).reshape(-1, 2), np.repeat(model.normal, 2, axis=0)
	return (apart * normal).sum(axis=1), cross(normal, apart)
