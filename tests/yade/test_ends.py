# yade-blocks, GPL-2.0-or-later
"""How runs end: interrupted, killed, with an error, without room on the disk. What was done is there, and what was not goes on.

	KILLS=100 ctest --test-dir build -R yade.test_ends     kills a run so many times (without: five times)
"""
import json
import random
import shutil
import signal
import time
from pathlib import Path

import pytest

from scenes import *

scripts = Path(differences.__code__.co_filename).parents[2] / 'scripts'
quick = { # some seconds each, with cracks
	'tension': ['case=TT3', 'alpha=0.3', 'steps=100000', 'seeds=2', 'vtk=false'],
	'shear': ['size=7e-3', 'steps=4000', 'vtk=false'],
	'compression': ['width=0.1', 'unitSize=0.02', 'mortarSize=0.006', 'steps=4000', 'vtk=false']
}
kills = int(os.environ.get('KILLS', 5))


class Process:
	"""A scenario that is running in a folder."""
	def __init__(self, folder, name, *words):
		environment = {**os.environ, 'OMP_WAIT_POLICY': 'passive'}
		environment.pop('OMP_NUM_THREADS', None)
		script = name if str(name).endswith('.py') else scripts / (name + '.py')
		self.start, self.log = time.monotonic(), open(Path(folder) / 'log', 'w+')
		command = ['yade', '-n', '-x', '-j1', str(script), *words]
		self.popen = subprocess.Popen(command, cwd=folder, env=environment, stdout=self.log, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)

	def wait(self):
		"""Exit code, and what it said."""
		code = self.popen.wait(600)
		self.log.seek(0)
		return code, self.log.read()

	def until(self, condition):
		"""Waits until something is so; False if the process has ended before."""
		while not condition():
			if self.popen.poll() is not None: return False
			time.sleep(0.01)
		return True


def result(folder, name):
	return json.loads((Path(folder) / 'out' / name / 'result.json').read_text())


def withoutCost(found):
	return {key: value for key, value in found.items() if key != 'cost'}


# ---- interrupts


@pytest.mark.parametrize('number, code', [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_anInterruptActsDuringTheLoading(number, code, tmp_path):
	process = Process(tmp_path, 'tension', 'case=TT3', 'steps=2000000', 'seeds=2', 'vtk=false')
	assert process.until(lambda: (tmp_path / 'out/tension').exists())
	time.sleep(3) # it is loading
	process.popen.send_signal(number)
	asked = time.monotonic()
	found, text = process.wait()
	assert found == code, text
	last = text.strip().splitlines()[-1]
	assert last == 'tension: %s: no seed was done' % signal.Signals(number).name and 'Traceback' not in text
	assert time.monotonic() - asked < 1 + 5 * os.getloadavg()[0] / os.cpu_count() # a second, on a machine that does nothing else
	rows = (tmp_path / 'out/tension/unfinished.csv').read_text().splitlines()
	assert rows[0] == 'displacement,stress,broken,unbalanced' and len(rows) > 2


def test_whatIsDoneIsThere(tmp_path):
	"""Interrupted in the second seed: the first one's results are on the disk, as they were all the time, and say that they are not all."""
	process = Process(tmp_path, 'tension', 'case=TT3', 'alpha=0.3', 'steps=100000', 'seeds=3', 'vtk=false')
	assert process.until((tmp_path / 'out/tension/curve.csv').exists)
	early = result(tmp_path, 'tension') # whole as soon as it is there
	process.popen.send_signal(signal.SIGINT)
	code, text = process.wait()
	assert code == 130 and 'tension: SIGINT: results of seed 1 are in out/tension' in text, text
	found = result(tmp_path, 'tension')
	assert found['complete'] is False and early['complete'] is False and found['quantities'] == early['quantities']
	assert {row.split(',')[0] for row in (tmp_path / 'out/tension/curve.csv').read_text().splitlines()} == {'seed', '1'}
	assert (tmp_path / 'out/tension/cracks.png').exists()


scenario = """
import yadeblocks
from yade import *
from yadeblocks import scenario, running, recording
from yadeblocks.session import Session
import os, pathlib, shutil
p = scenario.parameters({**scenario.commonParameters(), 'fail': 'no'}, {'fail': ('no', 'build', 'reading', 'step', 'delete', 'extra')})
def read():
	if p.fail == 'reading' and seed == 2 and O.iter > 5: raise KeyError('the reading')
	return O.iter
with Session(p) as session:
	for seed in p.seedList:
		with session.run(seed) as run:
			if p.fail == 'build' and seed == 2: raise ValueError('the second one cannot be built')
			O.reset()
			O.engines = [recording.Recorder(step=read).engine()] + [BlockForces()] * (p.fail == 'step' and seed == 2)
			running.run(20)
			run.add('seed', '1', seed)
			run.curve(step=[1, 2], stress_MPa=[1, 0])
		if p.fail == 'extra': session.later(lambda: open('/nowhere/file', 'w'))
		if p.fail == 'delete': shutil.rmtree(p.folder)
	session.write()
"""


def made(folder, *words):
	(folder / 'mine.py').write_text(scenario)
	return Process(folder, folder / 'mine.py', *words).wait()


@pytest.mark.parametrize('fail, said', [('build', 'the second one cannot be built'), ('reading', 'the reading'), ('step', 'no blocks in the scene')])
def test_anErrorInTheSecondSeed(fail, said, tmp_path):
	code, text = made(tmp_path, 'seeds=3', 'fail=' + fail)
	assert code == 1 and said in text and 'mine: results of seed 1 are in out/mine' in text, text
	found = result(tmp_path, 'mine')
	assert found['complete'] is False and [q['measured'] for q in found['quantities']] == [1]


def test_toItsEnd(tmp_path):
	code, text = made(tmp_path, 'seeds=3')
	assert code == 0 and result(tmp_path, 'mine')['complete'] is True, text
	assert sorted(os.listdir(tmp_path / 'out/mine')) == ['curve.csv', 'result.json']


# ---- folders and disks


def test_theFolderIsDeletedInTheMiddle(tmp_path):
	code, text = made(tmp_path, 'seeds=3', 'fail=delete')
	assert code == 0 and result(tmp_path, 'mine')['complete'] is True and (tmp_path / 'out/mine/curve.csv').exists(), text


def test_aPictureThatCannotBeWritten(tmp_path):
	code, text = made(tmp_path, 'fail=extra')
	assert code == 1 and 'mine: cannot write /nowhere/file: No such file or directory' in text and 'Traceback' not in text, text
	assert result(tmp_path, 'mine')['complete'] is True


def test_outIsAFile(tmp_path):
	(tmp_path / 'out').write_text('')
	code, text = made(tmp_path)
	assert code == 2 and text.strip().splitlines()[-1] == 'mine: out is no folder' and 'Traceback' not in text


def test_outIsALinkWithinOut(tmp_path):
	(tmp_path / 'out').mkdir()
	(tmp_path / 'theirs').mkdir()
	(tmp_path / 'theirs/result.json').write_text('precious')
	(tmp_path / 'out/mine').symlink_to(tmp_path / 'theirs')
	code, text = made(tmp_path)
	assert code == 2 and 'out/mine is a symbolic link' in text.strip().splitlines()[-1] and (tmp_path / 'theirs/result.json').read_text() == 'precious'


@pytest.fixture
def mounted(tmp_path):
	"""Mounts a disk as out/."""
	(tmp_path / 'out').mkdir()

	def mount(options):
		if subprocess.run(['mount', '-t', 'tmpfs', '-o', options, 'tmpfs', tmp_path / 'out'], capture_output=True).returncode: pytest.skip('no right to mount a disk')
		mount.done = True

	mount.done = False
	yield mount
	if mount.done: subprocess.run(['umount', tmp_path / 'out'], check=True)


def test_outCannotBeWrittenTo(tmp_path, mounted):
	mounted('ro')
	code, text = made(tmp_path)
	assert code == 2 and text.strip().splitlines()[-1] == 'mine: out/mine cannot be written to: Read-only file system'


def test_littleRoomOnTheDisk(tmp_path, mounted):
	"""64 kB: the results are small and come first; pictures have no room, which is said."""
	mounted('size=64k')
	code, text = Process(tmp_path, 'tension', 'case=TT3', 'alpha=0.3', 'steps=3000', 'seeds=2').wait()
	assert code == 1 and 'Traceback' not in text, text
	assert 'No space left on device' in text.strip().splitlines()[-1]
	assert result(tmp_path, 'tension')['complete'] is True and not [name for name in os.listdir(tmp_path / 'out/tension') if name.endswith('.part')]
	assert {row.split(',')[0] for row in (tmp_path / 'out/tension/curve.csv').read_text().splitlines()} == {'seed', '1', '2'}


# ---- checkpoints


@pytest.mark.parametrize('name', list(quick))
def test_killedAndResumed(name, tmp_path):
	"""Killed at random moments, again and again; each time resume=true goes on. In the end nothing but the cost tells it from the run that was left alone."""
	whole, torn, dice = tmp_path / 'whole', tmp_path / 'torn', random.Random(1)
	whole.mkdir(), torn.mkdir()
	process = Process(whole, name, *quick[name])
	assert process.until(lambda: (whole / 'out').exists())
	begun = time.monotonic()
	code, text = process.wait()
	assert code == 0, text
	lasting, expected = time.monotonic() - begun, result(whole, name)

	share = list(quick).index(name)
	for _ in range(kills * (share + 1) // len(quick) - kills * share // len(quick)): # five are 1, 2 and 2
		process = Process(torn, name, *quick[name], 'checkpoint=0.2', 'resume=true')
		assert process.until(lambda: (torn / 'out').exists())
		time.sleep(dice.uniform(0.1, 0.7) * lasting)
		process.popen.kill()
		assert process.wait()[0] == -signal.SIGKILL
	checkpoints = list((torn / 'out' / name / 'checkpoint').glob('0*'))
	assert 0 < len(checkpoints) <= 2
	code, text = Process(torn, name, *quick[name], 'checkpoint=0.2', 'resume=true').wait()
	assert code == 0 and name + ': goes on ' in text, text
	found = result(torn, name)
	assert withoutCost(found) == withoutCost(expected) and found['cost']['steps'] == expected['cost']['steps']
	assert (torn / 'out' / name / 'curve.csv').read_text() == (whole / 'out' / name / 'curve.csv').read_text()
	assert found['cost']['cpu_s'] > 0.5 * expected['cost']['cpu_s'] # adds up; machines run unevenly
	assert not (torn / 'out' / name / 'checkpoint').exists() and (torn / 'out' / name / 'cracks.png').exists()


def test_resumedWithTheServoAndAtHalfTheRate(tmp_path):
	"""Interrupted in the second loading of a seed: what the first one gave is kept."""
	words = ['case=TT3', 'steps=20000', 'servo=true', 'halfRate=true', 'jump=false', 'vtk=false', 'damping=local']
	whole, torn = tmp_path / 'whole', tmp_path / 'torn'
	whole.mkdir(), torn.mkdir()
	assert Process(whole, 'tension', *words).wait()[0] == 0
	process = Process(torn, 'tension', *words, 'checkpoint=0.1')
	checkpoint = lambda: sorted((torn / 'out/tension/checkpoint').glob('0*'))

	def atHalfTheRate():
		try: return json.loads((checkpoint()[-1] / 'state.json').read_text())['state']['stage']['label'] == 'seed 1, half rate'
		except (IndexError, OSError, KeyError): return False

	assert process.until(atHalfTheRate)
	process.popen.send_signal(signal.SIGTERM)
	code, text = process.wait()
	assert code == 143 and 'results of seed 1 are in out/tension, resume=true goes on' in text, text
	refused, text = Process(torn, 'tension', *words[:-1], 'damping=adaptive', 'resume=true').wait()
	assert refused == 2 and 'resume=true goes on with the same code and keys only' in text
	code, text = Process(torn, 'tension', *words, 'resume=true').wait()
	assert code == 0 and 'tension: goes on in seed 1, half rate' in text, text
	assert withoutCost(result(torn, 'tension')) == withoutCost(result(whole, 'tension'))
	code, text = Process(torn, 'tension', *words, 'resume=true').wait()
	assert code == 0 and 'out/tension is complete: there is nothing to go on with' in text


def test_resumedWithOtherCode(tmp_path):
	(tmp_path / 'scripts').mkdir()
	script = tmp_path / 'scripts/tension.py'
	shutil.copy(scripts / 'tension.py', script)
	words = ['case=TT3', 'steps=1000000', 'vtk=false']
	process = Process(tmp_path, script, *words, 'checkpoint=0.2')
	assert process.until(lambda: list((tmp_path / 'out/tension/checkpoint').glob('0*/scene.yade')))
	process.popen.kill()
	process.wait()
	script.write_text(script.read_text() + '# other code\n')
	code, text = Process(tmp_path, script, *words, 'resume=true').wait()
	assert code == 2 and text.strip().splitlines()[-1].endswith('the checkpoint has other ones: code'), text
