# yade-blocks, GPL-2.0-or-later
"""Blocks and joints for ParaView, and the geometry of a model as pictures and exports need it.

	export = BlocksExport(p.folder)
	export.write(model, O.time)          # as often as wanted; blocks.pvd and joints.pvd can be opened after every call
"""
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from . import files


def pairName(model, first, second):
	"""The joint type between two blocks, from the labels of their materials: alphabetical, mortar last ("unit-mortar")."""
	labels = (model.materialLabels[model.blockMaterial[block]] for block in (first, second))
	return "-".join(sorted(labels, key=lambda label: (label == "mortar", label)))


def blockOutlines(model):
	"""The boundary of every block: a list of rings per block, each an array of node indices, material on the left (holes clockwise)."""
	outlines = []
	for first, last in zip(model.firstEdge[:-1], model.firstEdge[1:]):
		following = dict(np.asarray(model.edgeNodes[first:last]).tolist())
		rings = []
		while following:
			node, end = following.popitem()
			ring = [node]
			while end != ring[0]:
				ring.append(end)
				end = following.pop(end)
			rings.append(np.array(ring))
		outlines.append(rings)
	return outlines


def contactLines(model, position):
	"""The part of a joint that belongs to each contact point, from the point to the middle of its segment: (2S, 2, 2) [m].

	It lies midway between the two blocks. position: (N, 2), where the nodes shall be [m]."""
	a1, b1, a2, b2 = np.moveaxis(np.asarray(position)[model.segmentNodes], 1, 0)[:, :, None] # (S, 1, 2) each
	s1, s2 = np.asarray(model.segmentParameters).reshape(-1, 2, 2, 1).swapaxes(0, 1) # of both points, (S, 2, 1) each
	points = ((1 - s1) * a1 + s1 * b1 + (1 - s2) * a2 + s2 * b2) / 2
	middles = np.broadcast_to(points.mean(axis=1, keepdims=True), points.shape)
	return np.stack([points, middles], axis=2).reshape(-1, 2, 2)


def principalStresses(stress):
	"""(Z, 3) of sxx, syy, sxy -> (Z, 2): the larger and the smaller principal stress in the plane, in the unit of `stress`."""
	sxx, syy, sxy = np.asarray(stress).T
	mean, radius = (sxx + syy) / 2, np.hypot((sxx - syy) / 2, sxy)
	return np.column_stack([mean + radius, mean - radius])


class State:
	"""What BlocksExport writes of a model at a time [s]: copied, so that it can be written later, whatever has become of the model.

	untouched: as the model was before anything moved or broke."""
	def __init__(self, model, time, untouched=False):
		self.time = float(time)
		self.grids = {"blocks": _zones(model, untouched), "joints": _joints(model, untouched)}


class BlocksExport:
	"""Two collections for ParaView in `folder`, begun anew: blocks.pvd (zones; rigid blocks as triangles between their corners) and joints.pvd
	(a line for every contact point, its half of the segment), each with a compressed .vtu file per step.

	Zones: block, material (number in O.materials' order), stresses sxx, syy, sxy and principal stresses s1, s2 [Pa]; grid points:
	displacement [m], velocity [m/s]; joints: firstBlock, secondBlock, opening [m], slip [m], sigma [Pa], tau [Pa], status (0 intact,
	1 broken in tension, 2 in shear, 3 never bonded, 4 softening), damage (0 whole to 1, only residual strength is left)."""
	def __init__(self, folder):
		self.folder = Path(folder)
		self.folder.mkdir(parents=True, exist_ok=True)
		self.times = []
		for name in ("blocks", "joints"):
			for old in (self.folder / f"{name}.pvd", *self.folder.glob(f"{name}_[0-9]*.vtu")):
				old.unlink(missing_ok=True)

	def write(self, model, time):
		"""Adds the model as it is now, at this time [s]."""
		self.add(State(model, time))

	def add(self, state):
		"""Adds a State."""
		for name, grid in state.grids.items():
			with files.replacing(self.folder / f"{name}_{len(self.times):04}.vtu") as part:
				_writeGrid(part, *grid)
		self.times.append(state.time)
		for name in state.grids:
			_writeCollection(self.folder, name, self.times)


def writeStates(folder, *states):
	"""Both collections at once, of these States."""
	export = BlocksExport(folder)
	for state in states:
		export.add(state)


def _zones(model, untouched):
	"""Arguments of _writeGrid."""
	rigid = np.flatnonzero(np.diff(model.firstZone) == 0)
	triangles = [np.reshape(model.zoneNodes, (-1, 3)), *map(model.cornerTriangles, rigid.tolist())]
	blocks = np.repeat([*range(len(model.blockMaterial)), *rigid], [*np.diff(model.firstZone), *map(len, triangles[1:])]).astype(np.int32)
	stress = np.zeros((len(blocks), 3)) # none in rigid blocks
	if not untouched: stress[:len(triangles[0])] = model.zoneStress()
	there = 0.0 if untouched else 1.0
	position = model.reference if untouched else model.position
	displacement, velocity = _spatial(position - model.reference), _spatial(there * model.velocity)
	cells = {"block": blocks, "material": np.asarray(model.blockMaterial, np.int32)[blocks], **dict(zip(("sxx", "syy", "sxy"), stress.T))}
	cells.update(zip(("s1", "s2"), principalStresses(stress).T))
	return np.array(position), "triangle", np.concatenate(triangles), {"displacement": displacement, "velocity": velocity}, cells


def _joints(model, untouched):
	"""Arguments of _writeGrid."""
	lines = contactLines(model, model.reference if untouched else model.position)
	first, second = np.repeat(np.asarray(model.segmentBlocks, np.int32), 2, axis=0).T
	cells = {"firstBlock": first, "secondBlock": second}
	for name in ("opening", "slip", "sigma", "tau", "damage"):
		values = np.array(getattr(model, "point" + name.capitalize()))
		cells[name] = np.zeros_like(values) if untouched else values
	status = np.array(model.pointStatus, np.uint8)
	cells["status"] = np.where(status == 3, status, 0).astype(np.uint8) if untouched else status # never bonded stays so
	return lines.reshape(-1, 2), "line", np.arange(2 * len(lines)).reshape(-1, 2), {}, cells


def _spatial(vectors):
	"""(n, 2) -> (n, 3): VTK lives in space."""
	return np.pad(vectors, ((0, 0), (0, 1)))


def _writeGrid(path, points, kind, cells, pointData, cellData):
	"""A compressed .vtu file of equal cells, (m, corners) point indices."""
	from meshio import Mesh, vtu # not VTK: ParaView's Python and YADE's VTK cannot live in one process
	plain = lambda values: np.array(values, order="C") # meshio takes bytes as they lie
	pointData = {name: plain(values) for name, values in pointData.items()}
	vtu.write(path, Mesh(_spatial(points), [(kind, plain(cells))], pointData, {name: [plain(values)] for name, values in cellData.items()}))


def _writeCollection(folder, name, times):
	"""name.pvd with all steps so far; the file is replaced at once, so that a reader never sees half of it."""
	root = ElementTree.Element("VTKFile", type="Collection", version="0.1")
	collection = ElementTree.SubElement(root, "Collection")
	for step, time in enumerate(times):
		ElementTree.SubElement(collection, "DataSet", timestep=repr(time), part="0", file=f"{name}_{step:04}.vtu")
	files.replace(folder / f"{name}.pvd", ElementTree.tostring(root, encoding="utf-8", xml_declaration=True))
