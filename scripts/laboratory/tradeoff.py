# yade-blocks, GPL-2.0-or-later
"""What error costs what time: summaries over seeds, the Pareto front, the cheapest setting for a wanted error, the reading in words.

An error over several seeds is Error(mean, scatter, rms): rms = sqrt(mean of the squares) is what counts, since a mean may be small by
luck. Errors are against the laboratory (the same value for all seeds) or against a reference (each seed's own slow run).
"""
import math
from typing import NamedTuple

import numpy as np

#: The first one is the quantity that plots and readings are about.
quantities = {
	"tension": ("peak_tensile_stress", "joint_stiffness"), "shear": ("peak_shear_stress", "residual_shear_stress", "shear_stiffness"),
	"compression": ("compressive_strength", "youngs_modulus")
}
shortNames = {
	"peak_tensile_stress": "peak", "peak_shear_stress": "peak", "compressive_strength": "peak", "residual_shear_stress": "residual",
	"joint_stiffness": "stiffness", "shear_stiffness": "stiffness", "youngs_modulus": "stiffness"
}

#: Knobs that change the specimen or its parameters, not only the way it is computed: their points are no settings to choose for a wanted error.
specimenKnobs = ("size", "plane", "units", "radius", "softening", "one set", "low friction")


class Error(NamedTuple):
	"""Relative error over seeds: its mean, the sample standard deviation, the root of the mean square, and of how many seeds."""
	mean: float
	scatter: float
	rms: float
	seeds: int


def errorOf(values, truths):
	"""The Error of values against truths (one for each, or one for all); None without any pair of numbers."""
	truths = truths if np.ndim(truths) else [truths] * len(values)
	relative = np.array([value / truth - 1 for value, truth in zip(values, truths) if value is not None and truth])
	if not len(relative):
		return None
	scatter = relative.std(ddof=1) if len(relative) > 1 else math.nan
	return Error(relative.mean(), scatter, math.sqrt((relative**2).mean()), len(relative))


class Row(NamedTuple):
	"""A point of the study, over its seeds. cpu: median CPU time of a run [s], including the building of the specimen."""
	case: str # tension, "shear 0.5", ...
	model: str # blocks or a sphere model
	knob: str # what this point varies
	label: str # settings in a few words
	seeds: int # runs that gave a result
	cpu: float
	values: dict # quantity: (mean, scatter)
	laboratory: dict # quantity: Error
	reference: dict # quantity: Error
	failed: str = "" # reason, if any run failed
	isReference: bool = False
	rising: int = 0 # runs whose stress did not fall after its highest value: no peak

	@property
	def sound(self):
		"""Whether every run gave a result, with a peak: a setting must work for every seed."""
		return not self.failed and not self.rising

	def worst(self, kind):
		"""The largest rms over all quantities."""
		errors = [error.rms for error in getattr(self, kind).values() if error]
		return max(errors) if errors else math.nan

	def rms(self, kind, quantity):
		error = getattr(self, kind).get(quantity)
		return error.rms if error else math.nan


def summarise(case, model, knob, label, names, results, truths, references, isReference=False):
	"""The Row of a point. results: what jobs.result gave, by seed (None: not run yet); truths: {quantity: laboratory value or None};
	references: results of the reference, by seed."""
	good = {seed: result for seed, result in results.items() if result and "failed" not in result}
	reasons = sorted({result["failed"] for result in results.values() if result and "failed" in result})
	measured = {name: [result["measures"][name] for result in good.values() if name in result["measures"]] for name in names}
	mean = lambda values: (float(np.mean(values)), float(np.std(values, ddof=1)) if len(values) > 1 else math.nan) if values else (math.nan, math.nan)

	def against(name):
		known = {seed: other["measures"][name] for seed, other in references.items() if other and name in other.get("measures", {})}
		pairs = [(result["measures"][name], known[seed]) for seed, result in good.items() if seed in known and name in result["measures"]]
		return errorOf(*zip(*pairs)) if pairs else None

	missing = sum(result is None for result in results.values())
	failed = "; ".join(reasons + [f"{missing} of {len(results)} not run"] * bool(missing))
	return Row(
		case, model, knob, label, len(good),
		float(np.median([result["cost"]["cpu_s"] for result in good.values()])) if good else math.nan,
		{name: mean(values) for name, values in measured.items()}, {name: errorOf(values, truths.get(name)) for name, values in measured.items()},
		{} if isReference else {name: against(name) for name in names}, failed, isReference,
		sum(bool((result.get("quality") or {}).get("without_peak")) for result in good.values())
	)


def pareto(points):
	"""Indices of the (cost, error) pairs that no other pair beats in both, by rising cost. NaN never belongs to them."""
	front, best = [], math.inf
	for i in sorted((i for i, point in enumerate(points) if not any(map(math.isnan, point))), key=lambda i: points[i]):
		if points[i][1] < best:
			front.append(i)
			best = points[i][1]
	return front


def cheapest(rows, limit, error):
	"""The row of the lowest cost whose error(row) is within the limit, or None. Rows of which a run failed do not count."""
	fit = [row for row in rows if row.sound and error(row) <= limit]
	return min(fit, key=lambda row: row.cpu) if fit else None


def reading(rows, names, limits=(0.05, 0.02, 0.01), most=10):
	"""What the plot of one case shows, in at most so many lines; what failed is always among them. names: the quantities, the peak first."""
	peak, lines = names[0], []
	exact = any(row.isReference and row.label.startswith("events") for row in rows) # no setting is to be judged by itself
	left = (*specimenKnobs, "half as slow", "slow") + ("solver", ) * exact
	blocks = [row for row in rows if row.model == "blocks" and not row.isReference and row.knob not in left]
	others = [row for row in rows if row.model != "blocks" and not row.isReference]
	check = next((row for row in rows if row.model == "blocks" and row.knob == "half as slow"), None)
	known = check.reference if check else {}
	if known.get(peak):
		moves = ", ".join(f"{shortNames[name]} {_signed(known[name].mean)} ± {_percent(known[name].scatter)}" for name in names if known.get(name))
		lines.append(
			f"Errors are rms over {known[peak].seeds} seeds against each seed's own slow run; that one moves when loaded twice as fast: {moves}."
		)
	slow = next((row for row in rows if row.model == "blocks" and row.knob == "slow" and row.reference.get(peak)), None)
	if slow:
		moves = ", ".join(
			f"{shortNames[name]} {_signed(slow.reference[name].mean)} ± {_percent(slow.reference[name].scatter)}" for name in names
			if slow.reference.get(name)
		)
		lines.append(
			f"Errors are rms over {slow.reference[peak].seeds} seeds against each seed's own cascades from event to event; "
			f"a slow run ({slow.label}) is off by: {moves}."
		)
	path = [row for row in rows if row.knob == "solver" and exact and row.seeds]
	if path:
		told = "; ".join(f"{row.label} ({row.cpu:.2g} CPU s)" + _off(row, peak) for row in path)
		lines.append(f"From event to event, without time steps: {told}.")
	said = [text for text in (_bestFor(blocks, name, known.get(name), limits) for name in names) if text]
	lines += said[:1]
	converged = [row for row in rows if row.model == "blocks" and row.isReference and row.laboratory.get(peak)]
	near = converged or [row for row in blocks if row.sound and row.laboratory.get(peak)]
	if near:
		lines.append(
			f"Laboratory: {near[0].label if not converged or near[0].label.startswith('events') else 'the slow run'} gives " +
			_laboratory(near[0], names) + "."
		)
	soft = [row for row in rows if row.knob == "softening" and row.sound and not math.isnan(row.rms("reference", peak))]
	if soft:
		told = "; ".join(f"{row.label} {_percent(row.rms('reference', peak))} ({row.cpu:.2g} CPU s)" for row in soft)
		lines.append(f"Against their own slow runs: {told}; against the laboratory the last gives {_laboratory(soft[-1], names)}.")
	best = {}
	for row in others:
		if row.knob not in specimenKnobs and row.sound and row.laboratory.get(peak):
			best[row.model] = min(best.get(row.model, row), row, key=lambda row: row.rms("laboratory", peak))
	if best:
		told = [
			f"{row.model} {_laboratory(row, names)} ({row.cpu:.2g} CPU s)"
			for row in sorted(best.values(), key=lambda row: row.rms("laboratory", peak))
		]
		lines.append("YADE's own models against the laboratory, each calibrated for this experiment: " + "; ".join(told) + ".")
	for knob, words in (("one set", "With the parameters of tension"), ("low friction", "With a friction of 5°")):
		told = [f"{row.model} {_laboratory(row, names)}" for row in rows if row.knob == knob and row.laboratory.get(peak)]
		if told: lines.append(f"{words}: " + "; ".join(told) + ".")
	knob = _worstKnob(blocks, peak)
	lines += [knob] * bool(knob) + said[1:]
	rates = [row for row in others if row.knob == "steps" and not math.isnan(row.rms("reference", peak))]
	if rates:
		lines.append(
			"YADE's own models against their own slow runs: " +
			"; ".join(f"{row.model} {row.label} {_percent(row.rms('reference', peak))} ({row.cpu:.2g} s)" for row in rates) + "."
		)
	warnings = []
	for words, told in (("Not all seeds were run (yet)", [
		row for row in rows if row.failed.endswith("not run")
	]), ("Failed, see the table", [row for row in rows if row.failed and not row.failed.endswith("not run")]),
				("Without a peak in some runs, whose stress had not fallen when they ended", [row for row in rows if row.rising])):
		if told:
			warnings.append(f"{words}: " + "; ".join(f"{row.model} {row.label}" for row in told) + ".")
	return lines[:max(0, most - len(warnings))] + warnings


def _off(row, peak):
	"""How far a way along the exact path is from the reference, in words; nothing where it is the same."""
	rms = row.rms("reference", peak)
	return "" if math.isnan(rms) or rms < 5e-5 else f", whose peak is off by {_percent(rms)}"


def _bestFor(blocks, name, known, limits):
	"""The cheapest settings for the limits, in one line; None where nothing is compared. The reference's own uncertainty counts as error:
	known is how far it moves when loaded twice as fast."""
	unknown = known.rms if known else 0.0
	error = lambda row: math.hypot(row.rms("reference", name), unknown)
	compared = [row for row in blocks if row.sound and not math.isnan(row.rms("reference", name))]
	if not compared:
		return None
	told = []
	for limit in limits:
		row = cheapest(compared, limit, error)
		if unknown > limit: told.append(f"{_percent(limit)}: cannot be judged, the reference is known to {_percent(unknown)} only")
		elif row: told.append(f"{_percent(limit)}: {row.label} ({row.cpu:.2g} CPU s, {_percent(row.rms('reference', name))})")
		else:
			best = min(compared, key=error)
			told.append(
				f"{_percent(limit)}: none of the settings tried, the best is {best.label} "
				f"({best.cpu:.2g} CPU s, {_percent(best.rms('reference', name))})"
			)
		if unknown > limit or not row: break
	return f"For the {shortNames[name]} within " + "; ".join(told) + "."


def _worstKnob(rows, peak):
	"""What each knob does to the error of the peak at the same number of steps (labels begin alike)."""
	rms = lambda row: row.rms("reference", peak)
	plain, said = [row for row in rows if row.knob == "steps" and not math.isnan(rms(row))], {}
	for row in rows:
		base = max((base for base in plain if row.label.startswith(base.label + " ")), key=lambda base: len(base.label), default=None)
		if base and not math.isnan(rms(row)):
			change = abs(math.log(max(rms(row), 1e-4) / max(rms(base), 1e-4)))
			said[row.knob] = max(
				said.get(row.knob, (-1, "")),
				(change, f"{row.label} {_percent(rms(row))} ({row.cpu:.2g} s) instead of {_percent(rms(base))} ({base.cpu:.2g} s)")
			)
	return "What moves it: " + "; ".join(text for change, text in sorted(said.values(), reverse=True)[:4]) + "." if said else None


def _laboratory(row, names):
	said = [
		f"{shortNames[name]} {_signed(row.laboratory[name].mean)} ± {_percent(row.laboratory[name].scatter)}" for name in names
		if row.laboratory.get(name)
	]
	return ", ".join(said)


def _percent(fraction):
	return "-" if fraction is None or math.isnan(fraction) else _digits(100 * fraction) + " %"


def _signed(fraction):
	return _digits(100 * fraction, "+") + " %"


def _digits(number, sign=""):
	"""Two digits, whole numbers from ten on, nothing below a hundredth."""
	if abs(number) < 0.01:
		return sign + "0"
	return f"{number:{sign}.0f}" if abs(number) >= 9.95 else f"{number:{sign}.2g}"


def asRecords(rows):
	"""The table as flat dictionaries, one a row, for a CSV file."""
	for row in rows:
		record = {
			"case": row.case, "model": row.model, "knob": row.knob, "setting": row.label, "seeds": row.seeds, "cpu_s": row.cpu,
			"reference": row.isReference
		}
		for name, (value, scatter) in row.values.items():
			record[name], record[f"{name} scatter"] = value, scatter
			for kind in ("laboratory", "reference"):
				for part, number in zip(("error", "error scatter", "error rms"), getattr(row, kind).get(name) or (math.nan, ) * 3):
					record[f"{name} {kind} {part}"] = number
		yield {**record, "without peak": row.rising, "failed": row.failed}


def asMarkdown(rows, names):
	"""The table: for each quantity the error against the laboratory and against the reference, mean ± scatter; * is on the Pareto front of
	its case and model family (peak against reference)."""
	front = {
		id(row) for case in {row.case for row in rows} for family in (True, False)
		for row in _front([r for r in rows
					if r.case == case and (r.model == "blocks") == family and not r.isReference and r.knob not in specimenKnobs], names[0])
	}
	head = ["case", "model", "setting", "seeds", "CPU s"] + [f"{shortNames[name]}, {kind}" for name in names for kind in ("laboratory", "reference")]
	lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
	for row in rows:
		cells = [
			row.case, row.model, row.label + (" *" if id(row) in front else "") + (" (reference)" if row.isReference else "") +
			(f", {row.rising} without peak" if row.rising else ""),
			str(row.seeds), "-" if math.isnan(row.cpu) else f"{row.cpu:.2g}"
		]
		cells += [
			f"{_signed(error.mean)} ± {_percent(error.scatter)}" if error else "" for name in names
			for error in (row.laboratory.get(name), row.reference.get(name))
		]
		lines.append("| " + " | ".join(cells) + " |" + (f" failed: {row.failed}" if row.failed and not row.seeds else ""))
		if row.failed: lines[-1] = lines[-1].replace(f"| {row.seeds} |", f"| {row.seeds} ({row.failed}) |", 1).removesuffix(f" failed: {row.failed}")
	return "\n".join(lines)


def _front(rows, peak):
	rows = [row for row in rows if row.sound]
	return [rows[i] for i in pareto([(row.cpu, row.rms("reference", peak)) for row in rows])]
