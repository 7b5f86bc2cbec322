# yade-blocks, GPL-2.0-or-later
"""Finding micro-parameters: each measured quantity is moved to its target by the parameter that governs it most.

	found = calibrate(evaluate, start={"young": 1e9, "tension": 1e6}, targets={"joint_stiffness": 36, "peak": 0.35},
	                  governs={"joint_stiffness": "young", "peak": "tension"})
	found.parameters, found.measured, found.rounds
"""
import math
from typing import NamedTuple


class Calibration(NamedTuple):
	parameters: dict
	measured: dict # at these parameters
	rounds: int # evaluations that were made

	def misfit(self, targets):
		"""The largest |ln(measured / target)|."""
		return _misfit(self.measured, targets)


def calibrate(evaluate, start, targets, governs, tolerance=0.01, rounds=6):
	"""The best parameters found within so many rounds, or once every quantity is within the tolerance of its target.

	evaluate(parameters) -> {quantity: value}. In logarithms: the first step takes a quantity as proportional to its parameter,
	later ones use the slope between the last two rounds (kept between 1/3 and 3: noisy runs would send a secant anywhere).
	A quantity that is not positive tells nothing; its parameter is doubled."""
	parameters, history = dict(start), []
	for number in range(1, rounds + 1):
		measured = evaluate(parameters)
		history.append((dict(parameters), measured))
		if _misfit(measured, targets) <= tolerance or number == rounds:
			break
		for quantity, parameter in governs.items():
			parameters[parameter] = _next(history, quantity, parameter, targets[quantity])
	best = min(history, key=lambda entry: _misfit(entry[1], targets))
	return Calibration(*best, len(history))


def _next(history, quantity, parameter, target):
	(parameters, measured) = history[-1]
	if not measured[quantity] > 0:
		return 2 * parameters[parameter]
	slope = 1.0
	if len(history) > 1 and history[-2][1][quantity] > 0:
		moved = math.log(parameters[parameter] / history[-2][0][parameter])
		if abs(moved) > 0.02:
			slope = min(3.0, max(1 / 3, math.log(measured[quantity] / history[-2][1][quantity]) / moved))
	change = math.log(target / measured[quantity]) / slope
	return parameters[parameter] * math.exp(min(1.5, max(-1.5, change)))


def _misfit(measured, targets):
	return max(abs(math.log(measured[name] / target)) if measured[name] > 0 else math.inf for name, target in targets.items())


def changes(entry, today):
	"""Names of the settings in which a calibration that was written down differs from today's; one that it does not name differs."""
	return [name for name, value in today.items() if entry.get(name) != value]
