# yade-blocks, GPL-2.0-or-later
"""What all kinds of studies share: their keys, a scenario's settings, the folder of results, runs at points of the settings."""
import difflib
import itertools
import json
import math
import os
import re
import subprocess
import sys
from pathlib import Path

from yadeblocks import scenario

from .jobs import Job, Jobs
from .study import plain as asWord

commonKeys = {"seed": 1, "seeds": 5, "jobs": os.cpu_count() or 1, "limit": 1800.0, "retry": False, "scheduler": "", "tls": "", "out": "", "quantities": ""}
commonRules = {"seed": scenario.notNegative, "seeds": scenario.atLeastOne, "jobs": scenario.atLeastOne, "limit": scenario.positive}
meanings = {
	"seed": "first tessellation", "seeds": "tessellations at each point", "jobs": "runs at a time on this machine",
	"limit": "seconds after which a run is ended", "retry": "run again what failed",
	"scheduler": "HOST:PORT or scheduler file of a dask.distributed cluster that is there already",
	"tls": "folder with certificate.pem and key.pem of an encrypted cluster, see scripts/workers.sh",
	"out": "folder of the results, out/study-KIND-NAME by default", "quantities": "only these, separated by commas"
}


class StudyError(RuntimeError):
	"""What keeps a study from going on, in one line for the user."""


class Command:
	"""scripts/study.sh KIND NAME key=value ...: the study's own keys as `p`, those of the scenario as `settings`.

	NAME is a scenario in scripts/, or the path of one's own; where a file of targets says the scenario of each experiment, any name."""
	def __init__(self, house, kind, name, words, keys, rules, stream=None, engine=None):
		self.house, self.kind, self.script, self.asked = Path(house), kind, name, set()
		own, theirs = {**commonKeys, **keys}, []
		mine = []
		for word in words:
			key, equals, text = word.partition("=")
			if not equals: raise StudyError(f"study: arguments must have the form key=value, got {word}")
			(mine if key in own else theirs).append(word)
		try:
			self.p = scenario.parse(mine, own, {**commonRules, **rules}, scenario="study")
		except scenario.ParameterError as error:
			raise StudyError(str(error)) from None
		self.settings = withJoints({word.partition("=")[0]: word.partition("=")[2] for word in theirs}, self.stem)
		if not str(getattr(self.p, "targets", "")).endswith(".json") or self.hasScript(name): self.settings = self.quiet(name, self.settings)
		self.folder = Path(self.p.out) if self.p.out else self.house / "out" / f"study-{kind}-{self.stem}"
		plugin = os.environ.get("YADEBLOCKS_PLUGIN", self.house / "build" / "libyadeblocks.so")
		try:
			self.folder.mkdir(parents=True, exist_ok=True)
		except OSError as error:
			raise StudyError(f"study: {self.folder} cannot be made: {error.strerror}") from None
		self.runs = Jobs(
			self.house, self.folder, plugin, pluginFree=("spheres", ), limit=self.p.limit, parallel=self.p.jobs, retry=self.p.retry, stream=stream,
			scheduler=self.p.scheduler, tls=self.p.tls, engine=engine
		)

	@property
	def stem(self):
		return Path(self.script).stem

	def hasScript(self, name):
		return self._place(name).is_file()

	def _place(self, name):
		return Path(name) if name.endswith(".py") else self.house / "scripts" / f"{name}.py"

	def path(self, name):
		"""The script of a scenario, which must be there."""
		if not self.hasScript(name): raise StudyError(f"study: there is no scenario {name}")
		return self._place(name)

	def quiet(self, name, settings):
		"""The settings of a scenario, without ParaView files unless they are asked for."""
		return {"vtk": False, **settings} if re.search(r"\bvtk\b", self.path(name).read_text()) else settings

	def refuseKeys(self, points, script):
		"""StudyError where the scenario refuses the keys of every point, which is known without a run. What only YADE can tell passes."""
		if script in self.asked: return
		self.asked.add(script)
		for point in points:
			words = [f"{key}={asWord(value)}" for key, value in point.items()]
			asked = subprocess.run([sys.executable, "-m", "yadeblocks.help", self._place(script), *words], capture_output=True, text=True)
			if asked.returncode != 2 or not asked.stderr.strip(): return
		raise StudyError("study: " + asked.stderr.strip().splitlines()[-1])

	def measure(self, points, seeds, script=None):
		"""Runs the points (settings) over the seeds, what is not there yet; for each point its records by seed."""
		if script or self.hasScript(self.script): self.refuseKeys(points, script or self.script)
		asked = [[Job(script or self.script, point, seed) for seed in seeds] for point in points]
		self.runs.do([job for jobs in zip(*asked) for job in jobs]) # seed by seed, so that an early end leaves all points
		return [{job.seed: self.runs.record(job) for job in jobs} for jobs in asked]

	def write(self, **study):
		"""study.json, whole or not at all."""
		writeWhole(
			self.folder / "study.json",
			json.dumps(plain({"kind": self.kind, "scenario": self.stem, "settings": self.settings, **study}), indent=1) + "\n"
		)


def plain(value):
	"""What json can write: numpy's numbers as Python's, NaN as null."""
	if isinstance(value, dict): return {str(key): plain(entry) for key, entry in value.items()}
	if isinstance(value, (list, tuple)) or type(value).__name__ == "ndarray": return [plain(entry) for entry in value]
	if hasattr(value, "item"): value = value.item()
	return None if isinstance(value, float) and not math.isfinite(value) else value


def writeWhole(path, text):
	part = path.with_suffix(".part")
	part.write_text(text)
	part.rename(path)


def asValue(text):
	"""A word of the command line as a number, a truth value or a text."""
	if text in ("true", "false"): return text == "true"
	for kind in (int, float):
		try:
			return kind(text)
		except ValueError:
			pass
	return text


def withJoints(texts, stem):
	"""Settings of a scenario as values. joints=FILE.json is replaced by what the file says, so that a changed file is another setting."""
	settings = {key: asValue(text) for key, text in texts.items()}
	if str(settings.get("joints", "")).endswith(".json"):
		try:
			settings = {**scenario.jointsFrom(settings.pop("joints"), stem), **settings}
		except scenario.ParameterError as error:
			raise StudyError(f"study: {error}") from None
	return settings


def product(settings):
	"""All points of settings whose values may be lists: "0.1e6,0.5e6" gives two."""
	lists = {key: [asValue(text) for text in value.split(",")] if isinstance(value, str) and "," in value else [value] for key, value in settings.items()}
	return [dict(zip(lists, values)) for values in itertools.product(*lists.values())]


def table(path):
	"""The points of a table: names in the first line, values below, separated by blanks (as yade-batch takes it) or commas."""
	try:
		lines = [line for line in Path(path).read_text().splitlines() if line.strip() and not line.lstrip().startswith("#")]
	except OSError as error:
		raise StudyError(f"study: the table {path} cannot be read: {error.strerror}") from None
	rows = [[word for word in re.split(r"[,\s]+", line.strip()) if word] for line in lines]
	if len(rows) < 2: raise StudyError(f"study: the table {path} needs names in its first line and at least one line of values")
	for number, row in enumerate(rows[1:], 2):
		if len(row) != len(rows[0]): raise StudyError(f"study: line {number} of {path} has {len(row)} values, the first line has {len(rows[0])} names")
	return [{name: asValue(text) for name, text in zip(rows[0], row) if name != "description"} for row in rows[1:]]


def good(records):
	"""The records that are results, by seed."""
	return {seed: record for seed, record in records.items() if record and "failed" not in record}


def reasons(records):
	"""Why runs failed: {reason: how often}."""
	found = {}
	for record in records:
		if record and "failed" in record: found[record["failed"]] = found.get(record["failed"], 0) + 1
	return found


def demandResults(measured):
	"""Raises StudyError if no run of all gave a result."""
	if not any(good(records) for records in measured):
		why = reasons(record for records in measured for record in records.values())
		raise StudyError("study: every run failed: " + "; ".join(why))


def quantitiesOf(measured, wanted=()):
	"""{quantity: unit} of the records, in their order; `wanted` restricts them. Raises StudyError for one that no run has measured."""
	units = {}
	for records in measured:
		for record in good(records).values():
			units.update(record["units"])
	for name in wanted:
		if name not in units:
			close = difflib.get_close_matches(name, units, 1)
			raise StudyError(
				f"study: there is no quantity {name}{f' (did you mean {close[0]}?)' if close else ''}; measured are: {' '.join(units)}"
			)
	return {name: units[name] for name in (wanted or units)}


def listed(text):
	return tuple(word for word in text.split(",") if word)


def bounds(text):
	"""{key: (low, high, whether it is varied in proportion)} from "kn:200e9:800e9,friction:20:50:lin" or a file of {key: [low, high]} or
	{key: [low, high, "lin"]}. In proportion, unless a bound is not positive or "lin" is said."""
	if text.endswith(".json"):
		try:
			entries = [[key, *values] for key, values in json.loads(Path(text).read_text()).items()]
		except OSError as error:
			raise StudyError(f"study: bounds: {text} cannot be read: {error.strerror}") from None
		except (ValueError, AttributeError, TypeError):
			raise StudyError(f"study: bounds: {text} must be of the form {{key: [low, high]}}") from None
	else:
		entries = [entry.split(":") for entry in text.split(",") if entry]
	found = {}
	for entry in entries:
		try:
			key, low, high = entry[0], float(entry[1]), float(entry[2])
			if len(entry) > 4 or len(entry) == 4 and entry[3] != "lin": raise ValueError
		except (ValueError, IndexError, TypeError):
			raise StudyError(f"study: bounds must be of the form key:low:high or key:low:high:lin, got {':'.join(map(str, entry))}") from None
		if not -math.inf < low < high < math.inf:
			raise StudyError(f"study: bounds of {key} must be finite, the lower one below the upper, got {low:g} and {high:g}")
		found[key] = low, high, low > 0 and len(entry) == 3
	if not found: raise StudyError("study: bounds= must be given, e.g. bounds=cohesion:0.5e6:2e6,friction:20:50:lin")
	return found


def place(bounds, unit):
	"""The parameters at a point of the unit cube; six digits, as they are written down and run."""
	return {
		key: float(f"{low * (high / low)**u if proportional else low + u * (high - low):.6g}")
		for (key, (low, high, proportional)), u in zip(bounds.items(), unit)
	}
