# yade-blocks, GPL-2.0-or-later
"""Where something ceases to hold."""
from ._door import door


@door('low', 'high', 'precision', holds='function')
def bisect(holds, low, high, precision):
	"""The largest value that held and the smallest that did not, apart by no more than `precision` times the latter: (low, high).

	holds(value) is true below some limit and false above. Each end is tried first. Raises RuntimeError if holds(low) is false or holds(high) is true."""
	if not low < high: raise ValueError(f'bisect: low must be below high, got {low!r} and {high!r}')
	if not precision > 0: raise ValueError(f'bisect: precision must be positive, got {precision!r}')
	if not holds(low): raise RuntimeError(f'bisect: {low:g} does not hold already')
	if holds(high): raise RuntimeError(f'bisect: {high:g} still holds')
	while high - low > precision * high:
		middle = (low + high) / 2
		if holds(middle): low = middle
		else: high = middle
	return low, high
