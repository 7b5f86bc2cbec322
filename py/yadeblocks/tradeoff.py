# yade-blocks, GPL-2.0-or-later
"""What error costs what time: summaries over seeds, the Pareto front, the cheapest setting for a wanted error, the reading in words.

An error over several seeds is Error(mean, scatter, rms): rms = sqrt(mean of the squares) is what counts, since a mean may be small by
luck. Errors are against the laboratory (the same value for all seeds) or against a reference (each seed's own slow run).
"""
import math
from typing import NamedTuple, Optional

import numpy as np

#: The first one is the quantity that plots and readings are about.
quantities = {
        "tension": ("peak_tensile_stress", "joint_stiffness"),
        "shear": ("peak_shear_stress", "residual_shear_stress", "shear_stiffness"),
        "compression": ("compressive_strength", "youngs_modulus")
}
shortNames = {
        "peak_tensile_stress": "peak", "peak_shear_stress": "peak", "compressive_strength": "peak", "residual_shear_stress": "residual",
        "joint_stiffness": "stiffness", "shear_stiffness": "stiffness", "youngs_modulus": "stiffness"
}


#: Knobs that change the specimen, not only the way it is computed: their points are no settings to choose for a wanted error.
specimenKnobs = ("size", "plane", "units", "radius", "one set")


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
	measured = {name: [result["measures"][name] for result in good.values()] for name in names}
	mean = lambda values: (float(np.mean(values)), float(np.std(values, ddof=1)) if len(values) > 1 else math.nan) if values else (math.nan, math.nan)

	def against(name):
		pairs = [(result["measures"][name], references[seed]["measures"][name]) for seed, result in good.items()
		         if references.get(seed) and "failed" not in references[seed]]
		return errorOf(*zip(*pairs)) if pairs else None

	missing = sum(result is None for result in results.values())
	failed = "; ".join(reasons + [f"{missing} of {len(results)} not run"] * bool(missing))
	return Row(
	        case, model, knob, label, len(good), float(np.median([result["cost"]["cpu_s"] for result in good.values()])) if good else math.nan,
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
	"""The row of the lowest cost whose error(row) is within the limit, or None. Rows of which a run failed do not count: a setting
	must work for every seed."""
	fit = [row for row in rows if not row.failed and error(row) <= limit]
	return min(fit, key=lambda row: row.cpu) if fit else None


def reading(case, rows, check, names, limits=(0.05, 0.02, 0.01)):
	"""Up to ten lines that say what the plot shows. check: how far the reference itself moves when its rate is doubled, an Error or
	None; names: the quantities, the peak first."""
	peak, lines = names[0], []
	blocks = [row for row in rows if row.model == "blocks" and not row.isReference and row.knob not in specimenKnobs]
	spheres = [row for row in rows if row.model != "blocks"]
	if check:
		lines.append(f"Errors are rms over {check.seeds} seeds against each seed's own slow run; that one moves by {_signed(check.mean)} ± {_percent(check.scatter)} when loaded twice as fast.")
	unknown = check.rms if check else 0.0
	compared = any(not math.isnan(row.rms("reference", peak)) for row in blocks)
	if compared and unknown > min(limits):
		lines.append(f"Errors below {_percent(unknown)} cannot be judged: the reference is not known better; mode=full has a slower one.")
	for limit in limits if compared else ():
		if unknown > limit: continue
		row = cheapest(blocks, limit, lambda row: row.rms("reference", peak))
		if row:
			every = cheapest(blocks, limit, lambda row: row.worst("reference"))
			lines.append(f"{_percent(limit)} in the peak: {row.label} ({row.cpu:.2g} CPU s, {_percent(row.rms('reference', peak))})" + (
			        "; in every quantity: " + (f"{every.label} ({every.cpu:.2g} CPU s)" if every else "none of the settings tried") + "."))
		else:
			best = min((row for row in blocks if not row.failed and not math.isnan(row.rms("reference", peak))), key=lambda row: row.rms("reference", peak), default=None)
			lines.append(f"{_percent(limit)} in the peak: none of the settings tried" + (f"; the best is {best.label} ({best.cpu:.2g} CPU s, {_percent(best.rms('reference', peak))})." if best else "."))
	knob = _worstKnob(blocks, peak)
	if knob:
		lines.append(knob)
	near = [row for row in blocks if not row.failed and row.laboratory.get(peak)]
	converged = [row for row in rows if row.model == "blocks" and row.isReference and row.laboratory.get(peak)]
	if near or converged:
		row = (converged or near)[0]
		lines.append(f"Laboratory: {'the slow run' if converged else row.label} gives " + _laboratory(row, names) + ".")
	best = {}
	for row in spheres:
		if row.knob not in ("one set", "radius") and not row.failed and row.laboratory.get(peak):
			best[row.model] = min(best.get(row.model, row), row, key=lambda row: row.rms("laboratory", peak))
	if best:
		said = [f"{row.model} {_laboratory(row, names)} ({row.cpu:.2g} CPU s)" for row in sorted(best.values(), key=lambda row: row.rms("laboratory", peak))]
		lines.append("Spheres against the laboratory, each model calibrated for this experiment: " + "; ".join(said) + ".")
	foreign = [f"{row.model} {_laboratory(row, names)}" for row in spheres if row.knob == "one set" and row.laboratory.get(peak)]
	if foreign:
		lines.append("Spheres with the parameters found in tension: " + "; ".join(foreign) + ".")
	rates = [f"{row.model} {row.label} {_percent(row.rms('reference', peak))} ({row.cpu:.2g} s)" for row in spheres if row.knob == "steps" and not math.isnan(row.rms("reference", peak))]
	if rates:
		lines.append("Spheres against their own slow runs: " + "; ".join(rates) + ".")
	rising = [f"{row.model} {row.label} ({row.rising} of {row.seeds})" for row in rows if row.rising]
	if rising:
		lines.append("The stress had not fallen when the run ended, so its highest value is no peak: " + "; ".join(rising) + ".")
	for words, rows in (("Not all seeds were run (yet)", [row for row in rows if row.failed.endswith("not run")]), ("Failed, see the table", [row for row in rows if row.failed and not row.failed.endswith("not run")])):
		if rows:
			lines.append(f"{words}: " + "; ".join(f"{row.model} {row.label}" for row in rows) + ".")
	return lines[:10]


def _worstKnob(rows, peak):
	"""What each knob does to the error of the peak at the same number of steps (labels begin alike)."""
	rms = lambda row: row.rms("reference", peak)
	plain, said = [row for row in rows if row.knob == "steps" and not math.isnan(rms(row))], {}
	for row in rows:
		base = max((base for base in plain if row.label.startswith(base.label + " ")), key=lambda base: len(base.label), default=None)
		if base and not math.isnan(rms(row)):
			change = abs(math.log(max(rms(row), 1e-4) / max(rms(base), 1e-4)))
			said[row.knob] = max(said.get(row.knob, (-1, "")), (change, f"{row.label} {_percent(rms(row))} ({row.cpu:.2g} s) instead of {_percent(rms(base))} ({base.cpu:.2g} s)"))
	return "What moves it: " + "; ".join(text for change, text in sorted(said.values(), reverse=True)[:4]) + "." if said else None


def _laboratory(row, names):
	said = [f"{shortNames[name]} {_signed(row.laboratory[name].mean)} ± {_percent(row.laboratory[name].scatter)}" for name in names if row.laboratory.get(name)]
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
		record = {"case": row.case, "model": row.model, "knob": row.knob, "setting": row.label, "seeds": row.seeds, "cpu_s": row.cpu, "reference": row.isReference}
		for name, (value, scatter) in row.values.items():
			record[name], record[f"{name} scatter"] = value, scatter
			for kind in ("laboratory", "reference"):
				for part, number in zip(("error", "error scatter", "error rms"), getattr(row, kind).get(name) or (math.nan,) * 3):
					record[f"{name} {kind} {part}"] = number
		yield {**record, "without peak": row.rising, "failed": row.failed}


def asMarkdown(rows, names):
	"""The table: for each quantity the error against the laboratory and against the reference, mean ± scatter; * is on the Pareto front of
	its model family (peak against reference)."""
	front = {id(row) for family in (True, False) for row in _front([r for r in rows if (r.model == "blocks") == family and not r.isReference and r.knob not in specimenKnobs], names[0])}
	head = ["case", "model", "setting", "seeds", "CPU s"] + [f"{shortNames[name]}, {kind}" for name in names for kind in ("laboratory", "reference")]
	lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
	for row in rows:
		cells = [row.case, row.model, row.label + (" *" if id(row) in front else "") + (" (reference)" if row.isReference else "") + (f", {row.rising} without peak" if row.rising else ""), str(row.seeds), "-" if math.isnan(row.cpu) else f"{row.cpu:.2g}"]
		cells += [f"{_signed(error.mean)} ± {_percent(error.scatter)}" if error else "" for name in names for error in (row.laboratory.get(name), row.reference.get(name))]
		lines.append("| " + " | ".join(cells) + " |" + (f" failed: {row.failed}" if row.failed and not row.seeds else ""))
		if row.failed: lines[-1] = lines[-1].replace(f"| {row.seeds} |", f"| {row.seeds} ({row.failed}) |", 1).removesuffix(f" failed: {row.failed}")
	return "\n".join(lines)


def _front(rows, peak):
	return [rows[i] for i in pareto([(row.cpu, row.rms("reference", peak)) for row in rows])]
