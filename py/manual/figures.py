# yade-blocks, GPL-2.0-or-later
"""The figures of the manual: yade -n -x py/manual/figures.py FOLDER draws them all."""
import contextlib
import runpy
import sys
import tempfile
from pathlib import Path

import numpy as np
from matplotlib import rc_context
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

_tone, _other, _blue, _red, _grey = "#EBD3C3", "#DDE6DF", "#0072B2", "#D55E00", "#9C958B"


def _figure(width, height):
	figure = Figure(figsize=(width, height))
	FigureCanvasSVG(figure)
	return figure


def _plain(axes, x, y):
	axes.set(xlim=x, ylim=y, aspect="equal")
	axes.axis("off")


def _arrow(axes, start, end, colour, text="", at=(0, 0)):
	axes.annotate("", end, start, arrowprops=dict(arrowstyle="-|>", color=colour, linewidth=1.4, shrinkA=0, shrinkB=0))
	if text: axes.text(end[0] + at[0], end[1] + at[1], text, color=colour, ha="center", va="center", fontsize=11)


def joint():
	"""Two blocks that have come apart a little, the joint's two contact points, its frame."""
	figure = _figure(7.2, 3.2)
	axes = figure.add_axes((0, 0, 1, 1))
	_plain(axes, (-0.6, 8.4), (-0.2, 3.8))
	lower, shift = np.array([(0, 0), (6, 0.2), (5.4, 1.6), (0.6, 1.6)]), np.array([-0.6, 0.45])
	upper = np.array([(0.6, 1.6), (5.4, 1.6), (5.8, 3.0), (0.3, 3.1)]) + shift
	axes.add_patch(Polygon(lower, facecolor=_tone, edgecolor=_grey)), axes.add_patch(Polygon(upper, facecolor=_other, edgecolor=_grey))
	axes.text(3, 0.75, "block 1", ha="center"), axes.text(2.4, 2.85, "block 2", ha="center")
	for x in (0.6, 5.4):
		one, two = np.array((x, 1.6)), np.array((x, 1.6)) + shift
		axes.plot(*np.array([one, two]).T, color=_blue, linewidth=1, linestyle=":")
		axes.plot(*one, "o", color=_blue, markersize=6), axes.plot(*two, "o", color=_blue, markersize=6, markerfacecolor="white")
		_arrow(axes, (x, 1.6), (x, 2.05), _red), _arrow(axes, (x, 2.05), (x - 0.6, 2.05), _red)
	axes.text(5.48, 1.8, "$u_n$", color=_red, ha="left"), axes.text(5.1, 2.17, "$u_s$", color=_red, ha="center")
	_arrow(axes, (3, 1.6), (3, 2.55), "black", "$n$", (0.22, -0.1)), _arrow(axes, (3, 1.6), (2.2, 1.6), "black", "$t$", (-0.1, -0.25))
	axes.text(6.5, 1.45, "each point: area\n$A = L\\,t/2$", va="center", color=_blue)
	return figure


def law():
	"""Normal and shear stress over opening and slip: brittle and softening."""
	figure = _figure(7.2, 2.8)
	kn, ft, energy = 5.0, 1.0, 1.0
	opening = np.linspace(0, 4, 400)
	left = figure.add_axes((0.07, 0.17, 0.4, 0.75))
	left.plot([-0.35, ft / kn, ft / kn, 4], [-0.35 * kn, ft, 0, 0], color=_blue, label="brittle")
	inelastic = np.linspace(0, 4, 400)
	stress = ft * np.exp(-ft * inelastic / energy)
	left.plot(np.append(0, inelastic + stress / kn), np.append(0, stress), color=_red, linestyle="--", label="softening")
	left.fill_between(inelastic + stress / kn, stress, color=_red, alpha=0.12, linewidth=0)
	left.text(0.9, 0.15, "$G_{fI}$", color=_red), left.text(0.28, 1.02, "$f_t$")
	left.set(xlabel="opening $u_n$", ylabel="$\\sigma$", xlim=(-0.5, 4), ylim=(-1.6, 1.3))
	right = figure.add_axes((0.57, 0.17, 0.4, 0.75))
	cohesion, friction, residual, sigma, ks = 1.0, 1.0, 0.7, -0.7, 4.0
	peak, rest = cohesion - sigma * friction, -sigma * residual
	right.plot([0, peak / ks, peak / ks, 4], [0, peak, rest, rest], color=_blue)
	shear = rest + (peak - rest) * np.exp(-1.2 * opening)
	right.plot(np.append(0, opening + shear / ks), np.append(0, shear), color=_red, linestyle="--")
	right.text(0.55, peak - 0.03, "$c - \\sigma\\,\\tan\\varphi$"), right.text(2.0, rest + 0.32, "$c_{res} - \\sigma\\,\\tan\\varphi_{res}$")
	right.set(xlabel="slip $u_s$", ylabel="$\\tau$", xlim=(0, 4), ylim=(0, 2.1))
	for axes in (left, right):
		axes.set(xticks=[], yticks=[])
		axes.axhline(0, color="black", linewidth=0.6), axes.axvline(0, color="black", linewidth=0.6)
		for side in axes.spines.values():
			side.set_visible(False)
	left.legend(frameon=False, fontsize=9, loc="lower right")
	return figure


def bond():
	"""Bricks with mortar, and what the model makes of them."""
	figure = _figure(7.2, 2.4)
	length, height, gap = 2.1, 0.65, 0.16
	for place, grown in ((0.0, False), (0.5, True)):
		axes = figure.add_axes((place + 0.01, 0.02, 0.48, 0.86))
		_plain(axes, (-0.15, 4.75), (-0.12, 2.6))
		for course in range(3):
			for number in range(-1, 3):
				x0 = number * (length + gap) + (0.5 * (length + gap) if course % 2 else 0)
				x1, y0, edge = x0 + length, course * (height + gap), 2 * (length + gap)
				x0, x1, y0, y1 = (x0 - gap / 2, x1 + gap / 2, y0, y0 + height + gap) if grown else (x0, x1, y0 + gap / 2, y0 + gap / 2 + height)
				x0, x1 = max(x0, -gap / 2), min(x1, edge - gap / 2)
				if x1 - x0 < 0.1: continue
				axes.add_patch(Polygon([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], facecolor=_tone, edgecolor=_grey, linewidth=1))
				if grown and x1 - x0 > length: axes.plot([(x0 + x1) / 2] * 2, [y0, y1], color=_red, linewidth=1, linestyle=":")
		axes.set_title("blocks and joints of the model" if grown else "bricks and mortar", fontsize=10)
		if grown:
			axes.text(3.0, height + gap, "bed", color=_blue, fontsize=9, va="center", ha="center", backgroundcolor="white")
			axes.text(length + gap / 2, 0.4, "head", color=_blue, fontsize=9, va="center", ha="center", backgroundcolor="white")
			axes.text(length / 2, 2.0, "unit", color=_red, fontsize=9, va="center", ha="center", backgroundcolor="white")
	return figure


def builders():
	"""What the builders lay out, as they are called in the code."""
	from yadeblocks.brickwork import englishBond, runningBond, stackBond
	from yadeblocks.jointsets import JointSet, cut
	from yadeblocks.layout import Mortared
	from yadeblocks.rubble import rubble
	from yadeblocks.specimen import rectangle
	from yadeblocks.voussoirs import arch
	brick = dict(length=0.21, height=0.052, joint=0.01)
	sets = [JointSet("bedding", 15, 0.09), JointSet("cross", -70, 0.13, persistence=0.8, scatter=0.1, seed=3)]
	shown = [("runningBond, crack=True, openings", runningBond(3.5, 8, crack=True, openings=[(0.33, 0.124, 0.55, 0.372)], **brick)),
			("stackBond", stackBond(3.5, 8, **brick)), ("englishBond", englishBond(3.5, 8, width=0.1, **brick)),
			("Mortared(runningBond(...), 0.01)", Mortared(runningBond(3.5, 8, **brick), 0.01)),
			("rubble, flatness=1.5, Mortared", Mortared(rubble(rectangle(0, 0, 0.77, 0.496), 0.11, flatness=1.5), 0.012)),
			("arch", arch(radius=0.42, thickness=0.1, count=15, chords=3)),
			("cut by two JointSets and a crack", cut(rectangle(0, 0, 0.77, 0.496), sets, cracks={"fault": [(0, 0.33), (0.3, 0.28), (0.77, 0.07)]}))]
	figure = _figure(7.2, 2.9)
	for number, (name, layout) in enumerate(shown):
		axes = figure.add_axes((0.01 + 0.25 * (number % 4), 0.5 - 0.49 * (number // 4), 0.23, 0.43))
		stones = getattr(layout, "blocks", layout)
		if stones is not layout:
			axes.add_patch(Polygon(rectangle(*_bounds([ring for ring, _ in layout.mortar])), facecolor="#F6F3EA", edgecolor="none"))
		tones = {"whole": _tone, "half": _other, "part": "#E3DDEA"}
		for ring, kind in zip(stones.outlines, stones.kinds):
			axes.add_patch(Polygon(ring, facecolor=tones.get(kind, _tone), edgecolor=_grey, linewidth=0.7))
		x0, y0, x1, y1 = stones.bounds
		_plain(axes, (x0 - 0.01, x1 + 0.01), (y0 - 0.01, y1 + 0.01))
		axes.set_title(name, fontsize=7)
	return figure


def mechanism(path):
	"""That of the example of limit analysis, which is run for it."""
	import yadeblocks
	from yade import O
	from yadeblocks.pictures import drawMechanism
	example = Path(yadeblocks.__file__).resolve().parents[2] / "scripts/examples/limit.py" # within YADE __file__ is YADE's
	O.reset()
	with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
		found = runpy.run_path(str(example))
	drawMechanism(path, found["model"], found["limit"].mechanism)


def _bounds(rings):
	points = np.vstack(rings)
	return (*points.min(axis=0), *points.max(axis=0))


def write(folder):
	"""All figures."""
	folder = Path(folder)
	folder.mkdir(parents=True, exist_ok=True)
	with rc_context({"font.size": 10, "mathtext.fontset": "dejavuserif", "svg.hashsalt": "manual"}):
		for draw in (joint, law, bond, builders):
			draw().savefig(folder / f"{draw.__name__}.svg", metadata={"Date": None})
	mechanism(folder / "mechanism.png")


if __name__ == "__main__" and len(sys.argv) > 1: write(sys.argv[1])
