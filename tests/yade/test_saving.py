# yade-blocks, GPL-2.0-or-later
"""O.save, O.load and O.switchScene: a run that was interrupted goes on with the same bits."""
import pytest

from scenes import *
from yadeblocks import recording


def broken(model):
	return np.count_nonzero(model.pointStatus)


@pytest.mark.parametrize('ending', ['.xml', '.yade', '.yade.bz2'])
@pytest.mark.parametrize('damping, trackEnergy', [('local', False), ('adaptive', True)])
def test_aSavedRunContinuesWithTheSameBits(ending, damping, trackEnergy, tmp_path):
	whole = couplet(damping=damping, trackEnergy=trackEnergy)
	O.run(1200, True)
	while broken(whole) < 3:
		O.run(20, True)
	steps, before = O.iter, broken(whole)
	O.run(400, True)
	expected = state(whole)

	couplet(damping=damping, trackEnergy=trackEnergy)
	O.run(steps, True)
	file = str(tmp_path / ('half' + ending))
	O.save(file)
	O.reset()
	O.load(file)
	assert before == broken(model()) < broken(whole) and O.iter == steps
	O.run(400, True)
	assert O.iter == steps + 400 and differences(state(model()), expected) == []
	assert len(expected['energy']) == (8 if trackEnergy else 0)


def test_savedBeforeTheFirstStep(tmp_path):
	whole = couplet()
	O.save(str(tmp_path / 'start.yade'))
	O.run(300, True)
	expected = state(whole)
	O.load(str(tmp_path / 'start.yade'))
	O.run(300, True)
	assert differences(state(model()), expected) == []


def keeper(folder):
	"""A PyRunner that saves step 50."""
	return recording.runner('keep', lambda: O.iter == 50 and O.save(str(folder / 'kept.yade')))


def test_savedByAPyRunner(tmp_path):
	"""Within a step, behind its motion: loaded it goes on with the same bits. (It moved once more than the one that was saved.)"""
	whole = couplet(trackEnergy=True)
	O.engines += [keeper(tmp_path)]
	O.run(120, True)
	expected = state(whole)
	O.load(str(tmp_path / 'kept.yade'))
	at, when = O.iter, O.time
	O.run(120 - at, True)
	assert differences(state(model()), expected) == []
	assert at == 51 and when == pytest.approx(51 * O.dt, rel=1e-12)


@pytest.mark.parametrize('place', [0, -1])
def test_savedByAPyRunnerBeforeTheMotion(place, tmp_path):
	"""First of all: the step is done again. Between forces and motion there is no way to go on."""
	whole = couplet()
	engines = O.engines
	engines.insert(place, keeper(tmp_path))
	O.engines = engines
	if place < 0:
		with pytest.raises(RuntimeError): # YADE's own, of the command; it shows what was wrong
			O.run(100, True)
		with pytest.raises(RuntimeError, match='O.save between the forces and the motion'):
			O.save(str(tmp_path / 'kept.yade')) # the step has not ended
		assert os.listdir(tmp_path) == []
		return
	O.run(100, True)
	expected = state(whole)
	recording.known('keep', lambda: None)
	O.load(str(tmp_path / 'kept.yade'))
	assert O.iter == 50
	O.run(100 - O.iter, True)
	assert differences(state(model()), expected) == []


def test_savedInMemory():
	whole = couplet()
	O.run(100, True)
	O.saveTmp('here')
	O.run(100, True)
	expected = state(whole)
	O.loadTmp('here')
	O.run(100, True)
	assert differences(state(model()), expected) == []


def test_runsInPieces():
	whole = couplet()
	O.run(370, True)
	expected = state(whole)
	pieces = couplet()
	for steps in 1, 99, 250:
		O.run(steps, True)
	for _ in range(20):
		O.step()
	assert differences(state(pieces), expected) == []


def test_theModelIsSavedOnce(tmp_path):
	couplet()
	O.run(1, True)
	sizes = []
	for name in 'first.xml', 'second.xml':
		O.save(str(tmp_path / name))
		text = (tmp_path / name).read_text()
		assert text.count('<reference>') + text.count('<reference ') == 1
		sizes.append(len(text))
		O.load(str(tmp_path / name))
	assert sizes[1] == sizes[0]
	assert all(b.shape.model is not None for b in O.bodies)
	# one model, not a copy for every block: what one block shows changes with what another writes
	O.bodies[0].shape.model.displacement[0] = (7, 8)
	assert tuple(O.bodies[len(O.bodies) - 1].shape.model.displacement[0]) == (7, 8)
	assert all(tuple(i.geom.model.displacement[0]) == tuple(i.phys.model.displacement[0]) == (7, 8) for i in O.interactions)


def test_loadedPropertiesAreThoseSaved(tmp_path):
	couplet()
	O.run(1, True)
	i = O.interactions[0, 1] if O.interactions.has(0, 1) else next(iter(O.interactions))
	ids = i.id1, i.id2
	i.phys.tension, i.phys.kn = 0.25e6, 123e9
	O.save(str(tmp_path / 'a.yade'))
	O.load(str(tmp_path / 'a.yade'))
	phys = O.interactions[ids].phys
	assert (phys.tension, phys.kn, phys.ks) == (0.25e6, 123e9, 200e9)
	assert list(model().materialLabels) == ['mortar', 'unit'] and model().groups == ['bottom', 'top'] and model().thickness == 0.05
	joints = O.engines[0].physDispatcher.functors[0].joints
	assert [(j.material1, j.material2, j.kn) for j in joints] == [(a, b, 400e9) for a, b in (('unit', 'unit'), ('unit', 'mortar'), ('mortar', 'mortar'))]


def test_anotherSceneDoesNotDisturb():
	alone = couplet()
	O.run(900, True)
	expected = state(alone)

	first = couplet()
	O.run(400, True)
	O.switchScene()
	materials(reset=False)
	other = column(labels=['mortar', 'unit'])
	other.drive('bottom', nodesWhere(other, lambda x, y: y < 1e-9), 'xy')
	other.gravity((0, -9.81))
	other.insert()
	O.dt = 1e-3
	O.engines = engines(strong())
	O.run(300, True)
	assert len(O.bodies) == 2 and O.iter == 300 and abs(other.velocity).max() > 0
	O.switchScene()
	assert O.iter == 400
	O.run(500, True)
	assert differences(state(first), expected) == []
	O.switchScene()
	O.run(100, True)
	assert O.iter == 400
	O.reset()
	O.switchScene()


def test_enginesServeOneSceneAfterTheOther():
	"""A script that loops over seeds may make its engines once."""
	def run(list):
		materials()
		O.trackEnergy = True
		m = column()
		m.drive('bottom', nodesWhere(m, lambda x, y: y < 1e-9), 'xy')
		m.gravity((0, -9.81))
		m.insert()
		O.dt = 1e-3
		O.engines = list
		O.run(250, True)
		return state(m)

	expected = run(engines(strong(), damping='adaptive'))
	kept = engines(strong(), damping='adaptive')
	for _ in range(4):
		assert differences(run(kept), expected) == []
