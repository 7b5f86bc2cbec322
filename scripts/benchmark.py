# yade-blocks, GPL-2.0-or-later
"""Error against run time: our blocks, YADE's bonded spheres and its polyhedra in tension, shear and compression.

	scripts/benchmark.sh [mode=quick|full|calibrate] [experiment=tension|shear|compression|structures] [key=value ...]

What is run are the tables of laboratory.plan: each point for several seeds, a process each. A result is kept under a hash of parameters and code
(laboratory.jobs): an interrupted benchmark continues, and nothing old is taken for new. For each experiment out/benchmark/ gets
NAME-MODE.png (error over CPU seconds, and its reading), NAME-MODE.md (table and reading), NAME-MODE.csv and NAME-MODE-runs.csv.

experiment=structures runs the other scenarios, each at three costs, against their expected values: structures.md, .csv and .png. mode=full has it, too.

	mode=quick      a quarter of an hour on two idle cores
	mode=full       every knob, all stresses, finer packings: about two hours on two idle cores
	mode=calibrate  goes on with the calibration of YADE's models (model=NAME: of this one only) from scripts/calibrated.json, and writes it; a report says
			which calibrations were made with other code, targets, packings or ties than today's

Errors are against the laboratory and against a reference of the same specimen: in tension and shear the exact peak (solver=events, release=cascade), in
compression a slow run, whose own convergence is shown by one twice as fast (references of other specimens than the usual are half as slow). The solver is
a point of its own, too.
retry=true runs again what failed; jobs=1 keeps processes from slowing each other down, which shows in CPU times. scheduler=HOST:PORT, or a scheduler
file, has the runs done by a cluster of dask.distributed that is there already (scripts/workers.sh; tls=FOLDER: with these certificates).
"""
import os
import signal
import sys
from pathlib import Path

if "yade" in sys.modules: sys.exit("benchmark is no scenario: start scripts/benchmark.sh, outside YADE")

house = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(house / "py"))

from laboratory import structures
from laboratory.benchmarkreport import report
from laboratory.engine import EngineError
from laboratory.jobs import Job, Jobs
from laboratory.plan import modelsOf
from laboratory.points import points, seedsOf
from laboratory.yadecalibration import calibrateAll
from yadeblocks import scenario

# ---- parameters

p = scenario.parameters({
	"mode": "quick", "experiment": "all", "seeds": 5, "jobs": os.cpu_count() or 1, "model": "all", "limit": 1800.0, "retry": False, "scheduler": "",
	"tls": "", "out": "out/benchmark"
}, {
	"mode": ("quick", "full", "calibrate"), "experiment": ("all", "tension", "shear", "compression", "structures"),
	"model": ("all", "blocks", *modelsOf["shear"]), "seeds": scenario.atLeastOne, "jobs": scenario.atLeastOne, "limit": scenario.positive
}, scenario="benchmark")
experiments = ("tension", "shear", "compression") if p.experiment == "all" else () if p.experiment == "structures" else (p.experiment, )
withStructures = p.model in ("all", "blocks") and (p.experiment == "structures" or p.experiment == "all" and p.mode == "full") and p.mode != "calibrate"

# ---- running


def interrupt(*_):
	raise KeyboardInterrupt


signal.signal(signal.SIGTERM, interrupt)
signal.signal(signal.SIGINT, interrupt) # also where the shell has it ignored
plugin = os.environ.get("YADEBLOCKS_PLUGIN", house / "build" / "libyadeblocks.so")
jobs = Jobs(house, house / p.out, plugin, pluginFree=("spheres", ), limit=p.limit, parallel=p.jobs, retry=p.retry, scheduler=p.scheduler, tls=p.tls)
everything = {} if p.mode == "calibrate" else {
	experiment: [point for point in points(p.mode, experiment) if p.model in ("all", point.model)] for experiment in experiments
}
if p.mode == "calibrate" and not any(p.model in ("all", *modelsOf[experiment])
					for experiment in experiments) or p.mode != "calibrate" and not any(everything.values()) and not withStructures:
	sys.exit(f"benchmark: model={p.model} has nothing to {'calibrate' if p.mode == 'calibrate' else 'run'} with experiment={p.experiment}")
stopped = False
try:
	if p.mode == "calibrate":
		with jobs:
			calibrateAll(jobs, experiments, p.model)
		sys.exit()
	jobs.do([
		Job(point.script, point.settings, seed) for seed in range(1, p.seeds + 1) for all in everything.values()
		for point in all if seed in seedsOf(point, p.mode, p.seeds)
	] + structures.jobsOf() * withStructures) # seed by seed, so that an early end leaves all points
except KeyboardInterrupt:
	print("interrupted: what is complete is kept; the same command continues", file=sys.stderr)
	stopped = True
except EngineError as error:
	sys.exit(f"benchmark: {error}")
for experiment, all in everything.items():
	if all: report(p, jobs, experiment, all) # model= may leave nothing
if withStructures: print("\nstructures\n" + structures.report(jobs.record, jobs.folder) + f"see {jobs.folder}/structures.png, .md, .csv", flush=True)
sys.exit(130 if stopped else 0)
