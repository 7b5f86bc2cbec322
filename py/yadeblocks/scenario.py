# yade-blocks, GPL-2.0-or-later
"""What a scenario is told: `scripts/run.sh NAME key=value ...`, or a line of a yade-batch table. All values in SI units.

	p = scenario.parameters(
	        {**scenario.commonParameters(size=2e-3, seeds=5), "case": "TT1", "stroke": 0.03e-3},
	        {"case": ("TT1", "TT2"), "stroke": scenario.positive})
	p.case, p.size, p.seedList, p.folder     # "TT1", 0.002, [1, 2, 3, 4, 5], Path("out/tension")

Every value is checked here, once. What is refused leaves one line on stderr and exit code 2.
"""
import difflib
import json
import math
import os
import re
import sys
from collections import namedtuple
from pathlib import Path

#: What a value must fulfil: `test(value)` is true (a NaN must fail it), said in words by `text` ("must be positive").
Rule = namedtuple("Rule", "test text")


def choice(*values):
	"""The rule that a value is one of these."""
	return Rule(lambda value: value in values, "must be one of " + ", ".join(map(str, values)))


positive = Rule(lambda x: 0 < x < math.inf, "must be positive")
notNegative = Rule(lambda x: 0 <= x < math.inf, "must not be negative")
atLeastOne = Rule(lambda n: n >= 1, "must be at least 1")

_Common = namedtuple("_Common", "default rule meaning")

_common = {
	"seed": _Common(1, notNegative, "number of the first tessellation"),
	"seeds": _Common(1, atLeastOne, "how many tessellations; results are their means"),
	"threads": _Common(1, atLeastOne, "OpenMP threads"),
	"tag": _Common("", Rule(lambda t: re.fullmatch(r"[\w.,=+-]*", t), "must consist of letters, digits and . , = + - _"), "makes the folder out/NAME-TAG"),
	"size": _Common(2e-3, positive, "size of the Voronoi cells [m]"),
	"sizeMeaning": _Common("edge", choice("edge", "sqrtArea"), "size is the mean edge length, or the root of the mean area"),
	"lloyd": _Common(2, notNegative, "Lloyd iterations: how regular the cells are"),
	"damping": _Common("local", choice("local", "adaptive", "none"), "damping of the motion"),
	"alpha": _Common(0.3, Rule(lambda a: 0 <= a < 1, "must lie in [0, 1)"), "coefficient of local damping"),
	"safety": _Common(
		0.7, Rule(lambda s: 0 < s <= 0.95, "must lie in (0, 0.95]"),
		"time step as a fraction of the stable one; with local damping at most 0.95/sqrt(1+alpha)"
	),
	"steps": _Common(40000, Rule(lambda n: n >= 1000, "must be at least 1000"), "time steps for the whole loading"),
	"checkpoint": _Common(0.0, notNegative, "seconds between two checkpoints of a run that may be killed, of which resume=true goes on; 0: none"),
	"resume": _Common(False, Rule(lambda r: True, "must be true or false"), "go on where a run with the same keys was killed or interrupted"),
	"plane": _Common("strain", choice("strain", "stress"), "plane strain or plane stress"),
}


def commonParameters(**defaults):
	"""The keys that every scenario has, with their defaults: `seed seeds threads tag size sizeMeaning lloyd damping alpha
	safety steps plane`. Keyword arguments give a scenario's own defaults. Their rules are known to `parameters`.

	Raises TypeError for a name that is not common to all scenarios."""
	strangers = set(defaults) - set(_common)
	if strangers:
		raise TypeError(f"not a parameter common to all scenarios: {', '.join(sorted(strangers))}")
	return {**{key: common.default for key, common in _common.items()}, **defaults}


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

	A value takes the type of its default (bool, int, float or str; 4e4 is a whole number too). `allowed` maps a key to a
	Rule, a pair (test, text) or a list of choices; the common keys bring their own. Raises ParameterError."""
	texts = {}
	for word in words:
		key, equals, text = word.partition("=")
		if not equals:
			raise ParameterError(f"{scenario}: arguments must have the form key=value, got {word}")
		if key in texts:
			raise ParameterError(f"{scenario}.{key} must be given once, got {texts[key]} and {text}")
		if key not in defaults:
			raise ParameterError(f"{scenario} has no parameter {key}{_closest(key, defaults)}; known: {' '.join(defaults)}")
		texts[key] = text

	values = dict(defaults)
	for key, text in texts.items():
		values[key] = _typed(f"{scenario}.{key}", text, type(defaults[key]))
	for key, rule in _rules(defaults, allowed).items():
		if not rule.test(values[key]):
			raise ParameterError(f"{scenario}.{key} {rule.text}, got {values[key]!r}")
	if "alpha" in texts and values.get("damping", "local") != "local":
		raise ParameterError(f"{scenario}.alpha must only be given with damping=local, got damping={values['damping']}")
	if "safety" in values and values.get("damping") == "local" and values["safety"] > 0.95 / math.sqrt(1 + values["alpha"]):
		raise ParameterError(
			f"{scenario}.safety must not exceed 0.95/sqrt(1+alpha) = {0.95 / math.sqrt(1 + values['alpha']):.3g} with damping=local, "
			f"got {values['safety']}"
		)
	return Parameters(scenario, values)


def parameters(defaults, allowed=None, scenario=None):
	"""What the user asked for: from the command line, below that from the table line in YADE_BATCH, else `defaults`.

	defaults: key -> value, usually {**commonParameters(), "own": 1.0}; allowed: see `parse`; scenario: the name, by default
	that of the script. `help` as an argument shows all keys and leaves. Input that is refused ends the program with code 2."""
	scenario = scenario or Path(sys.argv[0]).stem # yade hands over the script's own argv
	words = sys.argv[1:]
	if "help" in words or "--help" in words:
		print(describe(defaults, allowed, scenario))
		sys.exit(0)
	try:
		words = withJoints(words, scenario)
		given = {word.partition("=")[0] for word in words}
		table = _batchLine(set(defaults))
		p = parse(words + [f"{key}={text}" for key, text in table.items() if key not in given], defaults, allowed, scenario)
		_checkThreads(p, "threads" in given or "threads" in table)
		return p
	except ParameterError as error:
		print(error, file=sys.stderr)
		sys.exit(2)


def require(fulfilled, text):
	"""Ends the program with this line and code 2 unless the values go together, which rules of single values cannot say."""
	if not fulfilled:
		print(text, file=sys.stderr)
		sys.exit(2)


def withJoints(words, scenario):
	"""The words with joints=FILE.json replaced by what the file says (see `jointsFrom`), except for keys that the words give themselves."""
	files = [word for word in words if word.startswith("joints=") and word.endswith(".json")]
	if not files:
		return words
	rest = [word for word in words if word not in files]
	given = {word.partition("=")[0] for word in rest}
	return rest + [f"{key}={value}" for file in files for key, value in jointsFrom(file[7:], scenario).items() if key not in given]


def jointsFrom(file, scenario):
	"""Keys and values for a scenario from a file of calibrated parameters, as scripts/study.sh calibrate writes it:
	{"parameters": {key: value}, "scenarios": {scenario: {key: value}}}; the second, which may be missing, is for that scenario only.
	"joints" among them names the set of joints that the others change. Raises ParameterError for a file that is not of this form."""
	try:
		found = json.loads(Path(file).read_text())
		values = {**found["parameters"], **found.get("scenarios", {}).get(scenario, {})}
	except OSError as error:
		raise ParameterError(f"{scenario}.joints must be a file that can be read, got {file} ({error.strerror})") from None
	except (ValueError, KeyError, TypeError, AttributeError):
		raise ParameterError(f'{scenario}.joints must be a file with {{"parameters": {{key: value}}}}, got {file}') from None
	if not all(isinstance(value, (int, float, str)) for value in values.values()):
		raise ParameterError(f"{scenario}.joints must be a file whose parameters are numbers or words, got {file}")
	return values


def describe(defaults, allowed=None, scenario="scenario"):
	"""One line for every key: its default, its meaning if it is a common one, its rule."""
	rules = _rules(defaults, allowed)
	lines = [f"scripts/run.sh {scenario} [key=value ...]   (SI units)"]
	for key, value in defaults.items():
		notes = ([_common[key].meaning] if key in _common else []) + ([rules[key].text] if key in rules else [])
		lines.append(f"  {key + '=' + str(value):<22} {'; '.join(notes)}".rstrip())
	return "\n".join(lines)


def waitIfBatch():
	"""Under yade-batch, waits until a simulation running in the background has ended; else returns at once."""
	if "YADE_BATCH" in os.environ:
		from yade import utils
		utils.waitIfBatch()


def _rules(defaults, allowed):
	rules = {key: common.rule for key, common in _common.items() if key in defaults}
	for key, rule in (allowed or {}).items():
		if key not in defaults:
			raise TypeError(f"a rule for {key}, which is no parameter of this scenario")
		rules[key] = rule if isinstance(rule, Rule) else Rule(*rule) if callable(rule[0]) else choice(*rule)
	return rules


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


def _closest(key, known):
	names = {name.lower(): name for name in known}
	close = difflib.get_close_matches(key.lower(), names, 1)
	return f" (did you mean {names[close[0]]}?)" if close else ""


def _batchLine(known):
	"""The line of the parameter table that yade-batch has chosen for this job: key -> text.

	utils.readParamsFromTable would evaluate the texts as Python, so that case=TT1 were an undefined name and * an error;
	here they mean what they mean on the command line. It leaves the same tags behind."""
	place = os.environ.get("YADE_BATCH")
	if not place:
		return {}
	from yade import utils
	from yade.wrapper import Omega
	table, _, line = place.rpartition(":")
	texts = utils.TableParamReader(table).paramDict().get(int(line))
	if texts is None:
		raise ParameterError(f"YADE_BATCH must name a line with parameters, got {place}")
	description, tags = texts.pop("description"), Omega().tags
	texts = {key: text for key, text in texts.items() if key[0] != "!" and text != "*"}
	tags["line"], tags["description"] = "l" + line, description
	tags["d.id"], tags["id.d"] = description + "." + tags["id"], tags["id"] + "." + description
	tags["params"] = ",".join(f"{key}={text}" for key, text in texts.items())
	if "tag" in known: # jobs of one table must not share a folder
		texts.setdefault("tag", re.sub(r"[^\w.,=+-]", "_", description))
	return texts


def _checkThreads(p, asked):
	"""YADE's number of threads is fixed at its start: what was asked for must agree, else the result shows the true one."""
	if "yade.wrapper" not in sys.modules or not hasattr(p, "threads"):
		return
	running = sys.modules["yade.wrapper"].Omega().numThreads
	if asked and p.threads != running:
		raise ParameterError(f"{p.scenario}.threads must be what YADE was started with (yade -j{p.threads}), got {p.threads} with -j{running}")
	p.threads = running
