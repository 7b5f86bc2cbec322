# yade-blocks, GPL-2.0-or-later
"""Bars on joints."""
import numpy as np

from .._door import door
from .._words import requireOneOf
from ..plane import left
from ..readings.joints import contactLines, jointMotion
from ..readings.names import pointsOf
from .blocks import drawOutlines
from .colours import pressureBlue, tensionRed
from .panel import drawAlone, note
from .titles import titles
from .units import inUnit, nearlyLargest

#: What bars can show.
onJoints = ("sigma", "tau", "opening", "slip")


@door(magnification='notNegative', path='path', model='model', window='box', title='str', what='str', joints='joints')
def drawJoints(path, model, what, magnification=None, window=None, title="", joints=None):
	"""Bars on the joints, as high as one of `onJoints` is large: a bar for each contact point, over its half of the joint; positive values
	(tension, opening)
	on the side of the joint's second block. Joints that have become free contacts show no stress. joints: which, a name, a list of names or
	indices, by default all."""
	requireOneOf("what", what, onJoints)
	title = title or titles[what] + (f": {joints}" if isinstance(joints, str) else "")
	return drawAlone(path, model, lambda axes, view: showBars(axes, view, what, joints=joints), magnification, window, title)


def showBars(axes, view, what, most=None, joints=None):
	"""Bars in a panel. most: the value of the highest, by default of this state."""
	from matplotlib.collections import PolyCollection
	model = view.model
	drawOutlines(axes, view, "#F7F7F7")
	values = valuesOnJoints(model, what)
	if not len(values): return
	there = np.repeat(np.asarray(model.segmentArea) > 0, 2)
	if what in ("opening", "slip"): there[:] = True
	there &= view.there.points & pointsOf(model, joints)
	lines, values = contactLines(model, view.shown)[there], values[there]
	if not len(values): return note(axes, "none")
	normals = np.repeat(model.normal, 2, axis=0)[there]
	most, factor, unit = inUnit(nearlyLargest(values) if most is None else most, "Pa" if what in ("sigma", "tau") else "m")
	values = values / factor
	if not most > 0: return
	along = lines[:, 1] - lines[:, 0]
	across = left(along)
	across /= np.maximum(np.hypot(*across.T), 1e-300)[:, None]
	across *= np.sign((across * normals).sum(axis=1))[:, None]
	tall = min(0.035 * view.size.max(), 2 * np.median(np.hypot(*along.T))) # bars of small joints stay among them
	height = tall * np.clip(values / most, -1, 1)[:, None] * across
	corners = np.stack([lines[:, 0], lines[:, 1], lines[:, 1] + height, lines[:, 0] + height], axis=1)
	colours = np.where(values > 0, tensionRed, pressureBlue)
	axes.add_collection(PolyCollection(corners, facecolors=colours, edgecolors=colours, linewidths=0.1, alpha=0.8, zorder=3), autolim=False)
	sense = {"sigma": "red tension, blue compression", "opening": "red open, blue closed"}.get(what, "red and blue: the two senses")
	note(axes, f"{sense}; the highest {most:.3g} {unit}")


def valuesOnJoints(model, what):
	"""A value for each contact point; openings and slips of free contacts, too."""
	values = np.array(getattr(model, "point" + what.capitalize()))
	if what not in ("opening", "slip") or not len(values): return values
	return np.where(np.repeat(np.asarray(model.segmentArea) > 0, 2), values, jointMotion(model)[onJoints[2:].index(what)])
