# yade-blocks, GPL-2.0-or-later
"""Loading: rest before it, and when to end it. How it is applied: `BlockModel.drive`, `push`, `traction`, `gravity`,
`elasticJump`, `setThrottle`, and the engine `BlockServo`.

	loading.settle(model)                                    # dead loads and pushed platens, to equilibrium
	stop = loading.Stop(drop=0.5, displacement=3e-3)
	O.engines += [PyRunner(command="stop(model.groupTravelled('top'), stress(), broken())", iterPeriod=100)]

	O.engines = [loading.Motion(model, 'base', loading.accelerogram(times, a)).engine()] + O.engines       # shaken

From event to event, the exact answer of the brittle model, instead of in time steps:

	path = loading.follow(model, 'top', 'seed 1', gauges=[gauge], displacement=1e-3)
"""
import math

import numpy as np

from . import running
from ._calls import door
from .curves import Peak
from .progress import Progress
from .recording import runner


@door('ratio', 'floor', 'period', 'maxSteps', model='model')
def settle(model, ratio=1e-4, floor=0.0, period=100, maxSteps=1000000):
	"""Runs until the scene is at rest: unbalanced forces and kinetic energy are below `ratio` (the paper's 0.01 % by default) of what there is, as
	`BlockModel.unrest` measures it, and every ramp is over.

	floor: least sum of forces that counts [N]; period: steps between two looks. Returns the number of steps.
	Raises RuntimeError if maxSteps do not suffice: something moves that nothing holds, or is driven."""
	if not ratio > 0: raise ValueError('settle: ratio must be positive, got %r' % ratio)
	if not period >= 1: raise ValueError('settle: period must be at least 1, got %r' % period)
	from yade.wrapper import Omega
	O, reached = Omega(), []

	def look():
		reached[:] = [model.unrest(floor=floor)]
		if reached[0] < ratio: running.end()

	start = O.iter
	O.engines = O.engines + [runner('settle', look, period)]
	try:
		running.run(maxSteps)
	finally:
		O.engines = O.engines[:-1]
	if not reached or reached[0] >= ratio: look()
	if not reached[0] < ratio:
		raise RuntimeError('settle: the unbalanced force ratio is %.3g after %d steps, not below %g' % (reached[0], maxSteps, ratio))
	return O.iter - start


@door(model='model', group='str', label='str', displacement='float')
def follow(model, group, label='', displacement=math.inf, **options):
	"""`BlockModel.follow` with a progress line, and one at the end that says why the path ends; options go to it. `displacement` is where it ends at the
	latest [m].

	A further column of the path, `cracked`, is the number of broken contact points with the one that stands at its strength and breaks next."""
	seen = [0., 0., 0]

	def look(*now):
		seen[:] = now
		line(int(1000 * now[0] / displacement))

	with Progress(1000, lambda: 'u %.4f mm  force %.4g N  broken %d' % (1e3 * seen[0], seen[1], seen[2]), label=label) as line:
		path = model.follow(group, displacement=displacement, progress=look, **options)
	path['cracked'] = path['broken'] + (path['point'] >= 0)
	top, last = path['force'].max(), path['force'][-1]
	fallen = ', %.2g %% below it' % (100 - 100 * last / top) if 0 < last < top else ''
	why = _askedFor.get(path['ended'], path['ended'])
	print('%s: from event to event, highest force %.4g N; the path ends%s: %s' % (label or group, top, fallen, why), flush=True)
	return path


_askedFor = {
	'drop': 'the force has fallen as far as was asked for', 'displacement': 'as far as was asked for', 'cracks': 'as many cracks as were asked for',
	'stopped': 'stopped'
} # all other ends are sentences


@door('within', 'ratio', 'floor', 'period', 'maxSteps', model='model')
def comesToRest(model, within, ratio=1e-6, floor=0.0, period=500, maxSteps=100000):
	"""Whether what moves comes to rest, True, or some grid point goes further than `within` [m] from its reference position or is still moving
	after maxSteps (counted from O.iter = 0), False. Rest is an unbalanced force ratio below `ratio`; floor, period: as in `settle`."""
	if not within > 0: raise ValueError('comesToRest: within must be positive, got %r' % within)
	if not period >= 1: raise ValueError('comesToRest: period must be at least 1, got %r' % period)
	from yade.wrapper import Omega
	O = Omega()
	while O.iter < maxSteps:
		O.run(period, True)
		if not abs(model.displacement).max() <= within: return False
		if model.unbalancedRatio(floor=floor) < ratio: return True
	return False


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


class Approach:
	"""Slow up to the peak, where the rate counts, and fast after it: the speed of a driven group is `slow` x its velocity until the
	stress has fallen below `drop` x its peak after something has broken, then grows by `growth` from look to look up to the whole velocity.

	With a growth near 1 the speed rises in proportion to the way since then, which is how long tails may be followed without inertia.

	>>> approach = Approach(model, 'top', slow=0.25)
	>>> approach(stress, broken)     # every now and then"""
	@door('slow', 'drop', 'growth', model='throttled', group='str')
	def __init__(self, model, group, slow, drop=0.7, growth=1.1):
		if not 0 < slow <= 1: raise ValueError('Approach: slow must lie in (0, 1], got %r' % slow)
		if not 0 < drop < 1: raise ValueError('Approach: drop must lie in (0, 1), got %r' % drop)
		if not growth > 1: raise ValueError('Approach: growth must be above 1, got %r' % growth)
		self.model, self.group, self.speed, self.growth = model, group, slow, growth
		self._peak = Peak(drop)
		model.setThrottle(group, slow)

	@property
	def peak(self):
		"""The highest stress so far [Pa]."""
		return self._peak.value

	@property
	def passed(self):
		"""Whether the peak has been passed."""
		return self._peak.passed

	@property
	def kept(self):
		"""What a checkpoint keeps."""
		return {"speed": self.speed, "peak": self._peak.kept}

	@kept.setter
	def kept(self, kept):
		self.speed, self._peak.kept = kept["speed"], kept["peak"]
		self.model.setThrottle(self.group, self.speed)

	def __call__(self, stress, broken):
		"""Looks at the present stress [Pa] and number of broken contact points."""
		self._peak.look(stress, broken)
		if self._peak.passed and self.speed < 1:
			self.speed = min(1, self.growth * self.speed)
			self.model.setThrottle(self.group, self.speed)


class Stop:
	"""Ends the run, after the present step, once it has shown what is wanted, by any of the conditions that are given:

	drop: the stress has fallen below this fraction of its peak, after something has broken;
	displacement: the displacement has reached this [m]; cracks: so many contact points are broken.
	`reason` says which one it was ("drop", "displacement", "cracks"), "" while none holds."""
	@door('drop', 'displacement', 'cracks')
	def __init__(self, drop=None, displacement=None, cracks=None):
		if drop is None and displacement is None and cracks is None: raise ValueError('Stop: no condition is given')
		if drop is not None and not 0 < drop < 1: raise ValueError('Stop: drop must lie in (0, 1), got %r' % drop)
		if displacement is not None and not displacement > 0: raise ValueError('Stop: displacement must be positive, got %r' % displacement)
		if cracks is not None and not cracks >= 1: raise ValueError('Stop: cracks must be at least 1, got %r' % cracks)
		self.drop, self.displacement, self.cracks = drop, displacement, cracks
		self._peak, self.reason = Peak(drop or 0), ''

	@property
	def peak(self):
		"""The highest stress so far [Pa]."""
		return self._peak.value

	@property
	def kept(self):
		"""What a checkpoint keeps."""
		return {"peak": self._peak.kept, "reason": self.reason}

	@kept.setter
	def kept(self, kept):
		self._peak.kept, self.reason = kept["peak"], kept["reason"]

	def __call__(self, displacement, stress, broken):
		"""Looks at the present state: displacement [m], stress [Pa], number of broken contact points."""
		below = self._peak.look(stress, broken)
		if self.drop is not None and below: self.reason = 'drop'
		elif self.displacement is not None and abs(displacement) >= self.displacement: self.reason = 'displacement'
		elif self.cracks is not None and broken >= self.cracks: self.reason = 'cracks'
		else: return False
		running.end() # a pause would let O.run(n, True) return within this step
		return True
