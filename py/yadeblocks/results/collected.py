# yade-blocks, GPL-2.0-or-later
"""The runs of a scenario together."""
import json
from contextlib import contextmanager

import numpy as np

from .. import files
from .jsonable import jsonable
from .quantity import meanOf
from .report import report
from .run import Run


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
		return [meanOf(quantities, len(self.runs)) for quantities in samples.values()]

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
		return report(self)

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
