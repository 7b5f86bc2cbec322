# yade-blocks, GPL-2.0-or-later
"""Pictures of studies: bands of curves, indices as bars, profiles of parameters."""
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

colours = plt.rcParams["axes.prop_cycle"].by_key()["color"]


def drawEnsemble(path, bands, rows, title):
	"""Left the curves' bands (5 % to 95 % of the runs) and means, right each quantity's mean with its interval and 5 % fractile, as shares of the mean."""
	figure, (left, right) = plt.subplots(1, 2, figsize=(12, 5))
	for number, (label, columns, band, curves) in enumerate(bands):
		colour = colours[number % len(colours)]
		for x, y in curves[:50]:
			left.plot(x, y, color=colour, lw=0.3, alpha=0.4)
		left.fill_between(band["x"], band["low"], band["high"], color=colour, alpha=0.25, lw=0)
		left.plot(band["x"], band["mean"], color=colour, lw=2, label=label)
		left.set_xlabel(columns[0]), left.set_ylabel(columns[1])
	if bands: left.legend(fontsize=8)
	known = [row for row in rows if row["n"] > 1 and row["mean"]]
	for number, row in enumerate(known):
		share = lambda value: value / row["mean"]
		right.plot([share(row["smallest"]), share(row["largest"])], [number] * 2, color="0.7", lw=6, solid_capstyle="butt")
		right.plot([share(row["low"]), share(row["high"])], [number] * 2, color="C0", lw=3, solid_capstyle="butt")
		right.plot([share(row["characteristic"])], [number], "r|", ms=12, mew=2)
	right.axvline(1, color="k", lw=0.5)
	right.set_yticks(range(len(known)), [f"{row['quantity']}\n{row['point']}" for row in known], fontsize=7)
	right.set_xlabel("share of the mean: all runs (grey), 95 % interval of the mean (blue), 5 % fractile (red)", fontsize=8)
	_save(figure, path, title)


def drawSensitivity(path, names, keys, screening, indices, title):
	"""Above the effect of each key alone, from its lower to its upper bound; below first-order and total indices with their intervals."""
	wide = min(len(names), 4) # quantities side by side; the others stand below
	high = math.ceil(len(names) / wide)
	figure, axes = plt.subplots(2 * high, wide, figsize=(max(5, 3.5 * wide), 1.6 + (1 + 0.4 * len(keys)) * 2 * high), squeeze=False)
	for spare in range(len(names), high * wide):
		for below in range(2):
			axes[2 * (spare // wide) + below, spare % wide].axis("off")
	for number, name in enumerate(names):
		upper, lower = (axes[2 * (number // wide) + below, number % wide] for below in range(2))
		effects = [screening[name].get(key, {"effect": np.nan, "error": np.nan}) for key in keys]
		upper.barh(range(len(keys)), [100 * e["effect"] for e in effects], xerr=_known(100 * e["error"] for e in effects), color="0.6")
		upper.set_yticks(range(len(keys)), keys), upper.set_title(name, fontsize=9)
		upper.set_xlabel("change over its bounds [%]", fontsize=8)
		found = indices.get(name)
		if not found: continue
		rows = list(found["first"])
		for shift, kind, colour in ((-0.2, "first", "C0"), (0.2, "total", "C1")):
			values = np.array([found[kind][key] for key in rows]) # value, low, high
			lower.barh(
				np.arange(len(rows)) + shift, values[:, 0], 0.4, color=colour, label=kind, xerr=_known(abs(values[:, 1:].T - values[:, 0])),
				ecolor="0.3"
			)
		lower.set_yticks(range(len(rows)), rows), lower.legend(fontsize=7)
		lower.set_xlabel(f"Sobol index; seeds' share {100 * found['seeds_share']:.0f} %, Q² {found['Q2']:.2f}", fontsize=8)
	_save(figure, path, title)


def drawCalibration(path, profiles, targets, title):
	"""Left, per parameter, how much worse the best fit gets when it is held elsewhere; right the targets with what held-out seeds gave."""
	figure, axes = plt.subplots(1, len(profiles) + 1, figsize=(3.5 * (len(profiles) + 1), 4))
	for axis, (key, profile) in zip(axes, profiles.items()):
		axis.plot(profile["values"], np.minimum(profile["misfit"], 20), "k-")
		axis.axhline(min(profile["misfit"]) + 1, color="0.6", lw=0.7)
		axis.axvline(profile["best"], color="r", lw=0.8)
		axis.set_xlabel(key), axis.set_ylabel("least misfit (chi²)")
	axis = axes[-1]
	for number, (name, row) in enumerate(targets.items()):
		scale = lambda value: (value - row["target"]) / row["tolerance"]
		axis.plot([-1, 1], [number] * 2, color="0.8", lw=8, solid_capstyle="butt")
		if row["mean"] is not None: axis.errorbar([scale(row["mean"])], [number], xerr=[row["error"] / row["tolerance"]], fmt="ro", capsize=3)
	axis.set_yticks(range(len(targets)), list(targets), fontsize=7), axis.set_xlabel("(held-out mean - target) / tolerance")
	_save(figure, path, title)


def _known(errors):
	"""Error bars, none of which is drawn where none is known: of one seed, or without fits to points drawn again."""
	errors = np.array(list(errors), float)
	return errors if np.isfinite(errors).any() else None


def _save(figure, path, title):
	figure.suptitle(title)
	figure.tight_layout(rect=(0, 0, 1, 1 - 0.35 / figure.get_figheight())) # below the title
	figure.savefig(path, dpi=120)
	plt.close(figure)
