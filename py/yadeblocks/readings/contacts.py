# yade-blocks, GPL-2.0-or-later
"""Edges that touch without a bond."""
import numpy as np


def freeContactLines(model):
	"""Edges that touch without a bond: where they face each other (n, 2, 2) [m], the blocks (n, 2), the force on the first of them (n, 2) [N]."""
	contacts = model.freeContacts() if hasattr(model, "freeContacts") else {}
	if not contacts: return np.zeros((0, 2, 2)), np.zeros((0, 2), int), np.zeros((0, 2))
	a0, a1, b0, b1 = np.moveaxis(np.asarray(model.position)[contacts["nodes"]], 1, 0)
	along = a1 - a0 - (b1 - b0)
	along /= np.maximum(np.hypot(*along.T), 1e-300)[:, None]
	at = lambda point: (point * along).sum(axis=1)
	low, high = np.maximum(at(a0), at(b1)), np.minimum(at(a1), at(b0))
	middle = (a0 + a1 + b0 + b1) / 4
	off = lambda place: middle + (place - at(middle))[:, None] * along
	return np.stack([off(low), off(np.maximum(low, high))], axis=1), contacts["blocks"], contacts["force"]
