# yade-blocks, GPL-2.0-or-later
"""Quadratic surfaces through the trials of a calibration, and what follows from them: where the misfit is least, and how well each parameter is determined.

A surface gives, for each target, (mean - target) / tolerance over the unit cube of the parameters. It is fitted by least squares in which near trials count
more: exp(-(distance from the best trial / L)²), L being the distance within which there are three
trials more than the surface has coefficients.
It passes through the best trial.
In `profiles` and `correlations` the standard error of the mean over tessellations widens the tolerance.
"""
import itertools
import math

import numpy as np
from scipy.optimize import least_squares

reach = 0.3 #: So far from the best trial, in each direction of the unit cube, a surface is believed.


def fit(trials):
	"""The Surface through these trials; they must be more than parameters + 1."""
	return Surface(trials)


class Surface:
	def __init__(self, trials):
		best = min(trials, key=lambda trial: trial.misfit)
		self.centre, self.names = np.array(best.unit), list(best.targets)
		units = np.array([trial.unit for trial in trials])
		d = units.shape[1]
		self.quadratic = len(trials) >= (d + 1) * (d + 2) // 2 + 1
		design = self._terms(units)
		distance = np.linalg.norm(units - self.centre, axis=1)
		scale = np.sort(distance)[min(len(trials) - 1, design.shape[1] + 3)]
		weight = np.exp(-(distance / max(scale, 1e-3))**2)
		rows = np.array(
			[[(trial.means[name].mean - trial.targets[name].value) / trial.targets[name].tolerance for name in self.names] for trial in trials]
		)
		root = np.sqrt(weight)[:, None]
		stiff = 1e-6 * np.eye(design.shape[1]) # keeps apart what the trials do not tell apart
		stiff[0, 0] = 0
		inverse = np.linalg.inv((root * design).T @ (root * design) + stiff)
		self.coefficients = inverse @ (root * design).T @ (root * rows)
		leverage = np.clip(np.einsum("ij,jk,ik->i", root * design, inverse, root * design), 0, 0.999)
		left = (rows - design @ self.coefficients) / (1 - leverage)[:, None] # of each trial, from the surface without it
		self.errors = dict(zip(self.names, np.sqrt((weight[:, None] * left**2).sum(axis=0) / weight.sum())))
		self.coefficients[0] = rows[trials.index(best)] # the same tessellations in every trial: there it is known, and steps from there converge
		self.weight = np.sqrt([best.targets[name].weight for name in self.names])
		noise = [best.means[name].scatter / math.sqrt(best.means[name].n) / best.targets[name].tolerance for name in self.names]
		self.widened = np.sqrt(1 + np.nan_to_num(noise)**2)

	def _terms(self, units):
		u = np.atleast_2d(units) - self.centre
		columns = [np.ones(len(u)), *u.T]
		if self.quadratic: columns += [u[:, i] * u[:, j] for i, j in itertools.combinations_with_replacement(range(u.shape[1]), 2)]
		return np.stack(columns, axis=1)

	def residuals(self, unit):
		return self.weight * (self._terms(unit) @ self.coefficients)[0]

	def best(self):
		"""The point of the unit cube where the misfit is least, within reach of the best trial."""
		low, high = np.clip(self.centre - reach, 0, 1), np.clip(self.centre + reach, 0, 1)
		return self._least(self.residuals, low, high)[0]

	def _least(self, function, low, high):
		starts = [np.clip(self.centre, low, high), 0.75 * low + 0.25 * high, 0.25 * low + 0.75 * high]
		found = [least_squares(function, np.clip(start, low + 1e-9 * (high - low), high - 1e-9 * (high - low)), bounds=(low, high)) for start in starts]
		least = min(found, key=lambda each: each.cost)
		return least.x, 2 * least.cost

	def profiles(self, bounds, points=41):
		"""{key: {"values", "misfit": the least one with this value held, "best", "low", "high": between which it is within 1 of the least,
		"determined":
		whether it is not at either bound}}."""
		from .command import place
		found = {}
		function = lambda unit: self.residuals(unit) / self.widened
		for i, key in enumerate(bounds):
			held, misfit = np.linspace(0, 1, points), []
			others = [j for j in range(len(bounds)) if j != i]

			def whole(rest, value):
				unit = np.empty(len(bounds))
				unit[i], unit[others] = value, rest
				return unit

			for value in held:
				if not others: misfit.append(float((function([value])**2).sum()))
				else:
					starts = [np.clip(self.centre[others], 1e-6, 1 - 1e-6), np.full(len(others), 0.3), np.full(len(others), 0.7)]
					misfit.append(
						min(
							2 * least_squares(lambda rest: function(whole(rest, value)), start, bounds=(0, 1)).cost
							for start in starts
						)
					)
			misfit = np.array(misfit)
			allowed = np.flatnonzero(misfit <= misfit.min() + 1)
			first, last = allowed[0], allowed[-1]
			cross = lambda inside, outside: held[inside] + (held[outside] - held[inside]) * (misfit.min() + 1 - misfit[
				inside]) / (misfit[outside] - misfit[inside]) # between two of the values
			low = cross(first, first - 1) if first > 0 else 0.0
			high = cross(last, last + 1) if last < points - 1 else 1.0
			value = lambda u: place(bounds, [u if j == i else 0.5 for j in range(len(bounds))])[key]
			found[key] = {
				"values": [value(u) for u in held], "misfit": misfit, "best": value(self.centre[i]), "low": value(low), "high": value(high),
				"determined": bool(first > 0 and last < points - 1)
			}
		return found

	def correlations(self, keys, pairs):
		"""{(key, other): correlation} of parameters that fit equally well, all of the bounds alike before. pairs: for each parameter the
		trials below and
		above the best one, of which the slopes are taken."""
		row = lambda trial: np.array([(trial.means[name].mean - trial.targets[name].value) / trial.targets[name].tolerance for name in self.names])
		slopes = np.stack([(row(above) - row(below)) / (np.array(above.unit) - below.unit)[i] for i, (below, above) in enumerate(pairs)], axis=1)
		slopes *= (self.weight / self.widened)[:, None]
		spread = np.linalg.inv(slopes.T @ slopes + 12 * np.eye(len(keys))) # 12: an even distribution over the bounds
		return {(keys[i], keys[j]): spread[i, j] / math.sqrt(spread[i, i] * spread[j, j]) for i, j in itertools.combinations(range(len(keys)), 2)}
