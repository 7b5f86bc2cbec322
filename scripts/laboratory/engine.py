# yade-blocks, GPL-2.0-or-later
"""Many runs at a time, by dask.distributed: on this machine, or on a cluster that is there already.

	with Engine(parallel=2) as engine:                       # a scheduler and workers of its own, on the loopback address, ended with the block
		engine.do(tasks, done)                               # done(task, outcome) for each, in the order in which they end
	Engine(scheduler="node7:8786")                           # or the scheduler file that the cluster's workers have met by
	Engine(scheduler="FOLDER/scheduler.json", tls="FOLDER")  # encrypted, see scripts/workers.sh

A worker runs one task at a time. One that dies loses only its run, which another worker does again; a run with which five workers have died counts as failed.
"""
import collections
import os
import queue
import subprocess
import sys
import time
from pathlib import Path

from . import run

patience = 60.0 #: Seconds after which a cluster without workers counts as gone.
attempts = 5 #: So many workers may die of a run, or while it waits for its turn on them.
ahead = 2 #: Tasks that each worker has: one that is running and one that waits, since asking for the next one takes time.


class EngineError(RuntimeError):
	"""What keeps the engine from going on, in one line for the user."""


class Engine:
	"""parallel: workers of the local cluster; scheduler: address or file of a cluster to be used instead ("": none).

	tls: folder with certificate.pem, which all sides share, and key.pem; "": those of Dask's own configuration (distributed.comm.tls), if any."""
	def __init__(self, parallel=1, scheduler="", tls=""):
		self.parallel, self.scheduler, self.tls = parallel, scheduler, tls
		self.cluster = self.client = self.workers = self.kind = None

	def __enter__(self):
		self.start()
		return self

	def __exit__(self, *_):
		self.close()

	def start(self):
		"""Connects, once; what is there already stays."""
		if self.client: return
		import cloudpickle
		import dask
		from distributed import Client
		cloudpickle.register_pickle_by_value(run) # workers need not have our code, nor the same state of it
		dask.config.set({
			"distributed.scheduler.allowed-failures": attempts - 1, "distributed.scheduler.transition-log-length": 1000,
			"distributed.scheduler.events-log-length": 1000, "distributed.admin.log-length": 1000, "distributed.comm.retry.count": 2
		})
		_quieten()
		try:
			if not self.scheduler: self._startCluster()
			self.client = Client(**self._address(), **self._security(), timeout=min(30, patience), set_as_default=False)
			self._waitForWorkers()
			self.kind = None if self.local else self._oneKind()
		except (OSError, TimeoutError, TypeError) as error: # TypeError: no certificates for an address that begins with tls://
			self.close()
			raise EngineError(f"no scheduler answers at {self.scheduler or 'the loopback address'}: {error}") from None
		except BaseException:
			self.close()
			raise

	@property
	def local(self):
		return not self.scheduler

	def _startCluster(self):
		from distributed import LocalCluster
		self.cluster = LocalCluster(n_workers=0, host="127.0.0.1", dashboard_address="127.0.0.1:0", silence_logs=50)
		command = [
			sys.executable, "-m", "distributed.cli.dask_worker", self.cluster.scheduler_address, "--nworkers",
			str(self.parallel), "--nthreads", "1", "--host", "127.0.0.1", "--no-dashboard", "--dashboard-address", "127.0.0.1:0", "--memory-limit",
			"0", "--death-timeout", "60"
		]
		environment = {**os.environ, "DASK_DISTRIBUTED__WORKER__PROFILE__ENABLED": "False", "OMP_NUM_THREADS": "1"}
		self.workers = subprocess.Popen(["setpriv", "--pdeathsig", "KILL", "--", *command], env=environment, stdin=subprocess.DEVNULL,
						stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)

	def _address(self):
		if self.cluster: return {"address": self.cluster}
		if self.scheduler.endswith(".json"):
			if not Path(self.scheduler).is_file(): raise EngineError(f"there is no scheduler file {self.scheduler}")
			return {"scheduler_file": self.scheduler}
		return {"address": self.scheduler}

	def _security(self):
		if not self.tls: return {}
		from distributed.security import Security
		certificate, key = (os.path.join(self.tls, name) for name in ("certificate.pem", "key.pem"))
		for file in (certificate, key):
			if not os.access(file, os.R_OK): raise EngineError(f"tls: {file} cannot be read")
		return {"security": Security(tls_ca_file=certificate, tls_client_cert=certificate, tls_client_key=key, require_encryption=True)}

	def _waitForWorkers(self):
		where = self.scheduler or "this machine"
		until = time.monotonic() + patience
		while not self.slots():
			if self.workers and self.workers.poll() is not None:
				raise EngineError("the local workers did not start: is python3-distributed installed?")
			if time.monotonic() > until: raise EngineError(f"no worker of {where} has appeared within {patience:g} s")
			time.sleep(0.05)

	def slots(self):
		"""How many runs the workers that are there can do at a time."""
		return sum(worker["nthreads"] for worker in self.client.scheduler_info()["workers"].values())

	def _oneKind(self):
		"""What results of a cluster depend on besides code and settings: its (YADE's version, processor), which have to be alike."""
		kinds = sorted(set(self.client.run(run.kind).values()))
		if len(kinds) > 1: raise EngineError("workers differ in YADE's version or processor: " + " and ".join(", ".join(kind) for kind in kinds))
		return kinds[0]

	def do(self, tasks, done):
		"""Runs the tasks and calls done(task, outcome) for each. What done raises ends the other runs."""
		waiting, running, ended = collections.deque(tasks), {}, queue.SimpleQueue()
		lastSeen = time.monotonic()
		try:
			while waiting or running:
				slots = self.slots()
				while waiting and len(running) < ahead * max(1, slots): # no more, so that neither tasks nor results pile up
					task = waiting.popleft()
					future = self.client.submit(run.execute, task, pure=False)
					running[future.key] = task, future
					future.add_done_callback(lambda future: ended.put(future.key))
				if slots: lastSeen = time.monotonic()
				self._alive(lastSeen)
				try:
					key = ended.get(timeout=1)
				except queue.Empty:
					continue
				task, future = running.pop(key)
				done(task, self._outcome(future))
				del future
		except BaseException:
			self._stopRuns([future for task, future in running.values()])
			raise

	def _outcome(self, future):
		from distributed.scheduler import KilledWorker
		if future.status == "finished": return future.result()
		self._alive(time.monotonic())
		if future.status == "cancelled":
			raise EngineError(f"the scheduler {self.scheduler} has gone; what is complete is kept, the same command continues")
		error = future.exception()
		if isinstance(error, KilledWorker):
			return {"failed": f"{attempts} workers died of it", "again": True, "wall_s": 0.0, "host": "", "processor": ""}
		return {"failed": f"the worker: {type(error).__name__}: {error}", "again": True, "wall_s": 0.0, "host": "", "processor": ""}

	def _alive(self, lastSeen):
		"""Raises EngineError once there is nothing to wait for."""
		if self.client.status not in ("running", ):
			raise EngineError(f"the scheduler {self.scheduler} has gone; what is complete is kept, the same command continues")
		if self.workers and self.workers.poll() is not None:
			raise EngineError("the local workers have ended; what is complete is kept, the same command continues")
		if time.monotonic() - lastSeen > patience:
			raise EngineError(f"all workers of {self.scheduler or 'this machine'} have gone; what is complete is kept, the same command continues")

	def _stopRuns(self, futures):
		if self.client.status != "running": return
		try:
			self.client.cancel(futures)
			self.client.run(run.stopAll, on_error="ignore")
		except Exception: # the cluster may have gone: the first reason is the one that counts
			pass

	def close(self):
		"""Ends what was started; a cluster that was there stays."""
		if self.client:
			self.client.close(timeout=5)
		if self.workers:
			self.workers.terminate()
			try:
				self.workers.wait(5)
			except subprocess.TimeoutExpired:
				self.workers.kill() # their runs die with them
				self.workers.wait()
		if self.cluster: self.cluster.close(timeout=5)
		self.cluster = self.client = self.workers = None


def _quieten():
	"""Dask's own reports: what matters is said by EngineError."""
	import logging
	for name in ("distributed", *("distributed." + part for part in ("worker", "scheduler", "nanny", "client", "core")), "tornado", "asyncio"):
		logging.getLogger(name).setLevel(logging.CRITICAL)
