"""Every attribute of YADE's classes, set from Python, is read in C++ where pkg/yade-api declares it."""
import pytest
from yade import *
from yade.minieigenHP import Matrix3, Quaternion, Vector3, Vector3i

import probes # noqa: F401
from probes import abiprobe

examples = [
	Sphere, Aabb, State, FrictMat, FrictPhys, ScGeom, Body, Interaction, Cell, ForceEngine, PyRunner, GlobalStiffnessTimeStepper, InteractionLoop,
	Bo1_Sphere_Aabb
]
counter = 0


def changed(value):
	"""A value of the same type that occurs nowhere else."""
	global counter
	counter += 1
	if isinstance(value, bool): return not value
	if isinstance(value, int): return 1000 + counter
	if isinstance(value, float): return 0.5 + counter
	if isinstance(value, str): return 'text%d' % counter
	if isinstance(value, list): return [counter, counter + 7]
	if isinstance(value, Vector3): return Vector3(counter, counter + .25, -counter)
	if isinstance(value, Vector3i): return Vector3i(counter, counter + 1, -counter)
	if isinstance(value, Matrix3): return Matrix3(*(counter + .1 * i for i in range(9)))
	if isinstance(value, Quaternion): return Quaternion((1, 0, 0), .01 * counter)
	return None


made = {'material': FrictMat, 'shape': Sphere, 'state': State, 'bound': Aabb, 'geom': ScGeom, 'phys': FrictPhys}
recomputed = {'prevHSize'} # by Cell's postLoad


@pytest.mark.parametrize('example', examples, ids=lambda c: c.__name__)
def test_attributes(example):
	instance = example()
	values = {}
	for name, old in instance.dict().items():
		if name not in abiprobe.attributes(instance): continue
		new = made[name]() if name in made else changed(old)
		assert new is not None, 'no new value for %s.%s' % (example.__name__, name)
		instance.updateAttrs({name: new})
		values[name] = new
	seen = abiprobe.attributes(instance)
	for name, value in values.items():
		assert seen[name] == getattr(instance, name), name
		assert seen[name] == value or name in recomputed, name
	missing = set(seen) - set(values) - {'pos', 'ori', 'isActive'}
	assert not missing, 'not set from Python'


def test_what_has_its_own_property():
	s = State()
	s.pos, s.ori = (1, 2, 3), Quaternion((0, 0, 1), .3)
	seen = abiprobe.attributes(s)
	assert (seen['pos'], seen['ori']) == (Vector3(1, 2, 3), Quaternion((0, 0, 1), .3))
	i = Interaction()
	i.isActive = False
	assert not abiprobe.attributes(i)['isActive']


def test_scene():
	O.reset()
	O.dt, O.trackEnergy, O.stopAtIter, O.stopAtTime, O.subStepping = 3e-4, True, 77, 12., False
	O.periodic = True
	O.materials.append(FrictMat(label='clay'))
	O.materials.append(FrictMat(label='stone'))
	O.engines = [ForceResetter(), PyRunner(command='pass', iterPeriod=1)]
	O.tags['key'] = 'value'
	seen = abiprobe.sceneValues()
	assert (seen['dt'], seen['trackEnergy'], seen['stopAtIter'], seen['stopAtTime']) == (3e-4, True, 77, 12.)
	assert seen['isPeriodic'] and not seen['subStepping'] and (seen['iter'], seen['subStep'], seen['subdomain']) == (0, -1, 0)
	assert seen['engines'] == ['ForceResetter', 'PyRunner']
	assert seen['materials'] == ['clay', 'stone']
	assert 'key=value' in seen['tags']
	O.periodic = False
	O.run(5, True)
	seen = abiprobe.sceneValues()
	assert seen['iter'] == 5 and seen['time'] == pytest.approx(5 * 3e-4) and not seen['isPeriodic'] and seen['speed'] == O.speed
	O.reset()
