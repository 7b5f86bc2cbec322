# yade-blocks, GPL-2.0-or-later
"""Principal stresses as crosses."""
import numpy as np

from .._door import door
from ..readings.zones import principalStresses
from .blocks import drawOutlines
from .colours import pressureBlue, tensionRed
from .panel import drawAlone, note
from .units import inUnit

_crosses = 900 # so many crosses at most


@door(magnification='notNegative', path='path', model='model', window='box', title='str')
def drawCrosses(path, model, magnification=None, window=None, title="principal stresses"):
	"""Principal stresses as crosses along their directions, as long as they are large; tension red, compression blue; of at most 900 zones,
	evenly spread."""
	return drawAlone(path, model, showCrosses, magnification, window, title)


def showCrosses(axes, view):
	"""Crosses in a panel."""
	from matplotlib.collections import LineCollection
	model = view.model
	drawOutlines(axes, view, "#F7F7F7")
	stress = np.asarray(model.zoneStress())
	if not len(stress): return
	stress, middles = stress[view.there.zones], view.shown[model.zoneNodes[view.there.zones]].mean(axis=1)
	chosen = _spread(middles, view, _crosses)
	stress, middles = stress[chosen], middles[chosen]
	principal = principalStresses(stress)
	_, factor, unit = inUnit(np.abs(principal).max(), "Pa")
	principal = principal / factor
	angle = np.arctan2(2 * stress[:, 2], stress[:, 0] - stress[:, 1]) / 2
	spacing = np.sqrt(np.prod(view.size) / max(len(chosen), 1))
	most = np.percentile(np.abs(principal).max(axis=1), 99) or 1
	for column, turn in ((0, 0), (1, np.pi / 2)):
		half = 0.6 * spacing * np.clip(principal[:, column] / most, -1.5, 1.5)[:, None] * np.column_stack([np.cos(angle + turn), np.sin(angle + turn)])
		axes.add_collection(
			LineCollection(
				np.stack([middles - half, middles + half], axis=1), colors=np.where(principal[:, column] > 0, tensionRed, pressureBlue),
				linewidths=0.6, zorder=3
			), autolim=False
		)
	note(axes, f"red tension, blue compression; the longest {most:.3g} {unit}")


def _spread(places, view, most):
	"""Indices of places, one in each cell of a grid of about so many."""
	if len(places) <= most: return np.arange(len(places))
	size = view.size
	cell = np.sqrt(np.prod(size) / most)
	columns = int(np.ceil(size[0] / cell)) + 1
	index = np.floor((places - view.low) / cell).astype(int)
	return np.unique(index[:, 1] * columns + index[:, 0], return_index=True)[1]
