# yade-blocks, GPL-2.0-or-later
"""Quantities along a setting that has several values, as sigma=0.1e6,0.5e6,1e6: their values there, and the slope of the line through them.

What is measured at each value is named `QUANTITY at KEY=VALUE`, the slope of the least-squares line `QUANTITY along KEY`. Units of a slope: those of the
quantity by those of the key.
"""
import numpy as np

from .command import StudyError, demandResults, good, listed, product, quantitiesOf, reasons


def along(settings):
	"""The key with several values, and these; None without one. Raises StudyError for two such keys, or values that are no different numbers."""
	several = [key for key, value in settings.items() if isinstance(value, str) and "," in value]
	if not several: return None
	if len(several) > 1: raise StudyError(f"study: only one key may have several values, got {' and '.join(several)}")
	key, = several
	values = [point[key] for point in product({key: settings[key]})]
	if not all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in values) or len(set(values)) < len(values):
		raise StudyError(f"study: the values of {key} must be different numbers, got {settings[key]}")
	return key, values


def measure(command, points, seeds):
	"""As command.measure; points with a key of several values are run at each, and give one record a seed. A seed of which one run failed has failed."""
	line = along(command.settings)
	if not line: return command.measure(points, seeds)
	key, values = line
	found = command.measure([{**point, key: value} for point in points for value in values], seeds)
	demandResults(found)
	names = quantitiesOf(found, listed(command.p.quantities))
	return [_merged(key, values, found[i:i + len(values)], names) for i in range(0, len(found), len(values))]


def _merged(key, values, measured, names):
	"""Of a point: one record for each seed, from those at each value."""
	merged = {}
	for seed in measured[0]:
		records = [records[seed] for records in measured]
		if len(good(dict(enumerate(records)))) < len(records):
			merged[seed] = {"failed": "; ".join(reasons(records)) or "not run"}
			continue
		reported, units = {}, {}
		for name, unit in names.items():
			each = [record["reported"].get(name) for record in records]
			for value, number in zip(values, each):
				reported[f"{name} at {key}={value:g}"], units[f"{name} at {key}={value:g}"] = number, unit
			slope = f"{name} along {key}"
			reported[slope] = float(np.polyfit(values, each, 1)[0]) if None not in each and np.isfinite(each).all() else None
			units[slope] = f"{unit} by {key}"
		merged[seed] = {"reported": reported, "units": units}
	return merged
