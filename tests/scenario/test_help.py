# yade-blocks, GPL-2.0-or-later
"""What the commands say before anything runs: scenarios, keys, and how far the first build is. Nothing is built or installed: cmake, ninja and dpkg are small
stand-ins."""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

house = Path(__file__).resolve().parents[2]


def called(*command, **more):
	environment = {**os.environ, "PYTHONPATH": str(house / "py"), **more.pop("env", {})}
	return subprocess.run([*map(str, command)], capture_output=True, text=True, env=environment, **more)


def test_everyKeyHasAMeaning():
	"""All scenarios in one Python, without YADE."""
	scripts = [path for path in sorted((house / "scripts").glob("*.py")) if not path.with_suffix(".sh").exists()]
	run = called(sys.executable, "-m", "yadeblocks.help", *scripts, env={"YADEBLOCKS_PLUGIN": "/there/is/none"})
	assert run.returncode == 0, run.stderr
	lines = re.findall(r"^  (\w+)=(\S*)( \[.*?\])?(.*)$", run.stdout, re.M)
	assert len(lines) > 80 and not [line for line in lines if len(line[3].split(";")[0].strip()) < 8]
	units = dict((key, unit.strip()) for key, _, unit, _ in lines)
	assert units["sigma"] == "[Pa]" and units["size"] == "[m]" and units["kn"] == "[Pa/m]" and units["seed"] == ""
	assert re.search(r"^  sigma=500000 \[Pa\] +precompression; must not be negative$", run.stdout, re.M)
	below = re.findall(r"; (must (?:not )?be .*smaller than .*|must be below .*)$", run.stdout, re.M)
	assert below and not [rule for rule in below if not re.match("must be positive and |must not be negative", rule)] # both ends of what is allowed
	assert run.stdout.count("key=value ...]\n  ") == len(scripts) # each showed its keys


def test_runAloneListsScenarios():
	run = called(house / "scripts/run.sh")
	assert run.returncode == 0 and not run.stderr
	assert re.search(r"^  shear +Shear of a masonry couplet under precompression", run.stdout, re.M) and "  benchmark" not in run.stdout
	run = called(house / "scripts/run.sh", "wood")
	assert run.returncode == 2 and run.stderr.startswith("there is no scenario 'wood'\n") and "  shear  " in run.stderr


def test_helpOfAScenarioAnywhereInTheLine():
	run = called(house / "scripts/run.sh", "shear", "sigma=1e5", "help")
	assert run.returncode == 0 and run.stdout.startswith("Shear of a masonry couplet") and "  steps=32000  " in run.stdout


@pytest.mark.parametrize(
	"words, said", [(["detial=mortar"], "wall has no parameter detial (did you mean detail?); known: "),
			(["detail=morter"], "wall.detail must be one of interface, mortar, got 'morter'\n"),
			(["stroke=1", "stroke=2"], "wall.stroke must be given once, got 1 and 2\n")]
)
def test_wrongKeysAreRefusedBeforeAnythingIsBuilt(tmp_path, words, said):
	"""run.sh in a house without a build, in which neither setup.sh nor yade would do."""
	(tmp_path / "scripts").mkdir()
	for name in ("run.sh", "install.sh", "wall.py"):
		shutil.copy(house / "scripts" / name, tmp_path / "scripts")
	(tmp_path / "scripts/setup.sh").write_text("#!/bin/sh\necho building\nexit 3\n")
	(tmp_path / "scripts/setup.sh").chmod(0o755)
	os.symlink(house / "py", tmp_path / "py")
	run = called(tmp_path / "scripts/run.sh", "wall", *words)
	assert run.returncode == 2 and run.stdout == "" and run.stderr.startswith(said)
	assert called(tmp_path / "scripts/run.sh", "wall", "detail=mortar").stdout == "building\n"


def test_scriptsWithoutKeys(tmp_path):
	(tmp_path / "mine.py").write_text('"""A pile."""\nO.run(1)\n')
	(tmp_path / "bare.py").write_text("")
	(tmp_path / "report.py").write_text('"""A report."""')
	(tmp_path / "report.sh").write_text("")
	(tmp_path / "wants.py").write_text("from yade import utils\nfrom yadeblocks import scenario\nutils.nothing()\np = scenario.parameters({'a': 1})\n")
	assert called(sys.executable, "-m", "yadeblocks.help", tmp_path / "wants.py", "b=3").returncode == 0
	(tmp_path / "wants.py").unlink()
	run = called(sys.executable, "-m", "yadeblocks.help", tmp_path, tmp_path / "mine.py")
	assert run.stdout == "  bare\n  mine  A pile.\nA pile.\n\nIt has no keys.\n"


def test_keysThatAScriptWithoutKeysDoesNotRead():
	run = called(house / "scripts/run.sh", "examples/first", "threads=1", "size=3")
	assert run.returncode == 2 and run.stdout == "" and run.stderr == "first has no keys, got size=3\n"


def test_helpReadInPart():
	"""A reader that has seen enough (head) is no error of ours."""
	run = called("bash", "-c", f"'{house}/scripts/run.sh' shear help | head -c 20; exit ${{PIPESTATUS[0]}}")
	assert run.stdout == "Shear of a masonry c" and run.stderr == ""


def test_manualFindsTheModulesWithoutHelp(tmp_path):
	"""Figures and pages of classes are made by YADE with our modules, also where nobody has set PYTHONPATH."""
	for folder in ("scripts/examples", "py/manual", "bin"):
		(tmp_path / folder).mkdir(parents=True)
	shutil.copy(house / "scripts/manual.sh", tmp_path / "scripts")
	for name, text in {"scripts/setup.sh": "", "bin/yade": f'echo "$4 $PYTHONPATH" >> {tmp_path}/calls'}.items():
		(tmp_path / name).write_text("#!/bin/sh\n" + text + "\n")
		(tmp_path / name).chmod(0o755)
	environment = {**{key: value for key, value in os.environ.items() if key != "PYTHONPATH"}, "PATH": f"{tmp_path}/bin:{os.environ['PATH']}"}
	subprocess.run([tmp_path / "scripts/manual.sh"], capture_output=True, env=environment) # ends at Sphinx, for want of pages
	assert (tmp_path / "calls").read_text() == "".join(f"py/manual/{name}.py {tmp_path}/py\n" for name in ("figures", "classes"))


# ---- the first build


@pytest.fixture
def fresh(tmp_path):
	"""setup.sh in an empty house, with a cmake that makes ten steps."""
	(tmp_path / "scripts").mkdir(), (tmp_path / "bin").mkdir()
	for name in ("setup.sh", "install.sh"):
		shutil.copy(house / "scripts" / name, tmp_path / "scripts")
	steps = "for i in 1 2 3 4 5 6 7 8 9 10; do echo \"[$i/10] Building $i\"; done"
	for name, text in {
		"dpkg-query": 'case "$*" in *absent*) ;; *) printf installed ;; esac', "ninja": "true",
		"cmake": f'case "$1" in -S) touch build/build.ninja; echo -- Configuring ;; '
		f'--build) test ! -f fail || {{ echo "error: no such type"; exit 1; }}; '
		f'test ! -f nothing || {{ echo "[2/2] Re-checking globbed directories..."; exit; }}; '
		f'{steps}; touch build/libyadeblocks.so ;; esac', "apt-get": 'echo "apt-get $*" >> apt'
	}.items():
		(tmp_path / "bin" / name).write_text("#!/bin/sh\n" + text + "\n")
		(tmp_path / "bin" / name).chmod(0o755)
	return lambda *words: called(tmp_path / "scripts/setup.sh", *words, env={"PATH": f"{tmp_path / 'bin'}:{os.environ['PATH']}"}, cwd=tmp_path)


def test_firstBuildSaysWhatItDoes(fresh, tmp_path):
	run = fresh("--brief")
	assert run.returncode == 0 and run.stdout == ""
	assert run.stderr.splitlines() == [
		"yade-blocks: first build: looking for compiler and libraries",
		"yade-blocks: building the plugin in build/ (the first time takes some minutes)",
		*(f"yade-blocks: {done} of 10 steps done" for done in (2, 4, 6, 8, 10))
	]
	(tmp_path / "nothing").touch()
	again = fresh("--brief")
	assert (again.returncode, again.stdout, again.stderr) == (0, "", "")
	(tmp_path / "nothing").unlink()
	assert "[10/10] Building 10" in fresh().stdout # in full


def test_progressComesWhileItBuilds(fresh, tmp_path):
	"""Not at the end: a build that waits for our answer to its third step gets it."""
	steps = 'echo "[1/5] Building a"; echo "[2/5] Building b"; for i in 1 2 3 4 5 6 7 8 9 10; do test -f seen && break; sleep 0.1; done; test -f seen'
	(tmp_path / "bin/cmake").write_text(f"#!/bin/sh\ncase \"$1\" in --build) {steps} ;; *) touch build/build.ninja ;; esac\n")
	environment = {**os.environ, "PATH": f"{tmp_path / 'bin'}:{os.environ['PATH']}"}
	run = subprocess.Popen([tmp_path / "scripts/setup.sh", "--brief"], stderr=subprocess.PIPE, text=True, env=environment, cwd=tmp_path)
	for line in run.stderr:
		if "2 of 5 steps" in line: (tmp_path / "seen").touch()
	assert run.wait() == 0


def test_buildThatGoesOnSaysSo(fresh, tmp_path):
	"""One that was broken off, before its first step is done: that may be half a minute."""
	(tmp_path / "build").mkdir()
	(tmp_path / "build/build.ninja").touch()
	(tmp_path / "nothing").touch()
	assert fresh("--brief").stderr == "yade-blocks: building the plugin in build/ (the first time takes some minutes)\n"


def test_buildThatFailsShowsWhy(fresh, tmp_path):
	(tmp_path / "fail").touch()
	run = fresh("--brief")
	assert run.returncode == 1 and run.stderr.endswith("error: no such type\n")


def test_onlyMissingPackagesAreInstalled(fresh, tmp_path):
	assert fresh("--brief", "present").returncode == 0 and not (tmp_path / "apt").exists()
	run = fresh("--brief", "present", "absent1", "absent2")
	assert run.stderr.splitlines()[0] == "yade-blocks: installing 2 Debian packages: absent1 absent2"
	if os.getuid() == 0: assert (tmp_path / "apt").read_text().splitlines()[-1].endswith(" absent1 absent2")


def test_unknownOptionOfSetup(fresh):
	assert fresh("--breif").returncode == 2
