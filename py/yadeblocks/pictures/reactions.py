# yade-blocks, GPL-2.0-or-later
"""Forces of groups and of held rigid blocks."""
import numpy as np

from .._door import door
from ..readings.reactions import reactionsOf
from .blocks import drawBlocks
from .colours import tensionRed
from .panel import drawAlone, note
from .units import inUnit


@door(magnification='notNegative', path='path', model='model', window='box', title='str')
def drawReactions(path, model, magnification=None, window=None, title="reactions"):
	"""Forces on the blocks of groups and of rigid blocks that are held: an arrow at the middle of each, with its two components."""
	return drawAlone(path, model, showReactions, magnification, window, title)


def showReactions(axes, view):
	"""Reactions in a panel."""
	drawBlocks(axes, view.model, view.shown)
	found = [some for some in reactionsOf(view.model) if np.hypot(*some[2]) > 0]
	if not found: return note(axes, "no reactions")
	largest = max(np.hypot(*force) for _, _, force in found)
	most, factor, unit = inUnit(largest, "N")
	reach = 0.2 * view.size.max()
	middle = (view.low + view.high) / 2
	for name, place, force in found:
		place, arrow = np.clip(place, view.low, view.high), reach * force / largest
		tail = place - arrow # the arrow ends where the force acts, or begins there, where it would leave the picture
		if not ((tail >= view.low) & (tail <= view.high)).all(): tail = place
		axes.annotate("", tail + arrow, tail, arrowprops=dict(arrowstyle="-|>", color=tensionRed, linewidth=1.6, shrinkA=0, shrinkB=0), zorder=4)
		shown = [0 if abs(component) < 1e-3 * largest else component / factor for component in force]
		right = (tail + arrow / 2)[0] > middle[0]
		axes.annotate(
			f"{name}: {shown[0]:.3g}, {shown[1]:.3g} {unit}", tail + arrow / 2, (-6 if right else 6, 0), textcoords="offset points", fontsize=7,
			ha="right" if right else "left", va="center", zorder=5, bbox=dict(facecolor="white", alpha=0.7, linewidth=0, pad=1)
		)
	note(axes, "forces on the blocks along x and y")
