"""What Python does not show: containers, references, caches, forces and energies, used through pkg/yade-api."""
import pytest
from yade import *
from yade.minieigenHP import Vector3

import probes
from probes import abiprobe

globals().update(probes.toys)


def cube(x):
	b = Body()
	b.shape, b.state, b.mat = ToyShape(edge=1.1), State(), O.materials[0]
	b.state.pos, b.state.mass, b.state.inertia = x, 1, (1, 1, 1)
	return b


@pytest.fixture
def row():
	"""Three cubes that overlap by 0.1."""
	O.reset()
	O.materials.append(ToyMat(young=1e3))
	for x in 0, 1, 2:
		O.bodies.append(cube((x, 0, 0)))
	O.engines = [
		ForceResetter(),
		InsertionSortCollider([Bo1_ToyShape_Aabb()], verletDist=0),
		InteractionLoop([Ig2_ToyShape_ToyShape_ToyGeom()], [Ip2_ToyMat_ToyMat_ToyPhys()], [Law2_ToyGeom_ToyPhys_Toy()]),
		ToyEngine(label='toy'),
		NewtonIntegrator(damping=0)
	]
	O.dt = 1e-3
	yield
	O.reset()


def test_bodies(row):
	O.bodies.erase(1)
	assert [b[:5] for b in abiprobe.bodies()] == [(i, Vector3(i, 0, 0), True, 'ToyShape', 'State') for i in (0, 2)]
	abiprobe.move(2, Vector3(7, 8, 9), Vector3(1, 0, 0))
	assert O.bodies[2].state.pos == Vector3(7, 8, 9) and O.bodies[2].state.vel == Vector3(1, 0, 0)
	added = abiprobe.newBody(Vector3(3, 0, 0))
	assert O.bodies[added].state.pos == Vector3(3, 0, 0) and isinstance(O.bodies[added].shape, ToyShape)


def test_interactions(row):
	O.step()
	functors = ['Ig2_ToyShape_ToyShape_ToyGeom', 'Ip2_ToyMat_ToyMat_ToyPhys', 'Law2_ToyGeom_ToyPhys_Toy']
	assert abiprobe.interactions() == [(0, 1, True, True, functors, 0), (1, 2, True, True, functors, 1)]
	assert [b[5] for b in abiprobe.bodies()] == [[1], [2], []] or [b[5] for b in abiprobe.bodies()] == [[1], [0, 2], [1]]
	assert abiprobe.hasInteraction(0, 1) and not abiprobe.hasInteraction(0, 2)
	assert abiprobe.insertInteraction(0, 2) and not abiprobe.insertInteraction(0, 2)
	assert abiprobe.hasInteraction(0, 2) and len(abiprobe.interactions()) == 3
	assert abiprobe.eraseInteraction(0, 2) and not abiprobe.hasInteraction(0, 2)
	abiprobe.requestErase(0, 1)
	assert [i[2] for i in abiprobe.interactions()] == [False, True]


def test_trajectory(row):
	"""Springs of 1 kN/m between cubes of 1 kg: the middle one stays, the outer ones follow the discrete harmonic motion."""
	omega2 = 1e3
	x, v = 0., 0.
	O.run(50, True)
	for _ in range(50): # leapfrog, as in NewtonIntegrator; the law pulls body 0 by kn * gap
		v += O.dt * omega2 * (1 - x - 1.1)
		x += O.dt * v
	assert O.bodies[0].state.pos[0] == pytest.approx(x, rel=1e-12)
	assert O.bodies[1].state.pos[0] == pytest.approx(1, rel=1e-12)
	assert O.interactions[0, 1].phys.normalForce[0] == pytest.approx(1e3 * O.interactions[0, 1].geom.gap)


def test_forces(row):
	assert abiprobe.addedForce(1, Vector3(1, 2, 3)) == Vector3(1, 2, 3)
	assert O.forces.f(1) == Vector3(1, 2, 3)
	assert abiprobe.addedTorque(1, Vector3(4, 5, 6)) == Vector3(4, 5, 6) and abiprobe.addedTorque(1, Vector3(1, 0, 0)) == O.forces.t(1) == Vector3(5, 5, 6)
	O.forces.setPermF(2, (7, 8, 9))
	assert abiprobe.addedForce(2, Vector3(1, 1, 1)) == Vector3(8, 9, 10) and abiprobe.forceState()[1]
	O.forces.addF(1, (1, 0, 0))
	assert not abiprobe.forceState()[1] # NewtonIntegrator, or else BlockIntegrator, sums up before forces are read
	O.engines = [ForceResetter(), NewtonIntegrator(gravity=(0, -3, 0), damping=.4)]
	O.run(3, True)
	assert abiprobe.forceState()[0] == 2
	assert (abiprobe.attributeOfEngine(1, 'gravity'), abiprobe.attributeOfEngine(1, 'damping')) == (Vector3(0, -3, 0), .4)


def test_energy(row):
	O.trackEnergy = True
	assert abiprobe.addedEnergy('heat', .5, 1000) == 500 # sums of halves are exact
	assert abiprobe.addedEnergy('work', .25, 100) == 525
	assert dict(O.energy.items()) == {'heat': 500, 'work': 25}
	abiprobe.setEnergy('heat', 3)
	assert O.energy['heat'] == 3
	O.run(2, True)
	assert O.energy['toy'] == 3 # reset in every step
	O.trackEnergy = False


def test_dispatch(row):
	shape = O.bodies[0].shape
	assert shape.dispHierarchy() == ['ToyShape', 'Shape']
	assert O.materials[0].dispHierarchy() == ['ToyMat', 'FrictMat', 'ElastMat', 'Material']
	assert abiprobe.baseIndex(shape, 1) == Shape().dispIndex
	assert O.engines[2].geomDispatcher.dispMatrix() == {('ToyShape', 'ToyShape'): 'Ig2_ToyShape_ToyShape_ToyGeom'}
	assert O.engines[2].geomDispatcher.functors[0].bases == ['ToyShape', 'ToyShape']
	assert O.engines[1].boundDispatcher.functors[0].bases == ['ToyShape']
	assert isinstance(O.materials[0].newAssocState(), ToyState)


def test_engines(row):
	O.engines += [ToyPartialEngine(ids=[3, 4], label='partial'), ToyPeriodicEngine(iterPeriod=3, initRun=True, label='periodic')]
	O.run(8, True)
	assert O.engines[3].bodies == 3 and O.engines[5].sum == 7 and O.engines[6].steps == [0, 3, 6]
	O.engines = [ToyTimeStepper(timeStepUpdateInterval=2)]
	O.resetTime()
	O.run(4, True)
	assert O.dt == 3e-3 # set in steps 0 and 2
	O.engines[0].active = False
	O.run(4, True)
	assert O.dt == 3e-3


def test_timing(row):
	O.timingEnabled = True
	assert abiprobe.timingEnabled()
	O.run(10, True)
	O.timingEnabled = False
	assert [(label, count) for label, _, count in O.engines[3].timingDeltas.data] == [('bodies', 10), ('energy', 10)]
	assert 0 < sum(ns for _, ns, _ in O.engines[3].timingDeltas.data) <= O.engines[3].execTime
	O.run(10, True)
	assert O.engines[3].timingDeltas.data[0][2] == 10


def test_registers():
	assert abiprobe.knowsPluginClass('NewtonIntegrator') and abiprobe.knowsPluginClass('ToyShape')
	assert 'Sphere' in abiprobe.dynamicType(Sphere()) and 'ToyShape' in abiprobe.dynamicType(ToyShape())
	probes.library.yadeRegisterNewClasses() # nothing new: does nothing
	from yade import wrapper
	assert wrapper.ToyShape is ToyShape


def test_log(row, capfd):
	from yade import log
	O.step()
	assert 'counted' not in capfd.readouterr().err
	log.setLevel('Default', log.INFO)
	O.step()
	log.setLevel('Default', log.WARN)
	assert 'ToyEngine' in capfd.readouterr().err
