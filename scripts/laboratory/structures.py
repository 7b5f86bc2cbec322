# yade-blocks, GPL-2.0-or-later
"""Structures at three costs: the error of each quantity that has an expected value, over the CPU time of the run."""
import math
from pathlib import Path

import numpy as np

from .jobs import Job

_curves = {"vtk": False, "sheets": False} # nothing else is drawn
#: Scenario -> (quantities, three settings from cheap to dear).
costs = {
	"drywall": (("limit_multiplier", ), ({"precision": 2e-2, "steps": 1000}, {}, {"precision": 5e-4, "steps": 16000})),
	"arch": (("limit_thickness_ratio", ), ({"precision": 2e-2}, {}, {"precision": 5e-4})),
	"rocking": (("quarter_period", ), ({"kn": 1e8}, {}, {"kn": 1e12})),
	"disc": (("centre_stress", ), ({"zone": 4e-3, "vtk": False}, {"vtk": False}, {"zone": 1e-3, "vtk": False})),
	"diagonal": (("centre_tension_by_load", ), ({"zone": 0.06, "steps": 10000}, {}, {"zone": 0.01, "steps": 60000})),
	"triplet": (("cohesion", "friction"), ({"steps": 2500}, {}, {"steps": 40000})),
	"wall": (("peak_shear_force", "force_at_0.2_mm"), ({"steps": 20000, **_curves}, _curves, {"steps": 160000, **_curves})),
} # yapf: disable


def jobsOf(names=tuple(costs)):
	"""All runs."""
	return [Job(name, settings, None) for name in names for settings in costs[name][1]]


def rows(record):
	"""Scenario, settings, quantity, CPU seconds, measured, expected, error for all runs; record: Job -> what Jobs.record gives."""
	for name, (quantities, settings) in costs.items():
		for some in settings:
			kept = record(Job(name, some, None)) or {"failed": "not run"}
			for quantity in quantities:
				row = dict(
					scenario=name, settings=" ".join(f"{key}={value}" for key, value in some.items() if key not in ("vtk", "sheets")),
					quantity=quantity
				)
				if "failed" in kept: yield {**row, "failed": kept["failed"]}
				else:
					measured, expected = kept["reported"][quantity], kept["expected"].get(quantity)
					yield {
						**row, "cpu_s": kept["cost"]["cpu_s"], "measured": measured, "expected": expected,
						"error": (measured - expected) / expected if expected else math.nan
					}


def asMarkdown(all):
	"""The table."""
	lines = ["| scenario | settings | quantity | expected | measured | error | CPU s |", "|---|---|---|---|---|---|---|"]
	for row in all:
		numbers = f"| {row['failed']} | | |" if "failed" in row else f"{row['measured']:.4g} | {100 * row['error']:+.2f} % | {row['cpu_s']:.2g} |"
		expected = "" if "failed" in row else f"{row['expected']:.4g}"
		lines.append(f"| {row['scenario']} | {row['settings'] or 'default'} | {row['quantity']} | {expected} | {numbers}")
	return "\n".join(lines) + "\n"


def draw(path, all):
	"""The size of the error over CPU seconds, a line for each quantity; its sign by the markers: filled above what is expected, open below."""
	from yadeblocks.pictures.figure import picture
	groups = {}
	for row in all:
		if "failed" not in row and row["error"] and not math.isnan(row["error"]):
			groups.setdefault((row["scenario"], row["quantity"]), []).append((row["cpu_s"], 100 * row["error"]))
	with picture(path, 6.3, 4) as figure:
		axes = figure.add_subplot(xscale="log", yscale="log", xlabel="CPU time [s]", ylabel="size of the error [%]; filled: too high, open: too low")
		for (name, quantity), places in groups.items():
			seconds, error = np.array(sorted(places)).T
			line, = axes.plot(seconds, abs(error), linewidth=0.9, label=f"{name}, {quantity.replace('_', ' ')}")
			for high, face in ((True, line.get_color()), (False, "white")):
				chosen = (error > 0) == high
				axes.plot(seconds[chosen], abs(error)[chosen], "o", markersize=4, color=line.get_color(), markerfacecolor=face)
		axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1))


def report(record, folder):
	"""structures.md, .csv and .png in a folder; the table."""
	import pandas
	all = list(rows(record))
	folder = Path(folder)
	pandas.DataFrame(all).to_csv(folder / "structures.csv", index=False, float_format="%.6g")
	text = asMarkdown(all)
	(folder / "structures.md").write_text("# Structures at three costs\n\n" + text)
	draw(folder / "structures.png", all)
	return text
