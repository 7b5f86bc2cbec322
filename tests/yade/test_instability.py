# yade-blocks, GPL-2.0-or-later
"""A run that turns unstable stops, says when and where, and leaves its last good state."""
import re

import pytest

from scenes import *


def unstable(run):
	"""The message of an unstable run, its step and block."""
	with pytest.raises(RuntimeError) as caught:
		run()
	text = str(caught.value)
	found = re.search(r'unstable at step (\d+), block (\d+): ', text)
	assert found, text
	return text, int(found.group(1)), int(found.group(2))


def test_notANumber(tmp_path):
	file = str(tmp_path / 'rescue.yade.bz2')
	m = couplet(rescueFile=file, watchPeriod=50)
	O.run(720, True)
	good = couplet(rescueFile='', watchPeriod=50)
	O.run(700, True)
	expected = state(good)
	m = couplet(rescueFile=file, watchPeriod=50)
	O.run(720, True)
	m.velocity[m.firstNode[4] + 1] = float('nan')
	text, step, block = unstable(lambda: O.run(500, True))
	assert step == 750 and block <= 12 and 'not a number' in text and 'step 700' in text and file in text
	assert O.iter == 700 and O.time == pytest.approx(700 * O.dt, rel=1e-12)

	# put back in memory, and saved: both go on as if nothing had been
	O.run(100, True)
	here = state(m)
	O.load(file)
	assert O.iter == 700 and np.array_equal(model().position, expected['position']) and np.array_equal(model().velocity, expected['velocity'])
	O.run(100, True)
	couplet(watchPeriod=50)
	O.run(800, True)
	whole = state(m := model())
	for name in 'position', 'velocity', 'pointSigma', 'pointStatus': # elastic so far: all laws are functions of the positions
		assert here[name].tobytes() == whole[name].tobytes(), name


@pytest.mark.parametrize('watchPeriod', [1, 10])
@pytest.mark.parametrize('damping', ['none', 'local'])
def test_restIsStable(watchPeriod, damping):
	"""Neither rounding, which doubles from look to look at first, nor a motion that sets in, however little energy there is to compare with."""
	materials()
	m = column(heights=(0.2, 0.2, 0.2))
	m.drive('later', nodesWhere(m, lambda x, y: y < 1e-9), 'y', velocity=1e-3, startTime=0.05, rampTime=0.1)
	m.insert()
	O.dt, O.engines = 1e-3, engines(strong(), watchPeriod=watchPeriod, damping=damping)
	O.run(300, True)
	assert O.iter == 300


def test_theBlockIsNamed():
	materials()
	m = column(heights=(0.2, 0.2, 0.2))
	m.gravity((0, -9.81))
	m.insert()
	O.dt, O.engines = 1e-3, engines(strong(), watchPeriod=1)
	O.run(10, True)
	m.velocity[m.firstNode[1] + 2, 0] = float('inf')
	text, step, block = unstable(lambda: O.run(10, True))
	assert (step, block) in ((10, 1), (11, 1)) and O.iter in (9, 10)


def test_zonesInsideOut(tmp_path):
	"""Grid points thrown at each other, without damping: zones turn inside out."""
	file = str(tmp_path / 'rescue.yade')
	materials()
	m = column(heights=(0.3, 0.5))
	m.drive('low', nodesWhere(m, lambda x, y: y < 1e-9), 'xy')
	m.gravity((0, -9.81))
	m.insert()
	O.dt, O.engines = 1e-3, engines(strong(), damping='none', rescueFile=file)
	O.run(150, True)
	m.velocity[:] += 100 * np.random.default_rng(1).normal(size=m.velocity.shape)
	text, step, block = unstable(lambda: O.run(3000, True))
	assert 200 <= step <= 1000 and step % 100 == 0 and block in (0, 1) and 'a zone has turned inside out' in text
	assert 'step 100,' in text and file in text and O.iter == 100 # the last look before that

	def goesOn():
		O.engines[3].damping = 'local'
		O.run(3000, True)
		weight = 9.81 * model().mass.sum()
		assert model().groupForce('low', axis='y') == pytest.approx(
			weight, rel=1e-4
		) # at rest after 3000 steps; forces of 1e2 N from openings of 1e-9 +- 1e-16 m

	goesOn() # as it was put back
	O.load(file)
	assert O.iter == 100 and abs(model().velocity).max() < 1e-3
	goesOn()


def test_stableRunsAreLeftAlone():
	"""What a script does to a run is no instability: a kick, a sudden load, a brittle crash, a released group."""
	m = couplet(damping='none', watchPeriod=10)
	O.run(1000, True)
	m.velocity[:, 0] += 1e-4 # a kick
	O.run(500, True)
	m.setTarget('top', 5e-5)
	O.run(500, True)
	m.release('top')
	O.run(500, True)
	m.gravity((0, -9.81))
	O.run(500, True)
	assert np.isfinite(m.position).all() and np.count_nonzero(m.pointStatus) > 0


def test_instabilityBeforeTheFirstLook(tmp_path):
	"""Loaded at a step between two looks: there is a good state all the same."""
	couplet()
	O.run(150, True)
	O.save(str(tmp_path / 'a.yade'))
	O.load(str(tmp_path / 'a.yade'))
	m = model()
	O.run(1, True)
	m.velocity[3] = float('nan')
	text, step, block = unstable(lambda: O.run(100, True))
	assert step == 200 and O.iter in (150, 151) and np.isfinite(m.velocity).all()


def test_watchOff():
	m = couplet(watchPeriod=0)
	O.run(10, True)
	m.velocity[3] = float('nan')
	O.run(300, True)
	assert O.iter == 310 and not np.isfinite(m.velocity).all()
