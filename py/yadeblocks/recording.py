# yade-blocks, GPL-2.0-or-later
"""Readings of a run: a row of numbers every so many steps.

	record = Recorder(opening_m=gauge, stress_Pa=lambda: model.groupForce('top') / area, broken=cracks.look)
	record.after(lambda row: stop(row.opening_m, row.stress_Pa, row.broken))
	O.engines += [record.engine(iterPeriod=100)]
	O.run(10000, True)
	record['stress_Pa'], record.last.broken      # a column as an array; the last row
"""
from collections import namedtuple

import numpy as np

from ._door import door

_known = {} # by name: what PyRunner's commands refer to, which are text


class Recorder:
	"""Columns by name, each a function without arguments that returns a number; they are read in the given order.

	A recorder takes the name over from an earlier one of the same name, whose engines then read for the new one."""
	def __init__(self, name="record", /, **columns):
		if not columns: raise TypeError("Recorder: no columns are given")
		for column, read in columns.items():
			if not callable(read): raise TypeError(f"Recorder.{column} must be a function without arguments, got {read!r}")
		if not isinstance(name, str): raise TypeError(f"Recorder.name must be a text, got {name!r}")
		self.name, self.columns, self.rows, self.followers = name, columns, [], []
		self.Row = namedtuple("Row", columns)
		_known[name] = self

	def __call__(self):
		"""Reads a row now and hands it on."""
		row = self.Row(*(read() for read in self.columns.values()))
		self.rows.append(row)
		for follower in self.followers:
			follower(row)
		return row

	def take(self, **columns):
		"""Rows that were computed elsewhere: an array for each column, or a number for all rows. They are not handed on."""
		self.rows += [self.Row(*row) for row in zip(*np.broadcast_arrays(*(columns.pop(name) for name in self.columns)))]
		if columns: raise TypeError(f"Recorder: there is no column {', '.join(columns)}")

	@door(follower='function')
	def after(self, follower):
		"""Calls follower(row) after each reading; several are called in this order. Returns the recorder."""
		self.followers.append(follower)
		return self

	@door(iterPeriod='whole')
	def engine(self, iterPeriod=1, **attributes):
		"""A PyRunner that reads a row every so many steps, for O.engines."""
		return runner(self.name, self, iterPeriod, **attributes)

	@property
	def last(self):
		"""The last row, with the columns' names as attributes."""
		return self.rows[-1]

	def __len__(self):
		return len(self.rows)

	def __getitem__(self, column):
		"""All readings of a column."""
		return np.array([getattr(row, column) for row in self.rows])

	@property
	def kept(self):
		"""What a checkpoint keeps."""
		return [[float(value) for value in row] for row in self.rows]

	@kept.setter
	def kept(self, rows):
		self.rows = [self.Row(*row) for row in rows]


def runner(name, function, iterPeriod=1, **attributes):
	"""A PyRunner that calls a function every so many steps; `name` tells it from others, also in a scene that was saved and loaded."""
	from yade.wrapper import PyRunner
	known(name, function)
	return PyRunner(command=f"import yadeblocks.recording; yadeblocks.recording.call({name!r})", iterPeriod=iterPeriod, **attributes)


def known(name, function):
	"""Lets the PyRunners of this name call the function."""
	_known[name] = function


def call(name):
	"""What such a PyRunner does."""
	if name not in _known: raise RuntimeError(f"the scene reads {name!r}, which this session has not made: make a Recorder of this name before it runs")
	_known[name]()
