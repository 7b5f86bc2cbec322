# yade-blocks, GPL-2.0-or-later
"""Kinds of arguments that public functions take: what is said of a kind, and whether a value is of it. Types as Boost's signatures name them are kinds, too."""
import math
import os
from collections import namedtuple

import numpy as np

#: words: what it must be; fits(value): whether it is; type(value): whether its type is right, so that only its value may be wrong.
Kind = namedtuple("Kind", "words fits type", defaults=(lambda value: False, ))


def _isNumber(value):
	if isinstance(value, (str, bytes)) or value is None: return False
	try:
		return isinstance(float(value), float)
	except (TypeError, ValueError, OverflowError):
		return False


def _isFinite(value):
	return _isNumber(value) and math.isfinite(float(value))


def _isWhole(value):
	return _isFinite(value) and int(value) == value


def _areNumbers(value, *shape, finite=True):
	"""Whether it is an array of (finite) numbers with this shape; None: of any length, but not empty."""
	if isinstance(value, (str, bytes, dict)): return False
	try:
		array = np.asarray(value)
		if array.dtype.kind not in "iuf": return False
	except (TypeError, ValueError):
		return False
	fits = array.ndim == len(shape) and all(length > 0 if wanted is None else length == wanted for length, wanted in zip(array.shape, shape))
	return fits and (not finite or bool(np.isfinite(array).all()))


def _isPolygon(value, finite=True):
	return _areNumbers(value, None, 2, finite=finite) and len(value) >= 3


def _isBox(value, finite=True):
	return _areNumbers(value, 4, finite=finite) or _areNumbers(value, 2, 2, finite=finite)


def _isListOf(fits):
	return lambda value: not isinstance(value, (str, bytes, dict)) and hasattr(value, "__iter__") and all(map(fits, value))


def _isModel(value):
	return not isinstance(value, type) and all(hasattr(value, name) for name in ("reference", "position", "segmentBlocks", "materialLabels"))


def _isBlockModel(value):
	return _isModel(value) and hasattr(value, "groupPushForce")


def _areJoints(value):
	if isinstance(value, str): return True
	if isinstance(value, (bytes, dict)) or not hasattr(value, "__len__"): return False
	return not len(value) or all(isinstance(name, str) for name in value) or _areNumbers(value, None) and np.asarray(value).dtype.kind in "iu"


def _isVector(size):
	def fits(value):
		try:
			return len(value) == size and all(isinstance(float(part), float) for part in value)
		except (TypeError, ValueError):
			return False

	return fits


def _always(value):
	return True


kinds = {
	# of Boost's signatures
	"float": Kind("a number", _isNumber),
	"int": Kind("a whole number", lambda value: _isNumber(value) and not math.isnan(float(value)) and (math.isinf(float(value)) or int(value) == value)),
	"str": Kind("a text", lambda value: isinstance(value, str)),
	"bool": Kind("True or False", _isNumber),
	"tuple": Kind("a tuple", _always),
	"list": Kind("a list", _always),
	"dict": Kind("a dictionary", _always),
	"Vector2": Kind("a vector (x, y)", _isVector(2)),
	"Vector3": Kind("a vector (x, y, z)", _isVector(3)),
	# of functions in Python
	"finite": Kind("a finite number", _isFinite, _isNumber),
	"notNegative": Kind("a finite number, and not negative", lambda value: _isFinite(value) and value >= 0, _isNumber),
	"whole": Kind("a whole number", _isWhole, _isNumber),
	"flag": Kind("True or False", lambda value: isinstance(value, (bool, np.bool_))),
	"sequence": Kind("a list", lambda value: not isinstance(value, (str, bytes, dict)) and hasattr(value, "__len__")),
	"mapping": Kind("a dictionary", lambda value: isinstance(value, dict)),
	"mappingOrNone": Kind("a dictionary or None", lambda value: value is None or isinstance(value, dict)),
	"function": Kind("a function", callable),
	"functionOfPlace": Kind("a function of x and y", callable),
	"nodes": Kind("a list of indices", lambda value: _areNumbers(value, None) and np.asarray(value).dtype.kind in "iu"),
	"joints": Kind("a name of joints, a list of names or a list of indices", _areJoints),
	"table": Kind("a DataFrame", lambda value: hasattr(value, "groupby")),
	"path": Kind("a path or a binary file", lambda value: isinstance(value, (str, os.PathLike)) or hasattr(value, "write")),
	"file": Kind("a path", lambda value: isinstance(value, (str, os.PathLike))),
	"point": Kind("a pair of finite numbers (x, y)", lambda value: _areNumbers(value, 2), lambda value: _areNumbers(value, 2, finite=False)),
	"numbers": Kind("a list of finite numbers", lambda value: _areNumbers(value, None), lambda value: _areNumbers(value, None, finite=False)),
	"points": Kind("a list of points (x, y)", lambda value: _areNumbers(value, None, 2), lambda value: _areNumbers(value, None, 2, finite=False)),
	"polygon": Kind("a polygon, a list of at least three points (x, y)", _isPolygon, lambda value: _isPolygon(value, finite=False)),
	"polygons": Kind("a list of polygons, each a list of at least three points (x, y)", _isListOf(_isPolygon)),
	"box": Kind("a rectangle (x0, y0, x1, y1)", _isBox, lambda value: _isBox(value, finite=False)),
	"boxes": Kind("a list of rectangles (x0, y0, x1, y1)", _isListOf(lambda value: _areNumbers(value, 4))),
	"model": Kind("a BlockModel or a Snapshot of one", _isModel),
	"blockModel": Kind("a BlockModel", _isBlockModel),
	"motions": Kind(
		"a list of motions (vx, vy, rotation)", lambda value: _areNumbers(value, None, 3), lambda value: _areNumbers(value, None, 3, finite=False)
	),
	"throttled": Kind("a BlockModel, or what has its setThrottle", lambda value: not isinstance(value, type) and hasattr(value, "setThrottle")),
	"layout": Kind("a Layout", lambda value: hasattr(value, "outlines") and hasattr(value, "pieces")),
	"models": Kind("a list of Snapshots", _isListOf(_isModel)),
	"film": Kind("a Film", lambda value: hasattr(value, "states") and hasattr(value, "peak")),
}


def fits(value, kind):
	"""Whether a value is of a kind; a kind that is not known fits all."""
	return kinds[kind].fits(value) if kind in kinds else True


def wordsOf(kind):
	return kinds[kind].words if kind in kinds else kind


def wrong(name, value, kind, where=""):
	"""The error to raise where the value of this name is not of a kind, or None: TypeError, or ValueError where the type is right (a number that is not
	finite, say). where: what else is said, at the end."""
	if fits(value, kind): return None
	typeIsRight = kinds[kind].type(value)
	rule = wordsOf("float" if kind in ("finite", "notNegative") and not typeIsRight else kind)
	return (ValueError if typeIsRight else TypeError)(f"{name} must be {rule}, got {shown(value)}{where}")


def shown(value, most=160):
	"""A value as a sentence shows it: not longer than so many characters."""
	text = repr(value.tolist() if isinstance(value, np.ndarray) else value)
	return text if len(text) <= most else text[:most - 3] + "..."
