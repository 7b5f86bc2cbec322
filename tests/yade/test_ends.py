# yade-blocks, GPL-2.0-or-later
"""How runs end: interrupted, with an error, without room on the disk. What was done is there."""
import signal

import pytest

from processes import *

# ---- interrupts


@pytest.mark.parametrize('number, code', [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_anInterruptActsDuringTheLoading(number, code, tmp_path):
	process = Process(tmp_path, 'tension', 'case=TT3', 'steps=20000000', 'seeds=2', 'vtk=false')
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
	assert rows[0] == 'displacement,stress,broken,yielded,unbalanced' and len(rows) > 2


def test_whatIsDoneIsThere(tmp_path):
	"""Interrupted in the second seed: the first one's results are on the disk, as they were all the time, and say that they are not all."""
	process = Process(tmp_path, 'tension', 'case=TT3', 'alpha=0.3', 'steps=1000000', 'seeds=3', 'vtk=false')
	assert process.until((tmp_path / 'out/tension/curve.csv').exists)
	early = result(tmp_path, 'tension') # whole as soon as it is there
	process.popen.send_signal(signal.SIGINT)
	code, text = process.wait()
	assert code == 130 and 'tension: SIGINT: results of seed 1 are in out/tension' in text, text
	found = result(tmp_path, 'tension')
	assert found['complete'] is False and early['complete'] is False and found['quantities'] == early['quantities']
	assert {row.split(',')[0] for row in (tmp_path / 'out/tension/curve.csv').read_text().splitlines()} == {'seed', '1'}


scenario = """
import yadeblocks
from yade import *
from yadeblocks import files, scenario, running, recording
from yadeblocks.session import Session
import os, shutil, signal
p = scenario.parameters({**scenario.commonParameters(), 'fail': 'no'}, {'fail': ('no', 'build', 'reading', 'step', 'delete', 'extra', 'interrupt')})
def read():
	if p.fail == 'interrupt' and seed == 2 and O.iter == 5: os.kill(os.getpid(), signal.SIGTERM)
	if p.fail == 'reading' and seed == 2 and O.iter > 5: raise KeyError('the reading')
	return O.iter
with Session(p) as session:
	for seed in p.seedList:
		with session.run(seed) as run:
			if p.fail == 'build' and seed == 2: raise ValueError('the second one cannot be built')
			O.reset()
			O.engines = [recording.Recorder(step=read).engine()] + [BlockForces()] * (p.fail == 'step' and seed == 2)
			running.run(10000000 if p.fail == 'interrupt' and seed == 2 else 20)
			run.add('seed', '1', seed)
			run.curve(step=[1, 2], stress_MPa=[1, 0])
		session.later(files.replace, p.folder / 'picture.png', 'a picture')
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


def test_interruptedInTheSecondSeed(tmp_path):
	"""What pictures there are get written, behind the results."""
	code, text = made(tmp_path, 'seeds=3', 'fail=interrupt')
	assert code == 143 and text.strip().splitlines()[-1] == 'mine: SIGTERM: results of seed 1 are in out/mine', text
	assert result(tmp_path, 'mine')['complete'] is False and sorted(os.listdir(tmp_path / 'out/mine')) == ['curve.csv', 'picture.png', 'result.json']


def test_toItsEnd(tmp_path):
	code, text = made(tmp_path, 'seeds=3')
	assert code == 0 and result(tmp_path, 'mine')['complete'] is True, text
	assert sorted(os.listdir(tmp_path / 'out/mine')) == ['curve.csv', 'picture.png', 'result.json']


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


# ---- keys


def test_everyKeyOfMaterialsActs(tmp_path):
	"""Stiffer joints and mortar stiffen the layer, soft bricks do not stiffen it; strengths raise first crack and peak."""
	def measured(*words):
		folder = tmp_path / '-'.join(words or ['as-it-is'])
		folder.mkdir()
		code, text = Process(folder, 'tension', 'case=TT3', 'solver=events', 'vtk=false', 'sheets=false', *words).wait()
		assert code == 0, text
		return {q['name']: q['measured'] for q in result(folder, 'tension')['quantities']}

	stiffness, first, peak = 'joint_stiffness', 'first_crack_stress', 'peak_tensile_stress'
	usual = measured()
	for words in ['kn=800e9'], ['mortarYoung=6e9']:
		assert measured(*words)[stiffness] > 1.1 * usual[stiffness], words
	soft = measured('unitYoung=8e9')
	assert soft[stiffness] < 1.01 * usual[stiffness] and soft[first] != usual[first]
	weak = measured('cohesion=0.25e6') # shear comes first, and under tension friction weakens it
	assert weak[first] < usual[first] and measured('cohesion=0.25e6', 'friction=5', 'dilation=0')[first] > 1.01 * weak[first]
	assert measured('ks=300e9')[first] != usual[first]
	strong = measured('tension=0.9e6', 'cohesion=0.9e6')
	assert strong[first] == pytest.approx(1.5 * usual[first], rel=1e-6) and strong[peak] > 1.3 * usual[peak]
