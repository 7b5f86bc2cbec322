# yade-blocks, GPL-2.0-or-later
"""Blocks and joints for ParaView, and the geometry of a model as pictures and exports need it.

	export = BlocksExport(p.folder)
	export.write(model, O.time)          # as often as wanted; blocks.pvd and joints.pvd can be opened after every call
"""
import os
from pathlib import Path
from xml.etree import ElementTree

import numpy as np


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


class BlocksExport:
	"""Two collections for ParaView in `folder`, begun anew: blocks.pvd (zones; blocks without zones as polygons) and joints.pvd
	(a line for every contact point, its half of the segment), each with a compressed .vtu file per step.

	Zones: block, material (names in the field data), stress [Pa], principal stress [Pa]; grid points: displacement [m],
	velocity [m/s]; joints: blocks, opening [m], slip [m], sigma [Pa], tau [Pa], status (0 intact, 1 broken in tension,
	2 in shear, 3 never bonded)."""

	def __init__(self, folder):
		self.folder = Path(folder)
		self.folder.mkdir(parents=True, exist_ok=True)
		self.times = []
		for name in ("blocks", "joints"):
			for old in (self.folder / f"{name}.pvd", *self.folder.glob(f"{name}_[0-9]*.vtu")):
				old.unlink(missing_ok=True)

	def write(self, model, time):
		"""Adds the model as it is now, at this time [s]."""
		step = len(self.times)
		_writeGrid(self.folder / f"blocks_{step:04}.vtu", _zoneGrid(model))
		_writeGrid(self.folder / f"joints_{step:04}.vtu", _jointGrid(model))
		self.times.append(float(time))
		for name in ("blocks", "joints"):
			_writeCollection(self.folder, name, self.times)


def _zoneGrid(model):
	from vtkmodules.vtkCommonCore import vtkStringArray
	zones = np.asarray(model.zoneNodes).reshape(-1, 3)
	zoneBlocks = np.repeat(np.arange(len(model.blockMaterial)), np.diff(model.firstZone))
	outlines = blockOutlines(model)
	rigid = np.flatnonzero(np.diff(model.firstZone) == 0)
	polygons = [max(outlines[block], key=len) for block in rigid] # of a rigid block the outer ring
	blocks = np.concatenate([zoneBlocks, rigid])
	stress = np.vstack([np.reshape(model.zoneStress(), (-1, 3)), np.zeros((len(rigid), 3))])

	grid = _grid(np.asarray(model.position), [(_triangle, zones), *((_polygon, ring[None]) for ring in polygons)])
	_addArrays(grid.GetPointData(), displacement=_spatial(model.position - model.reference), velocity=_spatial(model.velocity))
	_addArrays(grid.GetCellData(), block=blocks.astype(np.int32), material=np.asarray(model.blockMaterial, np.int32)[blocks])
	_addArrays(grid.GetCellData(), ("sxx", "syy", "sxy"), stress=stress)
	_addArrays(grid.GetCellData(), ("s1", "s2"), principal=principalStresses(stress))
	labels = vtkStringArray()
	labels.SetName("materialLabels")
	for label in model.materialLabels:
		labels.InsertNextValue(label)
	grid.GetFieldData().AddArray(labels)
	return grid


def _jointGrid(model):
	lines = contactLines(model, model.position)
	grid = _grid(lines.reshape(-1, 2), [(_line, np.arange(2 * len(lines)).reshape(-1, 2))])
	_addArrays(
	        grid.GetCellData(), opening=model.pointOpening, slip=model.pointSlip, sigma=model.pointSigma, tau=model.pointTau,
	        status=np.asarray(model.pointStatus, np.uint8)
	)
	_addArrays(grid.GetCellData(), ("first", "second"), blocks=np.repeat(np.asarray(model.segmentBlocks, np.int32), 2, axis=0))
	return grid


_line, _triangle, _polygon = 3, 5, 7 # VTK_LINE, VTK_TRIANGLE, VTK_POLYGON


def _spatial(vectors):
	"""(n, 2) -> (n, 3): VTK lives in space."""
	return np.pad(vectors, ((0, 0), (0, 1)))


def _grid(points, cellGroups):
	"""An unstructured grid from points (n, 2) and groups of equal cells: (type, (m, corners) point indices)."""
	from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
	from vtkmodules.vtkCommonCore import vtkPoints
	from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkUnstructuredGrid
	sizes = np.concatenate([np.full(len(cells), cells.shape[1]) for _, cells in cellGroups])
	types = np.concatenate([np.full(len(cells), kind, np.uint8) for kind, cells in cellGroups])
	corners = np.concatenate([cells.ravel() for _, cells in cellGroups])
	offsets = np.concatenate([[0], np.cumsum(sizes)])

	vtkCorners = vtkPoints()
	vtkCorners.SetData(numpy_to_vtk(_spatial(points), deep=True))
	cells = vtkCellArray()
	cells.SetData(*(numpy_to_vtkIdTypeArray(array.astype(np.int64), deep=True) for array in (offsets, corners)))
	grid = vtkUnstructuredGrid()
	grid.SetPoints(vtkCorners)
	grid.SetCells(numpy_to_vtk(types, deep=True), cells)
	return grid


def _addArrays(data, components=(), **arrays):
	from vtkmodules.util.numpy_support import numpy_to_vtk
	for name, values in arrays.items():
		array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
		array.SetName(name)
		for i, component in enumerate(components):
			array.SetComponentName(i, component)
		data.AddArray(array)


def _writeGrid(path, grid):
	from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter
	writer = vtkXMLUnstructuredGridWriter() # appended, base64 and zlib: its defaults
	writer.SetFileName(str(path))
	writer.SetInputData(grid)
	if not writer.Write():
		raise OSError(f"cannot write {path}")


def _writeCollection(folder, name, times):
	"""name.pvd with all steps so far; the file is replaced at once, so that a reader never sees half of it."""
	root = ElementTree.Element("VTKFile", type="Collection", version="0.1")
	collection = ElementTree.SubElement(root, "Collection")
	for step, time in enumerate(times):
		ElementTree.SubElement(collection, "DataSet", timestep=repr(time), part="0", file=f"{name}_{step:04}.vtu")
	unfinished = folder / f".{name}.pvd"
	ElementTree.ElementTree(root).write(unfinished, encoding="utf-8", xml_declaration=True)
	os.replace(unfinished, folder / f"{name}.pvd")
