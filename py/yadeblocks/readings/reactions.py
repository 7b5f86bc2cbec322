# yade-blocks, GPL-2.0-or-later
"""What holds, drives and presses a model."""
import numpy as np

from .blocks import rigidBlocks


def reactionsOf(model):
	"""What holds, drives and presses a model: a list of (name, place [m], force on the blocks [N]) of its groups and of held rigid
	blocks. A Snapshot's own."""
	if not hasattr(model, "groupNodes"): return getattr(model, "reactions", [])
	found = []
	for name in model.groups:
		force = [model.groupForce(name, axis=axis) if axis in model.groupAxes(name) else 0.0 for axis in "xy"]
		found.append((name, np.asarray(model.position)[model.groupNodes(name)].mean(axis=0), np.array(force)))
	return found + _heldBlocks(model)


def _heldBlocks(model):
	rigid = rigidBlocks(model).tolist()
	if not rigid or model.firstBody < 0: return []
	from yade.wrapper import Omega
	O, found = Omega(), []
	for block in rigid:
		body = O.bodies[model.bodyOf(block)]
		if not {"x", "y"} & set(body.state.blockedDOFs): continue
		place = np.asarray(model.position)[model.firstNode[block]:model.firstNode[block + 1]].mean(axis=0)
		found.append((f"block {block}", place, -np.array(O.forces.f(body.id))[:2]))
	return found
