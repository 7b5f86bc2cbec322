# yade-blocks, GPL-2.0-or-later
"""What a scenario's keys are, in words."""
from .parsing import keysOf


def describe(defaults, allowed=None, scenario="scenario"):
	"""One line for every key: its default, unit, meaning and rule."""
	lines = [f"scripts/run.sh {scenario} [key=value ...]"]
	for key, kind in keysOf(defaults, allowed).items():
		default = str(kind.default).lower() if isinstance(kind.default,
									bool) else f"{kind.default:g}" if isinstance(kind.default, float) else kind.default
		notes = "; ".join(filter(None, (kind.meaning, kind.rule and kind.rule.text)))
		lines.append(f"  {f'{key}={default}' + f' [{kind.unit}]' * bool(kind.unit):<28} {notes}".rstrip())
	return "\n".join(lines)
