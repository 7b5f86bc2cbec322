# yade-blocks, GPL-2.0-or-later
"""A curve with its peak, and what it is compared with."""
from collections import namedtuple
from itertools import cycle

import numpy as np

from .._door import door
from .colours import black, blue, green, purple, vermillion
from .figure import picture, textWidth

#: What a curve is compared with: y is a number (drawn as a line), a pair (a band) or, with x, a measured curve.
Reference = namedtuple("Reference", "label y x", defaults=(None, ))


@door(path='path', curves='table', x='str', y='str', references='sequence', title='str')
def drawCurve(path, curves, x, y, labels=None, references=(), title=""):
	"""The curve y(x) of every seed with its peak or, of several seeds, the mean peak with standard deviations; references.

	curves: a DataFrame with the columns `seed`, x and y, as Results.curves; labels: of the two axes, with units, by default
	the column names; references: a list of Reference, in the units of the columns. Returns the path."""
	for name in ("seed", x, y):
		if name not in curves: raise ValueError(f"drawCurve: {name!r} must be a column of curves; there are {', '.join(map(str, curves.columns))}")
	runs = [run for _, run in curves.groupby("seed")]
	with picture(path, textWidth, 0.6 * textWidth) as figure:
		axes = figure.add_subplot()
		for i, run in enumerate(runs):
			label = "simulation" if len(runs) == 1 else f"simulation, {len(runs)} seeds"
			axes.plot(run[x], run[y], color=blue, zorder=3, linewidth=1.1 if len(runs) == 1 else 0.6, label=None if i else label)
		_markPeaks(axes, np.array([run.loc[run[y].idxmax(), [x, y]] for run in runs], dtype=float))
		for reference, colour, line in zip(references, cycle((vermillion, black, green, purple)), cycle(("--", "-.", ":"))):
			_drawReference(axes, reference, colour, line)

		axes.set(xlabel=labels[0] if labels else x, ylabel=labels[1] if labels else y)
		axes.set_title(title, fontsize=9)
		axes.margins(x=0)
		if curves[y].min() > -0.02 * curves[y].max(): # oscillation about zero is no reason to show negative stresses
			axes.set_ylim(bottom=0)
		axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncol=2)
	return path


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
		axes.plot(x, y, "o", color=blue, zorder=4, markersize=4, markerfacecolor="white", label=f"peak: {y:.3g}")
	else:
		dx, dy = peaks.std(axis=0, ddof=1)
		axes.errorbar(x, y, dy, dx, "o", color=black, markersize=3.5, linewidth=0.9, capsize=2.5, zorder=4, label=f"mean peak: {y:.3g} ± {dy:.2g}")
