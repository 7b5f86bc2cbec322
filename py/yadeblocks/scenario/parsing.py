# yade-blocks, GPL-2.0-or-later
"""From words "key=value" to checked parameters."""
import math
import re
from pathlib import Path

from .._words import closest
from .keys import Key, asRule
from .usual import common, usual


class ParameterError(ValueError):
	"""A key or a value that a scenario refuses; its text is the line the user reads."""


class Parameters:
	"""Checked parameters as attributes. `vars(p)` are the keys and values; what follows from them:"""
	def __init__(self, scenario, values):
		self.__dict__.update(values)
		self.__dict__["scenario"] = scenario

	@property
	def folder(self):
		"""out/NAME or out/NAME-TAG, below the current directory (a Path; it need not exist yet)."""
		tag = getattr(self, "tag", "")
		return Path("out") / (f"{self.scenario}-{tag}" if tag else self.scenario)

	@property
	def seedList(self):
		"""[seed, seed + 1, ...], as many as `seeds` says."""
		return list(range(self.seed, self.seed + self.seeds))

	def asDict(self):
		"""The keys and their values, as result.json shows them: all that a result may depend on, and nothing of how a run is kept from getting lost."""
		return {key: value for key, value in vars(self).items() if key not in ("scenario", "checkpoint", "resume")}


def parse(words, defaults, allowed=None, scenario="scenario"):
	"""Values for `defaults` from words "key=value" -> Parameters.

	defaults: key -> Key, or a bare default. A value takes the type of its default (bool, int, float or str; 4e4 is a whole number too). `allowed` maps a
	key to a rule in place of its own, see Key. Raises ParameterError."""
	keys = keysOf(defaults, allowed)
	texts = {}
	for word in words:
		key, equals, text = word.partition("=")
		if not equals:
			raise ParameterError(f"{scenario}: arguments must have the form key=value, got {word}")
		if key in texts:
			raise ParameterError(f"{scenario}.{key} must be given once, got {texts[key]} and {text}")
		if key not in defaults:
			raise ParameterError(f"{scenario} has no parameter {key}{closest(key, defaults)}; known: {' '.join(defaults)}")
		texts[key] = text

	values = {key: kind.default for key, kind in keys.items()}
	for key, text in texts.items():
		values[key] = _typed(f"{scenario}.{key}", text, type(values[key]))
	for key, kind in keys.items():
		if kind.rule and not kind.rule.test(values[key]):
			raise ParameterError(f"{scenario}.{key} {kind.rule.text}, got {values[key]!r}")
	if "alpha" in texts and values.get("damping", "local") != "local":
		raise ParameterError(f"{scenario}.alpha must only be given with damping=local, got damping={values['damping']}")
	if "safety" in values and values.get("damping") == "local" and values["safety"] > 0.95 / math.sqrt(1 + max(0, values["alpha"])):
		raise ParameterError(
			f"{scenario}.safety must not exceed 0.95/sqrt(1+alpha) = {0.95 / math.sqrt(1 + max(0, values['alpha'])):.3g} with damping=local, "
			f"got {values['safety']}"
		)
	return Parameters(scenario, values)


def keysOf(defaults, allowed):
	"""key -> Key with a Rule (or None), whatever short form was given."""
	for key in allowed or {}:
		if key not in defaults: raise TypeError(f"a rule for {key}, which is no parameter of this scenario")
	bare = {**common, **usual}
	keys = {}
	for key, given in defaults.items():
		kind = given if isinstance(given, Key) else bare[key]._replace(default=given) if key in bare else Key(given, "")
		keys[key] = kind._replace(rule=asRule((allowed or {}).get(key, kind.rule)))
	return keys


def _typed(name, text, kind):
	"""The text as a value of this type."""
	if kind is str:
		return text.strip("'\"") # tables of yade-batch quote their strings
	if kind is bool:
		if text.lower() in ("true", "false"):
			return text.lower() == "true"
		raise ParameterError(f"{name} must be true or false, got {text}")
	try:
		number = float(text)
	except ValueError:
		number = math.nan
	if kind is int:
		if not number.is_integer():
			raise ParameterError(f"{name} must be a whole number, got {text}")
		return int(text) if re.fullmatch(r"[+-]?\d+", text) else int(number)
	if kind is float:
		if math.isnan(number):
			raise ParameterError(f"{name} must be a number, got {text}")
		return number
	raise TypeError(f"{name}: a default must be a bool, int, float or str, not {kind.__name__}")
