# yade-blocks, GPL-2.0-or-later
"""When a run ends."""
from .. import running
from .._door import door
from ..curves import Peak


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
