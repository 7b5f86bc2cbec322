# yade-blocks, GPL-2.0-or-later
"""The engine of many runs, with workers that are really there: what dies, what takes too long, what is not there. Runs are small shell scripts."""
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import psutil
import pytest

from yadeblocks import curves

package = Path(curves.__file__).parent
sys.path.insert(0, str(package.parents[1] / "scripts"))
from laboratory import engine, run
from laboratory.jobs import Job, Jobs


def listeners(*pids):
	"""(process, address, port) on which these processes listen."""
	return {(each.pid, each.laddr.ip, each.laddr.port) for each in psutil.net_connections("inet") if each.status == psutil.CONN_LISTEN and each.pid in pids}


@pytest.fixture(scope="module")
def workers():
	before = listeners(os.getpid()) # YADE itself listens on every address
	with engine.Engine(2) as started:
		started.before = before
		yield started


def task(script, limit=60.0, files=()):
	"""One whose shell script may say `result`: it leaves a result."""
	leave = 'result() { mkdir -p out; echo \'{"quantities": [], "cost": {}, "quality": {}}\' > out/result.json; }; '
	return {
		"command": ["sh", "-c", leave + script], "environment": {}, "folder": "out", "limit": limit, "files": list(files), "digest": run.digest(files),
		"scratch": None
	}


def outcomes(workers, *tasks):
	found = {}
	workers.do(tasks, lambda task, outcome: found.setdefault(tasks.index(task), outcome))
	return [found[i] for i in range(len(tasks))]


def gone(pid):
	try:
		return psutil.Process(pid).status() == psutil.STATUS_ZOMBIE
	except psutil.NoSuchProcess:
		return True


def test_onlyOnTheLoopbackAddress(workers):
	group = [process.pid for process in psutil.Process(workers.workers.pid).children(recursive=True)]
	found = listeners(os.getpid(), workers.workers.pid, *group) - workers.before
	assert len({pid for pid, address, port in found}) >= 3 # the scheduler's process and both workers
	assert {address for pid, address, port in found} == {"127.0.0.1"}


def test_whatFailsSaysWhyAndTheRestGoesOn(workers):
	fine, long, refused, killed, silent = outcomes(
		workers, task("result"), task("echo tired; sleep 60", limit=0.5), task("echo too small >&2; exit 2"), task("kill -9 $$"), task(":")
	)
	assert fine["result"]["quantities"] == [] and fine["curve"] is None
	assert long["failed"] == "not done after 0.5 s: tired" and long["limit"] == 0.5
	assert refused["failed"] == "exit code 2: too small" and not refused["again"]
	assert killed["failed"].startswith("exit code -9") and killed["again"]
	assert silent["failed"] == "left no result (FileNotFoundError): (said nothing)"


def test_aWorkerThatDiesLosesOnlyItsRun(workers, tmp_path):
	"""The first attempt kills its worker; the process it leaves behind ends too, and the run is done again."""
	first = tmp_path / "first"
	deadly = task(f"if [ ! -e {first} ]; then echo $$ > {first}; kill -9 $PPID; sleep 100; fi; result")
	found = outcomes(workers, deadly, task("sleep 0.2; result"), task("result"))
	assert all("result" in each for each in found)
	assert gone(int(first.read_text()))


def test_codeThatIsNotTheSame(workers, tmp_path):
	code = tmp_path / "code"
	code.write_text("a")
	asked = task("result", files=[str(code)])
	code.write_text("b")
	assert outcomes(workers, asked)[0]["changed"]


def test_interruptEndsTheRuns(workers, tmp_path):
	pid = tmp_path / "pid"

	def interrupt(task, outcome):
		while not (pid.exists() and pid.read_text().strip()):
			time.sleep(0.01)
		raise KeyboardInterrupt

	with pytest.raises(KeyboardInterrupt):
		workers.do([task(f"echo $$ > {pid}; exec sleep 100"), task("result")], interrupt)
	until = time.monotonic() + 20
	while not gone(int(pid.read_text())) and time.monotonic() < until:
		time.sleep(0.05)
	assert gone(int(pid.read_text()))


def test_noScheduler(monkeypatch, tmp_path):
	monkeypatch.setattr(engine, "patience", 1.0)
	with pytest.raises(engine.EngineError, match="no scheduler answers at 127.0.0.1:1"):
		engine.Engine(scheduler="127.0.0.1:1").start()
	with pytest.raises(engine.EngineError, match="there is no scheduler file .*nowhere.json"):
		engine.Engine(scheduler=str(tmp_path / "nowhere.json")).start()


def test_noWorker(monkeypatch):
	from distributed import LocalCluster
	monkeypatch.setattr(engine, "patience", 1.0)
	with LocalCluster(n_workers=0, host="127.0.0.1", dashboard_address="127.0.0.1:0") as empty:
		with pytest.raises(engine.EngineError, match="no worker of tcp://127.0.0.1:.* has appeared within 1 s"):
			engine.Engine(scheduler=empty.scheduler_address).start()


def test_encryptedCluster(tmp_path):
	"""scripts/workers.sh without Slurm: who has the certificate gets in, who has none or another does not."""
	script, folder = package.parents[1] / "scripts/workers.sh", tmp_path / "cluster"
	with open(tmp_path / "log", "w") as log:
		started = subprocess.Popen([script, folder], env={**os.environ, "BLOCKS_HOST": "127.0.0.1"}, stdout=log, stderr=log, start_new_session=True)
	try:
		until = time.monotonic() + 200
		while not (folder / "scheduler.json").exists() and time.monotonic() < until:
			time.sleep(0.1)
		assert oct((folder / "key.pem").stat().st_mode)[-3:] == "600"
		where = str(folder / "scheduler.json")
		with engine.Engine(scheduler=where, tls=str(folder)) as user:
			assert user.client.scheduler.address.startswith("tls://127.0.0.1")
			assert "result" in outcomes(user, task("result"))[0]
		with pytest.raises(engine.EngineError, match="no scheduler answers"):
			engine.Engine(scheduler=where).start()
		with pytest.raises(engine.EngineError, match="tls: .* cannot be read"):
			engine.Engine(scheduler=where, tls=str(tmp_path)).start()
	finally:
		os.killpg(started.pid, signal.SIGTERM)
		started.wait()


def house(tmp_path):
	(tmp_path / "scripts").mkdir(), (tmp_path / "py/yadeblocks").mkdir(parents=True)
	(tmp_path / "scripts/mine.py").write_text("")
	return tmp_path


def test_diskFull(workers, tmp_path):
	"""/dev/full refuses as a full disk does."""
	jobs = Jobs(house(tmp_path), tmp_path / "out", tmp_path / "scripts/mine.py", engine=workers, stream=open(os.devnull, "w"))
	job = Job("mine", {}, 1)
	jobs.kept.mkdir(parents=True)
	jobs.path(job).with_suffix(".part").symlink_to("/dev/full")
	with pytest.raises(engine.EngineError, match="the result of mine .* cannot be kept in .*: No space left on device"):
		jobs.do([job])
	assert jobs.record(job) is None


def test_schedulerThatGoes():
	"""Last, since it ends a cluster: one that another engine was using."""
	with engine.Engine(1) as owner:
		user = engine.Engine(scheduler=owner.cluster.scheduler_address)
		user.start()
		threading.Timer(1.0, owner.close).start()
		try:
			with pytest.raises(engine.EngineError, match="the scheduler tcp://127.0.0.1:.* has gone"):
				user.do([task("sleep 30; result")], lambda task, outcome: None)
		finally:
			user.close()
