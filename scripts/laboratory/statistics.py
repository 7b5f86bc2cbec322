# yade-blocks, GPL-2.0-or-later
"""What a few values say of all that might be: mean, scatter, how well the mean is known, the value that 5 % fall below."""
import math
from typing import NamedTuple

import numpy as np
from scipy import stats

confidence = 0.95 #: of intervals


class Summary(NamedTuple):
	"""Of n values. low and high: the interval that holds the mean of all with 95 % confidence, if they are normally distributed; characteristic: their
	5 % fractile after EN 1990, D7.2, normal distribution of unknown scatter: mean - kn * scatter. NaN where one value says nothing."""
	n: int
	mean: float
	scatter: float # sample standard deviation
	low: float
	high: float
	characteristic: float
	smallest: float
	largest: float

	@property
	def halfWidth(self):
		"""That of the interval of the mean, as a share of the mean; inf if it is unknown."""
		width = (self.high - self.low) / 2
		return abs(width / self.mean) if self.n > 1 and self.mean else math.inf


def summary(values):
	"""The Summary of finite values; None if there are none."""
	values = np.asarray([value for value in values if value is not None and math.isfinite(value)], float)
	n = len(values)
	if not n: return None
	mean = values.mean()
	if n == 1: return Summary(1, mean, *[math.nan] * 4, mean, mean)
	scatter = values.std(ddof=1)
	half = stats.t.ppf((1 + confidence) / 2, n - 1) * scatter / math.sqrt(n)
	return Summary(n, mean, scatter, mean - half, mean + half, mean - fractileFactor(n) * scatter, values.min(), values.max())


def fractileFactor(n):
	"""kn of EN 1990, Table D1, for an unknown scatter: 5 % of further values are expected below mean - kn * scatter."""
	return stats.t.ppf(0.95, n - 1) * math.sqrt(1 + 1 / n)


def valuesNeeded(known, share):
	"""About how many values make the mean known to this share of it, judged from a Summary."""
	if known.n < 2 or not known.mean: return known.n + 1
	n = known.n
	while n < 100000 and stats.t.ppf((1 + confidence) / 2, n - 1) * known.scatter / math.sqrt(n) > share * abs(known.mean):
		n += 1
	return n


def band(curves, points=200):
	"""Several curves (x, y) on common x: {"x", "runs", "mean", "low", "median", "high"}, low and high the 5 % and 95 % quantiles of the runs.

	A curve is followed by its largest x so far: where x goes back, y falls at once. Curves end at different x; the band ends where fewer than
	half go on."""
	longest = sorted(max(x) for x, y in curves)[len(curves) // 2]
	grid, rows = np.linspace(0, longest, points), []
	for x, y in curves:
		x, y = np.asarray(x, float), np.asarray(y, float)
		forward = x > np.concatenate(([-math.inf], np.maximum.accumulate(x)[:-1]))
		rows.append(np.interp(grid, x[forward], y[forward], right=math.nan))
	rows = np.array(rows)
	runs = np.isfinite(rows).sum(axis=0)
	keep = runs >= max(1, len(curves) / 2)
	grid, rows, runs = grid[keep], rows[:, keep], runs[keep]
	low, median, high = np.nanquantile(rows, (0.05, 0.5, 0.95), axis=0)
	return {"x": grid, "runs": runs, "mean": np.nanmean(rows, axis=0), "low": low, "median": median, "high": high}
