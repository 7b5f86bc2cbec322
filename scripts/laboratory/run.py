# yade-blocks, GPL-2.0-or-later
"""One run on a worker: a process of its own, killed with its limit or its worker, and what it left behind.

A worker gets these functions with the task and needs nothing but Python, YADE and the checkout: import only the standard library here.

A task is {"command": words, "environment": variables, "folder": where results will be, below a fresh folder, "limit": s of wall-clock time, "files": the
code that the run depends on, "digest": what their hash has to be, "scratch": where the fresh folder is made, None: the worker's own}.
Its outcome is {"result": result.json, "curve": {column: values} or None} or {"failed": reason}, with "wall_s", "host" and "processor"; or
{"changed": true}: the code is not, or not any more, the one that was asked for.
"again" says that the reason lies in the machine: the same run may succeed. "limit" says which limit was too short.
"""
import csv
import hashlib
import json
import os
import platform
import shutil
import signal
import subprocess
import tempfile
import time


def execute(task):
	"""Runs the task and returns its outcome. The kernel kills the process when its worker dies."""
	start = time.monotonic()
	outcome = {"host": platform.node(), "processor": processor(), **_attempt(task)}
	return {**outcome, "wall_s": time.monotonic() - start}


def _attempt(task):
	if task["digest"] != digest(task["files"]): return {"changed": True}
	place = None
	try:
		place = tempfile.mkdtemp(dir=task["scratch"])
		log = os.path.join(place, "log")
		reason = _process(task, place, log)
		said = _lastLine(log)
		if reason:
			outcome = {"failed": f"{reason}: {said}", "again": reason.startswith("exit code -") or "No space left on device" in said}
			if reason.startswith("not done"): outcome["limit"] = task["limit"] # more time may do
		else:
			try:
				outcome = _read(os.path.join(place, task["folder"]))
			except (OSError, KeyError, ValueError) as error:
				outcome = {"failed": f"left no result ({type(error).__name__}): {said}", "again": False}
	except OSError as error:
		outcome = {"failed": f"the worker's machine: {error}", "again": True}
	finally:
		if place: shutil.rmtree(place, ignore_errors=True)
	return outcome if task["digest"] == digest(task["files"]) else {"changed": True}


def _process(task, place, log):
	"""Why the process failed, or nothing."""
	runs = _kept("runs", set)
	with open(log, "w") as output:
		process = subprocess.Popen(["setpriv", "--pdeathsig", "KILL", "--", *task["command"]], cwd=place, env={**os.environ, **task["environment"]},
						stdout=output, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, start_new_session=True)
	runs.add(process.pid)
	try:
		code = process.wait(task["limit"])
		return f"exit code {code}" if code else ""
	except subprocess.TimeoutExpired:
		os.killpg(process.pid, signal.SIGKILL) # the group that this very process was started in
		process.wait()
		return f"not done after {task['limit']:g} s"
	finally:
		runs.discard(process.pid)


def _kept(name, kind):
	"""What stays with the worker from one task to the next: these functions come anew with each."""
	try:
		from distributed import get_worker
		return get_worker().__dict__.setdefault("blocks_" + name, kind())
	except (ImportError, ValueError): # no worker: called directly
		return kind()


def stopAll(dask_worker):
	"""Ends what a worker is running."""
	for pid in list(dask_worker.__dict__.get("blocks_runs", ())):
		try:
			os.killpg(pid, signal.SIGTERM)
		except ProcessLookupError:
			pass


def _read(folder):
	"""What the run left behind. The curve is kept, not what is read from it: that may be read again, in a better way."""
	with open(os.path.join(folder, "result.json")) as file:
		result = json.load(file)
	curve = os.path.join(folder, "curve.csv")
	if not os.path.exists(curve): return {"result": result, "curve": None}
	with open(curve, newline="") as file:
		names, *rows = csv.reader(file)
	columns = {name: [float(value) if value else float("nan") for value in values] for name, values in zip(names, zip(*rows))}
	return {"result": result, "curve": columns}


def digest(files):
	"""A hash of the contents of these files; what cannot be read differs from everything. A file is read again once its time or size has changed."""
	known, total = _kept("digests", dict), hashlib.sha256()
	for path in sorted(files):
		try:
			now = os.stat(path)
			stamp = now.st_mtime_ns, now.st_ctime_ns, now.st_size, now.st_ino
			if known.get(path, (None, ))[0] != stamp:
				with open(path, "rb") as file:
					known[path] = stamp, hashlib.sha256(file.read()).digest()
			total.update(f"\0{os.path.basename(path)}\0".encode() + known[path][1])
		except OSError as error:
			total.update(f"\0{error}\0".encode())
	return total.hexdigest()


def kind():
	"""What results depend on besides code and settings: YADE's version and the processor."""
	return yadeVersion(), processor()


def yadeVersion():
	"""Of the YADE that is found on the path."""
	try:
		return subprocess.run(["yade", "--version"], capture_output=True, text=True, stdin=subprocess.DEVNULL).stdout.split("\n")[0]
	except OSError:
		return "no YADE"


def processor():
	known = _kept("processor", list)
	if not known:
		with open("/proc/cpuinfo") as file:
			lines = file.read().splitlines()
		known.append(next((line.partition(":")[2].strip() for line in lines if line.startswith("model name")), platform.machine()))
	return known[0]


def _lastLine(log):
	"""What a run said last."""
	with open(log, errors="replace") as file:
		lines = [line.strip() for line in file if line.strip()]
	return lines[-1][:300] if lines else "(said nothing)"
