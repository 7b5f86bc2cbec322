# yade-blocks, GPL-2.0-or-later
"""Blocks and joints for ParaView, and the geometry of a model as pictures and exports need it.

	export = BlocksExport(p.folder)
	export.write(model, O.time)          # as often as wanted; blocks.pvd and joints.pvd can be opened after every call
"""
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from . import files
from ._calls import door
from ._kinds import wrong
from .snapshot import poissonOf


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


class Present:
	"""What of a model has not been removed, as masks: `blocks`, `nodes`, `zones`, `joints` and `points` (contact points; those between two blocks that are
	there). everything: as before any removal."""
	def __init__(self, model, everything=False):
		self.blocks = np.ones(len(model.blockMaterial), bool)
		self.all = everything or not len(model.removedBlocks)
		if not self.all: self.blocks[model.removedBlocks] = False
		self.nodes = np.repeat(self.blocks, np.diff(model.firstNode))
		self.zones = np.repeat(self.blocks, np.diff(model.firstZone))
		self.joints = self.blocks[np.reshape(model.segmentBlocks, (-1, 2))].all(axis=1)
		self.points = np.repeat(self.joints, 2)


@door(model='model')
def areasAndCentroids(model):
	"""Of every block, holes left out, from its boundary (Green) [m2, m]."""
	ends = np.asarray(model.reference)[np.asarray(model.edgeNodes)]
	owner = np.repeat(np.arange(model.blockCount), np.diff(model.firstEdge))
	origin = ends[np.asarray(model.firstEdge)[:-1], 0][owner]
	a, b = ends[:, 0] - origin, ends[:, 1] - origin
	cross = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
	sums = lambda values: np.bincount(owner, values, model.blockCount)
	areas = sums(cross) / 2
	middle = np.column_stack([sums(cross * (a[:, axis] + b[:, axis])) for axis in range(2)]) / (6 * areas[:, None])
	return areas, middle + ends[np.asarray(model.firstEdge)[:-1], 0]


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


def jointMotion(model):
	"""Opening and slip of every contact point, from where the blocks are now [m]: also of joints that have become free contacts, whose columns rest."""
	ends = np.asarray(model.position)[np.asarray(model.segmentNodes)]
	t = np.asarray(model.segmentParameters)
	host = lambda side: np.stack([(1 - t[:, i, None]) * ends[:, 2 * side] + t[:, i, None] * ends[:, 2 * side + 1]
					for i in (2 * side, 2 * side + 1)], axis=1)
	apart, normal = (host(1) - host(0)).reshape(-1, 2), np.repeat(model.normal, 2, axis=0)
	return (apart * normal).sum(axis=1), apart[:, 1] * normal[:, 0] - apart[:, 0] * normal[:, 1]


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
	return np.repeat(np.asarray(poissonOf(model))[model.blockMaterial], np.diff(model.firstZone)) * (stress[:, 0] + stress[:, 1])


def vonMises(stress, szz):
	"""Equivalent stress of von Mises, in the unit of `stress`, (Z, 3) of sxx, syy, sxy."""
	sxx, syy, sxy = np.asarray(stress).T
	return np.sqrt(((sxx - syy)**2 + (syy - szz)**2 + (szz - sxx)**2) / 2 + 3 * sxy**2)


class State:
	"""What BlocksExport writes of a model at a time [s]: copied, so that it can be written later, whatever has become of the model.

	untouched: as the model was before anything moved, broke or was removed."""
	@door(model='model', time='float', untouched='flag')
	def __init__(self, model, time, untouched=False):
		self.time = float(time)
		self.names = list(getattr(model, "jointNames", ()))
		self.grids = {"blocks": _zones(model, untouched), "joints": _joints(model, untouched), "contacts": _contacts(model, untouched)}


class BlocksExport:
	"""Three collections for ParaView in `folder`, begun anew: blocks.pvd (zones; rigid blocks as triangles between their corners), joints.pvd
	(a line for every contact point, its half of the segment) and contacts.pvd (a line for every two edges that touch without a bond), each with a
	compressed .vtu file per step. Blocks that have been removed are not in it. Where joints have names (BlockModel.nameJoints), joints.names.csv says
	which number stands for which.

	Zones: block, material (number in O.materials' order), stresses sxx, syy, sxy, szz, principal stresses s1, s2 in the plane and vonMises [Pa],
	strains exx, eyy, exy; grid points: displacement [m], velocity [m/s];
	joints: firstBlock, secondBlock, name (a number, -1 without), normal (out of the first block), area [m2], opening [m], slip [m], sigma [Pa], tau [Pa],
	status (0 intact, 1 broken in tension, 2 in shear, 3 never bonded, 4 softening), damage (0 whole to 1, only residual strength is left) and the columns
	of a joint law of one's own (BlockModel.lawColumns);
	contacts: firstBlock, secondBlock and force on the first [N]."""
	@door(folder='file')
	def __init__(self, folder):
		self.folder = Path(folder)
		self.folder.mkdir(parents=True, exist_ok=True)
		self.times = []
		for name in ("blocks", "joints", "contacts"):
			for old in (self.folder / f"{name}.pvd", self.folder / f"{name}.names.csv", *self.folder.glob(f"{name}_[0-9]*.vtu")):
				old.unlink(missing_ok=True)

	@door(model='model', time='float')
	def write(self, model, time):
		"""Adds the model as it is now, at this time [s]."""
		self.add(State(model, time))

	def add(self, state):
		"""Adds a State."""
		for name, grid in state.grids.items():
			with files.replacing(self.folder / f"{name}_{len(self.times):04}.vtu") as part:
				_writeGrid(part, *grid)
		if state.names:
			lines = [f'{number},"{name.replace(chr(34), 2 * chr(34))}"' for number, name in enumerate(state.names)]
			files.replace(self.folder / "joints.names.csv", ("number,name\n" + "\n".join(lines) + "\n").encode())
		self.times.append(state.time)
		for name in state.grids:
			_writeCollection(self.folder, name, self.times)


@door(folder='file')
def writeStates(folder, *states):
	"""Both collections at once, of these States."""
	for state in states:
		if not isinstance(state, State): raise TypeError(f"writeStates.states must be States, and one is {state!r}")
	export = BlocksExport(folder)
	for state in states:
		export.add(state)


@door(folder='file', film='film', end='model')
def writeFilm(folder, film, end):
	"""The model untouched, the frames and the peak of a Film, and the Snapshot `end`, each once."""
	states = [snapshot for snapshot in film.states() if snapshot.time < end.time]
	writeStates(folder, State(end, 0, untouched=True), *(State(snapshot, snapshot.time) for snapshot in states if snapshot.time > 0), State(end, end.time))


def _zones(model, untouched):
	"""Arguments of _writeGrid."""
	there = Present(model, everything=untouched)
	rigid = np.flatnonzero(np.diff(model.firstZone) == 0)
	triangles = [np.reshape(model.zoneNodes, (-1, 3)), *map(model.cornerTriangles, rigid.tolist())]
	blocks = np.repeat([*range(len(model.blockMaterial)), *rigid], [*np.diff(model.firstZone), *map(len, triangles[1:])]).astype(np.int32)
	stress = np.zeros((len(blocks), 3)) # none in rigid blocks
	if not untouched: stress[:len(triangles[0])] = model.zoneStress()
	position = model.reference if untouched else model.position
	displacement, velocity = _spatial(position - model.reference), _spatial((0.0 if untouched else 1.0) * model.velocity)
	cells = {"block": blocks, "material": np.asarray(model.blockMaterial, np.int32)[blocks], **dict(zip(("sxx", "syy", "sxy"), stress.T))}
	strain = np.zeros((len(blocks), 3))
	if not untouched: strain[:len(triangles[0])] = zoneStrains(model)
	cells.update(zip(("exx", "eyy", "exy"), strain.T))
	szz = np.zeros(len(blocks))
	szz[:len(model.zoneNodes)] = outOfPlaneStress(model, stress[:len(model.zoneNodes)])
	cells.update(zip(("s1", "s2"), principalStresses(stress).T), szz=szz, vonMises=vonMises(stress, szz))
	triangles, kept = np.concatenate(triangles), there.blocks[blocks]
	number = np.cumsum(there.nodes) - 1 # of the grid points that are left
	cells = {name: values[kept] for name, values in cells.items()}
	pointData = {"displacement": displacement[there.nodes], "velocity": velocity[there.nodes]}
	return np.array(position)[there.nodes], "triangle", number[triangles[kept]], pointData, cells


def _joints(model, untouched):
	"""Arguments of _writeGrid."""
	lines = contactLines(model, model.reference if untouched else model.position)
	first, second = np.repeat(np.asarray(model.segmentBlocks, np.int32), 2, axis=0).T
	cells = {
		"firstBlock": first, "secondBlock": second, "normal": _spatial(np.repeat(model.normal, 2, axis=0)),
		"area": np.repeat(np.asarray(model.segmentArea), 2), "name": np.full(len(first), -1, np.int32)
	}
	if getattr(model, "jointNames", ()): cells["name"] = np.repeat(np.asarray(model.segmentName, np.int32), 2)
	for name in ("opening", "slip", "sigma", "tau", "damage"):
		values = np.array(getattr(model, "point" + name.capitalize()))
		cells[name] = np.zeros_like(values) if untouched else values
	for name, values in getattr(model, "lawColumns", {}).items():
		cells[name] = np.zeros_like(values) if untouched else values
	status = np.array(model.pointStatus, np.uint8)
	cells["status"] = np.where(status == 3, status, 0).astype(np.uint8) if untouched else status # never bonded stays so
	kept = Present(model, everything=untouched).points
	lines, cells = lines[kept], {name: values[kept] for name, values in cells.items()}
	return lines.reshape(-1, 2), "line", np.arange(2 * len(lines)).reshape(-1, 2), {}, cells


def _contacts(model, untouched):
	"""Arguments of _writeGrid."""
	lines, blocks, force = freeContactLines(model)
	if untouched: lines, blocks, force = lines[:0], blocks[:0], force[:0]
	first, second = np.asarray(blocks, np.int32).T
	cells = {"firstBlock": first, "secondBlock": second, "force": _spatial(force)}
	return lines.reshape(-1, 2), "line", np.arange(2 * len(lines)).reshape(-1, 2), {}, cells


def _spatial(vectors):
	"""(n, 2) -> (n, 3): VTK lives in space."""
	return np.pad(vectors, ((0, 0), (0, 1)))


def _writeGrid(path, points, kind, cells, pointData, cellData):
	"""A compressed .vtu file of equal cells, (m, corners) point indices; of no cells one that can be read all the same."""
	from meshio import Mesh, vtu # not VTK: ParaView's Python and YADE's VTK cannot live in one process
	plain = lambda values: np.array(values, order="C") # meshio takes bytes as they lie
	pointData = {name: plain(values) for name, values in pointData.items()}
	if not len(cells): return _writeNothing(path, pointData, {name: plain(values) for name, values in cellData.items()})
	vtu.write(path, Mesh(_spatial(points), [(kind, plain(cells))], pointData, {name: [plain(values)] for name, values in cellData.items()}))


def _writeNothing(path, pointData, cellData):
	"""A .vtu file with the same arrays and no cell, which meshio cannot write."""
	root = ElementTree.Element("VTKFile", type="UnstructuredGrid", version="0.1")
	piece = ElementTree.SubElement(ElementTree.SubElement(root, "UnstructuredGrid"), "Piece", NumberOfPoints="0", NumberOfCells="0")
	kinds = {"f": "Float", "i": "Int", "u": "UInt"}

	def array(parent, name, values):
		components = str(values.shape[1] if values.ndim > 1 else 1)
		kind = kinds[values.dtype.kind] + str(8 * values.dtype.itemsize)
		ElementTree.SubElement(parent, "DataArray", type=kind, Name=name, NumberOfComponents=components, format="ascii")

	array(ElementTree.SubElement(piece, "Points"), "Points", np.zeros((0, 3)))
	connections = ElementTree.SubElement(piece, "Cells")
	for name, kind in (("connectivity", np.int64), ("offsets", np.int64), ("types", np.uint8)):
		array(connections, name, np.zeros(0, kind))
	for tag, arrays in (("PointData", pointData), ("CellData", cellData)):
		parent = ElementTree.SubElement(piece, tag)
		for name, values in arrays.items():
			array(parent, name, values)
	path.write_bytes(ElementTree.tostring(root, encoding="utf-8", xml_declaration=True))


def _writeCollection(folder, name, times):
	"""name.pvd with all steps so far; the file is replaced at once, so that a reader never sees half of it."""
	root = ElementTree.Element("VTKFile", type="Collection", version="0.1")
	collection = ElementTree.SubElement(root, "Collection")
	for step, time in enumerate(times):
		ElementTree.SubElement(collection, "DataSet", timestep=repr(time), part="0", file=f"{name}_{step:04}.vtu")
	files.replace(folder / f"{name}.pvd", ElementTree.tostring(root, encoding="utf-8", xml_declaration=True))
