# yade-blocks, GPL-2.0-or-later
"""What the benchmark has found: tables, curves, readings."""
from pathlib import Path

import pandas

from yadeblocks.experiments import expected

from . import tradeoff, tradeoffpicture
from .jobs import Job, machine
from .plan import middle, spheres
from .points import seedsOf, stressOf
from .yadecalibration import staleCalibrations


def truths(case, model, results):
	"""The laboratory's values; the stiffness in theory is that of the specimen as its scenario says. Broken bonds of MortarMat on polyhedra
	carry nothing, so they have no residual stress to compare."""
	said = next((result["expected"] for result in results.values() if result and "expected" in result), {})
	known = {name: value for name, (value, source) in expected(case.split()[0], stressOf(case).get("sigma", 0)).items()}
	if model == "polyhedra": known.pop("residual_shear_stress", None)
	return {**known, **{name: said[name] for name in said if name == "joint_stiffness"}}


def report(p, jobs, experiment, all):
	"""Table, CSV, plot and reading of what has been run."""
	names = tradeoff.quantities[experiment]
	get = lambda point, settings: {seed: jobs.result(Job(point.script, settings, seed)) for seed in seedsOf(point, p.mode, p.seeds)}
	rows = []
	for point in all:
		results = get(point, point.settings)
		rows.append(
			tradeoff.summarise(
				point.case, point.model, point.knob, point.label, names, results, truths(point.case, point.model, results),
				get(point, point.slow) if point.slow else {}, point.isReference
			)
		)
	cases = {case: [row for row in rows if row.case == case] for case in dict.fromkeys(row.case for row in rows)}
	most = lambda case: 10 if case in middle and len(cases) == 1 else 8 if case in middle else 3
	texts = {case: tradeoff.reading(mine, names, most=most(case)) for case, mine in cases.items()}
	lines = [f"{case}: {line}" if len(cases) > 1 else line for case in sorted(cases, key=lambda case: case not in middle) for line in texts[case]
			] + list(staleCalibrations(experiment, p.model))
	lines.append(f"CPU seconds of {machine()}, {p.jobs} runs at a time, the building of the specimen included.")
	place = jobs.folder / f"{experiment}-{p.mode}"
	pandas.DataFrame(tradeoff.asRecords(rows)).to_csv(f"{place}.csv", index=False, float_format="%.6g")
	pandas.DataFrame(runRecords(p, jobs, all)).to_csv(f"{place}-runs.csv", index=False, float_format="%.6g")
	Path(f"{place}.md"
		).write_text(f"# {experiment}, {p.mode} mode\n\n" + "\n".join("- " + line for line in lines) + "\n\n" + tradeoff.asMarkdown(rows, names) + "\n")
	seeds, packings = max(len(seedsOf(point, p.mode, p.seeds)) for point in all), min(p.seeds, spheres[p.mode]["packings"])
	title = f"{experiment}: error over CPU time, {seeds} seeds a point, {packings} packings of YADE's models"
	tradeoffpicture.drawTradeoff(f"{place}.png", cases, names, lines, title=title)
	print(f"\n{experiment}\n" + "\n".join(lines) + f"\nsee {place}.png, .md, .csv", flush=True)


def runRecords(p, jobs, all):
	"""Every single run: what it measured and cost, or why it failed, and the command that repeats it."""
	for point in all:
		for seed in seedsOf(point, p.mode, p.seeds):
			result = jobs.result(Job(point.script, point.settings, seed))
			if result:
				yield {
					"case": point.case, "model": point.model, "setting": point.label, "seed": seed,
					**result.get("measures", {}), "cpu_s": result.get("cost", {}).get("cpu_s"), "steps": result.get("cost",
																	{}).get("steps"),
					"runs_at_a_time": result.get("parallel"), "unbalanced_ratio_max": result.get("quality", {}).get("unbalanced_ratio_max"),
					"failed": result.get("failed"), "command": result["command"]
				}
