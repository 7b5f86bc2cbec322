# yade-blocks, GPL-2.0-or-later
"""Copies of a model taken while it runs."""
import math

from .._door import door
from ..recording import runner
from .snapshot import Snapshot


class Film:
	"""Snapshots of a run. frames: how many in equal parts of the way, 0 for the peak alone. They stay in memory until they are written."""
	@door(model='model', frames='whole')
	def __init__(self, model, frames=0):
		if frames < 0: raise ValueError(f"Film.frames must not be negative, got {frames!r}")
		self.model, self.count, self.frames, self.peak, self.highest = model, frames, [], None, -math.inf

	def look(self, share, stress, time):
		"""Takes the present state where it is due. share: of the way, 0 to 1; stress: the highest makes the peak; time [s]."""
		due, higher = self.count and share * self.count >= len(self.frames), stress > self.highest
		if not due and not higher: return
		now = Snapshot(self.model, time, like=self.peak)
		if higher: self.peak, self.highest = now, stress
		if due: self.frames.append(now)

	@door(iterPeriod='whole')
	def engine(self, iterPeriod):
		"""An engine for O.engines that takes a frame every so many steps."""
		def take():
			from yade.wrapper import Omega
			self.frames.append(Snapshot(self.model, Omega().time, like=self.frames[-1] if self.frames else self.peak))

		return runner("film", take, iterPeriod)

	def states(self):
		"""All frames and the peak, each once, in order of time."""
		all_ = {snapshot.time: snapshot for snapshot in [*self.frames, *([self.peak] if self.peak else [])]}
		return [all_[time] for time in sorted(all_)]
