# yade-blocks, GPL-2.0-or-later
"""Names of sets of joints: kept in the model and its files, and what goes by them: parameters, crack tables, results, pictures, ParaView."""
import re

import matplotlib.image
import pytest

import scenes
from scenes import *
from yadeblocks import brickwork, export, layout, pictures, picturesfields, results, snapshot

wallJoint = dict(material1='unit', material2='unit', kn=82e9, ks=36e9, cohesion=0.35e6, tension=0.25e6, frictionAngle=0.6)


def wall():
	"""Two bricks by three courses with cracks in mid-brick, pulled apart; bed, head and unit."""
	materials()
	model = BlockModel(thickness=0.1)
	placed = brickwork.runningBond(bricks=2, courses=3, length=0.2, height=0.1, crack=True).addTo(model, 'unit', zoneSize=0.05)
	joints = placed.bond(model, [JointMat(**wallJoint)], head=dict(tension=1e3, cohesion=2e3), unit=dict(kn=1e12, tension=1e15, cohesion=1e15))
	x = np.asarray(model.reference)[:, 0]
	model.drive('left', np.flatnonzero(x < 1e-9), 'xy')
	model.drive('right', np.flatnonzero(x > 0.4 - 1e-9), 'x', velocity=1e-4)
	return model, joints


def pull(model, steps=60, **recorder):
	model.insert()
	O.dt, O.engines = 1e-3, [BlockLoop(), BlockMotion(rescueFile=''), BlockCrackRecorder(label='recorder', **recorder)]
	O.run(steps, True)
	return model


def test_namesAreKept():
	"""Read back for each joint, by number and by name; several sets of properties between one pair of blocks."""
	model, joints = wall()
	assert sorted(model.jointNames) == ['bed', 'head', 'unit'] and model.segmentName.dtype == np.int32
	assert not model.segmentName.flags.writeable or model.segmentName is not model.segmentName # a copy
	for number, name in enumerate(model.jointNames):
		assert list(np.flatnonzero(model.segmentName == number)) == list(joints[name]) == list(model.jointsNamed(name))
	assert list(model.jointsNamed(['head', 'unit'])) == sorted([*joints['head'], *joints['unit']])
	pair = np.asarray(model.segmentBlocks)
	two = next(i for i in range(len(pair) - 1) if (pair[i] == pair[i + 1]).all()) # two joints of one pair of blocks
	model.nameJoints('weak', [two])
	model.setJoints('weak', cohesion=5.)
	cohesion = model.jointProperties['cohesion']
	assert cohesion[two] == 5 and cohesion[two + 1] != 5 and list(np.flatnonzero(cohesion == 5)) == [two]
	assert two not in model.jointsNamed('bed') # one name a joint
	factors = model.scatterStrengths(cov=0.3, joints='bed')
	assert len(factors) == len(model.jointsNamed('bed')) and np.ptp(factors) > 0.1


def test_aNameThatNoJointHasIsGone():
	model, joints = wall()
	names = list(model.jointNames)
	model.nameJoints('mortar', ['bed', 'head'])
	assert list(model.jointNames) == [name for name in names if name == 'unit'] + ['mortar']
	assert list(model.jointsNamed('unit')) == list(joints['unit']) and set(model.segmentName) == {0, 1}


def test_unnamed():
	m = couplet()
	assert list(m.jointNames) == [] and (m.segmentName == -1).all() and len(m.segmentName) == len(m.segmentBlocks)
	assert set(results.Cracks(m).pairs) == {'mortar-mortar', 'unit-mortar'}


@pytest.mark.parametrize(
	'call, error, words',
	[(lambda m: m.nameJoints('', [0]), ValueError, 'a name of joints must not be empty'),
		(lambda m: m.nameJoints('a', []), ValueError, 'name of joints "a": there must be at least one joint'),
		(lambda m: m.nameJoints('a', [10**6]), ValueError, 'BlockModel.nameJoints: no such joint'),
		(lambda m: m.nameJoints('a', [-1]), ValueError, 'BlockModel.nameJoints: no such joint'),
		(lambda m: m.nameJoints(3, [0]), TypeError, 'BlockModel.nameJoints.name must be a text, got 3'),
		(lambda m: m.setJoints('beds', cohesion=1), ValueError, 'BlockModel.setJoints: no joint has the name "beds"; there are: '),
		(lambda m: m.jointsNamed(['bed', 'b']), ValueError, 'BlockModel.jointsNamed: no joint has the name "b"; there are: '),
		(lambda m: m.jointsNamed(3), ValueError, 'BlockModel.jointsNamed.name must be a text or a list of texts, got 3'),
		(lambda m: pictures.drawCracks('nowhere.png', m, joints='b'), ValueError, "no joint has the name 'b'; there are bed, head, unit")]
)
def test_namesThatCannotBe(call, error, words):
	model, _ = wall()
	before = (list(model.jointNames), list(model.segmentName))
	with pytest.raises(error) as caught:
		call(model)
	assert words in str(caught.value) and before == (list(model.jointNames), list(model.segmentName))


def test_noNamesBeforeJoints():
	materials()
	with pytest.raises(RuntimeError, match=r'BlockModel.nameJoints: there are no joints yet; call bond\(\) first'):
		BlockModel(thickness=1).nameJoints('a', [0])


@pytest.mark.parametrize('ending', ['yade', 'xml'])
def test_namesAreSaved(ending, tmp_path):
	model, joints = wall()
	pull(model, 5)
	O.save(str(tmp_path / f'wall.{ending}'))
	O.load(str(tmp_path / f'wall.{ending}'))
	again = scenes.model()
	assert list(again.jointNames) and {name: list(again.jointsNamed(name)) for name in again.jointNames
						} == {name: list(some) for name, some in joints.items()}


def test_filesOfAnotherFormatAreRefused(tmp_path):
	"""What was saved before names were: format 4."""
	pull(wall()[0], 1)
	path = tmp_path / 'wall.xml'
	O.unsealedSave(str(path), True)
	text = path.read_bytes()
	now, = re.findall(rb'<format>(\d+)</format>', text)
	assert int(now) > 4
	path.write_bytes(text.replace(b'<format>%b</format>' % now, b'<format>4</format>'))
	with pytest.raises(Exception, match=r'\(format 4, this one reads %d and 8\): build the model anew' % int(now)):
		O.load(str(path))


def test_crackTables(tmp_path):
	"""Results, events and the recorder's file say which joints have cracked by name."""
	model, joints = wall()
	cracks = results.Cracks(model)
	model.nameJoints('lowest head', joints['head'][:1])
	pull(model, fileName=str(tmp_path / 'cracks.txt'))
	assert cracks.counts()['head']['tension'] == 2 * len(joints['head']) and cracks.share('head') == 1
	counts = results.Cracks(model).counts()
	assert counts['lowest head']['tension'] == 2 and counts['head']['tension'] == 2 * len(joints['head']) - 2
	recorder = next(engine for engine in O.engines if engine.label == 'recorder')
	assert {event['name'] for event in recorder.events} == {'head', 'lowest head'}
	head, *rest = (tmp_path / 'cracks.txt').read_text().splitlines()
	assert head.split()[-1] == 'name' and sorted({line.split(' ', 12)[12] for line in rest}) == ['"lowest head"', 'head']


def test_picturesAndFiles(tmp_path):
	"""Cracks and bars of a name alone; joints in the colours of their names; numbers in ParaView's file, and which is which beside it."""
	import meshio
	model, joints = wall()
	pull(model)
	snap = snapshot.Snapshot(model, 1)
	assert snap.jointNames == list(model.jointNames) and np.array_equal(snap.segmentName, model.segmentName)
	colour = lambda path, rgb: (abs(matplotlib.image.imread(path)[..., :3] - rgb).max(axis=2) < 0.02).sum()
	blue, vermillion, black = (0, 0x72 / 255, 0xB2 / 255), (0xD5 / 255, 0x5E / 255, 0), (0, 0, 0) # head, bed, unit
	draw = lambda joints: picturesfields.drawNames(tmp_path / 'names.png', snap, joints=joints)
	assert all(colour(draw(None), rgb) > 200 for rgb in (blue, vermillion, black))
	assert colour(draw('bed'), blue) == 0 < colour(draw('bed'), vermillion)
	assert colour(pictures.drawCracks(tmp_path / 'a.png', model), blue) > 200
	assert colour(pictures.drawCracks(tmp_path / 'b.png', model, joints=['bed', 'unit']), blue) == 0
	red = lambda path: (matplotlib.image.imread(path)[..., 0] > matplotlib.image.imread(path)[..., 1] + 0.3).sum()
	bars = {name: red(picturesfields.drawJoints(tmp_path / 'c.png', model, 'opening', joints=name)) for name in ('head', 'unit')}
	assert bars['head'] > 1000 and bars['unit'] != bars['head']
	picturesfields.drawMovie(tmp_path / 'd.gif', [snap], 'cracks')

	export.BlocksExport(tmp_path).write(model, 0.5)
	names = meshio.read(tmp_path / 'joints_0000.vtu').cell_data['name'][0]
	assert np.array_equal(names, np.repeat(model.segmentName, 2))
	assert (tmp_path / 'joints.names.csv').read_text().splitlines() == ['number,name'] + [f'{i},"{name}"' for i, name in enumerate(model.jointNames)]
	export.BlocksExport(tmp_path)
	assert not (tmp_path / 'joints.names.csv').exists()


def test_severalLayouts():
	"""Two walls side by side, each names its own; those between them keep the first one's."""
	materials()
	model = BlockModel(thickness=0.1)
	placed = [
		layout.Layout([np.array(rectangle(x + dx, y, x + dx + 0.2, y + 0.1)) for y in (0, 0.1) for dx in (0, 0.2)], ['a'] * 4, range(4),
				lambda normals, ends, same, name=name: np.full(len(normals), name, object)).addTo(model, 'unit', zoneSize=0.1)
		for name, x in (('left', 0), ('right', 0.4))
	]
	model.bond([JointMat(**wallJoint)])
	for some in placed:
		some.nameJoints(model)
	assert sorted(model.jointNames) == ['left', 'platen', 'right'] and (model.segmentName >= 0).all()
