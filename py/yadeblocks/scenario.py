# yade-blocks, GPL-2.0-or-later
"""What a scenario is told: `scripts/run.sh NAME key=value ...`, or a line of a yade-batch table. All values in SI units.

	p = scenario.parameters({
		**scenario.commonParameters(size=2e-3, seeds=5), **scenario.usualParameters(jump=True),
		"case": Key("TT1", "which tables the joints follow", rule=("TT1", "TT2")),
		"stroke": Key(0.03e-3, "path of the top", "m", scenario.positive)})
	p.case, p.size, p.seedList, p.folder     # "TT1", 0.002, [1, 2, 3, 4, 5], Path("out/tension")

Every value is checked here, once. What is refused leaves one line on stderr and exit code 2. `help` shows what the Keys say.
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

#: A key of a scenario: its default, what it means, its unit ("" for numbers and words) and its rule: a Rule, a pair (test, text), a tuple of choices, or
#: None where every value of the default's type will do.
Key = namedtuple("Key", "default meaning unit rule", defaults=("", None))

_common = {
	"seed": Key(1, "number of the first tessellation", rule=notNegative),
	"seeds": Key(1, "how many tessellations; results are their means", rule=atLeastOne),
	"threads": Key(1, "OpenMP threads", rule=atLeastOne),
	"tag": Key("", "makes the folder out/NAME-TAG", rule=(lambda t: re.fullmatch(r"[\w.,=+-]*", t), "must consist of letters, digits and . , = + - _")),
	"size": Key(2e-3, "size of the Voronoi cells", "m", positive),
	"sizeMeaning": Key("edge", "size is the mean edge length, or the root of the mean area", rule=("edge", "sqrtArea")),
	"lloyd": Key(2, "Lloyd iterations: how regular the cells are", rule=notNegative),
	"damping": Key("local", "damping of the motion", rule=("local", "adaptive", "none")),
	"alpha": Key(0.3, "coefficient of local damping", rule=(lambda a: 0 <= a < 1, "must lie in [0, 1)")),
	"safety": Key(
		0.7, "time step as a fraction of the stable one; with local damping at most 0.95/sqrt(1+alpha)",
		rule=(lambda s: 0 < s <= 0.95, "must lie in (0, 0.95]")
	),
	"steps": Key(40000, "time steps for the whole loading", rule=(lambda n: n >= 1000, "must be at least 1000")),
	"checkpoint": Key(0.0, "time between two checkpoints of a run that may be killed, of which resume=true goes on; 0: none", "s", notNegative),
	"resume": Key(False, "go on where a run with the same keys was killed or interrupted"),
	"plane": Key("strain", "plane strain or plane stress", rule=("strain", "stress")),
}

_usual = {
	"units": Key("plain", "bricks are one elastic block each, or made of Voronoi blocks that could crack", rule=("plain", "voronoi")),
	"cells": Key("voronoi", "Voronoi cells, or triangles of the same size", rule=("voronoi", "triangles")),
	"edgeSegments": Key(1, "joints along an edge between two blocks", rule=atLeastOne),
	"solver": Key("steps", "time steps, or the exact path from failure to failure", rule=("steps", "events")),
	"unitYoung": Key(20e9, "Young's modulus of the units", "Pa", positive),
	"mortarYoung": Key(5e9, "Young's modulus of the mortar", "Pa", positive),
	"release": Key(
		"path", "solver=events: the load falls where that keeps the next point whole, or, under a held displacement, cascades break",
		rule=("path", "cascade")
	),
	"brickZone": Key(8e-3, "size of the zones in plain bricks, mean edge of the blocks in others", "m", positive),
	"merge": Key(0.1, "edges of Voronoi cells below this fraction of the size are merged", rule=(lambda f: 0 <= f < 1, "must lie in [0, 1)")),
	"jump": Key(True, "leap over the elastic part of the loading"),
	"servo": Key(False, "the unbalanced force sets the speed of loading"),
	"halfRate": Key(False, "repeat each run at half the loading rate and report the change"),
	"vtk": Key(True, "write files for ParaView"),
	"frames": Key(10, "frames of the loading in the files for ParaView, besides those at the peak and at the end", rule=notNegative),
	"movie": Key("none", "a movie of the cracks, of as many frames as are said; mp4 needs Debian's ffmpeg", rule=("none", "gif", "mp4")),
	"sheets": Key(True, "draw sheets of displacements, stresses and joints at the peak and at the end"),
	"pressSteps": Key(2000, "time steps in which the precompression comes on", rule=atLeastOne),
	"approach": Key(0.2, "speed up to the peak by that after it", rule=(lambda f: 0 < f <= 1, "must lie in (0, 1]")),
	"sigma": Key(0.5e6, "precompression", "Pa", notNegative),
	"stroke": Key(1e-3, "path of the loaded edge at which the run ends", "m", positive),
}


def commonParameters(**defaults):
	"""The keys that every scenario has: `seed seeds threads tag size sizeMeaning lloyd damping alpha safety steps checkpoint resume plane`, each a Key.
	Keyword arguments give a scenario's own defaults.

	Raises TypeError for a name that is not common to all scenarios."""
	return {**_common, **_chosen(_common, "common to all scenarios", defaults)}


def usualParameters(**defaults):
	"""Keys that more than one scenario has, with these defaults: `units cells unitYoung mortarYoung edgeSegments solver release brickZone merge jump servo
	halfRate vtk frames movie sheets pressSteps approach sigma stroke` and all the common ones.

	Raises TypeError for a name that is none of them."""
	return _chosen({**_common, **_usual}, "that several scenarios have", defaults)


def _chosen(known, what, defaults):
	strangers = set(defaults) - set(known)
	if strangers:
		raise TypeError(f"not a parameter {what}: {', '.join(sorted(strangers))}")
	return {key: known[key]._replace(default=default) for key, default in defaults.items()}


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
	keys = _keys(defaults, allowed)
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


def parameters(defaults, allowed=None, scenario=None):
	"""What the user asked for: from the command line, below that from the table line in YADE_BATCH, else `defaults`.

	defaults: key -> Key, usually {**commonParameters(), "own": Key(1.0, "what it is", "m")}; allowed: see `parse`; scenario: the name, by default
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
	"""One line for every key: its default, unit, meaning and rule."""
	lines = [f"scripts/run.sh {scenario} [key=value ...]"]
	for key, kind in _keys(defaults, allowed).items():
		default = str(kind.default).lower() if isinstance(kind.default,
									bool) else f"{kind.default:g}" if isinstance(kind.default, float) else kind.default
		notes = "; ".join(filter(None, (kind.meaning, kind.rule and kind.rule.text)))
		lines.append(f"  {f'{key}={default}' + f' [{kind.unit}]' * bool(kind.unit):<28} {notes}".rstrip())
	return "\n".join(lines)


def waitIfBatch():
	"""Under yade-batch, waits until a simulation running in the background has ended; else returns at once."""
	if "YADE_BATCH" in os.environ:
		from yade import utils
		utils.waitIfBatch()


def _keys(defaults, allowed):
	"""key -> Key with a Rule (or None), whatever short form was given."""
	for key in allowed or {}:
		if key not in defaults: raise TypeError(f"a rule for {key}, which is no parameter of this scenario")
	bare = {**_common, **_usual}
	keys = {}
	for key, given in defaults.items():
		kind = given if isinstance(given, Key) else bare[key]._replace(default=given) if key in bare else Key(given, "")
		keys[key] = kind._replace(rule=_asRule((allowed or {}).get(key, kind.rule)))
	return keys


def _asRule(rule):
	if rule is None or isinstance(rule, Rule): return rule
	return Rule(*rule) if callable(rule[0]) else choice(*rule)


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
