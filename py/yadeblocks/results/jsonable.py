# yade-blocks, GPL-2.0-or-later
"""Values as json writes them."""
import math
import numbers

import numpy as np


def jsonable(value):
	"""Plain Python values for json: numpy's numbers and arrays become Python's, NaN and infinity None."""
	if isinstance(value, dict):
		return {str(key): jsonable(item) for key, item in value.items()}
	if isinstance(value, (list, tuple, np.ndarray)):
		return [jsonable(item) for item in value]
	if isinstance(value, (bool, np.bool_)):
		return bool(value)
	if isinstance(value, numbers.Integral):
		return int(value)
	if isinstance(value, numbers.Real):
		return float(value) if math.isfinite(value) else None
	return value if value is None else str(value)
