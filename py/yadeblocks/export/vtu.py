# yade-blocks, GPL-2.0-or-later
"""Grids of equal cells as .vtu files, and collections of them as .pvd files, which ParaView reads."""
from xml.etree import ElementTree

import numpy as np

from .. import files


def spatial(vectors):
	"""(n, 2) -> (n, 3): VTK lives in space."""
	return np.pad(vectors, ((0, 0), (0, 1)))


def writeGrid(path, points, kind, cells, pointData, cellData):
	"""A compressed .vtu file of equal cells, (m, corners) point indices; of no cells one that can be read all the same."""
	from meshio import Mesh, vtu # not VTK: ParaView's Python and YADE's VTK cannot live in one process
	plain = lambda values: np.array(values, order="C") # meshio takes bytes as they lie
	pointData = {name: plain(values) for name, values in pointData.items()}
	if not len(cells): return _writeNothing(path, pointData, {name: plain(values) for name, values in cellData.items()})
	vtu.write(path, Mesh(spatial(points), [(kind, plain(cells))], pointData, {name: [plain(values)] for name, values in cellData.items()}))


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


def writeCollection(folder, name, times):
	"""name.pvd with all steps so far; the file is replaced at once, so that a reader never sees half of it."""
	root = ElementTree.Element("VTKFile", type="Collection", version="0.1")
	collection = ElementTree.SubElement(root, "Collection")
	for step, time in enumerate(times):
		ElementTree.SubElement(collection, "DataSet", timestep=repr(time), part="0", file=f"{name}_{step:04}.vtu")
	files.replace(folder / f"{name}.pvd", ElementTree.tostring(root, encoding="utf-8", xml_declaration=True))
