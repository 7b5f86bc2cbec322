# yade-blocks, GPL-2.0-or-later
"""Edges that touch without a bond, and their forces."""
import numpy as np

from .._door import door
from ..readings.contacts import freeContactLines
from .blocks import drawBlocks
from .colours import pressureBlue
from .panel import drawAlone, note
from .units import inUnit


@door(magnification='notNegative', path='path', model='model', window='box', title='str')
def drawContacts(path, model, magnification=None, window=None, title="free contacts"):
	"""Edges that touch without a bond, as of the last step: where they face each other, and the force between them as an arrow on each side. Needs
	BlockLoop(contact=True) or BlockContacts in the run."""
	return drawAlone(path, model, showContacts, magnification, window, title)


def showContacts(axes, view):
	"""Contacts in a panel."""
	from matplotlib.collections import LineCollection
	drawBlocks(axes, view.model, view.shown)
	lines, blocks, force = freeContactLines(view.model)
	if not len(lines): return note(axes, "no edges touch without a bond")
	size, before = np.hypot(*force.T), _referenceOf(view, lines)
	drawn = (_facing(view) > 0.5) | (size > 0.01 * size.max()) # edges at a corner stand across each other and carry next to nothing
	lines, force, before = lines[drawn], force[drawn], before[drawn]
	if not len(lines): return note(axes, "no edges touch without a bond")
	moved = view.magnification * (lines.mean(axis=1) - before - view.carried)
	shown = before[:, None] + moved[:, None] + (lines - lines.mean(axis=1, keepdims=True))
	axes.add_collection(LineCollection(shown, colors="black", linewidths=1.2, zorder=2), autolim=False)
	size = np.hypot(*force.T)
	most, factor, unit = inUnit(size.max(), "N")
	if not most > 0: return
	reach = 0.06 * view.size.max() / size.max()
	middle = shown.mean(axis=1)
	for sign in (-1, 1):
		axes.quiver(
			*middle.T,
			*(sign * reach * force).T, color=pressureBlue, angles="xy", scale_units="xy", scale=1, width=0.003, pivot="tip", zorder=3
		)
	note(axes, f"arrows: forces between edges that touch without a bond; the longest {most:.3g} {unit}")


def _facing(view):
	"""How straight the two edges of each free contact face each other: 1 parallel, 0 at a right angle."""
	a0, a1, b0, b1 = np.moveaxis(np.asarray(view.model.position)[view.model.freeContacts()["nodes"]], 1, 0)
	unit = lambda edge: edge / np.maximum(np.hypot(*edge.T), 1e-300)[:, None]
	return -(unit(a1 - a0) * unit(b1 - b0)).sum(axis=1)


def _referenceOf(view, lines):
	"""Where the middles of free contacts were in the reference state."""
	nodes = view.model.freeContacts()["nodes"]
	moved = np.asarray(view.model.position) - np.asarray(view.model.reference)
	return lines.mean(axis=1) - moved[nodes].mean(axis=1)
