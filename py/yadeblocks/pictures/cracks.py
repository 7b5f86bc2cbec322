# yade-blocks, GPL-2.0-or-later
"""Cracks: in colours of the kinds of joints, solid where they broke in tension, dashed where in shear."""
import math
from collections import defaultdict

import numpy as np

from .._door import door
from ..readings.joints import contactLines
from ..readings.names import pointNames, pointsOf
from ..readings.present import Present
from ..readings.status import intact, isBroken, modes
from ..results.cracks import Cracks
from .blocks import drawBlocks
from .colours import assigned, jointColours, purple, spareColours
from .figure import picture, point, textWidth
from .panel import drawScale
from .view import View

_styles = {"tension": "solid", "shear": (0, (1.8, 1.1))} # dash and gap in line widths


@door(magnification='notNegative', path='path', model='model', window='box', title='str', names='mapping', joints='joints')
def drawCracks(path, model, magnification=None, window=None, title="", names=None, joints=None):
	"""The specimen in its deformed shape: blocks in the light tones of their materials, on top the cracks, coloured by joint type,
	solid where the joint broke in tension, dashed where it broke in shear.

	magnification: of the displacements (less those of the whole), by default a round number that makes them visible;
	window: (x0, y0, x1, y1) in the picture [m], by default all of it, fragments and platens too, unless they have flown far;
	names: of joints, as in results.Cracks; joints: whose cracks are drawn, a name, a list of names or indices, by default all. Returns the path."""
	view = View(model, magnification, window)
	width, height = view.size * min(textWidth / view.size[0], 1.3 * textWidth / view.size[1])
	with picture(path, width, height) as figure:
		axes = figure.add_axes((0, 0, 1, 1), xlim=(view.low[0], view.high[0]), ylim=(view.low[1], view.high[1]))
		axes.axis("off")
		axes.set_title(title, fontsize=9)
		cracks, blocks = drawCrackLines(axes, model, view.shown, names, joints), drawBlocks(axes, model, view.shown)
		drawScale(axes, view.magnification)
		axes.legend(
			handles=cracks + blocks, title="" if cracks else "no broken joints", loc="upper center", borderaxespad=0,
			bbox_to_anchor=(0.5, -26 * point / height), ncol=math.ceil(len(cracks + blocks) / len(modes)), columnspacing=1.4, handlelength=2.2
		)
	return path


def showCracks(axes, view):
	"""Cracks in a panel."""
	drawBlocks(axes, view.model, view.shown)
	handles = drawCrackLines(axes, view.model, view.shown)
	axes.legend(handles=handles, title="" if handles else "no broken joints", loc="upper center", bbox_to_anchor=(0.5, -0.01), fontsize=5, ncol=2)


def drawCrackLines(axes, model, shown, names=None, joints=None):
	"""Draws the cracks; the legend's handles, all modes of a joint type one after the other."""
	from matplotlib.collections import LineCollection
	from matplotlib.lines import Line2D
	there = Present(model).points & pointsOf(model, joints)
	counts = {pair: count for pair, count in Cracks(model, names).counts(there).items() if any(count.values())}
	colours = assigned(counts, jointColours, spareColours)
	pairs = pointNames(model, names)
	status = np.where(there, model.pointStatus, intact)
	lines = contactLines(model, shown)
	size = np.ptp(model.reference, axis=0).max()
	width = _lineWidth(axes, lines)
	ends = np.rint(contactLines(model, model.reference) / (1e-6 * size)).astype(np.int64) # ends of neighbours coincide in the reference
	handles = _drawSoftened(axes, model, lines, status, width, there)
	for pair, count in counts.items():
		for mode, value in modes.items():
			if not count[mode]: continue
			style = dict(color=colours[pair], linestyle=_styles[mode], linewidth=width)
			cracked = (pairs == pair) & (status == value)
			axes.add_collection(
				LineCollection(chains(lines[cracked], ends[cracked]), capstyle="butt", joinstyle="round", zorder=2, **style), autolim=False
			)
			handles.append(Line2D([], [], label=f"{pair}, {mode} ({count[mode]})", **style))
	return handles


def _drawSoftened(axes, model, lines, status, width, there):
	"""Joints that have begun to soften and are not cracked: paler and thinner the less they are damaged; the legend's handle, if there are any."""
	from matplotlib.collections import LineCollection
	from matplotlib.lines import Line2D
	damage = np.asarray(getattr(model, "pointDamage", np.zeros(len(status))))
	begun = (damage > 0.05) & there & ~isBroken(status)
	if not begun.any(): return []
	shade = damage[begun]
	colours = [(0.8, 0.47, 0.65, 0.25 + 0.75 * value) for value in shade] # of Okabe and Ito, too
	axes.add_collection(LineCollection(lines[begun], colors=colours, linewidths=width * (0.4 + shade), zorder=1.8), autolim=False)
	return [Line2D([], [], color=purple, linewidth=width, label=f"softening ({np.count_nonzero(begun)})")]


def _lineWidth(axes, lines):
	"""Thinner cracks where joints are short on the paper [points]."""
	left, right = axes.get_xlim()
	scale = axes.figure.get_figwidth() / (right - left) / point # points per metre of specimen
	joint = 2 * np.median(np.hypot(*(lines[:, 1] - lines[:, 0]).T)) if len(lines) else 0
	return np.clip(0.2 * scale * joint, 0.6, 1.2)


def chains(lines, ends):
	"""Joins lines that meet end to end, so that dashes run on from one to the next.

	lines: (n, 2, 2) coordinates; ends: (n, 2, 2) integers, equal where two lines meet -> a list of (m, 2) polylines."""
	names = [[tuple(end) for end in pair] for pair in ends.tolist()]
	meeting = defaultdict(list)
	for i, pair in enumerate(names):
		for end in pair:
			meeting[end].append(i)
	unused = set(range(len(lines)))
	joined = []
	for start in sorted(meeting, key=lambda end: len(meeting[end]) == 2): # ends and forks first, closed rings last
		for i in meeting[start]:
			end, chain = start, []
			while i in unused:
				unused.remove(i)
				forward = names[i][0] == end
				chain.extend(lines[i] if forward else lines[i][::-1])
				end = names[i][1 if forward else 0]
				i = next((j for j in meeting[end] if j in unused), i) if len(meeting[end]) == 2 else i
			if chain:
				joined.append(np.array(chain))
	return joined
