# yade-blocks, GPL-2.0-or-later
"""Error against run time: how curves are read, runs kept, fronts and readings found, parameters calibrated, spheres packed.

No test needs YADE; a small program of that name stands in for it where runs are started.
"""
import json
import math
import os
import shutil
import signal
import stat
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from yadeblocks import curves, experiments, packing, provenance

package = Path(curves.__file__).parent
sys.path.insert(0, str(package.parents[1] / "scripts"))
from laboratory import calibration, engine, jobs, study, tradeoff, tradeoffpicture

# ---- curves

ramp = np.arange(0, 101) / 100


def values(measured):
	return {name: value for name, (value, unit) in measured.items()}


def test_tensionCurve():
	x, y = 10e-3 * np.append(ramp, 1.01), np.append(0.35 * ramp, 0) # to 0.35 N/mm2 at 10 um, then nothing
	x[:99] *= 1 - 1e-9 # so that 98 % of the way is just not reached by the sample there
	m = values(curves.measure("tension", x, y))
	assert m["joint_stiffness"] == pytest.approx(35)
	assert m["peak_tensile_stress"] == pytest.approx(0.35 * 0.995) # mean of the last two of 100 samples: half a sample lower


def test_snapBackAsAMachineSeesIt():
	# up to (1, 1), back to (0.5, 0.2), and up again by (1, 0.6), where the machine has waited, to (1.5, 1)
	x, y = curves.driven([0, 1, 0.5, 1.5], [0, 1, 0.2, 1], samples=1501)
	assert x[1] - x[0] == pytest.approx(1e-3) and x[-1] == 1.5
	assert y[:1000] == pytest.approx(x[:1000]) # the way up
	assert y[1001:] == pytest.approx(0.6 + 0.8 * (x[1001:] - 1)) # the second branch, of slope 0.8


def test_areasBelowACurve():
	"""Up to 1 at x = 1, down to 0.2 at x = 2, and on to 10: above 0.2 are two triangles, 0.8 high and 0.8 and 1 wide."""
	x, y = np.array([0, 0.2, 1, 2, 10]), np.array([0, 0.2, 1, 0.2, 0.2])
	assert curves.aboveResidual(x, y) == pytest.approx(0.32 + 0.40)
	assert math.isnan(curves.aboveResidual([0, 1, 1.9, 2], [0, 0.9, 0.95, 1.0]))
	assert curves.behindPeak(x, y, 0.2) == pytest.approx(0.6)
	assert curves.behindPeak(x, y, 0.25) == pytest.approx(0.6) # the sample that is below counts
	assert math.isnan(curves.behindPeak(x, y, 0.1))


def test_oneSampleIsNoPeak():
	x = np.linspace(0, 1, 401)
	y = np.minimum(x, 0.5)
	y[300] = 0.9 # a spike at 0.75; 2 % of the way to it are 7 samples: it counts as a seventh of its height above the plateau
	assert values(curves.measure("tension", x, y))["peak_tensile_stress"] == pytest.approx(0.5 + 0.4 / 7)


def test_shearCurveHasAResidual():
	x = np.linspace(0, 0.5, 501)
	y = np.where(x < 0.1, 20 * x, 0.4) # peak 2 at 0.1 mm
	m = values(curves.measure("shear", x, y))
	assert m["residual_shear_stress"] == pytest.approx(0.4) and m["shear_stiffness"] == pytest.approx(20)


def test_modulusComesFromPermille():
	strain = 5 * ramp # permille
	assert values(curves.measure("compression", strain, 4.1 * strain))["youngs_modulus"] == pytest.approx(4100)


@pytest.mark.parametrize("x, y", [([2.0, 2.5, 3], [0.8, 0.9, 1]), ([0, 2, 2.5, 3], [0, 0.8, 0.9, 1]), ([1, 3, 3.5, 4], [0, 0.8, 0.9, 1])])
def test_elasticJump(x, y):
	assert values(curves.measure("tension", x, y))["joint_stiffness"] == pytest.approx(0.4)


def test_curveWithoutElasticPart():
	assert math.isnan(values(curves.measure("tension", [0, 1, 2], [1, 0.9, 0.8]))["joint_stiffness"])


def test_expectationsFollowThePrecompression():
	assert experiments.expected("shear", 0.5e6)["peak_shear_stress"][0] == pytest.approx(1.375)
	assert experiments.expected("shear", 0)["residual_shear_stress"][0] is None # no relative error against zero


# ---- fingerprints


@pytest.fixture
def tree(tmp_path):
	for name, text in {
		"py/yadeblocks/__init__.py": "from . import _plugin\n", "py/yadeblocks/_plugin.py": "",
		"py/yadeblocks/results.py": "from .export import pairName\n", "py/yadeblocks/export.py": "import numpy\n", "py/yadeblocks/unused.py": "",
		"scripts/mine.py": "from yadeblocks.results import Results\nimport os\n"
	}.items():
		(tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
		(tmp_path / name).write_text(text)
	return tmp_path


def test_sourcesAreFollowed(tree):
	found = {path.name for path in provenance.sourcesOf(tree / "scripts/mine.py", tree / "py/yadeblocks")}
	assert found == {"mine.py", "__init__.py", "_plugin.py", "results.py", "export.py"}


def test_realScriptsKnowTheirSources():
	found = {path.relative_to(package.parents[1]).as_posix() for path in provenance.sourcesOf(package.parents[1] / "scripts/tension.py", package)}
	modules = "__init__ _plugin specimen results/__init__ results/cracks scenario/parsing export/paraview readings/names".split()
	assert {"scripts/tension.py", *(f"py/yadeblocks/{module}.py" for module in modules)} <= found and "py/yadeblocks/packing.py" not in found


@pytest.mark.parametrize("changed", ["scripts/mine.py", "py/yadeblocks/export.py"])
def test_fingerprintSeesContents(tree, changed):
	files = provenance.sourcesOf(tree / "scripts/mine.py", tree / "py/yadeblocks")
	before = provenance.fingerprint(files, "YADE 1")
	assert before == provenance.fingerprint(list(reversed(files)), "YADE 1") != provenance.fingerprint(files, "YADE 2")
	(tree / changed).write_text((tree / changed).read_text() + "# a change\n")
	assert provenance.fingerprint(files, "YADE 1") != before


def test_contentsMayNotChangePlaces(tmp_path):
	a, b = tmp_path / "a.py", tmp_path / "b.py"
	a.write_text("x"), b.write_text("yz")
	before = provenance.fingerprint([a, b])
	a.write_text("yz"), b.write_text("x")
	assert provenance.fingerprint([a, b]) != before


def test_sameSettingsSameKey():
	assert study.settingsKey({"steps": 40000, "alpha": 0.3}) == study.settingsKey({"alpha": 0.3, "steps": 4e4})
	assert study.settingsKey({"vtk": False}) == "vtk=false"
	assert study.settingsKey({"alpha": 0.3}) != study.settingsKey({"alpha": 0.30000000001})


# ---- runs

imitation = """#!/usr/bin/python3
import json, os, pathlib, sys, time
if '--version' in sys.argv: sys.exit(print('YADE ' + os.environ.get('FAKE', '1')))
words = dict(word.split('=', 1) for word in sys.argv if '=' in word)
with open(os.environ['CALLS'], 'a') as calls: calls.write(' '.join(sys.argv[4:]) + chr(10))
if 'refuse' in words: sys.exit('mine.refuse must not be given')
if 'silent' in words: sys.exit()
while int(words['seed']) > 2 and os.path.exists(os.environ['CALLS'] + '.slow'): time.sleep(0.05)
folder = pathlib.Path('out/' + pathlib.Path(sys.argv[4]).stem + '-' + words['tag'])
folder.mkdir(parents=True)
stress = float(words.get('strength', '0.35'))
rows = ['seed,displacement_mm,stress_MPa'] + ['1,%g,%g' % (i / 1e4, stress * i / 100) for i in range(101)]
(folder / 'curve.csv').write_text(chr(10).join(rows))
peak = {'name': 'peak', 'measured': stress, 'unit': 'MPa', 'expected': None}
(folder / 'result.json').write_text(json.dumps({'quantities': [peak], 'cost': {'cpu_s': 1.5, 'steps': 7}, 'quality': {}}))
"""


@pytest.fixture
def house(tree, monkeypatch):
	(tree / "scripts/tension.py").write_text("from yadeblocks.results import Results\n")
	(tree / "plugin.so").write_bytes(b"plugin")
	(tree / "bin").mkdir()
	program = tree / "bin/yade"
	program.write_text(imitation)
	program.chmod(program.stat().st_mode | stat.S_IXUSR)
	monkeypatch.setenv("PATH", f"{tree / 'bin'}:{os.environ['PATH']}")
	monkeypatch.setenv("CALLS", str(tree / "calls"))
	jobs.yadeVersion.cache_clear()
	return tree


@pytest.fixture(scope="module")
def workers():
	"""Two workers that all tests share."""
	with engine.Engine(2) as started:
		yield started


@pytest.fixture(autouse=True)
def shared(workers):
	started.engine = workers


def started(house, **more):
	return jobs.Jobs(house, house / "out/benchmark", house / "plugin.so", stream=open(os.devnull, "w"), engine=started.engine, **more)


def calls(house):
	return len((house / "calls").read_text().splitlines()) if (house / "calls").exists() else 0


def test_resultsAreKept(house):
	job = jobs.Job("tension", {"steps": 1000, "strength": 0.4}, 3)
	assert started(house).result(job) is None
	started(house).do([job, jobs.Job("tension", {"strength": 0.4, "steps": 1e3}, 3)]) # the same one
	again = started(house)
	again.do([job])
	assert calls(house) == 1
	result = again.result(job)
	assert result["measures"]["peak_tensile_stress"] == pytest.approx(0.397, abs=0.0011) and result["cost"]["cpu_s"] == 1.5
	assert result["command"] == "scripts/run.sh tension steps=1000 strength=0.4 seed=3"
	assert {path.name for path in (house / "out/benchmark").iterdir()} == {"runs", ".lock"} # nothing is left lying about


@pytest.mark.parametrize("changed", ["scripts/tension.py", "py/yadeblocks/export.py", "plugin.so"])
def test_changedCodeIsRunAnew(house, changed):
	job = jobs.Job("tension", {"steps": 1000}, 1)
	started(house).do([job])
	(house / changed).write_text((house / changed).read_text() + "# a change\n")
	assert started(house).result(job) is None
	started(house).do([job])
	assert calls(house) == 2
	started(house, pluginFree=("tension", )).do([job])
	(house / "plugin.so").write_bytes(b"another plugin")
	assert started(house, pluginFree=("tension", )).result(job) # which does not depend on it


def test_changedYadeIsRunAnew(house, monkeypatch):
	job = jobs.Job("tension", {"steps": 1000}, 1)
	started(house).do([job])
	monkeypatch.setenv("FAKE", "2")
	jobs.yadeVersion.cache_clear()
	assert started(house).result(job) is None


@pytest.mark.parametrize(
	"settings, reason", [({"refuse": 1}, "exit code 1: mine.refuse must not be given"),
				({"silent": 1}, "left no result (FileNotFoundError): (said nothing)")]
)
def test_failuresAreKeptWithTheirReason(house, settings, reason):
	job = jobs.Job("tension", settings, 1)
	started(house).do([job])
	assert started(house).result(job)["failed"] == reason
	assert started(house).wanted([job]) == [] and started(house, retry=True).wanted([job]) == [job]


@pytest.mark.parametrize("failed, again", [("exit code 1: refused", False), ("exit code -9: killed", True)])
def test_whatTimeOrMemoryStoppedIsRunAgain(house, failed, again):
	job, some = jobs.Job("tension", {"steps": 1000}, 1), started(house, limit=100)
	some.kept.mkdir(parents=True)
	some.path(job).write_text(json.dumps({"job": {}, "failed": failed}))
	assert some.wanted([job]) == [job] * again
	some.path(job).write_text(json.dumps({"job": {}, "failed": "not done after 100 s: ...", "limit": 100}))
	assert some.wanted([job]) == [] and started(house, limit=200).wanted([job]) == [job]


def test_codeThatChangesMeanwhile(house):
	program = house / "bin/yade"
	program.write_text(imitation + "(pathlib.Path('%s') / 'py/yadeblocks/export.py').write_text('# edited')\n" % house)
	job, some = jobs.Job("tension", {"steps": 1000}, 1), started(house)
	with pytest.raises(RuntimeError, match="has changed while it was running"):
		some.do([job])
	assert some.result(job) is None and started(house).result(job) is None


def test_halfWrittenResultsAreNoResults(house):
	job, some = jobs.Job("tension", {"steps": 1000}, 1), started(house)
	some.kept.mkdir(parents=True)
	some.path(job).with_suffix(".part").write_text('{"job"')
	some.work.mkdir()
	(some.work / "out").mkdir() # leftovers
	assert started(house).result(job) is None
	some.do([job])
	assert "measures" in started(house).result(job)


def test_oneAtATime(house):
	job, first = jobs.Job("tension", {"steps": 1000}, 1), started(house)
	first.do([job])
	with first._claimed(), pytest.raises(RuntimeError, match="another benchmark is running"):
		started(house).do([job._replace(seed=2)])
	started(house).do([job._replace(seed=2)]) # it is free again


# ---- studies, as the user starts them


def test_studyGoesOnWhereItWasInterrupted(study5, house):
	(house / "scripts/tension.py").write_text("# reads vtk and all else from sys.argv\nfrom yadeblocks.results import Results\n")
	(house / "calls.slow").touch()
	words = "ensemble", "tension", "strength=0.3", "seeds=4"
	first = study5.study(*words)
	results = house / "out/study-ensemble-tension/runs"
	while len(list(results.glob("*.json"))) < 2 or calls(house) < 4:
		assert first.poll() is None, first.stderr.read()
	first.send_signal(signal.SIGINT)
	assert "interrupted: what is complete is kept" in first.communicate(timeout=300)[1] and first.returncode == 130
	(house / "calls.slow").unlink()
	again = study5.study(*words)
	out, progress = again.communicate(timeout=300)
	assert again.returncode == 0, progress
	assert "| tension | peak | MPa | 4 | 0.3 |" in out and "2/2  0:00 left" in progress and calls(house) == 6 # two of four were interrupted
	found = json.loads((house / "out/study-ensemble-tension/study.json").read_text())
	assert found["settings"] == {"strength": 0.3, "vtk": False} and found["points"][0]["quantities"]["peak"]["n"] == 4
	refused = study5.study("ensemble", "tension", "refuse=1", "seeds=2")
	assert refused.communicate(timeout=300)[1].splitlines()[-1] == "study: every run failed: exit code 1: mine.refuse must not be given"
	assert refused.returncode == 1
	unknown = study5.study("ensemble", "wood")
	assert unknown.communicate(timeout=300)[1] == "study: there is no scenario wood\n" and unknown.returncode == 1


# ---- errors and fronts


def result(peak, cpu=1.0, stiffness=36.0):
	return {"measures": {"peak_tensile_stress": peak, "joint_stiffness": stiffness}, "cost": {"cpu_s": cpu}}


def test_errorOf():
	error = tradeoff.errorOf([1.1, 0.9, 1.0], 1.0)
	assert error.mean == pytest.approx(0) and error.scatter == pytest.approx(0.1) and error.rms == pytest.approx(math.sqrt(0.02 / 3)) and error.seeds == 3
	assert tradeoff.errorOf([1.1, 2.2], [1.0, 2.0]).rms == pytest.approx(0.1) # each against its own
	assert tradeoff.errorOf([1.0], None) is None and tradeoff.errorOf([], 1.0) is None


def test_rowsCompareSeedWithSeed():
	results = {1: result(0.42, 2), 2: result(0.33, 4), 3: {"failed": "exit code 1"}, 4: None}
	references = {1: result(0.40), 2: result(0.30), 3: result(0.35), 4: None}
	row = tradeoff.summarise("tension", "blocks", "steps", "5k steps", tradeoff.quantities["tension"], results, {"peak_tensile_stress": 0.35}, references)
	assert row.seeds == 2 and row.cpu == 3 and row.failed == "exit code 1; 1 of 4 not run"
	assert row.reference["peak_tensile_stress"].mean == pytest.approx(0.075) # 5 and 10 %
	assert row.laboratory["peak_tensile_stress"].mean == pytest.approx((0.42 + 0.33) / 0.7 - 1) and row.laboratory["joint_stiffness"] is None
	assert row.worst("reference") == pytest.approx(math.sqrt((0.05**2 + 0.1**2) / 2)) and math.isnan(row.rms("laboratory", "joint_stiffness"))


def test_aReferenceMayKnowThePeakAlone():
	"""That of a path from event to event, which has no residual."""
	whole = lambda peak, residual: {**result(0), "measures": {"peak_shear_stress": peak, **({"residual_shear_stress": residual} if residual else {})}}
	row = tradeoff.summarise("shear 0.1", "blocks", "steps", "6k steps", tradeoff.quantities["shear"], {1: whole(1.1, 0.2)}, {}, {1: whole(1.0, None)})
	assert row.reference["peak_shear_stress"].mean == pytest.approx(0.1) and row.reference["residual_shear_stress"] is None
	assert "6k steps" in tradeoff.asMarkdown([row], tradeoff.quantities["shear"])


def test_runsWithoutPeakAreTold():
	results = {seed: {**result(0.4), "quality": {"without_peak": [seed] * (seed > 1)}} for seed in (1, 2, 3)}
	row = tradeoff.summarise("tension", "cpm", "steps", "5k steps", tradeoff.quantities["tension"], results, {"peak_tensile_stress": 0.35}, {})
	assert row.rising == 2
	assert any(
		line.startswith("Without a peak in some runs") and "cpm 5k steps" in line for line in tradeoff.reading([row], tradeoff.quantities["tension"])
	)
	assert not any("against the laboratory" in line for line in tradeoff.reading([row], tradeoff.quantities["tension"])) # what is no peak is no best result
	assert "5k steps, 2 without peak" in tradeoff.asMarkdown([row], tradeoff.quantities["tension"])


def test_pareto():
	points = [(1, 10), (2, 5), (3, 6), (2, 7), (4, 1), (5, 1), (math.nan, 0), (0.5, math.nan)]
	assert tradeoff.pareto(points) == [0, 1, 4]
	assert tradeoff.pareto([]) == []


def rowOf(label, cpu, rms, model="blocks", knob="steps", failed="", isReference=False, laboratory=0.1):
	error = lambda value: {
		"peak_tensile_stress": tradeoff.Error(value, value / 2, value, 5), "joint_stiffness": tradeoff.Error(0.5 * value, 0.0, 0.5 * value, 5)
	}
	return tradeoff.Row(
		"tension", model, knob, label, 5, cpu, {"peak_tensile_stress": (0.35, 0.01), "joint_stiffness": (36.0, 0.1)}, error(laboratory),
		{} if isReference else error(rms), failed, isReference
	)


study4 = [
	rowOf("2k steps", 0.2, 0.12),
	rowOf("5k steps", 0.5, 0.04),
	rowOf("lucky", 0.4, 0.001, failed="exit code 1"),
	rowOf("20k steps", 2, 0.015),
	rowOf("80k steps", 8, 0, isReference=True),
	rowOf("20k steps alpha 0.8", 2, 0.2, knob="alpha"),
	rowOf("5k steps 9 mm", 0.01, 0.001, knob="size"),
	rowOf("20k steps", 20, 0.01, model="jcfpm")
]


def test_cheapestNeedsAllSeeds():
	error = lambda row: row.rms("reference", "peak_tensile_stress")
	assert tradeoff.cheapest(study4[:4], 0.05, error).label == "5k steps" # not the one of which a seed failed
	assert tradeoff.cheapest(study4[:4], 0.01, error) is None


def moving(by):
	"""The reference, twice as fast."""
	return rowOf("40k steps", 4, by, knob="half as slow")


def test_reading():
	lines = tradeoff.reading(study4 + [moving(0.004)], tradeoff.quantities["tension"])
	text = "\n".join(lines)
	assert len(lines) <= 10 and "5 seeds" in lines[0] and "peak +0.4 % ± 0.2 %, stiffness +0.2 % ± 0 %" in lines[0]
	assert "For the peak within 5 %: 5k steps (0.5 CPU s, 4 %); 2 %: 20k steps (2 CPU s, 1.5 %);" in text
	assert "1 %: none of the settings tried, the best is 20k steps" in text # the spheres' 1 % is not ours, nor is that of the reference twice as fast
	assert "For the stiffness within 5 %: 5k steps (0.5 CPU s, 2 %); 2 %: 20k steps" in text # 2 % and what the reference moves by are more than 2 %
	assert "20k steps alpha 0.8 20 % (2 s) instead of 1.5 % (2 s)" in text and "9 mm" not in text # which is another specimen
	assert "the slow run gives peak +10 %" in text and "calibrated for this experiment: jcfpm peak +10 % ± 5 %, stiffness +5 % ± 0 % (20 CPU s)" in text
	assert "against their own slow runs: jcfpm 20k steps 1 % (20 s)" in text
	assert "Failed, see the table: blocks lucky." in text and "Not all seeds" not in text


def test_readingAgainstTheExactPath():
	"""The solver is the reference and told for itself: neither it nor the slow run is a setting to be judged by the solver."""
	cascades, single = rowOf("events cascades", 0.3, 0, knob="solver"), rowOf("events", 0.2, 0.004, knob="solver")
	slow = rowOf("80k steps", 0.9, 0.003, knob="slow")
	exact = rowOf("events cascades", 0.3, 0, isReference=True)
	lines = tradeoff.reading([row for row in study4 if not row.isReference] + [cascades, single, slow, exact], tradeoff.quantities["tension"])
	text = "\n".join(lines)
	assert "cascades from event to event; a slow run (80k steps) is off by: peak +0.3 % ± 0.15 %" in lines[0]
	assert lines[1] == "From event to event, without time steps: events cascades (0.3 CPU s); events (0.2 CPU s), whose peak is off by 0.4 %."
	assert "slow run gives" not in text and "1 %: events" not in text and "1 %: 80k" not in text
	assert lines[2].startswith("For the peak within 5 %: 5k steps")


def test_readingOfASolverThatIsNotTheReference():
	"""Where the path ends before the peak, steps go on from it: a setting among others."""
	solver = rowOf("5k steps events", 0.02, 0.004, knob="solver")
	text = "\n".join(tradeoff.reading(study4 + [moving(0.001), solver], tradeoff.quantities["tension"]))
	assert "1 %: 5k steps events (0.02 CPU s" in text and "From event to event" not in text


def test_readingAgainstAReferenceThatMoves():
	text = "\n".join(tradeoff.reading(study4 + [moving(0.028)], tradeoff.quantities["tension"]))
	assert "For the peak within 5 %: 5k steps" in text and "2 %: cannot be judged, the reference is known to 2.8 % only." in text
	text = "\n".join(tradeoff.reading(study4 + [moving(0.032)], tradeoff.quantities["tension"]))
	assert "For the peak within 5 %: 20k steps" in text # 4 % of error and 3.2 % of the reference's are more than 5 %


def test_readingKeepsWhatFailed():
	many = study4 + [
		moving(0.004),
		rowOf("tension's", 1, 1, model="cpm", knob="one set"),
		rowOf("slippery", 1, 1, model="cpm", knob="low friction"),
		rowOf("1k steps", 0.1, 0.5, failed="5 of 5 not run"),
		rowOf("3k steps", 0.1, 0.5)._replace(rising=1)
	]
	lines = tradeoff.reading(many, tradeoff.quantities["tension"], most=5)
	assert len(lines) == 5 and [line.split(":")[0] for line in lines[2:]] == [
		"Not all seeds were run (yet)", "Failed, see the table", "Without a peak in some runs, whose stress had not fallen when they ended"
	]
	assert "3k steps" not in lines[1] # nor is it recommended


def test_readingOfWhatIsNotThere():
	lines = tradeoff.reading([
		rowOf("2k steps", 0.2, 0, isReference=True),
		rowOf("5k steps", math.nan, math.nan, failed="5 of 5 not run")._replace(reference={}, laboratory={})
	], tradeoff.quantities["tension"])
	assert lines == ["Laboratory: the slow run gives peak +10 % ± 5 %, stiffness +5 % ± 0 %.", "Not all seeds were run (yet): blocks 5k steps."]


def test_tables(tmp_path):
	names = tradeoff.quantities["tension"]
	other = [row._replace(case="shear 0.5") for row in study4[1:4]]
	assert tradeoff.asMarkdown(study4 + other, names).count(" * |") == 3 + 2 + 1 # a front for each case, and for the spheres
	text = tradeoff.asMarkdown(study4, names)
	assert "lucky *" not in text # a run failed
	assert text.count(
		"\n"
	) == len(study4) + 1 and "| 2k steps * |" in text and "alpha 0.8 *" not in text and "80k steps (reference)" in text and "5 (exit code 1)" in text
	records = list(tradeoff.asRecords(study4))
	assert records[0]["peak_tensile_stress reference error rms"] == 0.12 and math.isnan(records[4]["joint_stiffness reference error"])
	assert len({tuple(record) for record in records}) == 1 # the same columns in all rows
	path = tradeoffpicture.drawTradeoff(tmp_path / "p.png", {"tension": study4}, names, ["a line"], "title")
	assert path.stat().st_size > 10000


# ---- calibration


def test_calibration():
	evaluate = lambda q: {"stiffness": 3e-8 * q["young"]**0.8, "peak": 0.4e-6 * q["tension"] * (q["young"] / 1e9)**0.1} # coupled and not linear
	found = calibration.calibrate(
		evaluate, {"young": 1e9, "tension": 1e6}, {"stiffness": 1.0, "peak": 0.35}, {"stiffness": "young", "peak": "tension"}, tolerance=0.005, rounds=8
	)
	assert found.misfit({"stiffness": 1.0, "peak": 0.35}) <= 0.005 and found.rounds < 8
	assert evaluate(found.parameters) == found.measured


def test_calibrationKeepsTheBest():
	answers = iter([{"peak": 1.2}, {"peak": 1.05}, {"peak": 3.0}])
	found = calibration.calibrate(lambda q: next(answers), {"tension": 1.0}, {"peak": 1.0}, {"peak": "tension"}, rounds=3)
	assert found.measured == {"peak": 1.05} and found.rounds == 3


def test_calibrationSurvivesNothing():
	answers = iter([{"peak": math.nan}, {"peak": -0.1}, {"peak": 1.0}])
	asked = []
	found = calibration.calibrate(lambda q: (asked.append(dict(q)), next(answers))[1], {"tension": 1.0}, {"peak": 1.0}, {"peak": "tension"}, rounds=5)
	assert [q["tension"] for q in asked] == [1, 2, 4] and found.rounds == 3


@pytest.mark.parametrize(
	"text, same", [("\"\"\"Other words.\"\"\"\nsteps = dict(a = 1)  # and a remark\n", True), ("\"\"\"Words.\"\"\"\nsteps = dict(a=2)\n", False)]
)
def test_meaningIsWithoutComments(tmp_path, text, same):
	a, b = tmp_path / "a.py", tmp_path / "b.py"
	a.write_text('"""Words."""\nsteps = dict(a=1)\n'), b.write_text(text)
	assert (study.meaning(a) == study.meaning(b)) == same


def test_changesOfACalibration():
	entry = {"targets": {"peak": 0.35}, "packings": [101], "code": "ab"}
	assert calibration.changes(entry, {**entry}) == []
	assert calibration.changes(entry, {"targets": {"peak": 0.43}, "packings": [101], "code": "cd"}) == ["targets", "code"]
	assert calibration.changes({}, {"code": "ab"}) == ["code"]


@pytest.fixture
def study5(house):
	"""The benchmark itself, with the imitation of YADE."""
	for folder in ("scripts", "py"):
		shutil.rmtree(house / folder)
		shutil.copytree(package.parents[1] / folder, house / folder)

	def benchmark(mode):
		cluster.start()
		where = f"scheduler={cluster.cluster.scheduler_address}"
		command = [sys.executable, house / "scripts/benchmark.py", "experiment=tension", "model=jcfpm", "seeds=1", f"mode={mode}", where]
		return subprocess.run(
			command, env={**os.environ, "YADEBLOCKS_PLUGIN": str(house / "plugin.so")}, capture_output=True, text=True, check=True
		).stdout

	def study(*words, **more):
		cluster.start()
		command = [sys.executable, "-m", "laboratory", *words, f"scheduler={cluster.cluster.scheduler_address}"]
		paths = os.pathsep.join([str(house / "scripts"), str(house / "py"), os.environ["PYTHONPATH"]])
		environment = {**os.environ, "YADEBLOCKS_PLUGIN": str(house / "plugin.so"), "PYTHONPATH": paths}
		return subprocess.Popen(command, cwd=house, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

	benchmark.file, benchmark.study = lambda name: house / name, study
	cluster = engine.Engine(2) # its workers find the imitation of YADE
	yield benchmark
	cluster.close()


@pytest.mark.parametrize(
	"words, said", [(["mode=calibrate", "model=blocks"], "nothing to calibrate"), (["experiment=compression", "model=lourenco"], "nothing to run"),
			(["model=wood"], "benchmark.model")]
)
def test_benchmarkOfNothing(study5, words, said):
	run = subprocess.run([sys.executable, study5.file("scripts/benchmark.py"), *words], capture_output=True, text=True)
	assert run.returncode and said in run.stderr


def test_staleCalibrationIsTold(study5):
	study5("calibrate")
	known = json.loads(study5.file("scripts/calibrated.json").read_text())["jcfpm tension"]
	assert known["parameters"]["tension"] == known["moved"]["tension"] and known["packings"] == [101, 102, 103]
	assert "Calibrated with other" not in study5("quick")
	for name, old, new, said in [("scripts/spheres.py", "coarser=2, steps=20000", "coarser=2, steps=10000", "code"),
					("py/yadeblocks/packing.py", "solidity = 0.86", "solidity = 0.9", "code"),
					("scripts/laboratory/yadefits.py", "22 * q", "21 * q", "parameters"),
					("py/yadeblocks/curves.py", "noise = 0.02", "noise = 0.03", "code"),
					("py/yadeblocks/experiments.py", "tensileStrength = 0.35", "tensileStrength = 0.36", "targets")]:
		path = study5.file(name)
		before = path.read_text()
		assert before.count(old) == 1
		path.write_text(before.replace(old, new))
		line = f"Calibrated with other {said}: jcfpm;"
		assert line in study5("quick") and line in study5.file("out/benchmark/tension-quick.md").read_text()
		path.write_text(before)


# ---- packings


@pytest.mark.parametrize("seed", [1, 2])
def test_randomPacking(seed):
	width, height, radius = 0.05, 0.02, 1e-3
	centres, radii = packing.randomPacking(width, height, radius, seed)
	assert (centres >= radii[:, None] - 1e-12).all() and (centres <= np.array([width, height]) - radii[:, None] + 1e-12).all()
	assert 0.8e-3 <= radii.min() and radii.max() <= 1.2e-3
	distance = np.hypot(*(centres[:, None] - centres[None]).transpose(2, 0, 1))
	overlap = np.maximum(radii[:, None] + radii[None] - distance, 0)
	np.fill_diagonal(overlap, 0)
	assert overlap.max(axis=1).mean() <= 0.02 * radius
	assert 0.72 < (math.pi * radii**2).sum() / (width * height) < 0.86 # loose 2D packings take 0.77 in bulk, walls cost some
	again, other = packing.randomPacking(width, height, radius, seed), packing.randomPacking(width, height, radius, seed + 10)
	assert np.array_equal(again[0], centres) and not np.array_equal(other[0][:10], centres[:10])


def test_hexagonalPackingTouches():
	centres, radii = packing.hexagonalPacking(0.05, 0.03, 1e-3, 3)
	distance = np.hypot(*(centres[:, None] - centres[None]).transpose(2, 0, 1))
	np.fill_diagonal(distance, 1)
	assert distance.min() == pytest.approx(2e-3, rel=1e-9)
	inside = (abs(centres - (0.025, 0.015)) < (0.02, 0.01)).all(axis=1)
	assert ((distance < 2.0001e-3).sum(axis=1)[inside] == 6).all()
