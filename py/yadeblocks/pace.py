# yade-blocks, GPL-2.0-or-later
"""Whether a quasi-static run is slow enough: what a look at energies and reactions says while it goes on.

	pace = Pace(model, load=lambda: model.groupForce('top'), reaction=lambda: model.groupForce('bottom', axis='y'), label='seed 1')
	record.after(lambda row: pace(row.broken))
	with Progress(steps, lambda: loadingLine(u(), stress(), model, pace)) as progress: ...
"""
import sys

import numpy as np

from ._door import door
from .readings.energy import strainEnergy

kineticShare, reactionsApart = 0.05, 0.1 # what is plainly too fast: kinetic by strain energy, reaction against load
_least = 10 # looks that are taken together: single ones tell of waves


class Pace:
	"""Watches a loading up to its peak, from the first crack on: before, inertia of the start is no matter.

	load: the force that is brought on [N]; reaction: that of what holds against it [N], or None; their signs do not count.
	label: names the run in what is said.
	`said` is what was said, "" if nothing: that the run is too fast, once, on stderr."""
	@door(model='model', load='function', reaction='function', label='str')
	def __init__(self, model, load, reaction=None, label="", stream=None):
		self.model, self.load, self.reaction, self.label, self.stream = model, load, reaction, label, stream
		self.said, self._known, self._highest, self._count, self._sums, self._cracked = "", {}, 0.0, 0, np.zeros(4), False

	def look(self):
		"""Kinetic energy [J], strain energy [J], load [N] and reaction [N] (NaN without one) now."""
		return np.array([
			self.model.kineticEnergy(),
			strainEnergy(self.model, self._known),
			abs(self.load()), np.nan if self.reaction is None else abs(self.reaction())
		])

	def __call__(self, broken):
		"""Looks at the present state; broken: contact points, or those that are not elastic any more.

		It judges the sums over all looks, at the first crack and whenever more is carried than ever before: behind a peak energy is set free, which
		is no matter of the pace."""
		if self.said: return
		kinetic, strain, load, reaction = self.look()
		carried = load if self.reaction is None else reaction # inertia is in the load, not in the reaction
		self._sums += kinetic, strain, load, 0 if self.reaction is None else abs(reaction - load)
		self._count += 1
		higher, self._highest = carried > self._highest, max(self._highest, carried)
		first = broken and not self._cracked # waves may have carried more before: what is carried then need not be the most
		if broken and (higher or first) and self._count >= _least: self._judge(*self._sums)
		self._cracked = self._cracked or bool(broken)

	def _judge(self, kinetic, strain, load, apart):
		excess = []
		if kinetic > kineticShare * strain: excess.append(f"kinetic energy is {100 * kinetic / strain:.3g} % of the strain energy")
		if apart > reactionsApart * load: excess.append(f"load and reaction are {100 * apart / load:.3g} % apart")
		if not excess: return
		self.said = " and ".join(excess) + ": the loading is too fast for a quasi-static run; slower loading is a smaller velocity or more steps"
		print(f"{self.label}: {self.said}" if self.label else self.said, file=self.stream or sys.stderr, flush=True)

	def words(self):
		"""For a progress line: unbalanced ratio, kinetic by strain energy, reaction against load."""
		kinetic, strain, load, reaction = self.look()
		parts = [f"unbalanced {self.model.unbalancedRatio():.1g}", f"kinetic/strain {kinetic / strain:.1g}" if strain > 0 else ""]
		if self.reaction is not None and load > 0: parts.append(f"reaction/load {reaction / load:.3f}")
		return "  ".join(filter(None, parts))
