# yade-blocks, GPL-2.0-or-later
"""Joints, coloured by name."""
import numpy as np

from .._door import door
from ..readings.joints import contactLines
from ..readings.names import pointNames, pointsOf
from .blocks import drawBlocks
from .colours import assigned, jointColours, spareColours
from .figure import point
from .panel import drawAlone


@door(magnification='notNegative', path='path', model='model', window='box', title='str', joints='joints')
def drawNames(path, model, magnification=None, window=None, title="joints by name", joints=None):
	"""Joints as lines, coloured by their names (BlockModel.nameJoints; else by their pairs of materials), with how many each name has. joints: which, a
	name, a list of names or indices, by default all."""
	return drawAlone(path, model, lambda axes, view: showNames(axes, view, joints), magnification, window, title, drop=9)


def showNames(axes, view, joints):
	"""Joints in a panel."""
	from matplotlib.collections import LineCollection
	from matplotlib.lines import Line2D
	drawBlocks(axes, view.model, view.shown)
	there = view.there.points & pointsOf(view.model, joints)
	names, lines = pointNames(view.model)[there], contactLines(view.model, view.shown)[there]
	colours = assigned(sorted(set(names)), jointColours, spareColours)
	for name, colour in colours.items():
		axes.add_collection(LineCollection(lines[names == name], colors=colour, linewidths=1.2, zorder=2), autolim=False)
	handles = [Line2D([], [], color=colour, linewidth=1.2, label=f"{name} ({np.count_nonzero(names == name) // 2})") for name, colour in colours.items()]
	below = -26 * point / axes.figure.get_figheight()
	axes.legend(handles=handles, title="" if handles else "no joints", loc="upper center", bbox_to_anchor=(0.5, below), borderaxespad=0, ncol=4)
