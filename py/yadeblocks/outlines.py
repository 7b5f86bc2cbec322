# yade-blocks, GPL-2.0-or-later
"""Polygons from drawings: CSV, DXF and SVG.

	for name, ring in read('stones.dxf', unit=1e-3): model.addRegion(ring, 'stone', zoneSize=0.05)

DXF needs ezdxf, SVG svgelements (Debian's python3-ezdxf, python3-svgelements)."""
import csv
import math
from collections import namedtuple
from pathlib import Path

import numpy as np

from ._door import door
from .polygons import counterClockwise

#: name: of the layer (DXF), the id or label (SVG) or the third column (CSV), '' without one; ring: (n, 2) array, counter-clockwise [m].
Outline = namedtuple('Outline', 'name ring')


@door('unit', 'sagitta', path='file')
def read(path, unit=1.0, sagitta=None):
	"""All closed polygons of a file -> a list of Outline, in the order of the file.

	unit: metres in a unit of the drawing (1e-3 for millimetres); sagitta: how far chords may leave a curve [m], by default a thousandth of the drawing's
	size. CSV: a line x,y or x,y,name for each corner, an empty line (or another name) between two polygons, lines that begin with # are remarks.
	DXF: closed polylines with their arcs, circles and ellipses of the model space. SVG: closed paths and shapes with their transformations, y turned
	upwards, in pixels (96 an inch).
	Errors: OSError where there is no such file, ValueError for other files, for those without a closed polygon and for polylines that are open."""
	path = Path(path)
	if not unit > 0: raise ValueError('outlines.read: unit must be positive, got %r' % unit)
	if sagitta is not None and not sagitta > 0: raise ValueError('outlines.read: sagitta must be positive, got %r' % sagitta)
	readers = {'.csv': _csv, '.dxf': _dxf, '.svg': _svg}
	if path.suffix.lower() not in readers: raise ValueError(f'outlines.read: {path.name} must end in one of {" ".join(readers)}')
	with open(path, 'rb'): # a file that is not there is said so, whoever reads it
		pass
	found = readers[path.suffix.lower()](path, sagitta and sagitta / unit)
	if not found: raise ValueError(f'outlines.read: {path.name} has no closed polygon')
	polygons = []
	for number, (name, ring) in enumerate(found, 1):
		try:
			polygons.append(Outline(name, counterClockwise(unit * np.asarray(ring, float))))
		except ValueError as error:
			raise ValueError(f'outlines.read: polygon {number} of {path.name}{name and f" ({name})"}: {error}') from None
	return polygons


def _notOf(path, kind, error):
	return ValueError(f'outlines.read: {path.name} cannot be read as {kind}: {error}')


def _csv(path, sagitta):
	rings = []
	name = None
	with open(path, newline='', encoding='utf-8-sig') as file:
		try:
			rows = list(csv.reader(file))
		except (UnicodeDecodeError, csv.Error) as error:
			raise _notOf(path, 'CSV', error) from None
		for number, row in enumerate(rows, 1):
			if not any(cell.strip() for cell in row): name = None
			elif not row[0].lstrip().startswith('#'):
				try:
					point = float(row[0]), float(row[1])
					if not np.isfinite(point).all(): raise ValueError
				except (ValueError, IndexError):
					raise ValueError(f'outlines.read: line {number} of {path.name} must be x,y or x,y,name, got {",".join(row)}') from None
				label = row[2].strip() if len(row) > 2 else ''
				if name is None or label != name: rings.append((label, []))
				name = label
				rings[-1][1].append(point)
	return rings


def _dxf(path, sagitta):
	try:
		import ezdxf
		from ezdxf import path as paths
	except ImportError as error:
		raise ImportError('DXF needs ezdxf: scripts/install.sh python3-ezdxf') from error
	try:
		drawing = ezdxf.readfile(path)
	except (OSError, UnicodeDecodeError, ezdxf.DXFError) as error:
		raise _notOf(path, 'DXF', error) from None
	shapes = list(drawing.modelspace().query('LWPOLYLINE POLYLINE CIRCLE ELLIPSE'))
	curves = [(shape.dxf.layer, paths.make_path(shape)) for shape in shapes]
	for layer, curve in curves:
		if not curve.is_closed: raise ValueError(f'outlines.read: {path.name} has an open polyline on layer {layer}')
	if not curves: return []
	corners = np.array([(point.x, point.y) for _, curve in curves for point in curve.control_vertices()])
	sagitta = sagitta or 1e-3 * np.ptp(corners, axis=0).max()
	return [(layer, [(point.x, point.y) for point in curve.flattening(sagitta)][:-1]) for layer, curve in curves]


def _svg(path, sagitta):
	try:
		import svgelements
	except ImportError as error:
		raise ImportError('SVG needs svgelements: scripts/install.sh python3-svgelements') from error
	try:
		drawing = svgelements.SVG.parse(str(path), reify=True)
	except (SyntaxError, ValueError) as error: # xml's ParseError is a SyntaxError
		raise _notOf(path, 'SVG', error) from None
	shapes = [element for element in drawing.elements() if isinstance(element, svgelements.Shape)]
	boxes = [box for box in (shape.bbox() for shape in shapes) if box]
	if not boxes: return []
	x0, y0, x1, y1 = np.array(boxes).T
	sagitta = sagitta or 1e-3 * max(x1.max() - x0.min(), y1.max() - y0.min())
	rings = []
	for shape in shapes:
		for part in abs(svgelements.Path(shape)).as_subpaths(): # abs: its transformation carried out
			part = svgelements.Path(part)
			if not any(isinstance(segment, svgelements.Close) for segment in part):
				raise ValueError(f'outlines.read: {path.name} has an open path {shape.id or ""}'.rstrip())
			points = []
			for segment in part:
				if isinstance(segment, (svgelements.Move, svgelements.Close)): continue
				pieces = 1 if isinstance(segment, svgelements.Line) else _pieces(segment.length(), sagitta)
				points += [segment.point(i / pieces) for i in range(pieces)]
			last = next((segment.end for segment in reversed(part) if not isinstance(segment, (svgelements.Move, svgelements.Close))), None)
			if last is not None: points.append(last)
			rings.append((shape.values.get('inkscape:label') or shape.id or '', _distinct([(point.x, -point.y) for point in points])))
	return rings


def _pieces(length, sagitta):
	"""Chords of a curve of this length that turns by half a circle at most: s = c^2 / (8 r), r = length / pi."""
	return max(2, math.ceil(length / math.sqrt(8 * sagitta * length / math.pi)))


def _distinct(points):
	"""Without corners that repeat the one before."""
	points = [point for point, before in zip(points, [None, *points]) if point != before]
	return points[:-1] if len(points) > 1 and np.allclose(points[0], points[-1], rtol=0, atol=1e-9) else points
