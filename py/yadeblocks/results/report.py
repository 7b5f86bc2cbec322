# yade-blocks, GPL-2.0-or-later
"""Results as a table for the terminal."""
import math

from ..curves import fall
from .jsonable import jsonable


def report(results):
	"""The table for the terminal: measured (with scatter), expected, error, source; then what the run cost."""
	rows = [("quantity", "unit", "measured", "expected", "error", "source")]
	for q in results.quantities:
		measured = _short(q.measured) + ("" if q.scatter is None else f" ± {_short(q.scatter, 2)}")
		error = "" if q.error is None else f"{100 * q.error:+.1f} %"
		rows.append((q.name, "" if q.unit == "1" else q.unit, measured, _short(q.expected), error, q.source or ""))
	widths = [max(map(len, column)) for column in zip(*rows)]
	justify = (str.ljust, str.ljust, str.ljust, str.rjust, str.rjust, str.ljust)
	lines = ["  ".join(put(cell, width) for put, cell, width in zip(justify, row, widths)).rstrip() for row in rows]
	lines.insert(1, "-" * max(map(len, lines)))
	return "\n".join([_heading(results), *lines, *_remarks(results)])


def _heading(results):
	seeds = [run.seed for run in results.runs]
	return f"\n{results.folder.name}: " + (f"seed {seeds[0]}" if len(seeds) == 1 else f"means of {len(seeds)} seeds, ± standard deviation of one")


def _remarks(results):
	told = jsonable(results.asDict())
	quality = [f"{name} {value:.2g}" for name, value in told["quality"].items() if isinstance(value, float)]
	rising = ", ".join(map(str, results.withoutPeak))
	cost = [
		f"{_short(told['cost'][key])} {unit}"
		for key, unit in (("cpu_s", "CPU s"), ("wall_s", "s"), ("steps", "steps"), ("us_per_step", "µs/step"), ("zones", "zones"),
					("contacts", "contact points"), ("ns_per_zone", "ns/zone"), ("ns_per_contact", "ns/contact point"))
		if told["cost"].get(key) is not None
	]
	return [f"no peak in seed {rising}: the stress did not fall by {100 * fall:g} % after its highest value before it ended"
		] * bool(rising) + ["quality: " + ", ".join(quality)] * bool(quality) + ["one run: " + ", ".join(cost)] * bool(cost) + [
			f"see {results.folder}"
		]


def _short(number, digits=4):
	if isinstance(number, int):
		return str(number)
	return "" if number is None else "-" if not math.isfinite(number) else f"{number:.{digits}g}"
