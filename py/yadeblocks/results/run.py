# yade-blocks, GPL-2.0-or-later
"""What one tessellation gave."""
import resource
import time
from contextlib import contextmanager

import numpy as np

from .._door import door
from ..curves import hasPeak
from .cracks import Cracks
from .quantity import Quantity


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
