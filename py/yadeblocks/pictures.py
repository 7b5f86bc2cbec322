# yade-blocks, GPL-2.0-or-later
"""curve.png and cracks.png, fit to be printed.

	drawCurve(results.folder / "curve.png", results.curves, "displacement_mm", "stress_MPa",
	          labels=("displacement across the joint [mm]", "tensile stress [N/mm²]"),
	          references=[Reference("Van der Pluijm 1992", 0.35)])
	drawCracks(results.folder / "cracks.png", model)
"""
import math
from collections import defaultdict, namedtuple
from contextlib import contextmanager
from itertools import cycle

import numpy as np

from . import files
from ._calls import door
from .export import Present, areasAndCentroids, blockOutlines, contactLines, pointNames, pointsOf
from .results import Cracks, intact, modes

#: What a curve is compared with: y is a number (drawn as a line), a pair (a band) or, with x, a measured curve.
Reference = namedtuple("Reference", "label y x", defaults=(None, ))

# Okabe and Ito's colours, which colour-blind readers and grey prints keep apart.
_blue, _vermillion, _green, _purple, _black = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000"
_jointColours = {"mortar-mortar": _blue, "unit-mortar": _vermillion, "unit-unit": _black, "bed": _vermillion, "head": _blue, "unit": _black, "platen": _green}
_blockTones = {"unit": "#EBD3C3", "mortar": "#F6F3EA", "platen": "#C9CDD2"}
_spareColours = (_green, _purple, "#56B4E9", "#E69F00")
_spareTones = ("#DDE6DF", "#E3DDEA", "#EFE3C2", "#D6E4EE")
_modeStyles = {"tension": "solid", "shear": (0, (1.8, 1.1))} # dash and gap in line widths

_style = {
	"font.size": 9, "legend.fontsize": 8, "legend.title_fontsize": 8, "legend.frameon": False, "axes.linewidth": 0.6, "xtick.major.width": 0.6,
	"ytick.major.width": 0.6, "xtick.direction": "in", "ytick.direction": "in", "xtick.major.pad": 5, "ytick.major.pad": 5, "axes.spines.top": False,
	"axes.spines.right": False
}
_textWidth = 6.3 # of a page: the width of a picture [inch]
_point = 1 / 72 # [inch]


@door(path='path', curves='table', x='str', y='str', references='sequence', title='str')
def drawCurve(path, curves, x, y, labels=None, references=(), title=""):
	"""The curve y(x) of every seed with its peak or, of several seeds, the mean peak with standard deviations; references.

	curves: a DataFrame with the columns `seed`, x and y, as Results.curves; labels: of the two axes, with units, by default
	the column names; references: a list of Reference, in the units of the columns. Returns the path."""
	for name in ("seed", x, y):
		if name not in curves: raise ValueError(f"drawCurve: {name!r} must be a column of curves; there are {', '.join(map(str, curves.columns))}")
	runs = [run for _, run in curves.groupby("seed")]
	with _picture(path, _textWidth, 0.6 * _textWidth) as figure:
		axes = figure.add_subplot()
		for i, run in enumerate(runs):
			label = "simulation" if len(runs) == 1 else f"simulation, {len(runs)} seeds"
			axes.plot(run[x], run[y], color=_blue, zorder=3, linewidth=1.1 if len(runs) == 1 else 0.6, label=None if i else label)
		_markPeaks(axes, np.array([run.loc[run[y].idxmax(), [x, y]] for run in runs], dtype=float))
		for reference, colour, line in zip(references, cycle((_vermillion, _black, _green, _purple)), cycle(("--", "-.", ":"))):
			_drawReference(axes, reference, colour, line)

		axes.set(xlabel=labels[0] if labels else x, ylabel=labels[1] if labels else y)
		axes.set_title(title, fontsize=9)
		axes.margins(x=0)
		if curves[y].min() > -0.02 * curves[y].max(): # oscillation about zero is no reason to show negative stresses
			axes.set_ylim(bottom=0)
		axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncol=2)
	return path


@door(magnification='notNegative', path='path', model='model', window='box', title='str', names='mapping', joints='joints')
def drawCracks(path, model, magnification=None, window=None, title="", names=None, joints=None):
	"""The specimen in its deformed shape: blocks in the light tones of their materials, on top the cracks, coloured by joint type,
	solid where the joint broke in tension, dashed where it broke in shear.

	magnification: of the displacements (less those of the whole), by default a round number that makes them visible;
	window: (x0, y0, x1, y1) in the picture [m], by default all of it, fragments and platens too, unless they have flown far;
	names: of joints, as in results.Cracks; joints: whose cracks are drawn, a name, a list of names or indices, by default all. Returns the path."""
	reference = np.asarray(model.reference)
	displacement = model.position - reference
	there = Present(model).nodes
	displacement = displacement - np.median(displacement[there], axis=0)
	if magnification is None:
		magnification = _visible(np.ptp(reference[there], axis=0).max(), displacement[there])
	shown = reference + magnification * displacement

	low, high = _window(reference, shown, there) if window is None else _corners(window)
	width, height = (high - low) * min(_textWidth / (high - low)[0], 1.3 * _textWidth / (high - low)[1])
	with _picture(path, width, height) as figure:
		axes = figure.add_axes((0, 0, 1, 1), xlim=(low[0], high[0]), ylim=(low[1], high[1]))
		axes.axis("off")
		axes.set_title(title, fontsize=9)
		cracks, blocks = _drawCrackLines(axes, model, shown, names, joints), _drawBlocks(axes, model, shown)
		_drawScale(axes, magnification)
		axes.legend(
			handles=cracks + blocks, title="" if cracks else "no broken joints", loc="upper center", borderaxespad=0,
			bbox_to_anchor=(0.5, -26 * _point / height), ncol=math.ceil(len(cracks + blocks) / len(modes)), columnspacing=1.4, handlelength=2.2
		)
	return path


@door(path='path', model='model', mechanism='motions', title='str')
def drawMechanism(path, model, mechanism, title=""):
	"""How rigid blocks move at once: a mechanism of `limitanalysis`, its largest displacement 5 % of the scene's size. mechanism: velocity of every block's
	centroid and its rotation, (blocks, 3). Returns the path."""
	mechanism = np.asarray(mechanism, float)
	if mechanism.shape != (model.blockCount, 3):
		raise ValueError(f"drawMechanism.mechanism must have the shape ({model.blockCount}, 3), got {mechanism.shape}")
	reference = np.asarray(model.reference)
	owner = np.repeat(np.arange(model.blockCount), np.diff(model.firstNode))
	arm = reference - areasAndCentroids(model)[1][owner]
	motion = mechanism[owner, :2] + mechanism[owner, 2:] * np.column_stack([-arm[:, 1], arm[:, 0]])
	size, largest = np.ptp(reference, axis=0).max(), np.hypot(*motion.T).max()
	shown = reference + (0.05 * size / largest * motion if largest > 0 else 0)
	low, high = _window(reference, shown)
	width, height = (high - low) * min(_textWidth / (high - low)[0], 1.3 * _textWidth / (high - low)[1])
	with _picture(path, width, height) as figure:
		axes = figure.add_axes((0, 0, 1, 1), xlim=(low[0], high[0]), ylim=(low[1], high[1]))
		axes.axis("off")
		axes.set_title(title, fontsize=9)
		_drawBlocks(axes, model, shown)
	return path


def drawSheets(session, film, model, title):
	"""sheet-peak.png and sheet-end.png of a Session: picturesfields.drawSheet of a Film's peak and of the model as it is now."""
	from .picturesfields import drawSheet
	if film.peak: session.picture("sheet-peak.png", drawSheet, film.peak, title=title + ", at the peak")
	session.picture("sheet-end.png", drawSheet, model, title=title + ", at the end")


def drawFilm(session, film, model, title):
	"""movie.gif or movie.mp4 of a Session whose key `movie` says so: the cracks in a Film's frames, at its peak and now."""
	from .picturesfields import drawMovie
	from .snapshot import Snapshot
	from yade.wrapper import Omega
	p = session.parameters
	if p.movie == "none": return
	states = [*film.states(), Snapshot(model, Omega().time, like=film.peak)]
	session.later(drawMovie, session.folder / f"movie.{p.movie}", states, "cracks", title=title)


@contextmanager
def _figure(width, height):
	"""A matplotlib figure of this size [inch] in our style; off pyplot, which belongs to YADE's own plots."""
	import matplotlib
	from matplotlib.backends.backend_agg import FigureCanvasAgg
	from matplotlib.figure import Figure
	with matplotlib.rc_context(_style):
		figure = Figure(figsize=(width, height))
		FigureCanvasAgg(figure)
		yield figure


@contextmanager
def _picture(path, width, height):
	"""A matplotlib figure of this size [inch], saved at the end to a path or a binary file."""
	with _figure(width, height) as figure:
		yield figure
		save = lambda place: figure.savefig(place, format="png", dpi=300, bbox_inches="tight", pad_inches=0.06)
		if hasattr(path, "write"): return save(path)
		with files.replacing(path) as part:
			save(part)


def _drawReference(axes, reference, colour, line):
	if reference.x is not None:
		axes.plot(reference.x, reference.y, color=colour, linestyle=line, linewidth=0.9, label=reference.label)
	elif np.ndim(reference.y) == 0:
		axes.axhline(reference.y, color=colour, linestyle=line, linewidth=0.9, label=f"{reference.label}: {reference.y:.3g}")
	else:
		low, high = reference.y
		axes.axhspan(low, high, color="#E4E4E4", linewidth=0, zorder=0, label=f"{reference.label}: {low:.3g} to {high:.3g}")


def _markPeaks(axes, peaks):
	"""peaks: (seeds, 2)."""
	x, y = peaks.mean(axis=0)
	if len(peaks) == 1:
		axes.plot(x, y, "o", color=_blue, zorder=4, markersize=4, markerfacecolor="white", label=f"peak: {y:.3g}")
	else:
		dx, dy = peaks.std(axis=0, ddof=1)
		axes.errorbar(x, y, dy, dx, "o", color=_black, markersize=3.5, linewidth=0.9, capsize=2.5, zorder=4, label=f"mean peak: {y:.3g} ± {dy:.2g}")


def _drawBlocks(axes, model, shown):
	"""Fills the blocks; the legend's handles."""
	from matplotlib.collections import PathCollection
	from matplotlib.patches import Patch
	from matplotlib.path import Path
	tones = _assigned(model.materialLabels, _blockTones, _spareTones)
	there = Present(model).blocks
	outlines = [rings for rings, kept in zip(blockOutlines(model), there) if kept]
	paths = [Path.make_compound_path(*(Path(shown[np.append(ring, ring[0])], closed=True) for ring in rings)) for rings in outlines]
	colours = [tones[model.materialLabels[material]] for material in np.asarray(model.blockMaterial)[there]]
	axes.add_collection(PathCollection(paths, facecolors=colours, edgecolors="#9C958B", linewidths=0.25, zorder=1), autolim=False)
	present = [label for label in tones if tones[label] in colours]
	return [Patch(facecolor=tones[label], edgecolor="#9C958B", linewidth=0.5, label=label) for label in present]


def _drawCrackLines(axes, model, shown, names=None, joints=None):
	"""Draws the cracks; the legend's handles, all modes of a joint type one after the other."""
	from matplotlib.collections import LineCollection
	from matplotlib.lines import Line2D
	there = Present(model).points & pointsOf(model, joints)
	counts = {pair: count for pair, count in Cracks(model, names).counts(there).items() if any(count.values())}
	colours = _assigned(counts, _jointColours, _spareColours)
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
			style = dict(color=colours[pair], linestyle=_modeStyles[mode], linewidth=width)
			broken = (pairs == pair) & (status == value)
			axes.add_collection(
				LineCollection(_chains(lines[broken], ends[broken]), capstyle="butt", joinstyle="round", zorder=2, **style), autolim=False
			)
			handles.append(Line2D([], [], label=f"{pair}, {mode} ({count[mode]})", **style))
	return handles


def _drawSoftened(axes, model, lines, status, width, there):
	"""Joints that have begun to soften and are not cracked: paler and thinner the less they are damaged; the legend's handle, if there are any."""
	from matplotlib.collections import LineCollection
	from matplotlib.lines import Line2D
	damage = np.asarray(getattr(model, "pointDamage", np.zeros(len(status))))
	begun = (damage > 0.05) & there & (status != modes["tension"]) & (status != modes["shear"])
	if not begun.any(): return []
	shade = damage[begun]
	colours = [(0.8, 0.47, 0.65, 0.25 + 0.75 * value) for value in shade] # of Okabe and Ito, too
	axes.add_collection(LineCollection(lines[begun], colors=colours, linewidths=width * (0.4 + shade), zorder=1.8), autolim=False)
	return [Line2D([], [], color=_purple, linewidth=width, label=f"softening ({np.count_nonzero(begun)})")]


def _lineWidth(axes, lines):
	"""Thinner cracks where joints are short on the paper [points]."""
	left, right = axes.get_xlim()
	scale = axes.figure.get_figwidth() / (right - left) / _point # points per metre of specimen
	joint = 2 * np.median(np.hypot(*(lines[:, 1] - lines[:, 0]).T)) if len(lines) else 0
	return np.clip(0.2 * scale * joint, 0.6, 1.2)


def _chains(lines, ends):
	"""Joins lines that meet end to end, so that dashes run on from one to the next.

	lines: (n, 2, 2) coordinates; ends: (n, 2, 2) integers, equal where two lines meet -> a list of (m, 2) polylines."""
	names = [[tuple(end) for end in pair] for pair in ends.tolist()]
	meeting = defaultdict(list)
	for i, pair in enumerate(names):
		for end in pair:
			meeting[end].append(i)
	unused = set(range(len(lines)))
	chains = []
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
				chains.append(np.array(chain))
	return chains


def _drawScale(axes, magnification, drop=9):
	"""So many points below the specimen: a bar of a round length and what was done to the displacements."""
	from matplotlib.transforms import ScaledTranslation, blended_transform_factory
	left, right = axes.get_xlim()
	width = right - left
	length = _roundDown(width / 5)
	below = blended_transform_factory(axes.transData, axes.transAxes) + ScaledTranslation(0, -drop * _point, axes.figure.dpi_scale_trans)
	left, right = left + 0.015 * width, right - 0.015 * width
	axes.plot([left, left + length], [0, 0], transform=below, color=_black, linewidth=1.5, solid_capstyle="butt", clip_on=False)
	axes.text(left + length + 0.015 * width, 0, f"{length:g} m" if length >= 1 else f"{1e3 * length:g} mm", transform=below, va="center")
	note = "displacements to scale" if magnification == 1 else f"displacements × {magnification:g}"
	axes.text(right, 0, note, transform=below, va="center", ha="right")


def _visible(size, displacement):
	"""The round magnification, at least 1, by which nearly all displacements become 2 % of the specimen's size at most."""
	largest = np.percentile(np.hypot(*displacement.T), 98)
	return max(1, _roundDown(0.02 * size / largest)) if largest > 1e-9 * size else 1


def _window(reference, shown, there=True):
	"""Corners of a view of all that is shown: the deformed shape, and the undeformed one of the same blocks; fragments count that are within the specimen's
	size of it. there: a mask of the grid points of blocks that have not been removed."""
	kept = reference[np.broadcast_to(there, len(reference))]
	low, high = kept.min(axis=0), kept.max(axis=0)
	size = (high - low).max()
	near = ((shown > low - size) & (shown < high + size)).all(axis=1) & there
	low, high = np.minimum(low, shown[near].min(axis=0, initial=np.inf)), np.maximum(high, shown[near].max(axis=0, initial=-np.inf))
	margin = 0.015 * (high - low).max()
	return low - margin, high + margin


def _corners(window):
	"""Lower left and upper right corner of a window (x0, y0, x1, y1)."""
	low, high = np.reshape(window, (2, 2))
	if not (low < high).all(): raise ValueError(f"window must have x0 < x1 and y0 < y1, got {window!r}")
	return low, high


def _roundDown(number):
	"""The next 1, 2 or 5 times a power of ten that is not larger."""
	power = 10.0**math.floor(math.log10(number))
	return max(factor for factor in (1, 2, 5) if factor * power <= number * (1 + 1e-12)) * power


def _assigned(names, known, spare):
	"""A colour for each name: the known one, else one of the spares in turn."""
	rest = cycle(spare)
	return {name: known[name] if name in known else next(rest) for name in names}
