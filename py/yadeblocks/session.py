# yade-blocks, GPL-2.0-or-later
"""A scenario from its first second to its last: results on the disk as soon as there are any, whatever ends the run.

	with Session(p) as session:
		for seed in p.seedList:
			if session.wants(seed):
				with session.run(seed) as run:                        # see results.Run
					stage = session.stage(f"seed {seed}")
					model = stage.model or build(seed)                # of a checkpoint, with resume=true
					record, cracks = Recorder(...), Cracks(model)
					stage.keep(record=record, cracks=cracks)          # what a checkpoint keeps besides the scene
					if not stage.model: begin(model)
					stage.run()                                       # until something stops it
					run.add(...)
				session.picture('cracks.png', drawCracks, model)      # pictures and ParaView files: behind the results
		session.write()                                               # all seeds are there

After each seed result.json (with "complete": false) and curve.csv are written anew, each whole or not at all; pictures and ParaView files come last. Ctrl-C and
SIGTERM act after the step that is going on and end the program with 130 or 143; what cannot be written is said in a line, and the exit code is 1, or 2
before anything was computed."""
import io
import json
import sys
from contextlib import contextmanager
from pathlib import Path

from . import _plugin, files, running
from .checkpoint import Checkpoints, Stranger
from .provenance import fingerprint, sourcesOf
from .results import Results, Run
from .scenario import Parameters
from .stage import Stage


class Session:
	"""Gathers the results of a scenario. parameters: from scenario.parameters."""
	def __init__(self, parameters):
		if not isinstance(parameters, Parameters): raise TypeError(f"Session.parameters must be what scenario.parameters returned, got {parameters!r}")
		self.parameters, self.results, self.folder = parameters, Results(parameters), parameters.folder
		self.period = getattr(parameters, "checkpoint", 0)
		self.waiting, self.troubles = [], []
		self.current = self.stageNow = self._resumed = self._keptRuns = None
		self.checkpoints = Checkpoints(self.folder / "checkpoint", self._identity())

	def _identity(self):
		"""What must be the same where a run is resumed."""
		script, plugin = Path(sys.argv[0]).resolve(), _plugin.loadedFrom(_plugin.libraryName)
		code = ([script] if script.suffix == ".py" else []) + [plugin] * bool(plugin)
		sources = sourcesOf(script, Path(__file__).parent) if script.suffix == ".py" else []
		return {"scenario": self.parameters.scenario, "code": fingerprint({*map(Path, code), *sources}), "keys": self.parameters.asDict()}

	# ---- beginning and end

	def __enter__(self):
		try:
			files.requireFolder(self.folder)
			files.requireFolder(self.checkpoints.folder) if self.period else None
			self._begin()
		except OSError as error:
			self._end(2, error)
		except Stranger as error:
			self._end(2, f"resume=true goes on with the same code and keys only, and the checkpoint has other ones: {error}")
		self._interrupts = running.interrupts()
		self._interrupts.__enter__()
		return self

	def _begin(self):
		files.remove(self.folder / "unfinished.csv")
		if not getattr(self.parameters, "resume", False):
			if self.checkpoints.numbers(): self._say(f"{self.checkpoints.folder} is of a run that did not end; resume=true would go on with it")
			return
		state = self.checkpoints.newest()
		if state is not None:
			self.results.runs = [Run.of(kept) for kept in state["runs"]]
			self._resumed = state.get("stage")
			self._say(f"goes on {'in ' + self._resumed['label'] if self._resumed else 'behind seed %d' % self.results.runs[-1].seed}")
		elif self._isComplete():
			self._say(f"{self.folder} is complete: there is nothing to go on with")
			sys.exit(0)
		else:
			self._say("there is no checkpoint: begins at the beginning")

	def _isComplete(self):
		try:
			result = json.loads((self.folder / "result.json").read_text())
		except (OSError, ValueError):
			return False
		return result.get("complete") is True and result["parameters"] == json.loads(json.dumps(self.parameters.asDict()))

	def __exit__(self, kind, error, trace):
		try:
			if kind is None or issubclass(kind, (Exception, running.Interrupted)):
				if kind is not None: self._keepUnfinished()
				self._writeWaiting()
				if kind is None: self.checkpoints.clear()
		except running.Interrupted as another:
			kind, error = type(another), another
		finally:
			self._interrupts.__exit__(None, None, None)
		if kind is None: return self._end(1, *self.troubles) if self.troubles else None
		if issubclass(kind, running.Interrupted): self._end(128 + error.signal, f"{error}: {self._whatThereIs()}", *self.troubles)
		if issubclass(kind, OSError): self._end(1, f"{_inWords(error)}: {self._whatThereIs()}", *self.troubles)
		if issubclass(kind, Exception):
			for line in (self._whatThereIs(), *self.troubles):
				self._say(line)
		return False

	def _whatThereIs(self):
		seeds = [str(run.seed) for run in self.results.runs]
		if self.results.complete: return f"all results are in {self.folder}"
		done = f"results of seed {', '.join(seeds)} are in {self.folder}" if seeds else "no seed was done"
		return done + (", resume=true goes on" if self.checkpoints.numbers() else "")

	def _say(self, line):
		print(f"{self.parameters.scenario}: {line}", file=sys.stderr, flush=True)

	def _end(self, code, *lines):
		for line in lines:
			self._say(line)
		sys.exit(code)

	# ---- seeds

	def wants(self, seed, quality=None):
		"""Whether this tessellation is still to be run; or, with the name of a quality, whether its run lacks this."""
		run = self._of(seed)
		return run is None if quality is None else quality not in run.qualities

	def _of(self, seed):
		return next((run for run in self.results.runs if run.seed == seed), None)

	@contextmanager
	def run(self, seed):
		"""A run with this tessellation; at the end of the block its results are on the disk."""
		with self.results.run(seed) as run:
			self.current = run
			if self._resumed and self._resumed["elapsed"]: run.resume(self._resumed["elapsed"])
			yield run
		self.current = self.stageNow = None
		self.results.save()

	def quality(self, seed, **values):
		"""Adds a quality to the run of a tessellation that is done, see results.Run.quality."""
		self._of(seed).quality(**values)
		self.results.save()

	def stage(self, label):
		"""A part of a run that takes long: its model is that of the checkpoint if this is where the run is resumed."""
		self.keepRuns()
		self.stageNow = Stage(self, label)
		if self._resumed and self._resumed["label"] == label:
			self.stageNow.resume(self.checkpoints.loadScene(), self._resumed)
			self._resumed = None
		return self.stageNow

	def later(self, write, *arguments, **named):
		"""Calls write(*arguments, **named), which writes files, behind the results; with checkpoints at once, since a killed run
		would not get there."""
		self.waiting.append((write, arguments, named))
		if self.period: self._writeWaiting()

	def picture(self, name, draw, *arguments, **named):
		"""Draws a picture now, draw(file, *arguments, **named), and writes it behind the results."""
		drawn = io.BytesIO()
		draw(drawn, *arguments, **named)
		self.later(files.replace, self.folder / name, drawn.getvalue())

	def measured(self, seed, quantity):
		"""What the run of this tessellation has measured."""
		return self._of(seed).quantities[quantity].measured

	def write(self):
		"""All runs are there: result.json and curve.csv for good, and the table."""
		self.results.write()

	def _writeWaiting(self):
		waiting, self.waiting = self.waiting, []
		for write, arguments, named in waiting:
			try:
				write(*arguments, **named)
			except OSError as error:
				self.troubles.append(_inWords(error))

	def _keepUnfinished(self):
		"""What recorders of an unfinished stage have read: unfinished.csv."""
		for recorder in [part for part in self.stageNow.parts.values() if hasattr(part, "rows")] if self.stageNow else []:
			lines = [",".join(recorder.columns), *(",".join(f"{value:.7g}" for value in row) for row in recorder.rows)]
			try:
				files.replace(self.folder / "unfinished.csv", "\n".join(lines) + "\n")
			except OSError as error:
				self.troubles.append(_inWords(error))

	# ---- checkpoints

	def keepRuns(self):
		"""A checkpoint between two stages."""
		if not self.period or not self.results.runs: return
		kept = [run.kept for run in self.results.runs]
		if kept != self._keptRuns and not self._resumed: self._checkpoint({"runs": kept}, scene=False)
		self._keptRuns = kept

	def keepStage(self, stage):
		"""A checkpoint within a stage, between two steps."""
		from yade.wrapper import Omega
		self._checkpoint({
			"runs": [run.kept for run in self.results.runs], "stage": {
				"label": stage.label, "parts": {name: part.kept for name, part in stage.parts.items()}, "elapsed": self.current
				and self.current.elapsed, "times": [[engine.execTime, engine.execCount] for engine in Omega().engines]
			}
		}, scene=True)

	def _checkpoint(self, state, scene):
		try:
			self.checkpoints.write(state, scene)
		except OSError as error:
			self._say(f"no checkpoint, {_inWords(error)}") # the run need not end for this


def _inWords(error):
	"""What could not be written and why."""
	return f"cannot write {error.filename}: {error.strerror}" if error.filename else str(error)
