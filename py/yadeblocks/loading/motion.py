# yade-blocks, GPL-2.0-or-later
"""Velocities and forces that change with time."""
import numpy as np

from .._door import door
from ..recording import runner


@door(times='numbers', acceleration='numbers')
def accelerogram(times, acceleration):
	"""Times [s] and the velocities [m/s] that accelerations [m/s2] bring about, from rest, for `Motion`. The baseline is not corrected."""
	times, acceleration = np.asarray(times, float), np.asarray(acceleration, float)
	_requireTable('accelerogram', times, acceleration)
	return times, np.concatenate([[0], np.cumsum(np.diff(times) * (acceleration[1:] + acceleration[:-1]) / 2)])


class Motion:
	"""The velocity of a driven group, or the force of a pushed one, as it changes with time: a function of the time [s], or a table (times, values) that is
	interpolated and must cover the run. Times count from now.

	motion = Motion(model, 'base', lambda t: 0.1 * math.sin(20 * t))
	O.engines = [motion.engine()] + O.engines           # first of all: what it says is of the middle of the step"""
	@door(model='model', group='str')
	def __init__(self, model, group, values):
		from yade.wrapper import Omega
		self.model, self.group, self.start = model, group, Omega().time
		if callable(values): self.at = values
		else:
			if not hasattr(values, '__len__') or len(values) != 2:
				raise ValueError(f'Motion.values must be a function of the time or a table (times, values), got {values!r}')
			times, values = (np.asarray(column, float) for column in values)
			_requireTable('Motion', times, values)
			self.at = lambda t: self._between(t, times, values)
		self.model.setTarget(group, float(self.at(0.0)))

	def _between(self, t, times, values):
		if not times[0] <= t <= times[-1]:
			raise ValueError(f'Motion: the table of {self.group!r} goes from {times[0]:g} to {times[-1]:g} s, and the time is {t:g} s')
		return np.interp(t, times, values)

	def __call__(self):
		"""Sets the velocity or force of the coming step."""
		from yade.wrapper import Omega
		O = Omega()
		self.model.setTarget(self.group, float(self.at(O.time + O.dt / 2 - self.start)))

	def engine(self):
		"""For the beginning of O.engines."""
		return runner('motion of ' + self.group, self, initRun=True) # PyRunner leaves out the first step else


def _requireTable(name, times, values):
	if times.ndim != 1 or times.shape != values.shape or len(times) < 2: raise ValueError(f'{name}: a value for each of at least two times')
	if not (np.diff(times) > 0).all(): raise ValueError(f'{name}: times must grow')
	if not (np.isfinite(times).all() and np.isfinite(values).all()): raise ValueError(f'{name}: times and values must be finite')
