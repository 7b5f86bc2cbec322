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
import platform
import shutil
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

from yadeblocks import curves
from yadeblocks.provenance import fingerprint, sourcesOf

from . import study


class Job(NamedTuple):
	"""One run: `yade scripts/SCRIPT.py key=value ... seed=N`."""
	script: str
	settings: dict
	seed: int

	@property
	def name(self):
		return f"{self.script} {study.settingsKey(self.settings)} seed={self.seed}"


class Jobs:
	"""The kept results in `folder`, and a way to get more.

	house: the checkout; plugin: the library that scripts load; pluginFree: scripts whose results do not depend on it;
	limit: seconds of wall-clock time after which a run counts as failed; parallel: how many at a time."""
	def __init__(self, house, folder, plugin, pluginFree=(), limit=1800, parallel=1, retry=False, stream=None):
		self.house, self.folder, self.plugin, self.pluginFree = Path(house), Path(folder).resolve(), Path(plugin).resolve(), pluginFree
		self.limit, self.parallel, self.retry, self.stream = limit, parallel, retry, stream or sys.stderr
		self.kept, self.work = self.folder / "runs", self.folder / "work"
		self.running, self.lock, self.stopped = set(), threading.Lock(), False
		self.code = lru_cache(maxsize=None)(self._code)

	def path(self, job):
		"""Where the result of this job is kept."""
		return self.kept / f"{fingerprint((), job.name, self.code(job.script))[:24]}.json"

	def result(self, job):
		"""What the job gave: {"job", "measures", "cost", "quality"} or {"job", "failed": reason}; None if it has not been run with this code."""
		path = self.path(job)
		if not path.exists():
			return None
		record = json.loads(path.read_text())
		if "failed" in record:
			return record
		x, y = record.pop("curve")
		if job.settings.get("solver") == "events": x, y = curves.driven(x, y) # what a machine would have seen
		measures = {name: value for name, (value, unit) in curves.measure(job.settings.get("experiment", job.script), x, y).items()}
		lacking = [name for name, value in measures.items() if math.isnan(value)]
		return {**record, "failed": "the curve has no " + ", no ".join(lacking)} if lacking else {**record, "measures": measures}

	def wanted(self, jobs):
		"""Those that have to be run, each once, in the given order."""
		seen = {}
		for job in jobs:
			kept = self.result(job)
			if kept is None or (
				"failed" in kept and (self.retry or kept.get("limit", math.inf) < self.limit or kept["failed"].startswith("exit code -"))
			): # killed
				seen.setdefault(job.name, job)
		return list(seen.values())

	def do(self, jobs):
		"""Runs what is not there yet. An interrupt ends the running processes and keeps what is complete."""
		jobs = self.wanted(jobs)
		if not jobs:
			return
		self.kept.mkdir(parents=True, exist_ok=True)
		with self._claimed():
			shutil.rmtree(self.work, ignore_errors=True) # leftovers of an interrupted run
			self.work.mkdir()
			self._all(jobs)
			shutil.rmtree(self.work)

	def _all(self, jobs):
		line = _ProgressLine(jobs, self.parallel, self.stream)
		with ThreadPoolExecutor(self.parallel) as pool:
			try:
				for future in [pool.submit(self._one, job, line) for job in jobs]:
					future.result()
			except BaseException:
				self.stopped = True
				with self.lock:
					for process in self.running:
						os.killpg(process.pid, signal.SIGTERM) # the group that this very process was started in
				raise
			finally:
				line.close()

	def _claimed(self):
		"""The folder, for one process at a time: the file to close when it is done."""
		claim = open(self.folder / ".lock", "w")
		try:
			fcntl.flock(claim, fcntl.LOCK_EX | fcntl.LOCK_NB)
		except BlockingIOError:
			raise RuntimeError(f"another benchmark is running in {self.folder}") from None
		return claim

	def _one(self, job, line):
		if self.stopped:
			return
		self._unchanged(job)
		start, key = time.monotonic(), self.path(job).stem
		words = [f"{name}={study.plain(value)}" for name, value in job.settings.items()]
		command = ["yade", "-n", "-x", "-j1", str(self.house / "scripts" / f"{job.script}.py"), *words, f"seed={job.seed}", f"tag={key}"]
		environment = {
			**os.environ, "OMP_WAIT_POLICY": "passive", "YADEBLOCKS_PLUGIN": str(self.plugin),
			"PYTHONPATH": os.pathsep.join([str(self.house / "py"), *filter(None, [os.environ.get("PYTHONPATH")])])
		}
		log = self.work / f"{key}.log"
		with open(log, "w") as output:
			with self.lock:
				if self.stopped: return
				process = subprocess.Popen(
					command, cwd=self.work, env=environment, stdout=output, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
					start_new_session=True
				)
				self.running.add(process)
			reason = self._wait(process)
		if self.stopped:
			return
		self._unchanged(job)
		record = {
			"parallel": self.parallel, "job": {"script": job.script, "settings": job.settings, "seed": job.seed},
			"command": " ".join(["scripts/run.sh", job.script, *words, f"seed={job.seed}"])
		}
		try:
			record.update(self._read(job, key) if not reason else {"failed": f"{reason}: {_lastLine(log)}"})
			if reason.startswith("not done"): record["limit"] = self.limit # more time may do
		except (OSError, KeyError, ValueError) as error:
			record["failed"] = f"left no result ({type(error).__name__}): {_lastLine(log)}"
		record["wall_s"] = time.monotonic() - start
		part = self.kept / f"{key}.part"
		part.write_text(json.dumps(record) + "\n")
		part.rename(self.path(job)) # complete or not there
		shutil.rmtree(self.work / "out" / f"{job.script}-{key}", ignore_errors=True)
		log.unlink()
		line.done(job, record)

	def _unchanged(self, job):
		"""A result that was made while the code changed belongs to neither state of it."""
		if self._code(job.script) != self.code(job.script):
			raise RuntimeError(f"the code behind scripts/{job.script}.py has changed while it was running: start the benchmark again")

	def _wait(self, process):
		"""Why the process failed, or nothing."""
		try:
			code = process.wait(self.limit)
			return f"exit code {code}" if code else ""
		except subprocess.TimeoutExpired:
			os.killpg(process.pid, signal.SIGKILL)
			process.wait()
			return f"not done after {self.limit:g} s"
		finally:
			with self.lock:
				self.running.discard(process)

	def _read(self, job, key):
		"""What the run left behind. The curve is kept, not what is read from it: that may be read again, in a better way."""
		import pandas
		folder = self.work / "out" / f"{job.script}-{key}"
		result, curve = json.loads((folder / "result.json").read_text()), pandas.read_csv(folder / "curve.csv")
		return {
			"reported": {quantity["name"]: quantity["measured"] for quantity in result["quantities"]}, "expected": {
				quantity["name"]: quantity["expected"] for quantity in result["quantities"] if quantity["expected"] is not None
			}, "cost": result["cost"], "quality": result["quality"], "curve": [curve.iloc[:, 1].tolist(), curve["stress_MPa"].tolist()]
		}

	def _code(self, script):
		"""The hash of all that a run of this script depends on but its settings."""
		files = sourcesOf(self.house / "scripts" / f"{script}.py", self.house / "py" / "yadeblocks")
		return fingerprint(files + ([] if script in self.pluginFree else [self.plugin]), yadeVersion(), _processor())


@lru_cache(maxsize=None)
def yadeVersion():
	return subprocess.run(["yade", "--version"], capture_output=True, text=True, stdin=subprocess.DEVNULL).stdout.split("\n")[0]


def machine():
	"""What CPU seconds were measured on."""
	return f"{_processor()}, {os.cpu_count()} cores"


@lru_cache(maxsize=None)
def _processor():
	lines = Path("/proc/cpuinfo").read_text().splitlines()
	return next((line.partition(":")[2].strip() for line in lines if line.startswith("model name")), platform.machine())


def _lastLine(log):
	"""What a run said last."""
	lines = [line.strip() for line in Path(log).read_text(errors="replace").splitlines() if line.strip()]
	return lines[-1][:300] if lines else "(said nothing)"


class _ProgressLine:
	"""done/all, the last job, the time left: jobs that cost more (by their steps) are expected to take longer."""
	def __init__(self, jobs, parallel, stream):
		self.left, self.total, self.parallel, self.stream = {job.name: job for job in jobs}, len(jobs), parallel, stream
		self.walls, self.start, self.lock = {}, time.monotonic(), threading.Lock()

	def done(self, job, record):
		with self.lock:
			del self.left[job.name]
			self.walls.setdefault(self._kind(job), []).append(record["wall_s"])
			everything = [wall for walls in self.walls.values() for wall in walls]
			mean = lambda walls: sum(walls) / len(walls)
			left = sum(mean(self.walls.get(self._kind(other), everything)) for other in self.left.values()) / self.parallel
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
