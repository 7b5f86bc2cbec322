# yade-blocks, GPL-2.0-or-later
"""Which parameters govern which quantity.

	scripts/study.sh sensitivity NAME bounds=cohesion:0.5e6:2e6,kn:1e11:1e12,friction:20:50:lin [points=N] [seeds=N] [screen=PERCENT] [key=value ...]

First each key alone is moved from its lower to its upper bound, the others staying in the middle, over the same tessellations. Keys that move no quantity by
more than `screen` percent of its middle value are left out; what acts only together with another key may be missed so. The others are then varied together,
at `points` points (Latin hypercube), `seeds` tessellations each. A polynomial chaos (OpenTURNS) through the means gives Sobol's indices: first order,
what a key governs alone; total, with all that it does together with others. They are shares of the variance that the keys cause; the seeds' share is that of
one run's variance that tessellations cause. Q² is how much of the variance the polynomial predicts at points it was not fitted to (five parts in turn;
the number of terms is the one with the best Q²); of indices with a Q² below 0.7 nothing should be read. Intervals: 5 % to 95 % of fits to points drawn with
replacement. One key of the scenario may have several values (sigma=0.1e6,0.5e6,1e6): each quantity is taken at all of them, with its slope along the key.
Results: study.json, table.md, points.csv, sensitivity.png.
"""
import math

import numpy as np
import pandas

from yadeblocks import scenario

from . import studypicture
from .command import StudyError, bounds, demandResults, good, listed, place, quantitiesOf, reasons
from .lines import along, measure

keys = {"bounds": "", "points": 0, "seeds": 3, "screen": 2.0, "samplerSeed": 1, "bootstrap": 30}
rules = {"points": scenario.notNegative, "screen": scenario.notNegative, "samplerSeed": scenario.notNegative, "bootstrap": scenario.notNegative}
meanings = {
	"bounds": "key:low:high[:lin],... or a file", "points": "sets of parameters; 0: 15 for each key that is left",
	"screen": "percent below which a key is left out", "samplerSeed": "of the Latin hypercube", "bootstrap": "fits for the intervals"
}


def study(command):
	p, edges = command.p, bounds(command.p.bounds)
	seeds = range(p.seed, p.seed + p.seeds)
	middle = {key: 0.5 for key in edges}
	ends = [middle] + [{**middle, key: end} for key in edges for end in (0.0, 1.0)]
	at = lambda units: [{**command.settings, **place(edges, [unit[key] for key in edges])} for unit in units]
	line = along(command.settings)
	measured = measure(command, at(ends), seeds)
	demandResults(measured)
	units = quantitiesOf(measured, () if line else listed(p.quantities))
	screening = {name: screen(list(edges), measured, name) for name in units}
	left = [key for key in edges if any(abs(screening[name][key]["effect"]) > p.screen / 100 for name in units if key in screening[name])]
	if not left: raise StudyError(f"study: no key moves any quantity by more than {p.screen:g} %: screen= must be smaller or the bounds wider")
	count = p.points or 15 * len(left)
	cube = latin(count, len(left), p.samplerSeed)
	varied = measure(command, at([{**middle, **dict(zip(left, row))} for row in cube]), seeds)
	demandResults(varied)
	indices = {}
	for name in units:
		found = analyse(
			cube, [[record["reported"].get(name) for record in good(records).values()] for records in varied], left, p.bootstrap, p.samplerSeed
		)
		if found: indices[name] = found
	report(command, edges, units, screening, left, cube, varied, indices)


def screen(keys, measured, name):
	"""{key: {"effect": change from bound to bound by the middle value, "error": its standard error}} over the seeds that all three points have."""
	value = lambda records: {seed: record["reported"][name] for seed, record in good(records).items() if record["reported"].get(name) is not None}
	middle, found = value(measured[0]), {}
	for i, key in enumerate(keys):
		low, high = value(measured[1 + 2 * i]), value(measured[2 + 2 * i])
		both = [seed for seed in low if seed in high]
		if not both or not middle: continue
		scale = abs(np.mean(list(middle.values()))) or 1.0
		changes = np.array([high[seed] - low[seed] for seed in both]) / scale
		error = changes.std(ddof=1) / math.sqrt(len(both)) if len(both) > 1 else math.nan
		found[key] = {"effect": changes.mean(), "error": error, "low": np.mean(list(low.values())), "high": np.mean(list(high.values()))}
	return found


def latin(count, dimension, seed):
	"""A Latin hypercube of the unit cube."""
	import openturns as ot
	ot.RandomGenerator.SetSeed(seed)
	return np.array(ot.LHSExperiment(ot.ComposedDistribution([ot.Uniform(0, 1)] * dimension), count).generate())


def analyse(cube, values, keys, bootstrap=30, seed=1):
	"""Indices of a quantity: {"first": {key: (value, low, high)}, "total": the same, "Q2", "seeds_share", "points", "sum_first"}, or None if fewer
	than 2 keys + 4 points have values, or they are all the same. values: those of the seeds, for each point."""
	fine = [i for i, row in enumerate(values) if len(row)]
	units, rows = np.asarray(cube)[fine], [np.asarray(values[i], float) for i in fine]
	means = np.array([row.mean() for row in rows])
	if len(fine) < 2 * len(keys) + 4 or not means.std() > 1e-12 * abs(means).max(): return None
	freedom = sum(len(row) - 1 for row in rows)
	within = sum(((row - row.mean())**2).sum() for row in rows) / freedom if freedom else math.nan
	quality, size = max((predicted(units, means, size), size) for size in sizes(len(keys), len(means)))
	result = _chaos(units, means, size)
	variance = float(result["variance"])
	rng, drawn = np.random.default_rng(seed), []
	for _ in range(bootstrap):
		pick = rng.integers(len(means), size=len(means))
		if means[pick].std() > 0: drawn.append(_chaos(units[pick], means[pick], min(size, len(set(pick)) // 2)))
	interval = lambda kind, i: tuple(np.quantile([each[kind][i] for each in drawn], (0.05, 0.95))) if drawn else (math.nan, math.nan)
	rowsOf = lambda kind: {key: (result[kind][i], *interval(kind, i)) for i, key in enumerate(keys)}
	return {
		"first": rowsOf("first"), "total": rowsOf("total"), "Q2": quality, "terms": size, "sum_first": float(sum(result["first"])),
		"seeds_share": within / (within + variance) if within + variance > 0 else math.nan, "scatter_of_seeds": math.sqrt(within),
		"scatter_by_keys": math.sqrt(variance), "mean": float(result["mean"]), "points": len(fine)
	}


def _chaos(units, means, size):
	"""Sobol's indices of a polynomial chaos of so many terms: they are orthogonal, so each one's square is a part of the variance."""
	chaos, powers, centre, scale = _fitted(units, means, size)
	parts = np.array(chaos.getCoefficients())[:, 0]
	acts = powers > 0
	mean = centre + scale * parts[~acts.any(axis=1)].sum()
	parts = parts**2
	variance = parts[acts.any(axis=1)].sum()
	alone = acts.sum(axis=1) == 1
	share = lambda which: float(parts[which].sum() / variance) if variance else 0.0
	return {
		"first": [share(alone & acts[:, i]) for i in range(acts.shape[1])], "total": [share(acts[:, i]) for i in range(acts.shape[1])],
		"variance": variance * scale**2, "mean": mean
	}


def _fitted(units, means, size):
	"""The chaos of (means - centre) / scale by least squares, the powers of its terms, centre and scale. Terms that are of low degree, and of few keys,
	come first."""
	import openturns as ot
	d, centre, scale = units.shape[1], means.mean(), means.std()
	terms = ot.HyperbolicAnisotropicEnumerateFunction(d, 0.7)
	basis = ot.OrthogonalProductPolynomialFactory([ot.LegendreFactory()] * d, terms)
	sample, values = ot.Sample(units.tolist()), ot.Sample([[value] for value in (means - centre) / scale])
	cube = ot.ComposedDistribution([ot.Uniform(0, 1)] * d)
	algorithm = ot.FunctionalChaosAlgorithm(sample, values, cube, ot.FixedStrategy(basis, size), ot.LeastSquaresStrategy(sample, values))
	algorithm.run()
	chaos = algorithm.getResult()
	return chaos, np.array([list(terms(i)) for i in chaos.getIndices()]).reshape(-1, d), centre, scale


def sizes(d, points):
	"""Numbers of terms worth trying: linear, and a sixth, a quarter, two fifths of the points."""
	return sorted({max(d + 1, int(share * points)) for share in (0, 1 / 6, 1 / 4, 2 / 5)})


def predicted(units, means, size, parts=5):
	"""Q²: 1 - squared errors of predictions by their variance; each fifth is predicted from the others."""
	errors = np.empty(len(means))
	order = np.random.default_rng(0).permutation(len(means))
	for part in range(parts):
		out = order[part::parts]
		rest = np.setdiff1d(order, out)
		if means[rest].std() > 0:
			chaos, _, centre, scale = _fitted(units[rest], means[rest], size)
			errors[out] = means[out] - centre - scale * np.array(chaos.getMetaModel()(units[out].tolist()))[:, 0]
		else:
			errors[out] = means[out] - means[rest].mean()
	return float(1 - (errors**2).mean() / means.var())


def report(command, edges, units, screening, left, cube, varied, indices):
	why = reasons(record for records in varied for record in records.values())
	rows = []
	for row, records in zip(cube, varied):
		fine = good(records).values()
		values = {name: [record["reported"].get(name) for record in fine if record["reported"].get(name) is not None] for name in units}
		middle = dict.fromkeys(edges, 0.5)
		middle.update(zip(left, row))
		rows.append({
			**place(edges, list(middle.values())), **{name: np.mean(each) if each else math.nan for name, each in values.items()},
			**{f"{name} scatter": np.std(each, ddof=1) if len(each) > 1 else math.nan for name, each in values.items()}
		})
	pandas.DataFrame(rows).to_csv(command.folder / "points.csv", index=False, float_format="%.6g")
	text = markdown(command, edges, units, screening, left, indices, why)
	(command.folder / "table.md").write_text(text)
	studypicture.drawSensitivity(command.folder / "sensitivity.png", list(units), list(edges), screening, indices, f"{command.stem}: {len(cube)} points")
	command.write(bounds=edges, screening=screening, kept=left, indices=indices, points=len(cube), sampler_seed=command.p.samplerSeed, failed=why)
	print(text)


def markdown(command, edges, units, screening, left, indices, why):
	lines = [
		f"# {command.stem}, what governs it", "",
		"Each key alone, from its lower to its upper bound, the others in the middle (change ± standard error):", ""
	]
	lines += ["| key | bounds | " + " | ".join(units) + " |", "|---" * (2 + len(units)) + "|"]
	for key, (low, high, _) in edges.items():
		cell = lambda name: "{:+.1f} ± {:.1f} %".format(*(100 * screening[name][key][part]
									for part in ("effect", "error"))) if key in screening[name] else ""
		lines.append(f"| {key}{'' if key in left else ' (left out)'} | {low:.4g} to {high:.4g} | " + " | ".join(map(cell, units)) + " |")
	lines += ["", "Sobol's indices, first order / total (5 % to 95 % of the total), shares of the variance that the keys cause:", ""]
	lines += ["| quantity | " + " | ".join(left) + " | sum of first | seeds' share of one run's variance | Q² | points |", "|---" * (5 + len(left)) + "|"]
	for name, found in indices.items():
		cell = lambda key: f"{found['first'][key][0]:.2f} / {found['total'][key][0]:.2f} ({found['total'][key][1]:.2f} to {found['total'][key][2]:.2f})"
		doubt = " (poor)" if not found["Q2"] > 0.7 else ""
		lines.append(
			f"| {name} | " + " | ".join(map(cell, left)) +
			f" | {found['sum_first']:.2f} | {100 * found['seeds_share']:.0f} % | {found['Q2']:.2f}{doubt} | {found['points']} |"
		)
	lines += [""] + [f"- {count} failed: {reason}" for reason, count in why.items()]
	return "\n".join(lines) + "\n"
