# yade-blocks, GPL-2.0-or-later
"""Runs that were killed or interrupted go on where the last checkpoint was, with the same bits.

	KILLS=100 ctest --test-dir build -R yade.test_resume     kills a run so many times (without: five times)
"""
import random
import shutil
import signal
import threading

import pytest

from processes import *
from yadeblocks import recording, running

quick = { # some seconds each, with cracks
	'tension': ['case=TT3', 'alpha=0.3', 'steps=800000', 'seeds=2', 'vtk=false'],
	'shear': ['size=7e-3', 'steps=60000', 'vtk=false'],
	'compression': ['width=0.1', 'unitSize=0.02', 'mortarSize=0.006', 'steps=120000', 'vtk=false']
}
kills = int(os.environ.get('KILLS', 5))


def test_aPauseIsBetweenTwoSteps():
	"""A run rests with whole steps only, also where a step is much longer than the 40 ms in which O.run looks whether it has ended."""
	O.reset()
	begun, done, paused = [], [], []
	slow = lambda: begun.append(O.iter) or time.sleep(0.08) # lets go of the interpreter, as engines do
	O.engines = [recording.runner('slow', slow), recording.runner('done', lambda: done.append(O.iter))]
	running.run(12, pause=lambda: done and paused.append((begun[-1], done[-1], O.iter)), every=0.13)
	assert len(paused) >= 3 and all(begun == done == now - 1 for begun, done, now in paused), paused
	assert begun == done == list(range(1, 12)) and O.iter == 12 # a PyRunner leaves out the first step


def test_anEndIsNotForgottenForAPause():
	"""Pauses as often as possible in a run of very many steps: it stops at the step that asked for it, also if a pause was being asked for just then."""
	for wanted in range(100, 120, 2):
		O.reset()
		paused = []
		O.engines = [recording.runner('end', lambda: O.iter == wanted and running.end())]
		running.run(pause=lambda: paused.append(O.iter), every=0.001)
		assert O.iter == wanted + 1 and paused == sorted(set(paused)) and all(0 < now <= wanted for now in paused)


def test_aPauseThatComesTooLateIsAskedForAgain():
	O.reset()
	O.engines, paused = [], []
	running.run(3000000, pause=lambda: paused.append(O.iter), every=0.2)
	assert paused and O.iter == 3000000


@pytest.mark.parametrize('begins', [True, False])
def test_anInterruptWhileTheRunStarts(begins, monkeypatch):
	"""An interrupt may come in before the thread of the run begins, or just behind. When it is passed on, nothing runs any more, nor begins later."""
	O.reset()
	O.engines, waiting, start = [], [], threading.Thread.start

	def interrupted(thread):
		start(thread) if begins else waiting.append(thread)
		while begins and O.iter < 100:
			time.sleep(0.001)
		raise running.Interrupted(signal.SIGINT)

	with monkeypatch.context() as patch:
		patch.setattr(threading.Thread, 'start', interrupted)
		with pytest.raises(running.Interrupted):
			running.run(100000000)
	for thread in waiting:
		start(thread)
		thread.join(10)
	steps = O.iter
	assert not O.running and (steps >= 100) == begins
	time.sleep(0.05)
	assert O.iter == steps


@pytest.mark.parametrize('name', list(quick))
def test_killedAndResumed(name, tmp_path):
	"""Killed at random moments again and again; each time resume=true goes on. In the end nothing but the cost tells it from the run left alone."""
	whole, torn, dice = tmp_path / 'whole', tmp_path / 'torn', random.Random(1)
	whole.mkdir(), torn.mkdir()
	code, text = Process(whole, name, *quick[name]).wait()
	assert code == 0, text
	expected, killed = result(whole, name), 0
	seen = lambda: {path.name for path in (torn / 'out' / name / 'checkpoint').glob('0*') if (path / 'scene.yade').exists()}

	share = list(quick).index(name)
	for _ in range(kills * (share + 1) // len(quick) - kills * share // len(quick)): # five are 1, 2 and 2
		process = Process(torn, name, *quick[name], 'checkpoint=0.2', 'resume=true')
		before = seen()
		process.until(lambda: seen() - before or process.popen.poll() is not None) # else it would start from nothing each time
		time.sleep(dice.uniform(0, 0.3))
		process.popen.kill()
		if process.wait()[0] != -signal.SIGKILL: break # it came to its end before
		killed += 1
	assert killed > 0, 'the run is too short to be killed'
	if process.popen.returncode == -signal.SIGKILL:
		assert 0 < len(seen()) <= 3 # the third: killed before the oldest went
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
		try:
			return json.loads((checkpoint()[-1] / 'state.json').read_text())['state']['stage']['label'] == 'seed 1, half rate'
		except (IndexError, OSError, KeyError):
			return False

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
