"""A class made with the macros of pkg/yade-api behaves like YADE's own: Python, pickling and files."""
import copy
import pickle

import pytest
from yade import *
from yade.minieigenHP import Matrix3, Vector3

import probes

globals().update(probes.toys)


def test_defaults_and_keywords():
	assert (ToyShape().edge, ToyShape().axis, ToyShape().name, ToyShape().corners, ToyShape().holder) == (1, Vector3(0, 0, 1), 'cube', [], None)
	s = ToyShape(edge=3, corners=[(0, 0, 0), (1, 2, 3)], color=(1, 0, 0))
	assert (s.edge, s.corners, s.color, s.twice()) == (3, [Vector3(0, 0, 0), Vector3(1, 2, 3)], Vector3(1, 0, 0), 6)


def test_wrong_arguments():
	with pytest.raises(AttributeError, match='bogus'):
		ToyShape(bogus=1)
	with pytest.raises(RuntimeError, match='keyword'):
		ToyShape(3)
	with pytest.raises(TypeError):
		ToyShape(edge='long')


def test_flags():
	s = ToyShape()
	assert s.loads == 0 # no keywords, nothing to complete
	s.edge = 2
	s.watched = (1, 2, 3)
	assert s.loads == 2 and s.watched == Vector3(1, 2, 3)
	s.name = 'box'
	assert s.loads == 2
	with pytest.raises(AttributeError):
		s.loads = 3
	assert not isinstance(ToyEngine.__dict__.get('energyId'), property) and 'energyId' not in ToyEngine().dict()


def test_references():
	s = ToyShape(holder=ToyHolder(numbers=[1]))
	s.axis[0] = 5
	s.matrix[0, 1] = 4
	s.holder.numbers = [2, 3]
	assert (s.axis, s.matrix[0, 1], s.holder.numbers) == (Vector3(5, 0, 1), 4, [2, 3])


def test_docstrings():
	assert ToyShape.__doc__.strip() == 'A cube.'
	assert ToyShape.edge.__doc__ == 'Edge [m]. :ydefault:`1` :yattrtype:`Real` :yattrflags:`4` '
	assert 'Twice the edge' in ToyShape.twice.__doc__
	assert ToyMat.young.__doc__ == FrictMat.young.__doc__


def test_dict_has_the_bases_too():
	assert {'edge', 'axis', 'color', 'wire'} <= set(ToyShape().dict()) and 'parts' not in ToyShape().dict()


@pytest.mark.parametrize('duplicate', [copy.deepcopy, lambda x: pickle.loads(pickle.dumps(x))], ids=['deepcopy', 'pickle'])
def test_duplicates(duplicate):
	s = ToyShape(edge=3, axis=(1, 2, 3), corners=[(0, 0, 1)], material=ToyMat(cohesion=7), color=(0, 1, 0))
	d = duplicate(s)
	assert d is not s and (d.edge, d.axis, d.corners, d.material.cohesion, d.color) == (3, Vector3(1, 2, 3), [Vector3(0, 0, 1)], 7, Vector3(0, 1, 0))


def scene():
	O.reset()
	O.materials.append(ToyMat(young=1e3, cohesion=7, label='toy'))
	holder = ToyHolder(numbers=[.1, .2, 1 / 3])
	for i in range(4):
		b = Body()
		b.shape = ToyShape(edge=1.1, corners=[(0, 0, i)], holder=holder, name='n%d' % i, material=O.materials[0], matrix=Matrix3(*range(9)), memory=i)
		b.shape.addPart()
		b.state, b.mat = ToyState(heat=i), O.materials[0]
		b.state.pos, b.state.mass, b.state.inertia = (i, .01 * i, 0), 1, (1, 1, 1)
		O.bodies.append(b)
	O.engines = [
		ForceResetter(),
		InsertionSortCollider([Bo1_ToyShape_Aabb(label='bound')], verletDist=0),
		InteractionLoop([Ig2_ToyShape_ToyShape_ToyGeom(margin=.5)], [Ip2_ToyMat_ToyMat_ToyPhys()], [Law2_ToyGeom_ToyPhys_Toy()]),
		ToyEngine(),
		ToyPartialEngine(ids=[1, 2]),
		ToyPeriodicEngine(iterPeriod=7),
		ToyTimeStepper(active=False),
		NewtonIntegrator(damping=0)
	]
	O.dt = 1e-3


@pytest.mark.parametrize('ending', ['.xml', '.xml.bz2', '.yade', '.yade.bz2', '.yade.gz', ':memory:'])
def test_saved_scene_continues_bit_by_bit(ending, tmp_path):
	scene()
	O.run(100, True)
	expected = [tuple(b.state.pos) + tuple(b.state.vel) for b in O.bodies], O.engines[5].steps

	scene()
	O.run(50, True)
	file = ':memory:toys' if ending == ':memory:' else str(tmp_path / ('toys' + ending))
	if ending == ':memory:': O.saveTmp('toys')
	else: O.save(file)
	O.reset()
	if ending == ':memory:': O.loadTmp('toys')
	else: O.load(file)
	shapes = [b.shape for b in O.bodies]
	assert [(s.edge, s.corners, s.name, s.matrix) for s in shapes] == [(1.1, [Vector3(0, 0, i)], 'n%d' % i, Matrix3(*range(9))) for i in range(4)]
	assert [(s.parts, s.memory, s.loads) for s in shapes] == [(1, 7, 1)] * 4 # hidden is kept, noSave is not, postLoad ran once
	assert [b.state.heat for b in O.bodies] == [0, 1, 2, 3]
	assert shapes[0].holder.numbers == [.1, .2, 1 / 3]
	shapes[0].holder.numbers = [9]
	assert shapes[3].holder.numbers == [9] # still the same object
	assert shapes[0].material.cohesion == O.materials[0].cohesion == 7
	assert (O.engines[2].geomDispatcher.functors[0].margin, O.engines[4].ids, O.engines[6].active) == (.5, [1, 2], False)

	O.run(50, True)
	assert ([tuple(b.state.pos) + tuple(b.state.vel) for b in O.bodies], O.engines[5].steps) == expected
	O.reset()
