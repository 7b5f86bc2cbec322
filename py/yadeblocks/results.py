# yade-blocks, GPL-2.0-or-later
"""What a scenario found: result.json, curve.csv and the table on the terminal.

	results = Results(p)
	for seed in p.seedList:
		with results.run(seed) as run:           # CPU and wall-clock time
			model = build(seed)
			with run.stepping():                 # the part that us_per_step speaks of
				O.run(p.steps, True)
			run.add("peak_tensile_stress", "MPa", stress.max() / 1e6, expected=0.35, source="Van der Pluijm 1992, Fig. 6")
			run.curve(displacement_mm=1e3 * displacement, stress_MPa=stress / 1e6)
			run.model(model, steps=O.iter)       # cost and cracks
			run.quality(unbalanced_ratio_max=ratio)
	results.write()
"""
import json
import math
import numbers
import resource
import time
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Optional

import numpy as np

from . import files
from ._calls import door
from .curves import hasPeak
from .export import pointNames
from .recording import known, runner

#: Contact points by what has become of them: values of `model.pointStatus`.
intact, brokenInTension, brokenInShear, neverBonded = range(4)

modes = {"tension": brokenInTension, "shear": brokenInShear}


class Cracks:
	"""What has broken in a model, and what broke first: `look()` every now and then, the rest whenever it is wanted.

	To be made at the start of a run: areas count as they were bonded. Joints count under their names: those of the model (BlockModel.nameJoints), or
	names: name -> indices of joints; what has no name counts under that of its pair of materials. names={}: pairs of materials alone."""
	@door(model='model', names='mapping')
	def __init__(self, model, names=None):
		self.model = model
		self.pairs = pointNames(model, names)
		self.areas = np.repeat(model.segmentArea, 2)
		self.bonded = sorted(set(self.pairs[np.asarray(model.pointStatus) != neverBonded]))
		a, b = (np.asarray(model.reference)[np.asarray(model.segmentNodes)[:, end]] for end in (0, 1))
		along = np.abs(b - a)
		self.steep = (along[:, 1] > np.tan(np.pi / 3) * along[:, 0]).repeat(2)
		self.first, self.firstPoint = ((math.nan, math.nan), ""), -1
		self.highest, self.atPeak = -math.inf, {}

	@property
	def kept(self):
		"""What a checkpoint keeps."""
		return {
			"areas": self.areas.tolist(), "bonded": self.bonded, "first": [[float(x) for x in self.first[0]], self.first[1]],
			"firstPoint": int(self.firstPoint), "highest": self.highest, "atPeak": self.atPeak
		}

	@kept.setter
	def kept(self, kept):
		self.areas, self.bonded, self.highest, self.atPeak = np.array(kept["areas"]), kept["bonded"], kept["highest"], kept["atPeak"]
		self.first, self.firstPoint = (tuple(kept["first"][0]), kept["first"][1]), kept["firstPoint"]
		known('first crack', self._lookForFirst) # for the engine of the scene that was saved

	def noteStress(self, stress):
		"""Takes the present stress, so that `atPeak` are the `counts` of the moment at which it was highest."""
		if stress > self.highest: self.highest, self.atPeak = float(stress), self.counts()

	def _broken(self):
		status = np.asarray(self.model.pointStatus)
		return (status == brokenInTension) | (status == brokenInShear)

	def look(self):
		"""The number of broken contact points now. The first time that there are any, `first` becomes (place [m], joint type) of one of
		them, and `firstPoint` its number; before, the place is NaN, the type empty, the number -1."""
		broken = self._broken()
		count = np.count_nonzero(broken)
		if count and not self.first[1]:
			self._note(np.flatnonzero(broken)[0])
		return count

	def engine(self):
		"""A PyRunner, for O.engines, that looks in every step until something has broken: `first` then is the first, not one of several."""
		return runner('first crack', self._lookForFirst, label='firstCrack')

	def _lookForFirst(self):
		from yade import O
		if self.look(): next(engine for engine in O.engines if engine.label == 'firstCrack').dead = True

	def began(self, points):
		"""Takes the contact points in the order of breaking from who knows it (`crackPoint` of `BlockModel.follow`)."""
		if len(points): self._note(points[0])

	def _note(self, point):
		self.first, self.firstPoint = (tuple(np.asarray(self.model.contactPositions())[point]), self.pairs[point]), point

	def counts(self, which=True):
		"""Broken contact points by joint type and mode: {"unit-mortar": {"tension": 12, "shear": 3}, ...}, in alphabetical order.
		Every joint type that was bonded is there, also with zeros. which: a mask of the contact points that count; all."""
		status = np.where(which, self.model.pointStatus, intact)
		return {pair: {mode: np.count_nonzero((self.pairs == pair) & (status == value)) for mode, value in modes.items()} for pair in self.bonded}

	def share(self, pair):
		"""The share of a joint type in all that is cracked, by area: short edges, which break early and often, do not count more than
		they are. NaN without cracks."""
		cracked = self.areas * self._broken()
		return cracked[self.pairs == pair].sum() / cracked.sum() if cracked.any() else math.nan

	def steepShare(self, pair):
		"""The share of the cracked area of a joint type that is steeper than 60 degrees (in the reference state): a third if cracks
		run every way alike, near 1 if the blocks split vertically. NaN without cracks."""
		cracked = self.areas * (self._broken() & (self.pairs == pair))
		return cracked[self.steep].sum() / cracked.sum() if cracked.any() else math.nan


@dataclass
class Quantity:
	"""A measured number, with what it should be. Several seeds: the mean and the sample standard deviation, `scatter`."""
	name: str
	unit: str
	measured: float
	expected: Optional[float] = None
	source: Optional[str] = None
	scatter: Optional[float] = None

	@property
	def error(self):
		"""(measured - expected) / expected, None without an expected value."""
		return (self.measured - self.expected) / self.expected if self.expected else None

	def asDict(self):
		entry = {"name": self.name, "unit": self.unit, "measured": self.measured, "expected": self.expected, "source": self.source, "error": self.error}
		return entry if self.scatter is None else {**entry, "scatter": self.scatter}


class Run:
	"""What one tessellation gave; made by `Results.run`."""
	def __init__(self, seed, threads=1):
		self.seed = seed
		self.quantities = {}
		self.qualities = {}
		self.table = None
		self.hasPeak = None # not known without a curve of stress
		self.costs = {"threads": threads}
		self.steppingTime = None # CPU [s]
		self.spent = 0.0, 0.0 # CPU and wall-clock time before the run was resumed [s]
		self._started, self._stepping = (time.process_time(), time.perf_counter()), None

	@property
	def elapsed(self):
		"""CPU and wall-clock time of this run until now, and the CPU time of its steps [s]."""
		cpu, wall = time.process_time(), time.perf_counter()
		stepping = (self.steppingTime or 0) + (cpu - self._stepping if self._stepping is not None else 0)
		return self.spent[0] + cpu - self._started[0], self.spent[1] + wall - self._started[1], stepping

	def resume(self, elapsed):
		"""Counts what an earlier process has spent on this run, as `elapsed` gave it."""
		self.spent, self.steppingTime = tuple(elapsed[:2]), elapsed[2]

	@property
	def kept(self):
		"""What a checkpoint keeps of a run that is done."""
		table = None if self.table is None else {name: self.table[name].tolist() for name in self.table}
		return {
			"seed": self.seed, "quantities": [vars(quantity) for quantity in self.quantities.values()], "qualities": self.qualities, "table": table,
			"costs": self.costs
		}

	@classmethod
	def of(cls, kept):
		"""The run that `kept` was."""
		run = cls(kept["seed"])
		run.quantities = {entry["name"]: Quantity(**entry) for entry in kept["quantities"]}
		run.qualities, run.costs = kept["qualities"], kept["costs"]
		if kept["table"] is not None: run.curve(**{name: column for name, column in kept["table"].items() if name != "seed"})
		return run

	@door(name="str", unit="str", measured="float", expected="float", source="str")
	def add(self, name, unit, measured, expected=None, source=None):
		"""A measured number, and what it should be according to `source`, in the same unit."""
		if name in self.quantities:
			raise ValueError(f"quantity {name} must be added once a run, got {measured} after {self.quantities[name].measured}")
		self.quantities[name] = Quantity(name, unit, float(measured), expected, source)

	def curve(self, **columns):
		"""The run's history: columns of equal length, units in their names (displacement_mm, stress_MPa).

		A stress that does not fall by 5 % after its highest value has no peak, which the report says."""
		import pandas
		if not columns: raise TypeError("Run.curve: no columns are given")
		shapes = {name: np.shape(column) for name, column in columns.items()}
		given = {shape for shape in shapes.values() if shape} # a number stands for all rows
		if len(given) != 1 or len(*given) != 1: raise ValueError(f"Run.curve: columns must be lists of one length, got shapes {shapes}")
		self.table = pandas.DataFrame(columns)
		self.table.insert(0, "seed", self.seed)
		self.hasPeak = None if "stress_MPa" not in self.table else hasPeak(self.table.stress_MPa)

	def quality(self, unbalanced_ratio_max=None, half_rate_change=None, energy_error=None):
		"""How far the run may be trusted, as fractions: the largest unbalanced ratio; the change of the main quantity at half
		the loading rate; the energy error over the external work. None: not determined."""
		given = dict(unbalanced_ratio_max=unbalanced_ratio_max, half_rate_change=half_rate_change, energy_error=energy_error)
		self.qualities.update((name, value) for name, value in given.items() if value is not None)

	@contextmanager
	def stepping(self):
		"""Around the time steps proper (may be entered several times): their CPU time gives us_per_step."""
		self._stepping = time.process_time()
		yield
		self.steppingTime, self._stepping = self.elapsed[2], None

	def model(self, model, steps, names=None, **more):
		"""Sizes and cracks of the model as it is now, after `steps` time steps; names: of joints, as in Cracks. `more` joins the cost
		(ns_per_zone=...)."""
		self.costs.update(
			steps=int(steps), blocks=len(model.blockMaterial), nodes=len(model.position), zones=len(model.zoneNodes),
			contacts=len(model.pointStatus), **more
		)
		for pair, counts in Cracks(model, names).counts().items():
			for mode, count in counts.items():
				self.add(f"cracks_{pair}_{mode}", "1", count)

	def close(self):
		"""Takes the CPU and wall-clock time of the whole run."""
		cpu, wall, _ = self.elapsed
		steps = self.costs.get("steps")
		stepping = cpu if self.steppingTime is None else self.steppingTime
		self.costs.update(
			cpu_s=cpu, wall_s=wall, us_per_step=1e6 * stepping / steps if steps else None,
			peak_rss_mb=resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024 / 1e6
		)


def engineCosts(model, steps):
	"""What the hot engines took, if O.timingEnabled was set: {"ns_per_zone": of BlockLoop and BlockMotion (or of BlockForces), "ns_per_contact": of an
	InteractionLoop, for each contact point} in a step, wall-clock time; an empty dictionary otherwise."""
	from yade.wrapper import Omega
	if not Omega().timingEnabled or not steps:
		return {}
	times = {type(engine).__name__: engine.execTime for engine in Omega().engines}
	if "BlockLoop" in times: return {"ns_per_zone": (times["BlockLoop"] + times["BlockMotion"]) / steps / max(1, model.zoneCount)}
	return {
		"ns_per_zone": times["BlockForces"] / steps / max(1, model.zoneCount),
		"ns_per_contact": times["InteractionLoop"] / steps / max(1, model.contactCount)
	}


class Results:
	"""Gathers the runs of a scenario. `parameters`: from scenario.parameters."""
	def __init__(self, parameters):
		self.parameters = parameters
		self.folder = parameters.folder
		self.runs = []
		self.complete = False # whether all runs that were asked for are there

	@contextmanager
	def run(self, seed):
		"""A run with this tessellation, timed from here to the end of the block; one that fails leaves nothing."""
		run = Run(seed, getattr(self.parameters, "threads", 1))
		yield run
		run.close()
		self.runs.append(run)

	@property
	def quantities(self):
		"""The quantities over all runs, in the order in which they were first added."""
		samples = {}
		for run in self.runs:
			for quantity in run.quantities.values():
				samples.setdefault(quantity.name, []).append(quantity)
		return [_mean(quantities, len(self.runs)) for quantities in samples.values()]

	def __getitem__(self, name):
		"""The Quantity of this name over all runs."""
		return {quantity.name: quantity for quantity in self.quantities}[name]

	@property
	def curves(self):
		"""The histories of all runs, one below the other (a pandas.DataFrame whose first column is `seed`)."""
		import pandas
		return pandas.concat([run.table for run in self.runs if run.table is not None], ignore_index=True)

	def asDict(self):
		"""result.json as a dictionary. Cost is that of the first run."""
		costs = self.runs[0].costs if self.runs else {}
		keys = "cpu_s wall_s steps us_per_step blocks nodes zones contacts peak_rss_mb threads".split()
		qualities = "unbalanced_ratio_max half_rate_change energy_error".split()
		return {
			"scenario": self.parameters.scenario,
			"parameters": self.parameters.asDict(),
			"seed": getattr(self.parameters, "seed", None),
			"complete": self.complete,
			"quantities": [quantity.asDict() for quantity in self.quantities],
			"cost": {**{key: costs.get(key) for key in keys}, **costs},
			"quality": {**{name: self._quality(name) for name in qualities}, "without_peak": self.withoutPeak},
		}

	@property
	def withoutPeak(self):
		"""Seeds of the runs that ended before the stress fell."""
		return [run.seed for run in self.runs if run.hasPeak is False]

	def _quality(self, name):
		"""Of the worst run; but the change at half the rate is that of the mean, since single runs scatter."""
		values = [run.qualities[name] for run in self.runs if name in run.qualities]
		return None if not values else float(np.mean(values)) if name == "half_rate_change" else max(values, key=abs)

	def report(self):
		"""The table for the terminal: measured (with scatter), expected, error, source; then what the run cost."""
		rows = [("quantity", "unit", "measured", "expected", "error", "source")]
		for q in self.quantities:
			measured = _short(q.measured) + ("" if q.scatter is None else f" ± {_short(q.scatter, 2)}")
			error = "" if q.error is None else f"{100 * q.error:+.1f} %"
			rows.append((q.name, "" if q.unit == "1" else q.unit, measured, _short(q.expected), error, q.source or ""))
		widths = [max(map(len, column)) for column in zip(*rows)]
		justify = (str.ljust, str.ljust, str.ljust, str.rjust, str.rjust, str.ljust)
		lines = ["  ".join(put(cell, width) for put, cell, width in zip(justify, row, widths)).rstrip() for row in rows]
		lines.insert(1, "-" * max(map(len, lines)))
		return "\n".join([self._heading(), *lines, *self._remarks()])

	def save(self):
		"""Writes result.json, then curve.csv, each whole or not at all."""
		files.replace(self.folder / "result.json", json.dumps(jsonable(self.asDict()), indent=1, allow_nan=False) + "\n")
		if any(run.table is not None for run in self.runs):
			files.replace(self.folder / "curve.csv", self.curves.to_csv(index=False, float_format="%.7g"))

	def write(self):
		"""All runs are there: writes result.json and curve.csv, prints the table; returns the folder."""
		self.complete = True
		self.save()
		print(self.report())
		return self.folder

	def _heading(self):
		seeds = [run.seed for run in self.runs]
		return f"\n{self.folder.name}: " + (f"seed {seeds[0]}" if len(seeds) == 1 else f"means of {len(seeds)} seeds, ± standard deviation of one")

	def _remarks(self):
		result = jsonable(self.asDict())
		quality = [f"{name} {value:.2g}" for name, value in result["quality"].items() if isinstance(value, float)]
		rising = ", ".join(map(str, self.withoutPeak))
		cost = [
			f"{_short(result['cost'][key])} {unit}"
			for key, unit in (("cpu_s", "CPU s"), ("wall_s", "s"), ("steps", "steps"), ("us_per_step", "µs/step"), ("zones", "zones"),
						("contacts", "contact points"), ("ns_per_zone", "ns/zone"), ("ns_per_contact", "ns/contact point"))
			if result["cost"].get(key) is not None
		]
		return [f"no peak in seed {rising}: the stress did not fall by 5 % after its highest value before it ended"
			] * bool(rising) + ["quality: " + ", ".join(quality)] * bool(quality) + ["one run: " + ", ".join(cost)] * bool(cost) + [
				f"see {self.folder}"
			]


def jsonable(value):
	"""Plain Python values for json: numpy's numbers and arrays become Python's, NaN and infinity None."""
	if isinstance(value, dict):
		return {str(key): jsonable(item) for key, item in value.items()}
	if isinstance(value, (list, tuple, np.ndarray)):
		return [jsonable(item) for item in value]
	if isinstance(value, (bool, np.bool_)):
		return bool(value)
	if isinstance(value, numbers.Integral):
		return int(value)
	if isinstance(value, numbers.Real):
		return float(value) if math.isfinite(value) else None
	return value if value is None else str(value)


def _mean(quantities, runs):
	"""One quantity for the samples of several runs. A sample that is missing or NaN makes the mean NaN: it would be one of other seeds."""
	first = quantities[0]
	for other in quantities[1:]:
		if (other.unit, other.expected, other.source) != (first.unit, first.expected, first.source):
			raise ValueError(f"quantity {first.name} must have one unit, expected value and source in all runs, got {first} and {other}")
	if runs == 1:
		return first
	samples = np.array([quantity.measured for quantity in quantities] + [math.nan] * (runs - len(quantities)))
	return Quantity(first.name, first.unit, samples.mean(), first.expected, first.source, samples.std(ddof=1))


def _short(number, digits=4):
	if isinstance(number, int):
		return str(number)
	return "" if number is None else "-" if not math.isfinite(number) else f"{number:.{digits}g}"
