# yade-blocks, GPL-2.0-or-later
"""Error over CPU seconds, log-log, with the Pareto fronts marked and the reading beside it."""
import math
import textwrap
from pathlib import Path

from .tradeoff import pareto, shortNames, specimenKnobs

# Okabe and Ito's colours, as in pictures.py; a marker for each, for grey prints
_looks = {
	"blocks": ("#0072B2", "o"), "jcfpm": ("#D55E00", "s"), "jcfpmSmooth": ("#E69F00", "D"), "cohfrict": ("#009E73", "^"), "cpm": ("#CC79A7", "v"),
	"lourenco": ("#000000", "P"), "polyhedra": ("#56B4E9", "X")
}
_floor = 1e-4 # errors below are drawn here


def drawTradeoff(path, cases, names, lines, title=""):
	"""One row of two panels for each case: rms error of the peak against the reference and against the laboratory; the reading below.

	cases: {case: rows}; names: quantities, the peak first; lines: of the reading. Filled markers and the line are the Pareto front of
	the blocks and, apart, of all spheres; what is dominated is hollow."""
	import matplotlib
	from matplotlib.backends.backend_agg import FigureCanvasAgg
	from matplotlib.figure import Figure
	from matplotlib.lines import Line2D
	style = {
		"font.size": 8, "font.family": "DejaVu Sans", "legend.fontsize": 7, "legend.frameon": False, "axes.linewidth": 0.6, "axes.spines.top": False,
		"axes.spines.right": False
	}
	text = [part for line in lines for part in textwrap.wrap(line, 150, subsequent_indent="    ")]
	with matplotlib.rc_context(style):
		panels, words = 2.9 * len(cases) + 0.5, 0.135 * len(text) + 0.25
		figure = Figure(figsize=(8.2, panels + words))
		FigureCanvasAgg(figure)
		grid = figure.add_gridspec(
			len(cases), 2, left=0.075, right=0.955, top=1 - 0.7 / (panels + words), bottom=(words + 0.55) / (panels + words), wspace=0.2,
			hspace=0.35
		)
		for i, (case, rows) in enumerate(cases.items()):
			for j, (kind, against) in enumerate((("reference", "its own reference"), ("laboratory", "the laboratory"))):
				axes = figure.add_subplot(grid[i, j])
				axes.set_ylabel("rms error [%]")
				if kind == "laboratory": shown = [row for row in rows if row.knob not in ("one set", "low friction")]
				else: shown = [row for row in rows if not row.isReference and row.knob not in specimenKnobs]
				_panel(axes, shown, kind, names)
				axes.set_title(f"{case}: {shortNames[names[0]]} against {against}", loc="left", fontsize=8)
				if i == len(cases) - 1: axes.set_xlabel("CPU time of a run [s]")
		models = [model for model in _looks if any(row.model == model for rows in cases.values() for row in rows)]
		figure.legend(
			handles=[Line2D([], [], color=_looks[m][0], marker=_looks[m][1], markersize=5, linestyle="none", label=m) for m in models],
			ncols=len(models), loc="upper left", bbox_to_anchor=(0.01, 1 - 0.22 / (panels + words)), handletextpad=0.2, columnspacing=1.5
		) # above the panels, where no point can be
		figure.text(0.02, (words - 0.05) / (panels + words), "\n".join(text), va="top", fontsize=7, linespacing=1.35)
		figure.suptitle(title, x=0.02, ha="left", fontsize=9, y=1 - 0.1 / (panels + words), va="top")
		Path(path).parent.mkdir(parents=True, exist_ok=True)
		figure.savefig(path, dpi=160)
	return path


def _panel(axes, rows, kind, names):
	peak = names[0]
	from matplotlib.ticker import FuncFormatter
	labels = []
	shown = {row.model: [r for r in rows if r.model == row.model and not math.isnan(r.rms(kind, peak))] for row in rows}
	for family in ([m for m in shown if m == "blocks"], [m for m in shown if m != "blocks"]):
		mine = [row for model in family for row in shown[model]]
		points = [(row.cpu, max(100 * row.rms(kind, peak), 100 * _floor)) for row in mine]
		front = pareto([point if row.sound else (math.nan, math.nan) for row, point in zip(mine, points)])
		colour = _looks[family[0]][0] if family == ["blocks"] else "#888888"
		axes.plot([points[k][0] for k in front], [points[k][1] for k in front], color=colour, linewidth=0.8, zorder=2)
		for k, (row, (x, y)) in enumerate(zip(mine, points)):
			tone, marker = _looks[row.model]
			axes.plot(
				x, y, marker, color=tone, markersize=5, markerfacecolor=tone if k in front else "white", markeredgewidth=0.9, zorder=3,
				linestyle="none"
			)
		labels += [(mine[k].label, points[k], colour) for k in front]
	if not any(shown.values()):
		axes.set_axis_off()
		axes.text(0, 0.8, "no slow runs in this mode", transform=axes.transAxes, fontsize=7, color="#888888")
		return
	axes.set(xscale="log", yscale="log")
	for level in (5, 2, 1):
		axes.axhline(level, color="#CCCCCC", linewidth=0.5, zorder=0)
	for axis in (axes.xaxis, axes.yaxis):
		axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
		axis.set_minor_formatter(FuncFormatter(lambda value, _: f"{value:g}" if f"{value:e}"[0] in "25" else ""))
	axes.tick_params(which="both", labelsize=7)
	_write(axes, labels)


def _write(axes, labels):
	"""Writes (text, point, colour) beside the points, each at the first of some places where it covers no other text."""
	renderer, taken = axes.figure.canvas.get_renderer(), []
	for text, point, colour in labels:
		for place in [(4, 3 + 6.5 * row) for row in (0, -1.6, 1, -2.6, 2, -3.6, 3, -4.6, 4)]:
			label = axes.annotate(text, point, xytext=place, textcoords="offset points", fontsize=5.5, color=colour)
			box = label.get_window_extent(renderer)
			if not any(box.overlaps(other) for other in taken): break
			label.remove()
		else:
			continue # a front too crowded to be read: the table has it
		taken.append(box)
