# yade-blocks, GPL-2.0-or-later
"""Runs of scenario scripts, each a process of its own, whose results are kept and found again.

	jobs = Jobs(house, folder="out/benchmark", parallel=2)
	jobs.do([Job("tension", {"steps": 20000}, seed) for seed in (1, 2, 3)])
	jobs.result(Job("tension", {"steps": 20000}, 1))   # what it measured and cost, or why it failed; None if it has not been run

A result is kept under a hash of the settings, of the seed and of all code that the script uses: scripts, Python modules, plugin,
YADE's version, and the kind of processor. If any of these has changed the run is done anew; nothing old can be taken for new.
"""
import fcntl
import json
import math
import os
import shutil
import sys
from collections import Counter
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

from yadeblocks import curves
from yadeblocks.provenance import fingerprint, sourcesOf

from . import run, study
from .engine import Engine, EngineError


class Job(NamedTuple):
	"""One run: `yade scripts/SCRIPT.py key=value ... seed=N`; seed None: of a scenario that has none."""
	script: str
	settings: dict
	seed: int

	@property
	def name(self):
		return f"{Path(self.script).stem} {study.settingsKey(self.settings)} seed={self.seed}"


class Jobs:
	"""The kept results in `folder`, and a way to get more.

	house: the checkout; plugin: the library that scripts load; pluginFree: scripts whose results do not depend on it;
	limit: seconds of wall-clock time after which a run counts as failed; parallel: how many at a time on this machine; scheduler, tls: of a
	cluster to be used
	instead, see Engine. A script is the name of one in scripts/, or the path of one's own.
	In `with jobs:` the workers stay from one call of `do` to the next."""
	def __init__(self, house, folder, plugin, pluginFree=(), limit=1800, parallel=1, retry=False, stream=None, scheduler="", tls="", engine=None):
		self.house, self.folder, self.plugin, self.pluginFree = Path(house), Path(folder).resolve(), Path(plugin).resolve(), pluginFree
		self.limit, self.parallel, self.retry, self.stream = limit, parallel, retry, stream or sys.stderr
		self.kept, self.work = self.folder / "runs", self.folder / "work"
		self.engine, self.stays = engine or Engine(parallel, scheduler, tls), engine is not None
		self.code = lru_cache(maxsize=None)(self._code)

	def __enter__(self):
		self.stays = True
		return self

	def __exit__(self, *_):
		self.engine.close()

	def path(self, job):
		"""Where the result of this job is kept."""
		return self.kept / f"{fingerprint((), job.name, self.code(job.script)[0])[:24]}.json"

	def record(self, job):
		"""What the job left: {"job", "reported", "units", "expected", "cost", "quality", "curve", "columns"} or {"job", "failed": reason};
		None if it has not been run with this code."""
		path = self.path(job)
		return json.loads(path.read_text()) if path.exists() else None

	def result(self, job):
		"""As `record`, with the quantities that are read from the curve in place of it: {"measures"}. A curve that lacks one counts as failed."""
		record = self.record(job)
		if record is None or "failed" in record:
			return record
		x, y = record.pop("curve")
		experiment = job.settings.get("experiment", job.script)
		of = lambda x, y: {name: value for name, (value, unit) in curves.measure(experiment, x, y).items()}
		if job.settings.get("solver") == "events": # what a machine would have seen; behind the exact path only what it leaves is measured
			exact = 1 + max(range(record.get("exact") or len(x)), key=y.__getitem__) # up to the peak
			measures = {
				**of(*curves.driven(x, y)),
				**{k: v for k, v in of(*curves.driven(x[:exact], y[:exact])).items() if not k.startswith("residual")}
			}
		else:
			measures = of(x, y)
		if not job.settings.get("afterPeak", True): measures.pop("residual_shear_stress", None)
		lacking = [name for name, value in measures.items() if math.isnan(value)]
		return {**record, "failed": "the curve has no " + ", no ".join(lacking)} if lacking else {**record, "measures": measures}

	def wanted(self, jobs):
		"""Those that have to be run, each once, in the given order."""
		seen = {}
		for job in jobs:
			kept = self.record(job)
			if kept is None or (
				"failed" in kept and
				(self.retry or kept.get("again") or kept.get("limit", math.inf) < self.limit or kept["failed"].startswith("exit code -"))
			): # killed
				seen.setdefault(job.name, job)
		return list(seen.values())

	def do(self, jobs):
		"""Runs what is not there yet. An interrupt ends the running processes and keeps what is complete; raises EngineError if it cannot go on."""
		jobs = self.wanted(jobs)
		if not jobs:
			return
		self._makeRoom()
		with self._claimed():
			shutil.rmtree(self.work, ignore_errors=True) # leftovers of an interrupted run
			self.work.mkdir()
			line, jobsOf = _ProgressLine(jobs, self.stream), {self.path(job).stem: job for job in jobs}
			try:
				self.engine.start()
				line.parallel = self.engine.slots()
				self.engine.do((self._task(job) for job in jobs), lambda task, outcome: self._keep(jobsOf[task["key"]], outcome, line))
			finally:
				line.close()
				if not self.stays: self.engine.close()
				shutil.rmtree(self.work, ignore_errors=True)

	def _makeRoom(self):
		try:
			self.kept.mkdir(parents=True, exist_ok=True)
		except OSError as error:
			raise EngineError(f"results cannot be kept in {self.kept}: {error.strerror}") from None

	def _claimed(self):
		"""The folder, for one process at a time: the file to close when it is done."""
		claim = open(self.folder / ".lock", "w")
		try:
			fcntl.flock(claim, fcntl.LOCK_EX | fcntl.LOCK_NB)
		except BlockingIOError:
			raise RuntimeError(f"another benchmark is running in {self.folder}") from None
		return claim

	def _task(self, job):
		"""What a worker is asked to do, see run.execute."""
		key, words = self.path(job).stem, self._words(job)
		script, tag = self._script(job.script), f"tag={key}"
		environment = {
			"OMP_WAIT_POLICY": "passive", "YADEBLOCKS_PLUGIN": str(self.plugin),
			"PYTHONPATH": os.pathsep.join([str(self.house / "py"), *filter(None, [os.environ.get("PYTHONPATH")])])
		}
		return {
			"key": key, "command": ["yade", "-n", "-x", "-j1", str(script), *words, *self._seed(job),
						tag], "environment": {**(os.environ if self.engine.local else {}), **environment},
			"folder": os.path.join("out", f"{script.stem}-{key}"), "limit": self.limit, "files": self._files(job.script),
			"digest": self.code(job.script)[1], "scratch": str(self.work) if self.engine.local else None
		}

	def _words(self, job):
		return [f"{name}={study.plain(value)}" for name, value in job.settings.items()]

	def _seed(self, job):
		return [] if job.seed is None else [f"seed={job.seed}"]

	def _keep(self, job, outcome, line):
		"""Writes down what a run gave, whole or not at all."""
		if outcome.get("changed"): # a result that was made while the code changed belongs to neither state of it
			raise RuntimeError(f"the code behind {self._script(job.script)} has changed while it was running: start it again")
		if self.engine.kind and outcome["processor"] and outcome["processor"] != self.engine.kind[1]:
			outcome = {
				**outcome, "failed": f"{outcome['host']} has another processor than the first workers: {outcome['processor']}", "again": True
			}
		record = {
			"parallel": line.parallel, "job": {"script": job.script, "settings": job.settings, "seed": job.seed},
			"command": " ".join(["scripts/run.sh", job.script, *self._words(job),
						*self._seed(job)]), "wall_s": outcome["wall_s"], "host": outcome["host"]
		}
		if "failed" in outcome:
			record.update({name: outcome[name] for name in ("failed", "again", "limit") if outcome.get(name)})
		else:
			try:
				record.update(_whatCounts(outcome))
			except (KeyError, TypeError) as error:
				record["failed"] = f"its result.json or curve.csv lacks {error}"
		part = self.path(job).with_suffix(".part")
		try:
			part.write_text(json.dumps(record) + "\n")
			part.rename(self.path(job))
		except OSError as error:
			part.unlink(missing_ok=True)
			raise EngineError(
				f"the result of {job.name} cannot be kept in {self.kept}: {error.strerror}; "
				"what is complete is kept, the same command continues"
			) from None
		line.done(job, record)

	def _script(self, script):
		return Path(script).resolve() if script.endswith(".py") else self.house / "scripts" / f"{script}.py"

	def _files(self, script):
		files = sourcesOf(self._script(script), self.house / "py" / "yadeblocks") + ([] if script in self.pluginFree else [self.plugin])
		return [str(path) for path in files]

	def _code(self, script):
		"""The hash of all that a run of this script depends on but its settings, and that of its files alone."""
		files = run.digest(self._files(script))
		if self.engine.local: return fingerprint((), files, yadeVersion(), _processor()), files
		self.engine.start()
		return fingerprint((), files, *self.engine.kind), files


def _whatCounts(outcome):
	"""What is kept of a run: its quantities, its costs and one curve: stress over the second column, or else the third column over it."""
	result, curve = outcome["result"], outcome["curve"]
	quantities = result["quantities"]
	kept = {
		"reported": {quantity["name"]: quantity["measured"] for quantity in quantities}, "units": {
			quantity["name"]: quantity.get("unit", "") for quantity in quantities
		}, "expected": {quantity["name"]: quantity["expected"] for quantity in quantities if quantity["expected"] is not None}, "cost": result["cost"],
		"quality": result["quality"], "curve": None, "columns": None
	}
	names = list(curve or ())
	if len(names) > 2:
		kept["columns"] = [names[1], "stress_MPa" if "stress_MPa" in names else names[2]]
		kept["curve"] = [curve[name] for name in kept["columns"]]
		if "exact" in names: kept["exact"] = int(sum(curve["exact"])) # rows of the path from event to event, the first ones
	return kept


@lru_cache(maxsize=None)
def yadeVersion():
	return run.yadeVersion()


def machine():
	"""What CPU seconds were measured on."""
	return f"{_processor()}, {os.cpu_count()} cores"


_processor = lru_cache(maxsize=None)(run.processor)


class _ProgressLine:
	"""done/all, the last job, the time left: jobs that cost more (by their steps) are expected to take longer."""
	def __init__(self, jobs, stream):
		self.left, self.total, self.parallel, self.stream = {job.name: self._kind(job) for job in jobs}, len(jobs), 1, stream
		self.leftOfKind, self.walls = Counter(self.left.values()), {}

	def done(self, job, record):
		kind = self.left.pop(job.name)
		self.leftOfKind[kind] -= 1
		count, wall = self.walls.get(kind, (0, 0.0))
		self.walls[kind] = count + 1, wall + record["wall_s"]
		overall = sum(wall for count, wall in self.walls.values()) / sum(count for count, wall in self.walls.values())
		mean = lambda kind: self.walls[kind][1] / self.walls[kind][0] if kind in self.walls else overall
		left = sum(number * mean(kind) for kind, number in self.leftOfKind.items()) / self.parallel
		what = record.get("failed", f"{record.get('cost', {}).get('cpu_s', 0):.1f} CPU s")
		self._write(f"{self.total - len(self.left)}/{self.total}  {int(left) // 60}:{int(left) % 60:02} left  {job.name}: {what}")

	def _kind(self, job):
		return job.script, job.settings.get("experiment"), job.settings.get("model"), job.settings.get("steps"), job.settings.get("size")

	def _write(self, text):
		self.stream.write(f"\r{text[:shutil.get_terminal_size().columns - 1]}\x1b[K" if self.stream.isatty() else text + "\n")
		self.stream.flush()

	def close(self):
		if self.stream.isatty():
			self.stream.write("\r\x1b[K")
