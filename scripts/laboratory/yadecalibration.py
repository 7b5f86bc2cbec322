# yade-blocks, GPL-2.0-or-later
"""Calibrating YADE's own models, and whether what was found is of today's code."""
import json
import math
from pathlib import Path

from yadeblocks.provenance import fingerprint

from . import calibration, study
from .jobs import Job, yadeVersion
from .plan import calibrated, modelsOf
from .points import stepsOf
from .yadefits import fits, short, sigmas

house = Path(__file__).resolve().parents[2]


def evaluate(jobs, model, experiment, parameters, seeds):
	"""Means over packings; in shear of the line through the three peaks, and the residual stress at 0.5 N/mm2."""
	script = "polyhedra" if model == "polyhedra" else "spheres"
	settings = {"experiment": experiment, **({"model": model} if script == "spheres" else {}), **parameters, "steps": stepsOf(model, experiment)}
	cases = [{**settings, "sigma": sigma} for sigma in sigmas] if experiment == "shear" else [settings]
	asked = [[Job(script, case, seed) for seed in seeds] for case in cases]
	jobs.do([job for case in asked for job in case])
	found = [[jobs.result(job) for job in case] for case in asked]
	for result in (result for case in found for result in case):
		if "failed" in result:
			return dict.fromkeys((
				"intercept", "slope", "middle", "residual", "peak_tensile_stress", "joint_stiffness", "compressive_strength", "youngs_modulus"
			), math.nan)
	means = [{name: sum(result["measures"][name] for result in case) / len(case) for name in case[0]["measures"]} for case in found]
	if experiment != "shear": return means[0]
	peaks = [mean["peak_shear_stress"] for mean in means]
	x = [sigma / 1e6 for sigma in sigmas]
	mx, my = sum(x) / 3, sum(peaks) / 3
	slope = sum((a - mx) * (b - my) for a, b in zip(x, peaks)) / sum((a - mx)**2 for a in x)
	return {"intercept": my - slope * mx, "slope": slope, "middle": peaks[1], "residual": means[1]["residual_shear_stress"]}


def codeOf(model):
	"""What a calibration depends on besides its Fit: YADE and the code of the runs, whatever its comments."""
	parts = [
		house / "scripts" / ("polyhedra.py" if model == "polyhedra" else "spheres.py"),
		*(house / "py" / "yadeblocks" / f"{name}.py" for name in ("packing", "loading/approach", "loading/stop", "curves", "masonry"))
	]
	return fingerprint((), yadeVersion(), *map(study.meaning, parts))[:16]


def staleCalibrations(experiment, only="all"):
	"""A line for the models (or one of them) whose calibrations were made with other code, targets, packings or ties than today's."""
	known, stale = json.loads(calibrated.read_text()), {}
	for model in modelsOf[experiment]:
		entry = known.get(f"{model} {experiment}")
		if not entry or only not in ("all", model): continue
		fit = fits(model, experiment, known)
		reasons = calibration.changes(
			entry, {
				"targets": fit.targets, "packings": list(fit.seeds), "code": codeOf(model),
				"parameters": fit.parameters(entry["moved"]) if "moved" in entry else None
			}
		)
		if reasons: stale.setdefault(", ".join(reasons), []).append(model)
	for reasons, models in stale.items():
		yield f"Calibrated with other {reasons}: {', '.join(models)}; mode=calibrate experiment={experiment} does it again."


def calibrateAll(jobs, experiments, only="all"):
	"""Calibrates YADE's models (or one of them) for these experiments, from where scripts/calibrated.json stands, and writes it."""
	known = json.loads(calibrated.read_text())
	for experiment in experiments:
		for model in [model for model in modelsOf[experiment] if only in ("all", model)]:
			fit, before = fits(model, experiment, known), known.get(f"{model} {experiment}", {})
			start = before.get("moved", fit.start) # to go on is shorter than to begin again
			found = calibration.calibrate(
				lambda q: evaluate(jobs, model, experiment, fit.parameters(short(q)), fit.seeds), start, fit.targets, fit.governs,
				tolerance=0.03, rounds=4
			)
			runs = found.rounds * len(fit.seeds) * (len(sigmas) if experiment == "shear" else 1) + before.get("runs", 0)
			known[f"{model} {experiment}"] = {
				"parameters": fit.parameters(short(found.parameters)), "moved": short(found.parameters), "targets": fit.targets, "reached": {
					name: round(value, 4) for name, value in found.measured.items()
				}, "rounds": found.rounds + before.get("rounds", 0), "runs": runs, "packings": list(fit.seeds), "code": codeOf(model)
			}
			calibrated.write_text(json.dumps(known, indent=1) + "\n")
			print(f"{model} {experiment}: {runs} runs, reached", known[f"{model} {experiment}"]["reached"], "for", fit.targets, flush=True)
