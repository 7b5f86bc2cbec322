# yade-blocks, GPL-2.0-or-later
"""Contact points of joints: where they are, and how far they have opened and slipped."""
import numpy as np

from ..plane import cross


def onEdge(model, position, side):
	"""Where the contact points lie on the edge of their joint's first (side=0) or second block (1): (S, 2, 2) [m], both of a joint together.

	position: (N, 2), where the nodes shall be [m]."""
	of = slice(2 * side, 2 * side + 2)
	ends, t = np.asarray(position)[np.asarray(model.segmentNodes)[:, of]], np.asarray(model.segmentParameters)[:, of, None]
	return (1 - t) * ends[:, :1] + t * ends[:, 1:]


def contactLines(model, position):
	"""The part of a joint that belongs to each contact point, from the point to the middle of its segment: (2S, 2, 2) [m].

	It lies midway between the two blocks. position: (N, 2), where the nodes shall be [m]."""
	points = (onEdge(model, position, 0) + onEdge(model, position, 1)) / 2
	middles = np.broadcast_to(points.mean(axis=1, keepdims=True), points.shape)
	return np.stack([points, middles], axis=2).reshape(-1, 2, 2)


def jointMotion(model):
	"""Opening and slip of every contact point, from where the blocks are now [m]: also of joints that have become free contacts, whose columns rest."""
	apart, normal = (onEdge(model, model.position, 1) - onEdge(model, model.position, 0)).reshape(-1, 2), np.repeat(model.normal, 2, axis=0)
	return (apart * normal).sum(axis=1), cross(normal, apart)
