# yade-blocks, GPL-2.0-or-later
"""Contours of a displacement or a stress."""
import numpy as np

from .._door import door
from .._words import requireOneOf
from ..readings.blocks import rigidBlocks
from ..readings.zones import outOfPlaneStress, principalStresses, vonMises
from .blocks import drawOutlines
from .panel import drawAlone, pointsHigh
from .titles import titles
from .units import inUnit, nearlyLargest

#: What contours can show: displacements u, ux, uy of the grid points and stresses of the zones.
fields = ("u", "ux", "uy", "sxx", "syy", "sxy", "szz", "s1", "s2", "vonMises")


@door(magnification='notNegative', path='path', model='model', window='box', title='str', what='str')
def drawField(path, model, what, magnification=None, window=None, title=""):
	"""Contours of one of `fields` on the deformed specimen. magnification, window: as in pictures.drawCracks. Returns the path."""
	requireOneOf("what", what, fields)
	return drawAlone(path, model, lambda axes, view: showField(axes, view, what), magnification, window, title or titles[what])


def showField(axes, view, what, most=None):
	"""Colours: to both sides of zero for what has two signs; the largest hundredth shares the last colour. most: the end of the range, by default of this
	state."""
	from matplotlib.collections import PolyCollection
	model = view.model
	values, unit = valuesOf(view, what)
	most, factor, unit = inUnit(nearlyLargest(values[keptOf(view, what)]) if most is None else most, unit)
	values = values / factor
	drawOutlines(axes, view, "#EDEDED")
	if what in ("u", "ux", "uy"):
		rigid = rigidBlocks(model).tolist()
		triangles = np.concatenate([np.reshape(model.zoneNodes, (-1, 3))[view.there.zones], *map(model.cornerTriangles, rigid)])
		colours = axes.tripcolor(*view.shown.T, triangles, values, shading="gouraud", cmap="viridis" if what == "u" else "RdBu_r", zorder=1.5)
	else:
		if not len(values): return
		colours = PolyCollection(
			view.shown[model.zoneNodes[view.there.zones]], array=values[view.there.zones], cmap="viridis" if what == "vonMises" else "RdBu_r",
			linewidths=0, zorder=1.5
		)
		colours.set_edgecolor("face")
		axes.add_collection(colours, autolim=False)
	most = most or 1
	colours.set_clim(0 if what in ("u", "vonMises") else -most, most)
	drawOutlines(axes, view)
	_bar(axes, colours, unit)


def valuesOf(view, what):
	"""Values for each zone or grid point, and the unit."""
	if what in ("u", "ux", "uy"):
		d = view.displacement
		return (np.hypot(*d.T) if what == "u" else d[:, "xy".index(what[1])]), "m"
	stress = np.asarray(view.model.zoneStress())
	if what in ("s1", "s2"): return principalStresses(stress)[:, int(what[1]) - 1], "Pa"
	if what == "szz": return outOfPlaneStress(view.model, stress), "Pa"
	if what == "vonMises": return vonMises(stress, outOfPlaneStress(view.model, stress)), "Pa"
	return stress[:, ("sxx", "syy", "sxy").index(what)], "Pa"


def keptOf(view, what):
	"""Which of valuesOf are of blocks that have not been removed."""
	return view.there.nodes if what in ("u", "ux", "uy") else view.there.zones


def _bar(axes, colours, unit):
	points = pointsHigh(axes)
	place = axes.inset_axes((0.1, -12 / points, 0.8, 4 / points))
	bar = axes.figure.colorbar(colours, cax=place, orientation="horizontal", extend="both")
	bar.ax.tick_params(labelsize=6, width=0.4, length=2, pad=1)
	bar.ax.set_xlabel(f"[{unit}]", fontsize=6, labelpad=1)
	bar.outline.set_linewidth(0.4)
