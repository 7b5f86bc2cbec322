# yade-blocks, GPL-2.0-or-later
"""Slow up to the peak, fast after it."""
from .._door import door
from ..curves import Peak


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
