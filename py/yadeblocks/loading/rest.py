# yade-blocks, GPL-2.0-or-later
"""Rest: waiting for it, and whether it comes."""
from .. import running
from .._door import door
from ..recording import runner


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
