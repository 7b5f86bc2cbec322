# yade-blocks, GPL-2.0-or-later
"""Parameters with which quantities reach their targets.

	scripts/study.sh calibrate NAME targets=peak_shear_stress:1.375:5%,residual_shear_stress:0.365:0.04 bounds=cohesion:1e6:4e6,kn:1e11:1e12 [key=value ...]
	scripts/study.sh calibrate NAME targets=FILE.json bounds=FILE.json [trials=N] [seeds=N] [heldOut=N]

A target is quantity:value:tolerance[:weight], the tolerance in the quantity's unit or in percent. A file may hold several experiments:

	{"low": {"scenario": "shear", "settings": {"sigma": 1e5}, "targets": {"peak_shear_stress": {"value": 0.97, "tolerance": "5%", "weight": 1}}}, ...}

Bounds are key:low:high[:lin], varied in proportion unless lin is said; a key scenario.key is for that scenario only. The misfit is
chi² = sum of weight ((mean - target) / tolerance)², the mean being that over `seeds` tessellations, the same ones in every trial. Trials: first scattered
evenly, then those that surfaces fitted to the quantities promise the least misfit, and those of optuna's sampler (TPE), in turn; last, two beside the best
one in each parameter, for its slopes.
Tessellations scatter, so the verdict is that of `heldOut` further seeds, with the interval of their mean: reached, missed, or undecided where
the interval holds the edge of the tolerance. Profiles show how much worse the best fit gets when one parameter is held elsewhere: a parameter is determined if
that costs more than 1 at both ends; what it trades with is in the correlations. Results: joints.json, which scenarios take as joints=FILE, study.json,
table.md, trials.csv, calibration.png.
"""
import json
import math
from pathlib import Path

import numpy as np
import pandas

from yadeblocks import scenario

from . import surface, studypicture
from .command import StudyError, bounds, demandResults, good, place, plain, quantitiesOf, reasons, withJoints, writeWhole
from .statistics import summary

nearby = 0.08 #: Of the bounds' width: so far beside the best trial slopes are measured.

keys = {"targets": "", "bounds": "", "trials": 40, "heldOut": 5, "samplerSeed": 1, "seeds": 3, "enough": 0.25}
rules = {
	"trials": scenario.atLeastOne, "heldOut": scenario.Rule(lambda n: n >= 2, "must be at least 2"), "samplerSeed": scenario.notNegative,
	"enough": scenario.positive
}
meanings = {
	"targets": "quantity:value:tolerance[:weight],... or a file", "bounds": "key:low:high[:lin],... or a file",
	"trials": "the most sets of parameters tried", "heldOut": "further tessellations for the verdict", "samplerSeed": "of optuna's sampler",
	"seeds": "tessellations of a trial", "enough": "ends once all means are within this share of their tolerances"
}


def study(command):
	p = command.p
	edges, experiments = bounds(p.bounds), readTargets(p.targets, command)
	points, tried = _Points(command, edges, experiments), []
	propose = _Proposals(edges, p)
	while len(tried) < p.trials:
		batch = propose.batch(tried, min(p.trials - len(tried), max(2, p.jobs)))
		new = [_Trial(unit, measured, experiments) for unit, measured in zip(batch, points.measure(batch, range(p.seed, p.seed + p.seeds)))]
		if not tried: points.check(new)
		propose.told(new)
		tried += new
		if min(trial.worst for trial in tried) <= p.enough: break
	fine = [trial for trial in tried if trial.misfit < math.inf]
	if not fine: raise StudyError("study: no trial gave all quantities: " + "; ".join(why for trial in tried for why in trial.why))
	pairs = points.around(min(fine, key=lambda trial: trial.misfit), range(p.seed, p.seed + p.seeds))
	fine += [trial for pair in pairs for trial in pair if trial.misfit < math.inf]
	best = min(fine, key=lambda trial: trial.misfit)
	held = points.measure([best.unit], range(p.seed + p.seeds, p.seed + p.seeds + p.heldOut))[0]
	report(command, edges, experiments, fine, best, held, tried, points, pairs)


class Target:
	def __init__(self, value, tolerance, weight=1.0):
		self.value, self.weight = float(value), float(weight)
		self.tolerance = abs(self.value) * float(tolerance[:-1]) / 100 if str(tolerance).endswith("%") else float(tolerance)
		if not (self.tolerance > 0 and self.weight > 0 and math.isfinite(self.value)): raise ValueError


class Experiment:
	"""A scenario with settings, and {quantity: Target}."""
	def __init__(self, script, settings, targets):
		self.script, self.settings, self.targets = script, settings, targets


def readTargets(text, command):
	"""{label: Experiment}."""
	form = "study: targets must be of the form quantity:value:tolerance[:weight], with a tolerance > 0, or a file, got "
	if not text: raise StudyError("study: targets= must be given, e.g. targets=peak_tensile_stress:0.35:5%")
	if not text.endswith(".json"):
		try:
			return {
				command.stem: Experiment(
					command.script, command.settings,
					{words[0]: Target(*words[1:]) for words in (entry.split(":") for entry in text.split(",") if entry)}
				)
			}
		except (ValueError, TypeError, IndexError):
			raise StudyError(form + text) from None
	try:
		entries = json.loads(Path(text).read_text())
		found = {}
		for label, entry in entries.items():
			script = entry.get("scenario", command.script)
			own = withJoints({
				key: str(value).lower() if isinstance(value, bool) else str(value) for key, value in entry.get("settings", {}).items()
			}, script)
			found[label] = Experiment(
				script, command.quiet(script, {**command.settings, **own}),
				{name: Target(target["value"], target["tolerance"], target.get("weight", 1.0)) for name, target in entry["targets"].items()}
			)
		if not found: raise ValueError
		return found
	except OSError as error:
		raise StudyError(f"study: targets: {text} cannot be read: {error.strerror}") from None
	except (ValueError, KeyError, TypeError, AttributeError):
		raise StudyError(f'study: {text} must be of the form {{label: {{"targets": {{quantity: {{"value": 1, "tolerance": "5%"}}}}}}}}') from None


class _Points:
	"""Runs trials: all experiments at points of the unit cube."""
	def __init__(self, command, edges, experiments):
		self.command, self.edges, self.experiments = command, edges, experiments
		strangers = {key.partition(".")[0] for key in edges if "." in key} - {Path(each.script).stem for each in experiments.values()}
		if strangers: raise StudyError(f"study: bounds for {', '.join(sorted(strangers))}, which is no scenario of this study")

	def parameters(self, unit, script):
		"""Those of one scenario."""
		stem = Path(script).stem
		return {key.rpartition(".")[2]: value for key, value in place(self.edges, unit).items() if "." not in key or key.partition(".")[0] == stem}

	def measure(self, units, seeds):
		"""For each point {label: records by seed}."""
		found = [{} for _ in units]
		for label, each in self.experiments.items():
			points = [{**each.settings, **self.parameters(unit, each.script)} for unit in units]
			for place_, records in zip(found, self.command.measure(points, seeds, each.script)):
				place_[label] = records
		return found

	def around(self, best, seeds):
		"""Trials below and above the best one in each parameter, from which slopes are taken."""
		units = []
		for i in range(len(self.edges)):
			for side in (-nearby, nearby):
				unit = list(best.unit)
				unit[i] = min(1.0, max(0.0, unit[i] + side))
				units.append(unit)
		trials = [_Trial(unit, records, self.experiments) for unit, records in zip(units, self.measure(units, seeds))]
		return list(zip(trials[::2], trials[1::2]))

	def check(self, trials):
		"""That the scenarios run at all, and measure what is asked for."""
		for label, each in self.experiments.items():
			measured = [trial.records[label] for trial in trials]
			demandResults(measured)
			quantitiesOf(measured, each.targets)


class _Trial:
	"""What a set of parameters gave: {label.quantity: Summary} and its misfit, inf if a run failed or a quantity is missing."""
	def __init__(self, unit, records, experiments):
		self.unit, self.records, self.means, self.why = list(unit), records, {}, []
		self.misfit, self.worst = 0.0, 0.0
		for label, each in experiments.items():
			fine = good(records[label])
			self.why += reasons(records[label].values())
			for name, target in each.targets.items():
				found = summary([record["reported"].get(name) for record in fine.values()])
				if not found or found.n < len(records[label]): self.misfit = self.worst = math.inf
				else:
					self.means[f"{label}.{name}"] = found
					share = (found.mean - target.value) / target.tolerance
					self.misfit += target.weight * share**2
					self.worst = max(self.worst, abs(share))
		self.targets = {f"{label}.{name}": target for label, each in experiments.items() for name, target in each.targets.items()}


class _Proposals:
	"""Where to look next. The same results lead to the same proposals: the sampler's seed is given and each batch is told in its order."""
	def __init__(self, edges, p):
		import optuna
		optuna.logging.set_verbosity(optuna.logging.ERROR)
		self.edges, self.dimension, self.first = edges, len(edges), 2 * len(edges) + 3
		self.distributions = {key: optuna.distributions.FloatDistribution(0, 1) for key in edges}
		self.study = optuna.create_study(sampler=optuna.samplers.TPESampler(seed=p.samplerSeed, n_startup_trials=self.first))
		self.asked = []
		from scipy.stats import qmc
		self.even = list(qmc.Sobol(self.dimension, seed=p.samplerSeed).random_base2(math.ceil(math.log2(self.first))))[:self.first]

	def batch(self, tried, size):
		"""So many points of the unit cube."""
		if self.even:
			units, self.even = [list(unit) for unit in self.even[:size]], self.even[size:]
		else:
			fine = [trial for trial in tried if trial.misfit < math.inf]
			units = [list(surface.fit(fine).best())] if len(fine) > self.dimension + 1 else []
			if units and min(np.abs(np.subtract(trial.unit, units[0])).max() for trial in tried) < 1e-4: units = [] # it has been tried
		for unit in units:
			self.study.enqueue_trial(dict(zip(self.edges, map(float, unit))))
		self.asked = [self.study.ask(self.distributions) for _ in range(max(size, 1))]
		return [[trial.params[key] for key in self.edges] for trial in self.asked]

	def told(self, trials):
		import optuna
		for asked, trial in zip(self.asked, trials):
			if trial.misfit < math.inf: self.study.tell(asked, trial.misfit)
			else: self.study.tell(asked, state=optuna.trial.TrialState.FAIL)


def report(command, edges, experiments, fine, best, held, tried, points, pairs):
	p, parameters = command.p, place(edges, best.unit)
	fitted = surface.fit(fine) if len(fine) > len(edges) + 1 else None
	profiles = fitted.profiles(edges) if fitted else {}
	correlations = fitted.correlations(list(edges), pairs) if fitted and all(trial.misfit < math.inf for pair in pairs for trial in pair) else {}
	rows = {}
	for label, each in experiments.items():
		for name, target in each.targets.items():
			key = f"{label}.{name}"
			found = summary([record["reported"].get(name) for record in good(held[label]).values()])
			values = [trial.means[key].mean for trial in fine]
			rows[key] = {
				"target": target.value, "tolerance": target.tolerance, "weight": target.weight, "fitted": best.means[key].mean, "mean": found
				and found.mean, "error": found and (found.high - found.low) / 2, "scatter": found and found.scatter,
				"seeds": found.n if found else 0, "verdict": verdict(found,
											target), "smallest_tried": min(values), "largest_tried": max(values)
			}
	own = {stem: points.parameters(best.unit, each.script) for each in experiments.values() for stem in [Path(each.script).stem]}
	shared = {key: value for key, value in parameters.items() if "." not in key}
	joints = {
		"parameters": {**{key: value for key, value in command.settings.items() if key == "joints"}, **shared}, "scenarios": {
					stem: {key: value for key, value in values.items() if key not in shared} for stem, values in own.items()
				}, "made_by": f"study calibrate {command.stem}",
		"targets": {key: {name: row[name] for name in ("target", "tolerance", "mean", "verdict")} for key, row in rows.items()}
	}
	joints["scenarios"] = {stem: values for stem, values in joints["scenarios"].items() if values}
	writeWhole(command.folder / "joints.json", json.dumps(plain(joints), indent=1) + "\n")
	command.write(
		parameters=parameters, targets=rows, misfit=best.misfit, trials=len(tried), usable_trials=sum(trial.misfit < math.inf for trial in tried),
		sampler_seed=p.samplerSeed, optimiser="optuna TPE and quadratic surfaces", seeds=list(range(p.seed, p.seed + p.seeds)), held_out_seeds=list(
			range(p.seed + p.seeds, p.seed + p.seeds + p.heldOut)
		), bounds=edges, profiles=profiles, correlations={" ".join(pair): value for pair, value in correlations.items()},
		surface_error=fitted.errors if fitted else None, experiments={
			label: {"scenario": each.script, "settings": each.settings} for label, each in experiments.items()
		}
	)
	pandas.DataFrame([{
		**place(edges, trial.unit), **{key: found.mean for key, found in trial.means.items()},
		**{f"{key} scatter": found.scatter for key, found in trial.means.items()}, "misfit": trial.misfit
	} for trial in fine]).to_csv(command.folder / "trials.csv", index=False, float_format="%.6g")
	text = markdown(command, edges, parameters, rows, profiles, correlations, best, len(tried), fitted) + unusable(tried)
	(command.folder / "table.md").write_text(text)
	if profiles: studypicture.drawCalibration(command.folder / "calibration.png", profiles, rows, f"{command.stem}: {len(tried)} trials")
	print(text)


def unusable(tried):
	"""Which trials had no misfit, and why: a region of the bounds that was not seen."""
	failed = [trial for trial in tried if trial.misfit == math.inf]
	if not failed: return ""
	counts = {}
	for why in (why for trial in failed for why in set(trial.why) or {"a quantity is missing"}):
		counts[why] = counts.get(why, 0) + 1
	told = "; ".join(f"{why} ({count})" for why, count in sorted(counts.items(), key=lambda entry: -entry[1])[:5])
	return f"- {len(failed)} of {len(tried)} trials could not be used, so that part of the bounds is unknown: {told}.\n"


def verdict(found, target):
	"""What held-out seeds say: reached or missed if the whole interval of their mean lies within the tolerance or outside."""
	if not found or found.n < 2: return "not measured"
	low, high = target.value - target.tolerance, target.value + target.tolerance
	if low <= found.low and found.high <= high: return "reached"
	return "missed" if found.high < low or found.low > high else "undecided"


def markdown(command, edges, parameters, rows, profiles, correlations, best, tried, fitted):
	p = command.p
	lines = [f"# {command.stem}, calibrated", "", "| parameter | value | bounds | interval | |", "|---|---|---|---|---|"]
	for key, value in parameters.items():
		low, high, _ = edges[key]
		profile = profiles.get(key)
		interval = f"{profile['low']:.4g} to {profile['high']:.4g}" if profile else ""
		said = [] if not profile else ["determined" if profile["determined"] else "not determined within its bounds"]
		if not 0.01 < best.unit[list(edges).index(key)] < 0.99: said.append("at a bound")
		lines.append(f"| {key} | {value:.5g} | {low:.4g} to {high:.4g} | {interval} | {', '.join(said)} |")
	lines += ["", "| target | wanted | tolerance | fitted | held-out seeds | verdict |", "|---|---|---|---|---|---|"]
	for key, row in rows.items():
		mean = f"{row['mean']:.4g} ± {row['error']:.2g}" if row["mean"] is not None else ""
		lines.append(f"| {key} | {row['target']:.4g} | {row['tolerance']:.3g} | {row['fitted']:.4g} | {mean} | {row['verdict']} |")
	lines += [
		"", f"- {tried} trials and {2 * len(edges)} beside the best, {p.seeds} seeds each, {p.heldOut} held out; "
		f"misfit {best.misfit:.3g}; sampler seed {p.samplerSeed}."
	]
	for (a, b), value in correlations.items():
		if abs(value) > 0.7: lines.append(f"- {a} and {b} trade against each other (correlation {value:+.2f}).")
	for key, row in rows.items():
		if abs(row["fitted"] - row["target"]) > row["tolerance"]:
			side = (
				f"; outside all that was tried within the bounds, {row['smallest_tried']:.4g} to {row['largest_tried']:.4g}"
				if not row["smallest_tried"] <= row["target"] <= row["largest_tried"] else "; not together with the other targets"
			)
			lines.append(f"- {key} = {row['target']:.4g} was not reached{side}.")
	if fitted:
		lines.append(
			"- Surfaces miss the trials they were not fitted to by " + ", ".join(f"{key} {error:.2g}" for key, error in fitted.errors.items()) +
			" (in tolerances)."
		)
	return "\n".join(lines) + "\n"
