# yade-blocks, GPL-2.0-or-later
"""What scripts may do that blocks would not notice, and runs that end wrong: each is refused, or said, in a sentence."""
import gc

import pytest

from processes import * # noqa: F401 (mounted)
from yadeblocks import loading
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
	1.13 to 7.5.)"""
	ratios = [thrown(v, start)[0] for start in (1, 4, 7)]
	assert all(abs(ratio - 1) < 0.02 for ratio in ratios), ratios
	assert max(ratios) - min(ratios) < 1e-9


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
	"""Gravity that is put on during the run is work of loads from then on."""
	model = inserted(contact=False)
	O.engines[-1].watchPeriod = watchPeriod
	O.run(150, True)
	model.gravity((0, -9.81))
	O.run(500, True)
	model.gravity((3, 5))
	O.run(500, True)
	assert 'from nowhere' not in capfd.readouterr().err


# ---- rest


def test_settleWaitsForTheRamp():
	"""A press in its ramp is not at rest, whatever the ratio. (It returned at 0.14 % of the force.)"""
	O.reset()
	O.materials.append(BlockMat(label='rock', young=1e9, poisson=0.2, density=2000))
	model = BlockModel(thickness=1)
	model.addRegion(rectangle(0, 0, 0.1, 0.1), 'rock', zoneSize=0.05)
	model.addRegion(rectangle(0, 0.1, 0.1, 0.2), 'rock', zoneSize=0.05)
	model.bond([JointMat(material1='rock', material2='rock', kn=1e11, ks=5e10, cohesion=1e6, tension=1e6, frictionAngle=0.5)])
	model.drive('low', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
	model.push('press', nodesWhere(model, lambda x, y: y > 0.2 - 1e-9), 'y', force=-1e4, rampTime=2)
	model.insert()
	O.dt, O.engines = 1e-3, loopList(damping='local', alpha=0.5)
	steps = loading.settle(model)
	assert steps >= 2000 and model.groupForce('low', axis='y') == pytest.approx(1e4, rel=1e-3)
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


def test_aFallIsNoRest():
	model = pair()
	model.gravity((0, -9.81))
	model.insert()
	O.dt, O.engines = 1e-5, loopList(damping='none')
	said(['settle', 'not below'], lambda: loading.settle(model, maxSteps=500))


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


def test_spheresBeside():
	"""Without interactions of blocks, an InteractionLoop of spheres is welcome."""
	inserted(interactions=False)
	O.engines = [spheres()] + O.engines
	O.run(5, True)
	assert O.iter == 5


def test_noMotion(capfd):
	inserted()
	O.engines = O.engines[:1]
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


def test_stressesOfASlidingJoint():
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
	for sigma in model.pointSigma, next(iter(O.interactions)).phys.sigma:
		assert np.mean(sigma) == pytest.approx(-1e6, rel=1e-2)


def test_forceOfAGroupAlongTwoAxes():
	"""A block held in both directions, with a weight of 10 N per kg and a traction sideways of 5 N per kg."""
	O.reset()
	O.materials.append(BlockMat(label='rock', young=1e9, poisson=0.2, density=2000))
	model = BlockModel(thickness=1)
	model.addRegion(rectangle(0, 0, 1, 1), 'rock', zoneSize=0.5)
	model.bond()
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
