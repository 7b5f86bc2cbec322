# yade-blocks, GPL-2.0-or-later
"""Studies of many runs, of scenarios whose answers are known: an engine that answers at once stands in for the workers."""
import ast
import json
import math
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from yadeblocks import curves, experiments, scenario

house = Path(curves.__file__).resolve().parents[2]
sys.path.insert(0, str(house / "scripts"))
from laboratory import calibrate, command, ensemble, limit, sensitivity, statistics


class Answers:
	"""An engine whose runs are a function of their settings and seed: {quantity: value}."""
	local, kind, client = True, None, None

	def __init__(self, function):
		self.function, self.runs = function, []

	def start(self):
		pass

	def slots(self):
		return 2

	def close(self):
		pass

	def do(self, tasks, done):
		for task in tasks:
			words = {key: command.asValue(value) for key, _, value in (word.partition("=") for word in task["command"] if "=" in word)}
			self.runs.append(words)
			common = {"wall_s": 0.01, "host": "here", "processor": ""}
			try:
				values = self.function(words)
			except ValueError as error:
				done(task, {"failed": str(error), **common})
				continue
			quantities = [{"name": name, "measured": value, "unit": "MPa", "expected": None} for name, value in values.items()]
			first = next(iter(values.values()))
			curve = {"seed": [1] * 3, "x": [0, 1, 1 + words["seed"] / 100], "y": [0, first, 0]}
			done(task, {"result": {"quantities": quantities, "cost": {"cpu_s": 0.01}, "quality": {}}, "curve": curve, **common})


def noise(words, *names):
	"""Between -1 and 1, the same for the same tessellation."""
	return np.random.default_rng([words["seed"], *map(len, names)]).uniform(-1, 1)


@pytest.fixture
def studied(tmp_path):
	(tmp_path / "scripts").mkdir(), (tmp_path / "py/yadeblocks").mkdir(parents=True)
	(tmp_path / "scripts/mine.py").write_text("# reads sys.argv\n")
	(tmp_path / "scripts/other.py").write_text("# reads sys.argv\n")

	def start(kind, function, *words, name="mine"):
		engine = Answers(function)
		made = command.Command(tmp_path, kind.__name__.split(".")[-1], name, words, kind.keys, kind.rules, stream=open("/dev/null", "w"), engine=engine)
		made.runs.plugin = tmp_path / "scripts/mine.py"
		kind.study(made)
		return json.loads((made.folder / "study.json").read_text()), engine.runs, made.folder

	return start


def slowSteps(exact, cracked=7):
	"""Steps that exceed the exact peak by 1 % times 1000 / steps for their rate, and miss it by 2 % of what alpha lacks of 1 for their inertia."""
	def of(words):
		if words.get("solver") == "events": return {"peak_stress": exact, "first_crack_stress": 1, "first_crack_point": 7}
		peak = 2 * (1 + 10 / words["steps"] - 0.02 * (1 - words["alpha"]))
		return {"peak_stress": peak, "first_crack_stress": 1.001, "first_crack_point": cracked}

	return of


def test_slowStepsAreKnownToWhatTheyShow(studied, tmp_path):
	"""Half as many steps and less damping say what the slow run is known to: an exact peak within it agrees, one beyond it does not."""
	(tmp_path / "scripts/tension.py").write_text("# reads sys.argv\n")
	slow, half, less = (slowSteps(2)({"steps": s, "alpha": a})["peak_stress"] for s, a in ((2000, 0.95), (1000, 0.95), (2000, 0.8)))
	known = slow * (abs(slow / half - 1) + abs(slow / less - 1))
	for exact, agrees in (slow - 0.99 * known, True), (slow + 0.99 * known, True), (slow + 1.01 * known, False):
		row, = studied(limit, slowSteps(exact), "slow=2000", "seeds=1", "retry=true", f"out={tmp_path / str(exact)}", name="tension")[0]["rows"]
		assert row["agrees"] == agrees and row["known_to"] * slow == pytest.approx(known) and row["same_first_crack"]
		assert row["first_crack_off"] == pytest.approx(0.001)
	row, = studied(limit, slowSteps(2, cracked=8), "slow=2000", "seeds=1", f"out={tmp_path / 'other'}", name="tension")[0]["rows"]
	assert not row["same_first_crack"]


# ---- statistics


@pytest.mark.parametrize("n, factor", [(3, 3.37), (4, 2.63), (5, 2.33), (6, 2.18), (8, 2.00), (10, 1.92), (20, 1.76), (30, 1.73)])
def test_fractilesAreThoseOfTheEurocode(n, factor):
	assert statistics.fractileFactor(n) == pytest.approx(factor, abs=0.0121) # EN 1990, Table D1, row VX unknown, has rounded some down by up to 0.012


def test_intervalsHoldTheMean():
	rng = np.random.default_rng(5)
	held = [abs(statistics.summary(sample).mean) <= (lambda s: (s.high - s.low) / 2)(statistics.summary(sample)) for sample in rng.normal(0, 2, (2000, 6))]
	assert np.mean(held) == pytest.approx(0.95, abs=4 * math.sqrt(0.95 * 0.05 / 2000))


def test_fewOrNoValues():
	assert statistics.summary([]) is None and statistics.summary([None, math.nan]) is None
	one = statistics.summary([2.0])
	assert one.mean == 2 and math.isnan(one.low) and one.halfWidth == math.inf


def test_bandOfCurves():
	found = statistics.band([([0, 1, 2], [0, k, 2 * k]) for k in (1.0, 2.0, 3.0)] + [([0, 1, 0.5, 1.5], [0, 9, 5, 7])], points=5)
	assert found["x"][-1] == 2 and list(found["runs"]) == [4, 4, 4, 4, 3] # the last ends at 1.5, the grid has 0, 0.5, 1, 1.5, 2
	assert found["mean"][2] == pytest.approx((1 + 2 + 3 + 9) / 4) # where it goes back it is not followed
	assert found["mean"][3] == pytest.approx((1.5 + 3 + 4.5 + 7) / 4) and found["median"][4] == pytest.approx(4)


# ---- ensemble


def test_ensembleStopsWhenTheMeanIsKnown(studied):
	strength = lambda words: {"peak": 2 + words.get("sigma", 0) + 0.2 * noise(words), "same": 1.0}
	found, runs, folder = studied(ensemble, strength, "seeds=400", "until=2", "sigma=0,1")
	for point in found["points"]:
		peak = point["quantities"]["peak"]
		assert peak["mean_known_to_percent"] <= 2 and 5 <= peak["n"] < 200 and point["quantities"]["same"]["scatter"] == 0
		assert peak["mean"] == pytest.approx(2 + point["settings"]["sigma"], abs=0.08)
	assert len(runs) == sum(point["quantities"]["peak"]["n"] for point in found["points"]) # nothing twice
	assert {"table.md", "table.csv", "runs.csv", "band.csv", "ensemble.png", "study.json"} <= {path.name for path in folder.iterdir()}
	again, runs, _ = studied(ensemble, strength, "seeds=400", "until=2", "sigma=0,1")
	assert again == found and runs == []


def test_ensembleOfATable(studied, tmp_path):
	(tmp_path / "points.table").write_text("description sigma\nlow 0.5\nhigh 1.5\n")
	found, runs, _ = studied(ensemble, lambda words: {"peak": words["sigma"]}, f"table={tmp_path / 'points.table'}", "seeds=2")
	assert [point["quantities"]["peak"]["mean"] for point in found["points"]] == [0.5, 1.5] and len(runs) == 4


def test_failuresDoNotStopTheRest(studied):
	def half(words):
		if words["seed"] % 2: raise ValueError("exit code 1: it broke")
		return {"peak": 1.0}

	found, runs, folder = studied(ensemble, half, "seeds=6")
	assert found["points"][0]["quantities"]["peak"]["n"] == 3 and found["failed"] == {"exit code 1: it broke": 3} and len(runs) == 6
	assert "- 3 failed: exit code 1: it broke" in (folder / "table.md").read_text()


# ---- sensitivity


def ishigami(u):
	x = math.pi * (2 * np.asarray(u) - 1)
	return np.sin(x[..., 0]) + 7 * np.sin(x[..., 1])**2 + 0.1 * x[..., 2]**4 * np.sin(x[..., 0])


def test_indicesOfIshigami():
	"""Known in closed form (Ishigami and Homma 1990, a = 7, b = 0.1): first 0.314, 0.442, 0; total 0.558, 0.442, 0.244."""
	cube = sensitivity.latin(250, 3, 1)
	found = sensitivity.analyse(cube, [[value] for value in ishigami(cube)], ["a", "b", "c"], bootstrap=0)
	assert found["Q2"] > 0.95 and math.isnan(found["seeds_share"])
	assert [found["first"][key][0] for key in "abc"] == pytest.approx([0.314, 0.442, 0], abs=0.03)
	assert [found["total"][key][0] for key in "abc"] == pytest.approx([0.558, 0.442, 0.244], abs=0.03)


def test_shareOfTheSeeds():
	"""y = u + seeds' noise: 1/12 of variance by the key, 0.3²/3 by the seeds."""
	rng, cube = np.random.default_rng(3), sensitivity.latin(60, 2, 2)
	values = [u[0] + 0.3 * rng.uniform(-1, 1, 4) for u in cube]
	found = sensitivity.analyse(cube, values, ["a", "b"], bootstrap=10)
	expected = 0.03 / (0.03 + 1 / 12)
	assert found["seeds_share"] == pytest.approx(expected, abs=0.08) # 180 degrees of freedom: 11 % of each variance, and 60 points
	assert found["first"]["a"][0] > 0.85 and found["total"]["b"][0] < 0.15
	assert found["total"]["a"][1] <= found["total"]["a"][0] + 0.05


def test_noiseOnlyIsSeen():
	cube = sensitivity.latin(40, 2, 1)
	found = sensitivity.analyse(cube, np.random.default_rng(1).normal(size=(40, 3)), ["a", "b"], bootstrap=0)
	assert found["Q2"] < 0.3 and found["seeds_share"] > 0.5


def test_sensitivityLeavesOutWhatDoesNothing(studied):
	function = lambda words: {"peak": 1e-6 * words["cohesion"] * (1 + 0.05 * noise(words)), "slope": 0.02 * words["friction"]}
	found, runs, folder = studied(sensitivity, function, "bounds=cohesion:0.5e6:2e6,friction:20:50:lin,idle:1:2", "points=16", "seeds=2", "bootstrap=5")
	assert found["kept"] == ["cohesion", "friction"] and len(runs) == (1 + 2 * 3 + 16) * 2
	assert found["screening"]["peak"]["cohesion"]["effect"] == pytest.approx(1.5, rel=0.06) # from 0.5 to 2, the middle is 1
	assert found["indices"]["peak"]["total"]["cohesion"][0] > 0.98 and found["indices"]["slope"]["first"]["friction"][0] > 0.98
	assert found["indices"]["slope"]["seeds_share"] == 0 and 0 < found["indices"]["peak"]["seeds_share"] < 0.05
	assert (folder / "sensitivity.png").stat().st_size > 1000


def test_sensitivityOfASlope(studied):
	"""Along sigma a peak by Coulomb rises by tan(friction), whatever the cohesion, and at no pressure it is the cohesion."""
	coulomb = lambda words: {"peak": words["cohesion"] + words["sigma"] * words["tangent"], "other": 1.0}
	words = ["bounds=cohesion:0.5:1.5:lin,tangent:0.5:1.5:lin", "sigma=0,1,3", "points=16", "seeds=1", "bootstrap=0", "quantities=peak"]
	found, runs, _ = studied(sensitivity, coulomb, *words)
	assert len(runs) == (1 + 2 * 2 + 16) * 3 and list(found["indices"]) == ["peak at sigma=0", "peak at sigma=1", "peak at sigma=3", "peak along sigma"]
	first = lambda quantity: {key: value[0] for key, value in found["indices"][quantity]["first"].items()}
	assert first("peak along sigma") == {"cohesion": pytest.approx(0, abs=1e-9), "tangent": pytest.approx(1)}
	assert first("peak at sigma=0") == {"cohesion": pytest.approx(1), "tangent": pytest.approx(0, abs=1e-9)}
	assert first("peak at sigma=3")["tangent"] == pytest.approx(0.9) # 9 : 1
	assert found["screening"]["peak along sigma"]["tangent"] == {
		"effect": pytest.approx(1), "error": None, "low": pytest.approx(0.5), "high": pytest.approx(1.5)
	}


def test_aSlopeNeedsAllItsRuns(studied):
	"""A seed of which one run failed is not taken for its other values; what fails says why."""
	def brittle(words):
		if words["seed"] == 2 and words["sigma"] == 1: raise ValueError("exit code 1: it broke")
		return {"peak": words["cohesion"] * (1 + words["sigma"])}

	found, runs, _ = studied(sensitivity, brittle, "bounds=cohesion:1:2", "sigma=0,1", "points=8", "seeds=2", "bootstrap=0")
	assert found["failed"] == {"exit code 1: it broke": 8} and found["indices"]["peak along sigma"]["points"] == 8


# ---- calibration


def couplet(words):
	"""Peak and residual of a joint as by Coulomb, with 3 % of noise by tessellations; `ductility` moves nothing."""
	c, tangent = words["cohesion"] / 1e6, math.tan(math.radians(words["friction"]))
	sigma = words.get("sigma", 0.5)
	return {"peak": (c + sigma * tangent) * (1 + 0.03 * noise(words, "peak")), "residual": sigma * tangent * (1 + 0.03 * noise(words, "other"))}


def test_calibrationFindsKnownParameters(studied):
	"""Cohesion 0.87, tan(friction) 0.73 (36.1 degrees). Noise of 3 % / sqrt(3) in the means of three seeds is 1.7 %: a few percent in the parameters."""
	wanted = couplet({"cohesion": 0.87e6, "friction": 36.13, "seed": 0})
	targets = "peak:%g:2%%,residual:%g:2%%" % (0.87 + 0.365, 0.365)
	words = ["targets=" + targets, "bounds=cohesion:0.3e6:3e6,friction:15:60:lin,ductility:1:3", "trials=30", "heldOut=30", "enough=0.2", "jobs=2"]
	found, runs, folder = studied(calibrate, couplet, *words)
	assert found["parameters"]["cohesion"] == pytest.approx(0.87e6, rel=0.06) and found["parameters"]["friction"] == pytest.approx(36.13, abs=1.5)
	assert found["trials"] < 30 and all(abs(row["fitted"] - row["target"]) <= 0.2 * row["tolerance"] for row in found["targets"].values())
	assert found["profiles"]["cohesion"]["determined"] and not found["profiles"]["ductility"]["determined"]
	assert found["profiles"]["cohesion"]["low"] < found["parameters"]["cohesion"] < found["profiles"]["cohesion"]["high"]
	# More of one, less of the other gives the same peak. With tolerances a of the peak and b of the residual it is -b / sqrt(a² + b²) = -0.28.
	assert -0.5 < found["correlations"]["cohesion friction"] < -0.1
	assert {row["seeds"] for row in found["targets"].values()} == {30} and not set(found["seeds"]) & set(found["held_out_seeds"])
	joints = json.loads((folder / "joints.json").read_text())
	assert joints["parameters"] == found["parameters"] and wanted
	again, runs, _ = studied(calibrate, couplet, *words)
	assert again == found and runs == [] # the same seed of the sampler, the same way: nothing is run twice


def test_targetsThatCannotBeReached(studied):
	found, runs, folder = studied(calibrate, couplet, "targets=peak:9:1%", "bounds=cohesion:0.3e6:3e6", "friction=30", "trials=8", "jobs=2")
	assert found["targets"]["mine.peak"]["verdict"] == "missed"
	assert "outside all that was tried within the bounds" in (folder / "table.md").read_text() and "at a bound" in (folder / "table.md").read_text()


def test_severalExperimentsAtOnce(studied, tmp_path):
	"""Peaks at two precompressions tell cohesion from friction; a key of one scenario goes only there."""
	(tmp_path / "t.json").write_text(
		json.dumps({
			label: {"scenario": "mine", "settings": {"sigma": sigma}, "targets": {"peak": {"value": 0.87 + 0.73 * sigma, "tolerance": "3%"}}}
			for label, sigma in (("low", 0.1), ("high", 1.0))
		} | {"tie": {"scenario": "other", "settings": {}, "targets": {"peak": {"value": 1.2, "tolerance": 0.05}}}})
	)

	def function(words):
		assert ("friction" in words) == ("sigma" in words) # both are of the first scenario only
		return couplet({"friction": 30, **words})

	(tmp_path / "b.json").write_text('{"cohesion": [0.3e6, 3e6], "mine.friction": [15, 60, "lin"]}')
	found, runs, folder = studied(
		calibrate, function, f"targets={tmp_path / 't.json'}", f"bounds={tmp_path / 'b.json'}", "trials=24", "seeds=2", "heldOut=4", "jobs=2"
	)
	assert {"low.peak", "high.peak", "tie.peak"} == set(found["targets"])
	assert found["parameters"]["cohesion"] == pytest.approx(0.87e6, rel=0.08) and found["parameters"]["mine.friction"] == pytest.approx(36.13, abs=3)
	joints = json.loads((folder / "joints.json").read_text())
	assert set(joints["parameters"]) == {"cohesion"} and set(joints["scenarios"]["mine"]) == {"friction"} and "other" not in joints["scenarios"]


def test_trialsThatFailAreTold(studied):
	"""Half of the bounds is refused: how many trials that took, and why, is below the table."""
	def choosy(words):
		if words["cohesion"] < 1e6: raise ValueError("exit code 1: cohesion must be larger")
		return couplet(words)

	found, runs, folder = studied(calibrate, choosy, "targets=peak:1.6:5%", "bounds=cohesion:0.3e6:3e6", "friction=30", "trials=8", "jobs=2", "enough=1e-9")
	lost = found["trials"] - found["usable_trials"]
	assert 0 < lost < 8
	text = (folder / "table.md").read_text()
	assert f"- {lost} of 8 trials could not be used, so that part of the bounds is unknown: exit code 1: cohesion must be larger ({lost})." in text


def test_aStudyOfSeveralExperimentsHasANameOfItsOwn(studied, tmp_path):
	"""Where every experiment says its scenario, the study need not be one; where one does not, the name is taken for it."""
	(tmp_path / "scripts/other.py").write_text("scenario.parameters({'vtk': True})")
	experiment = {"targets": {"peak": {"value": 1.2, "tolerance": 0.05}}}
	(tmp_path / "t.json").write_text(json.dumps({"a": {"scenario": "mine", **experiment}, "b": {"scenario": "other", **experiment}}))
	words = ["bounds=cohesion:0.3e6:3e6", "friction=30", "trials=4", "jobs=2", f"targets={tmp_path / 't.json'}"]
	found, runs, folder = studied(calibrate, couplet, *words, name="joint")
	assert folder.name == "study-calibrate-joint" and set(found["targets"]) == {"a.peak", "b.peak"}
	assert {run.get("vtk") for run in runs} == {None, False} # ParaView files are written by nobody
	(tmp_path / "t.json").write_text(json.dumps({"a": {"scenario": "mine", **experiment}, "b": experiment}))
	with pytest.raises(command.StudyError, match="there is no scenario joint"):
		studied(calibrate, couplet, *words, name="joint")


@pytest.mark.parametrize("low, high, said", [(0.96, 1.04, "reached"), (1.06, 1.2, "missed"), (0.9, 1.01, "undecided")])
def test_verdicts(low, high, said):
	found = statistics.Summary(5, (low + high) / 2, 0.1, low, high, 0, 0, 0)
	assert calibrate.verdict(found, calibrate.Target(1, "5%")) == said


# ---- joints=FILE


def test_jointsOfAFile(tmp_path):
	file = tmp_path / "joints.json"
	file.write_text(json.dumps({"parameters": {"kn": 3e11, "joints": "calibrated"}, "scenarios": {"shear": {"friction": 40}, "tension": {"tension": 1}}}))
	assert scenario.withJoints(["sigma=1", "kn=5e11", f"joints={file}"], "shear") == ["sigma=1", "kn=5e11", "joints=calibrated", "friction=40"]
	assert scenario.withJoints(["joints=paper"], "shear") == ["joints=paper"]
	assert command.withJoints({"joints": str(file), "kn": "1"}, "shear") == {"kn": 1, "joints": "calibrated", "friction": 40}


@pytest.mark.parametrize("text", ["{", "[]", '{"cohesion": 1}', '{"parameters": {"cohesion": [1]}}'])
def test_filesThatAreNoJoints(tmp_path, text):
	(tmp_path / "bad.json").write_text(text)
	with pytest.raises(scenario.ParameterError, match="shear.joints must be a file"):
		scenario.withJoints([f"joints={tmp_path / 'bad.json'}"], "shear")
	with pytest.raises(scenario.ParameterError, match="can be read"):
		scenario.withJoints(["joints=nowhere.json"], "shear")


# ---- bad input


@pytest.mark.parametrize(
	"kind, words, said", [(ensemble, ["quantities=peek"], "no quantity peek .did you mean peak"), (ensemble, ["seeds=0"], "study.seeds must be at least 1"),
				(ensemble, ["oops"], "key=value"), (ensemble, ["table=nowhere"], "cannot be read"),
				(ensemble, ["refuse=1"], "every run failed: exit code 2: mine"), (sensitivity, [], "bounds= must be given"),
				(sensitivity, ["bounds=a:2:1"], "lower one below"), (sensitivity, ["bounds=a:1"], "of the form"),
				(sensitivity, ["bounds=idle:1:2"], "no key moves"), (sensitivity, ["bounds=idle:1:2", "a=1,2", "b=1,2"], "got a and b"),
				(sensitivity, ["bounds=idle:1:2", "a=low,high"], "values of a must be different numbers, got low,high"),
				(calibrate, ["bounds=a:1:2"], "targets= must be given"), (calibrate, ["bounds=a:1:2", "targets=peak:1:0"], "tolerance > 0"),
				(calibrate, ["bounds=a:1:2", "targets=peek:1:5%"], "no quantity peek"),
				(calibrate, ["bounds=wall.a:1:2", "targets=peak:1:5%"], "wall, which is no scenario")]
)
def test_badInputSaysWhatIsWrong(studied, kind, words, said):
	def function(words):
		if "refuse" in words: raise ValueError("exit code 2: mine has no parameter refuse")
		return {"peak": 1.0}

	with pytest.raises(command.StudyError, match=said):
		studied(kind, function, *words)


def test_theCoupletsJointsAreThoseThatShearHas():
	"""The one set for tension and shear stands in a file, which scenarios take, and as joints=calibrated in shear: the numbers are the same."""
	ours = json.loads((house / "scripts/studies/couplet.joints.json").read_text())["parameters"]
	sets = [node for node in ast.walk(ast.parse((house / "scripts/shear.py").read_text())) if isinstance(node, ast.Dict)]
	[calibrated] = [value for node in sets for key, value in zip(node.keys, node.values) if getattr(key, "value", None) == "calibrated"]
	written = {word.arg: word.value.value for word in calibrated.keywords if isinstance(word.value, ast.Constant)}
	same = {"cohesion", "friction", "GfI", "GfII", "mortarStrengths"}
	assert {name: ours[name] for name in same} == {name: written[name] for name in same}
	assert ours["tension"] == pytest.approx(1e6 * experiments.tensileStrength[0]) # as shear has it


def test_keysThatTheScenarioRefusesCostNoRun(studied, tmp_path, monkeypatch):
	"""As scripts/run.sh says it, before a single process is started; one point that is refused does not stop the others."""
	monkeypatch.setenv("PYTHONPATH", str(house / "py"))
	(tmp_path / "scripts/mine.py"
		).write_text("from yadeblocks import scenario\nscenario.parameters({'kn': scenario.Key(1., 'stiffness', 'Pa/m', scenario.positive)})\n")
	none = lambda words: pytest.fail("a run was started")
	with pytest.raises(command.StudyError, match="mine has no parameter km"):
		studied(ensemble, none, "km=3")
	with pytest.raises(command.StudyError, match="mine.kn must be positive, got -2"):
		studied(ensemble, none, "kn=-1,-2")
	made, runs, _ = studied(ensemble, lambda words: {"peak": 1.0}, "kn=-1,2", "seeds=2")
	assert len(runs) == 4


def test_unknownScenario(studied):
	with pytest.raises(command.StudyError, match="there is no scenario wood"):
		studied(ensemble, lambda words: {}, name="wood")


def commandsOfTheManual():
	"""The studies that the manual starts: kind, scenario and keys."""
	page = (house / "py/manual/runs.md").read_text()
	block = re.search(r"^```sh\n(.*?)^```$", page, re.M | re.S).group(1)
	return [line.split()[1:] for line in block.splitlines() if line.startswith("scripts/study.sh")]


@pytest.mark.parametrize("words", commandsOfTheManual(), ids=" ".join)
def test_commandsOfTheManual(studied, words, tmp_path):
	"""Each is carried out, with runs that a stand-in answers; the keys that the runs get are the scenario's."""
	kind, name, *keys = words
	(tmp_path / f"scripts/{name}.py").write_text("# reads sys.argv\n")
	asked = subprocess.run([sys.executable, "-m", "yadeblocks.help", house / f"scripts/{name}.py"], capture_output=True, text=True,
				env={**os.environ, "PYTHONPATH": str(house / "py")})
	known = set(re.findall(r"^  (\w+)=", asked.stdout, re.M))

	def answer(words):
		assert set(words) <= {*known, "seed", "seeds", "tag"}, set(words) - known
		if kind == "limit": return slowSteps(2)({"steps": 1000, "alpha": 0.5, **words})
		strength = 1 + words.get("cohesion", 1e6) / 2e6 + 0.01 * noise(words, name)
		return {
			"peak_tensile_stress" if name == "tension" else "peak_shear_stress": strength,
			"residual_shear_stress": words.get("residualFriction", 35) / 96
		}

	made, runs, folder = studied({"ensemble": ensemble, "sensitivity": sensitivity, "calibrate": calibrate, "limit": limit}[kind], answer, *keys, name=name)
	assert runs and made["kind"] == kind
	if kind == "calibrate": assert (folder / "joints.json").exists()
