# yade-blocks, GPL-2.0-or-later
"""What scripts may do that blocks would not notice, and runs that end wrong: each is refused, or said, in a sentence."""
import gc

import meshio
import pytest

from processes import * # noqa: F401 (mounted)
from yadeblocks import export, loading
from yadeblocks.engines import loopList


def pair(gap=0.0, size=0.1, joints=True, rigid=False, young=1e9, kn=1e11, zones=0.05, second=None):
	"""Two squares beside each other; issue 12's numbers."""
	O.reset()
	for label in 'rock', 'other':
		O.materials.append(BlockMat(label=label, young=young, poisson=0.2, density=2000))
	model = BlockModel(thickness=1)
	for number, x in enumerate((0, size + gap)):
		label = second if number and second else 'rock'
		outline = rectangle(x, 0, x + size, size)
		if rigid: model.addRigid(outline, label)
		else: model.addRegion(outline, label, zoneSize=zones)
	if joints: model.bond([JointMat(material1='rock', material2='rock', kn=kn, ks=kn / 2, cohesion=1e6, tension=1e6, frictionAngle=0.5)])
	return model


def oneBlock():
	O.reset()
	O.materials.append(BlockMat(label='rock', young=1e9, poisson=0.2, density=2000))
	model = BlockModel(thickness=1)
	model.addRegion(rectangle(0, 0, 1, 1), 'rock', zoneSize=0.5)
	model.bond()
	return model


def inserted(contact=True, motion=dict(damping='none', quasiStatic=False, rescueFile=''), interactions=True, **scene):
	model = pair(**scene)
	model.insert(interactions=interactions)
	O.engines = loopList(contact=contact, **motion)
	return model


def said(words, run=lambda: O.run(101, True)):
	with pytest.raises((RuntimeError, ValueError)) as caught:
		run()
	for word in words:
		assert word in str(caught.value)


# ---- contacts in time


def thrown(v, start, size=0.1, gap=0.05):
	"""Energy after by before, of a square thrown at another one at this step."""
	model = inserted(gap=gap)
	O.engines[-1].watchPeriod, O.trackEnergy = 0, True
	O.run(start, True)
	model.velocity[model.firstNode[1]:] = -v, 0
	O.run(1, True)
	total = lambda: sum(
		O.energy[name] for name in ('blockKinetic', 'blockZones', 'blockJoints', 'blockFriction', 'blockDamping') if name in O.energy.keys()
	)
	before = total()
	O.run(int(2.5 * gap / v / O.dt), True)
	return total() / before, model.fingerprint()


@pytest.mark.parametrize('v', [20, 40])
def test_theFirstTouchIsInTime(v):
	"""Whatever the step at which it starts. The energy is turned over twice, into strain and back: 1 % of that. (A contact that came late made
	1.11 and 1.88 at 20 m/s, 7.5 at 40.)"""
	ratios = [thrown(v, start)[0] for start in (1, 5, 8)]
	assert all(abs(ratio - 1) < 0.02 for ratio in ratios), ratios
	assert max(ratios) - min(ratios) < 1e-9


@pytest.mark.parametrize('start', [3, 8])
def test_aTouchThatIsTooFastForItsStepIsRefused(start):
	"""80 m/s are 2.1 mm a step, 8 % of the depth at which the contact is lost. (It made 11.6 and 1.36 of the energy.)"""
	said(['block 1 nears block 0 at 80 m/s', 'O.dt must not exceed'], lambda: thrown(80, start))


def test_rigidBlocksThatWouldFirstTouchDeep():
	"""Half a metre apart, 0.26 m a step: they would touch first a quarter of a metre deep, if at all. (They went through each other.)"""
	inserted(size=1, gap=0.5, rigid=True)
	O.engines, O.dt = loopList(contact=True, damping='none', quasiStatic=False, rescueFile='', newton=dict(damping=0)), 1e-4
	O.run(1, True)
	O.bodies[1].state.vel = -0.26 / O.dt, 0, 0
	said(['block 1 nears block 0 at 2600 m/s', 'O.dt must not exceed'], lambda: O.run(20, True))


@pytest.mark.parametrize('collider', [[], ['Bo1_Sphere_Aabb'], ['Bo1_Block_Aabb']])
def test_noColliderIsNeeded(collider):
	"""BlockContacts finds neighbours itself, whatever collider there is. (Without, or with another Bo1, blocks went through each other.)"""
	model = pair(gap=1e-3)
	model.insert()
	O.engines = engineList([], contact=True, stepper=dict(quasiStatic=False), damping='none', rescueFile='')
	others = [engine for engine in O.engines if not isinstance(engine, InsertionSortCollider)]
	O.engines = others[:1] + [InsertionSortCollider([globals()[name]()], verletDist=0) for name in collider] + others[1:]
	O.run(1, True)
	model.velocity[model.firstNode[1]:] = -5, 0
	O.run(3000, True)
	first = slice(0, model.firstNode[1]), slice(model.firstNode[1], None)
	middle = [model.position[part, 0].mean() for part in first]
	assert middle[1] - middle[0] > 0.099 and model.velocity[first[0], 0].mean() < -2 # the blow was passed on


@pytest.mark.parametrize('v', [300, 1e4, 1e6])
@pytest.mark.parametrize('wall', [0.02, 0.1])
@pytest.mark.parametrize('rigid', [False, True])
def test_nothingGoesThroughAWall(v, wall, rigid):
	O.reset()
	O.materials.append(BlockMat(label='rock', young=1e9, poisson=0.2, density=2000))
	model = BlockModel(thickness=1)
	model.addRegion(rectangle(0, 0, 0.1, 0.1), 'rock', zoneSize=0.05)
	outline = rectangle(0.15, -0.2, 0.15 + wall, 0.3)
	if rigid: model.addRigid(outline, 'rock')
	else: model.addRegion(outline, 'rock', zoneSize=0.1)
	model.bond([JointMat(material1='rock', material2='rock', kn=1e11, ks=5e10, bonded=False)])
	model.insert()
	O.engines = loopList(contact=True, damping='none', quasiStatic=False, rescueFile='', newton=dict(damping=0) if rigid else None)
	O.run(1, True)
	model.velocity[:model.firstNode[1]] = v, 0
	try:
		O.run(3000, True)
	except RuntimeError as error:
		assert all(word in str(error) for word in ('block', 'm/s', 'pass through', 'O.dt must not exceed')), error
	else: # slow enough for the contact
		assert v < 1000 and model.position[:model.firstNode[1], 0].mean() < model.position[model.firstNode[1]:, 0].mean()


def test_twoFastBlocksThatDoNotMeet():
	"""Both at 1000 m/s, beside each other: nothing is wrong with that."""
	model = inserted(gap=0.05)
	O.run(1, True)
	model.velocity[:] = 1000, 0
	O.run(200, True)
	assert np.allclose(model.velocity, (1000, 0), rtol=1e-9, atol=1e-6)


def test_aRigidBlockThatIsPressedThrough():
	"""By 1e6 N on springs of 5e8 Pa/m: it stops where the contact is about to be lost. (It fell to y = -315 m.)"""
	O.reset()
	O.materials.append(BlockMat(label='rock', young=1e9, poisson=0.2, density=2000))
	model = BlockModel(thickness=1)
	model.addRigid(rectangle(-0.2, -0.1, 0.3, 0), 'rock')
	model.addRigid(rectangle(0, 0, 0.1, 0.1), 'rock')
	model.bond([JointMat(material1='rock', material2='rock', kn=5e8, ks=5e8, bonded=False)])
	top = [e for e, nodes in enumerate(model.edgeNodes) if (model.reference[nodes, 1] > 0.1 - 1e-9).all()]
	model.traction(top, (0, -1e7))
	model.insert()
	O.bodies[0].state.blockedDOFs = 'xyzXYZ'
	O.engines = loopList(contact=True, damping='none', quasiStatic=False, rescueFile='', newton=dict(damping=0))
	said(['block'], lambda: O.run(30000, True))


# ---- looks


def test_theLastStepsAreLookedAt():
	"""99 steps, none of them the 100th: positions that are no numbers do not pass for a result."""
	model = inserted(contact=False)
	O.run(1, True)
	model.velocity[3] = float('nan')
	said(['unstable at step', 'not a number'], lambda: O.run(50, True))
	model = inserted(contact=False)
	O.run(1, True)
	model.velocity[0] = 1e5, 1e5
	said(['inside out'], lambda: O.run(1, True))


def test_theStateBeforeTheLastStepIsRescued(tmp_path):
	"""What turns inside out in the very step that was begun well: the beginning of that step is saved."""
	model = pair()
	model.drive('corner', [0], 'xy')
	model.insert()
	O.engines = loopList(quasiStatic=False, damping='none', rescueFile=str(tmp_path / 'rescued.yade'), watchPeriod=1)
	O.run(5, True)
	model.setTarget('corner', 1e5)
	said(['unstable at step 5', 'inside out', 'of step 5', 'saved as'], lambda: O.run(1, True))
	O.load(str(tmp_path / 'rescued.yade'))
	assert O.iter == 5


def test_anExcessOfEnergyIsSaid(capfd):
	"""Two rigid blocks that first touch far within each other: a jump within a step, not a growth."""
	model = inserted(contact=False)
	O.run(101, True)
	capfd.readouterr()
	model.velocity[:] += 1
	O.run(300, True)
	assert 'J of energy came from nowhere' in capfd.readouterr().err


@pytest.mark.parametrize('watchPeriod', [1, 10, 100])
def test_noFalseAlarm(watchPeriod, capfd):
	"""Gravity that is put on during the run, and taken off again bit by bit, is work of loads from then on. (It was an instability, with watchPeriod=1.)"""
	model = inserted(contact=False)
	O.engines[-1].watchPeriod = watchPeriod
	O.run(150, True)
	for g in [(0, -9.81)] + 15 * [(0, 1)]:
		model.gravity(g)
		O.run(11, True)
	model.gravity((3, 5))
	O.run(500, True)
	assert 'from nowhere' not in capfd.readouterr().err


def test_energyThatWasThereCounts(capfd):
	"""A fall that gravity ends where it began: what is left is rounding of what was there."""
	model = inserted(contact=False)
	O.engines[-1].watchPeriod = 1
	O.run(150, True)
	for g in -9.81, 19.62, -9.81:
		model.gravity((0, g))
		O.run(500, True)
	assert 'from nowhere' not in capfd.readouterr().err


@pytest.mark.parametrize('quasiStatic', [True, False])
def test_aVelocitySetByACallIsNoAlarm(quasiStatic, capfd):
	"""Grid points that are driven faster from look to look, without damping: work of their group."""
	model = pair()
	model.drive('left', nodesWhere(model, lambda x, y: x < 1e-9), 'xy')
	model.drive('right', nodesWhere(model, lambda x, y: x > 0.2 - 1e-9), 'x')
	model.insert()
	O.dt, O.engines = 1e-3, loopList(damping='none', quasiStatic=quasiStatic, rescueFile='', watchPeriod=1)
	O.run(100, True)
	for step in range(20):
		model.setTarget('right', -1e-3 * step)
		O.run(11, True)
	assert 'from nowhere' not in capfd.readouterr().err


# ---- rest


def test_settleWaitsForTheRamp():
	"""A press in its ramp is not at rest, whatever the ratio. (It returned after 900 steps at 0.6 % of the force.)"""
	O.reset()
	O.materials.append(BlockMat(label='rock', young=1e9, poisson=0.2, density=2000))
	model = BlockModel(thickness=1)
	model.addRegion(rectangle(0, 0, 0.1, 0.1), 'rock', zoneSize=0.05)
	model.addRegion(rectangle(0, 0.1, 0.1, 0.2), 'rock', zoneSize=0.05)
	model.bond([JointMat(material1='rock', material2='rock', kn=1e11, ks=5e10, cohesion=1e6, tension=1e6, frictionAngle=0.5)])
	model.drive('low', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
	model.push('press', nodesWhere(model, lambda x, y: y > 0.2 - 1e-9), 'y', force=-1e4, rampTime=20)
	model.insert()
	O.dt, O.engines = 1e-3, loopList(damping='local', alpha=0.5)
	steps = loading.settle(model)
	assert model.groupForce('press') == pytest.approx(-1e4, rel=1e-3) and steps >= 20000 and model.groupForce('low', axis='y'
															) == pytest.approx(1e4, rel=1e-3)
	assert len(O.engines) == 2


def test_settleWithoutJoints():
	"""A cantilever of one block: at its whole deflection, not at 11 % of it, of the answer of many more steps."""
	O.reset()
	O.materials.append(BlockMat(label='rock', young=1e9, poisson=0.2, density=2000))
	model = BlockModel(thickness=1)
	model.addRegion(rectangle(0, 0, 1, 0.2), 'rock', zoneSize=0.1)
	model.bond()
	model.drive('wall', nodesWhere(model, lambda x, y: x < 1e-9), 'xy')
	model.gravity((0, -9.81))
	model.insert()
	O.dt, O.engines = 1e-3, loopList(damping='local', alpha=0.5)
	loading.settle(model)
	tip = model.displacement[:, 1].min()
	O.run(5000, True)
	assert tip < 0 and tip == pytest.approx(model.displacement[:, 1].min(), rel=1e-2)


@pytest.mark.parametrize('blocks', [1, 2])
def test_aFallIsNoRest(blocks):
	"""A block without joints was at rest at once."""
	model = pair() if blocks == 2 else oneBlock()
	model.gravity((0, -9.81))
	model.insert()
	O.dt, O.engines = 1e-5, loopList(damping='none')
	said(['settle', 'not below'], lambda: loading.settle(model, maxSteps=500))


def test_settleDoesNotWait(monkeypatch):
	"""YADE takes 40 ms to see that a run has ended: looks must not end it. (Every look did.)"""
	model = pair()
	model.gravity((0, -9.81))
	model.drive('left', nodesWhere(model, lambda x, y: x < 1e-9), 'xy')
	model.insert()
	O.dt, O.engines = 1e-3, loopList(damping='local', alpha=0.5, rescueFile='')
	O.run(1, True)
	runs, run = [], type(O).run
	monkeypatch.setattr(type(O), 'run', lambda *given, **named: runs.append(given) or run(*given, **named))
	assert loading.settle(model, period=5) > 100 and len(runs) == 1


# ---- what is changed behind the model's back


def native():
	model = pair()
	model.insert()
	O.engines = engineList([], damping='none', rescueFile='')
	return model


def eraseInteractions():
	O.interactions.clear()


changes = {
	'shape': (lambda: setattr(O.bodies[0], 'shape', Sphere(radius=1)), ['shape of block 0 (body 0) was replaced']),
	'material': (lambda: setattr(O.bodies[0], 'mat', FrictMat()), ['material of block 0 (body 0) was changed']),
	'modulus': (lambda: setattr(O.materials[0], 'young', 2e9), ['material of block 0 (body 0) was changed', '1000000000']),
	'interactions': (eraseInteractions, ['interaction of block 0 (body 0) and block 1 (body 1)']),
	'permanent force': (lambda: O.forces.setPermF(0, (1, 0, 0)), ['setPermF', 'block 0 (body 0)', 'traction']),
	'dynamic': (lambda: setattr(O.bodies[0], 'dynamic', True), ['blockedDOFs of block 0 (body 0)']),
}


@pytest.mark.parametrize('make', [inserted, native])
@pytest.mark.parametrize('change', list(changes))
def test_changedBehindTheModelsBack(change, make):
	make()
	O.run(2, True)
	changes[change][0]()
	said(changes[change][1])


def test_jointMatChangedBehindTheModelsBack():
	O.reset()
	O.materials.append(BlockMat(label='rock', young=1e9, poisson=0.2, density=2000))
	joint = JointMat(material1='rock', material2='rock', kn=1e11, ks=5e10, cohesion=1e6, tension=1e6)
	model = BlockModel(thickness=1)
	for x in 0, 1:
		model.addRegion(rectangle(x, 0, x + 1, 1), 'rock', zoneSize=1)
	model.bond([joint])
	model.insert()
	O.engines = loopList(quasiStatic=False)
	O.run(2, True)
	joint.tension = 2e6
	said(['JointMat for "rock" and "rock" was changed', 'setJoints'])


@pytest.mark.parametrize('name, value', [('vel', (1, 0, 0)), ('pos', (1, 0, 0)), ('angVel', (0, 0, 1)), ('blockedDOFs', 'x')])
def test_stateOfADeformableBlock(name, value):
	inserted()
	said(['grid points'], lambda: setattr(O.bodies[0].state, name, value))
	assert O.bodies[0].state.blockedDOFs == 'xyzXYZ'


@pytest.mark.parametrize('what, words', [('geom', ['geom', 'was replaced']), ('phys', ['phys', 'was replaced'])])
def test_partsOfAnInteractionReplaced(what, words):
	native()
	O.run(2, True)
	setattr(next(iter(O.interactions)), what, ScGeom() if what == 'geom' else FrictPhys())
	said(words, lambda: O.run(3, True))


# ---- lists of engines

spheres = lambda: InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()])
ofBlocks = lambda: InteractionLoop([Ig2_Block_Block_BlockGeom()], [Ip2_BlockMat_BlockMat_JointPhys()], [Law2_BlockGeom_JointPhys_MohrCoulomb()])


@pytest.mark.parametrize(
	'change, words', [
		(lambda list: [spheres()] + list, ['InteractionLoop has no functors for blocks', 'interactions=False']),
		(lambda list: [ofBlocks()] + list, ['InteractionLoop has functors for blocks beside BlockLoop']),
		(lambda list: list + list, ['stands twice in O.engines']),
		(lambda list: [BlockLoop()] + list, ['one BlockLoop or BlockForces']),
	]
)
def test_engineLists(change, words):
	inserted()
	O.engines = change(O.engines)
	said(words, lambda: O.run(5, True))


def test_withoutEngines():
	inserted()
	O.engines = []
	said(['O.engines', 'BlockLoop', 'BlockMotion'], lambda: O.run(1, True))
	said(['O.engines', 'BlockLoop', 'BlockMotion'], O.step)


def test_yadesOwnEngines(tmp_path):
	"""Those that O.engines has when the program begins: YADE aborted."""
	run = runYade(
		"""
from scenes import *
assert len(O.engines) > 3
O.materials.append(BlockMat(label='rock', young=1e9, poisson=0.2, density=2000))
model = BlockModel(thickness=1)
model.addRegion(rectangle(0, 0, 1, 1), 'rock', zoneSize=1)
model.bond()
model.insert()
try: O.run(1, True)
except RuntimeError as error: print('said:', error)
""", cwd=tmp_path
	)
	assert run.returncode == 0 and 'said: O.engines has no BlockLoop' in run.stdout, run.stdout + run.stderr


def test_spheresBeside():
	"""Without interactions of blocks, an InteractionLoop of spheres is welcome."""
	inserted(interactions=False)
	O.engines = [spheres()] + O.engines
	O.run(5, True)
	assert O.iter == 5


def test_noMotion(capfd):
	inserted()
	O.engines = O.engines[:-1]
	O.run(3, True)
	assert 'deformable blocks do not move' in capfd.readouterr().err


def test_dampingOfNewton(capfd):
	model = pair(rigid=True)
	model.insert()
	O.engines = loopList(damping='none', newton={}, quasiStatic=False)
	O.run(3, True)
	assert 'NewtonIntegrator.damping=0.2' in capfd.readouterr().err.replace('0.20000000000000001', '0.2')


# ---- reading


def test_stressesOfPairsThatWereNeverBonded():
	"""Near each other (that crashed), and pressed together."""
	inserted(gap=1e-3)
	O.run(3, True)
	assert [(i.phys.sigma, i.phys.tau, i.phys.status) for i in O.interactions if i.isReal] == [([], [], [])]


def test_stressesOfASlidingJoint(tmp_path):
	"""1 MN on a joint that broke and has become a free contact: what stands on it is shown, 1 MN by the area."""
	O.reset()
	O.materials.append(BlockMat(label='rock', young=1e10, poisson=0, density=2000))
	model = BlockModel(thickness=1)
	model.addRegion(rectangle(0, 0, 1, 1), 'rock', zoneSize=1)
	model.addRegion(rectangle(0, 1, 1, 2), 'rock', zoneSize=1)
	model.bond([JointMat(material1='rock', material2='rock', kn=1e11, ks=5e10, frictionAngle=0.5, bonded=False)])
	model.drive('low', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
	model.push('top', nodesWhere(model, lambda x, y: y > 2 - 1e-9), 'y', force=-1e6)
	model.drive('side', nodesWhere(model, lambda x, y: y > 2 - 1e-9), 'x')
	model.insert()
	O.dt, O.engines = 1e-3, loopList(contact=True, damping='local', alpha=0.5)
	O.run(3000, True)
	assert (model.segmentArea == 0).all() # released
	export.BlocksExport(tmp_path).write(model, 0)
	exported = meshio.read(tmp_path / 'joints_0000.vtu').cell_data['sigma'][0]
	for sigma in model.pointSigma, next(iter(O.interactions)).phys.sigma, exported:
		assert np.mean(sigma) == pytest.approx(-1e6, rel=1e-2)


def test_residualCohesionOfAClosedJointWithoutPressure():
	"""Sheared with its faces held at their distance: sigma is 0, and what holds is the residual cohesion. (It was 0.)"""
	O.reset()
	O.materials.append(BlockMat(label='rock', young=1e9, poisson=0, density=2000))
	model = BlockModel(thickness=1)
	for y in 0, 1:
		model.addRegion(rectangle(0, y, 1, y + 1), 'rock', zoneSize=1, zoning='regular')
	model.bond([JointMat(material1='rock', material2='rock', kn=1e10, ks=1e10, cohesion=1e5, tension=1e6, frictionAngle=0.5, cohesionResidual=3e4)])
	low, high = np.arange(model.firstNode[1]), np.arange(model.firstNode[1], model.nodeCount)
	model.drive('low', low, 'xy')
	model.drive('high', high, 'y')
	model.drive('shear', high, 'x', velocity=1e-3)
	model.insert()
	O.dt, O.engines = 1e-3, loopList(rescueFile='')
	O.run(100, True)
	assert (model.pointSigma == 0).all() and (np.abs(model.pointTau) == 3e4).all() and model.groupForce('shear') == pytest.approx(3e4, rel=1e-12)


def test_forceOfAGroupAlongTwoAxes():
	"""A block held in both directions, with a weight of 10 N per kg and a traction sideways of 5 N per kg."""
	model = oneBlock()
	model.drive('low', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
	model.gravity((-5, -10))
	model.insert()
	O.dt, O.engines = 1e-3, loopList(damping='local', alpha=0.5)
	loading.settle(model, ratio=1e-6)
	assert model.groupForce('low', axis='x') == pytest.approx(10000, rel=1e-4) and model.groupForce('low', axis='y') == pytest.approx(20000, rel=1e-4)
	said(['"low"', 'two forces', 'axis="x"'], lambda: model.groupForce('low')) # it was Fx + Fy
	said(["'z'"], lambda: model.groupForce('low', axis='z'))


# ---- blocks that nothing joins


def test_blocksWithoutBond():
	"""insert() without bond(): said once, with the blocks."""
	model = pair(joints=False)
	with pytest.warns(UserWarning, match=r'1 pair of blocks touches, or nearly, without a joint \(blocks 0 and 1, 0 m apart\)'):
		model.insert()


def test_regionAddedBehindBond():
	model = pair()
	model.addRegion(rectangle(0, 0.1, 0.1, 0.2), 'rock', zoneSize=0.05)
	with pytest.warns(UserWarning, match=r'blocks 0 and 2, 0 m apart\)'):
		model.insert()


@pytest.mark.parametrize('gap, told', [(1e-9, False), (1e-5, True), (3e-4, True), (2e-3, False)])
def test_gapsThatBondToNothing(gap, told, recwarn):
	"""Edges of 0.05 m, of which bond() takes 1e-6 as touching; a gap of 1e-5 m looks closed, one of 2 mm is meant."""
	pair(gap=gap).insert()
	messages = [str(warning.message) for warning in recwarn]
	assert len(messages) == told and all('blocks 0 and 1, %.3g m apart' % gap in message for message in messages), messages


def test_theModelOfASceneThatWasReplaced(tmp_path):
	"""It showed the old scene, and let itself be loaded."""
	model = inserted()
	O.run(10, True)
	O.save(str(tmp_path / 'a.yade'))
	O.run(10, True)
	here = np.array(model.velocity)
	O.load(str(tmp_path / 'a.yade'))
	for use in lambda: model.velocity, lambda: model.gravity((0, -9.81)), lambda: model.thickness, lambda: model.drive('a', [0], 'x'):
		said(['belongs to the scene that was there before', 'a.yade was loaded', 'O.bodies'], use)
	now = O.bodies[0].shape.model
	O.run(10, True)
	assert np.array_equal(now.velocity, here) # the loaded one goes on


def test_indicesBeyondAnInt():
	model = pair()
	said(['a', '2147483653'], lambda: model.drive('a', [2147483653], 'x'))
	said(['edge', str(2**32)], lambda: model.traction([2**32], (1, 0)))


# ---- rescue


@pytest.mark.parametrize('format', ['yade', 'yade.gz', 'yade.bz2', 'xml', 'xml.bz2'])
def test_aRescueFileThatCannotBeWritten(format, tmp_path):
	"""It never came to an end with .gz and .bz2."""
	model = inserted(contact=False)
	O.engines[-1].rescueFile, O.engines[-1].watchPeriod = str(tmp_path / 'nowhere' / ('unstable.' + format)), 10
	O.run(20, True)
	model.velocity[3] = float('nan')
	said(['unstable at step', 'not a number', 'could not be saved', 'nowhere'], lambda: O.run(50, True))


@pytest.mark.parametrize('options, reason', [('size=64k', 'No space left on device'), ('ro', 'Read-only file system')])
@pytest.mark.parametrize('format', ['yade', 'yade.gz', 'yade.bz2', 'xml', 'xml.bz2'])
def test_noRoomForTheRescueFile(format, options, reason, tmp_path, mounted):
	"""A disk that is full, and one that cannot be written to: the message comes all the same, and no piece of a file stays."""
	mounted(options)
	folder = tmp_path / 'out'
	if options != 'ro':
		with pytest.raises(OSError), open(folder / 'filler', 'wb', buffering=0) as file:
			while True:
				file.write(bytes(1024))
	before = os.listdir(folder)
	model = inserted(contact=False)
	O.engines[-1].rescueFile, O.engines[-1].watchPeriod = str(folder / ('unstable.' + format)), 10
	O.run(20, True)
	model.velocity[3] = float('nan')
	said(['unstable at step', 'not a number', 'could not be saved', reason], lambda: O.run(50, True))
	assert os.listdir(folder) == before


def test_noRoomForCracks(tmp_path, mounted):
	"""The list of cracks keeps the whole lines that it has, and the run ends with a sentence."""
	mounted('size=8k')
	folder = tmp_path / 'out'
	couplet()
	O.engines += [BlockCrackRecorder(fileName=str(folder / 'cracks.txt'))]
	with pytest.raises(OSError), open(folder / 'filler', 'wb', buffering=0) as file:
		while True:
			file.write(bytes(1024))
	said(['cannot write to', 'cracks.txt', 'No space left on device'], lambda: O.run(1700, True))
	assert (folder / 'cracks.txt').read_text() == ''


# ---- memory


def test_memoryComesBack():
	"""Twenty scenes of 400 blocks with contacts, one after the other: a scene more costs less than 5 % of what it needs. (It was 6.2 MB.)"""
	def resident():
		gc.collect()
		return int(open('/proc/self/statm').read().split()[1]) * os.sysconf('SC_PAGESIZE') / 1e6

	def scene():
		O.reset()
		O.materials.append(BlockMat(label='rock', young=1e9, poisson=0.2, density=2000))
		model = BlockModel(thickness=1)
		model.addVoronoi(rectangle(0, 0, 2, 2), 'rock', size=0.1, seed=1)
		model.bond([JointMat(material1='rock', material2='rock', kn=1e11, ks=5e10, bonded=False, frictionAngle=0.5)])
		model.insert()
		O.engines = loopList(contact=True, quasiStatic=False, damping='local', rescueFile='')
		O.run(20, True)
		assert model.blockCount > 350
		return resident()

	empty = resident()
	levels = [scene() for _ in range(20)]
	assert (levels[-1] - levels[4]) / 15 < max(0.05 * (levels[0] - empty), 0.3), [round(level - empty, 1) for level in levels]


# ---- contacts without a JointMat


def triangles(distance):
	O.reset()
	for label in 'rock', 'other':
		O.materials.append(BlockMat(label=label, young=1e9, poisson=0.2, density=2000))
	model = BlockModel(thickness=1)
	model.addRegion([(0, 0), (1, 0), (0, 1)], 'rock', zoneSize=1)
	low = 0.5 + distance / 2**0.5 # its edge is parallel to the first one's
	model.addRegion([(low + 0.5, low - 0.5), (low + 0.5, low + 0.5), (low - 0.5, low + 0.5)], 'other', zoneSize=1)
	model.bond([JointMat(material1='rock', material2='rock', kn=1e11, ks=5e10)])
	model.insert()
	O.engines = loopList(contact=True, damping='none', quasiStatic=False, rescueFile='')
	return model


def test_onlyWhatTouchesNeedsAJointMat():
	model = triangles(0.42)
	O.run(10, True)
	assert O.iter == 10
	model = triangles(0.01)
	O.run(1, True)
	model.velocity[model.firstNode[1]:] = -5, -5
	said(['no JointMat', '"other" and "rock"', 'pass through each other'], lambda: O.run(5000, True))
