# yade-blocks, GPL-2.0-or-later
"""YADE's own InteractionLoop for what it is there for: a Law2 of one's own, and spheres beside deformable blocks in one scene."""
import pytest

import ownlaws
from scenes import *
from test_step import scene


def interactionLoop():
	return next(engine for engine in O.engines if isinstance(engine, InteractionLoop))


def saveAndLoad(path):
	O.save(str(path))
	O.reset()
	O.load(str(path))


# ---- a Law2 of one's own, see OwnLaws.cpp


def cut(kind, native):
	"""Joints with a tension cut-off and no friction, by a Law2 or by a law on ranges."""
	m = scene(kind, native=native)
	if native:
		loop = interactionLoop()
		loop.lawDispatcher.functors = [Law2_BlockGeom_JointPhys_CutOff()]
	else:
		O.engines[0].law = CutOffLaw()
	return m


@ownlaws.built
@pytest.mark.parametrize('kind', ['tension', 'shear'])
def test_aForeignLaw2(kind, tmp_path):
	"""The bits of the same arithmetic as BlockLoop.law, saved in the middle or not. Joints break, and with general contact (shear) their edges become free
	contacts."""
	flat = cut(kind, native=False)
	O.run(3000, True)
	expected = flat.fingerprint()
	broken, touching = (np.array(flat.pointStatus) > 0).sum(), len(flat.freeContacts()['blocks'])
	assert broken > 5 and (touching > 0) == (kind != 'tension')
	native = cut(kind, native=True)
	O.run(1737, True)
	saveAndLoad(tmp_path / 'middle.yade.bz2')
	assert [type(law).__name__ for law in interactionLoop().lawDispatcher.functors] == ['Law2_BlockGeom_JointPhys_CutOff']
	O.run(3000 - 1737, True)
	assert model().fingerprint() == expected
	native = cut(kind, native=True)
	O.run(3000, True)
	assert native.fingerprint() == expected and native.freeContacts()['blocks'].shape == (touching, 2)


@ownlaws.built
def test_aForeignLaw2OnTwoThreads(tmp_path):
	"""InteractionLoop takes pairs in any order; the bits are the same."""
	bits = []
	for threads in 1, 2:
		script = "import test_native as t\nm = t.cut('shear', native=True)\nt.O.run(2000, True)\nprint('result', t.O.numThreads, m.fingerprint())\n"
		run = runYade(script, threads=threads, cwd=tmp_path)
		assert run.returncode == 0 and f'result {threads} ' in run.stdout, run.stdout[-1000:] + run.stderr[-2000:]
		bits.append(run.stdout.split('result')[1].split()[1])
	assert bits[0] == bits[1]


@ownlaws.built
@pytest.mark.parametrize('kind', ['tension', 'shear'])
def test_itsAccounts(kind):
	"""What such a law dissipates is booked from one step to the next, as with BlockLoop.law."""
	sums = []
	for native in False, True:
		m = cut(kind, native)
		O.trackEnergy = True
		O.run(3000, True)
		sums.append({name: value for name, value in O.energy.items() if name.startswith('block')})
		sums[-1]['bits'] = m.fingerprint()
	assert sums[0].pop('blockJoints') == pytest.approx(sums[1].pop('blockJoints'), rel=1e-13)
	assert sums[0] == sums[1] and sums[0]['blockFracture'] > 0


# ---- spheres beside deformable blocks

blocksMask, spheresMask = 1, 2
far = 1.0 # [m], from the blocks


def addSpheres():
	"""Five that are held, as a bowl, and three that fall into it; far from the blocks."""
	O.materials.append(FrictMat(label='steel', young=1e6, poisson=0.3, frictionAngle=0.4, density=2600))
	bowl = [(-0.16, 0.1), (-0.09, 0.02), (0, 0), (0.09, 0.02), (0.16, 0.1)]
	for (x, y), fixed in [*((place, True) for place in bowl), ((0.01, 0.12), False), ((-0.02, 0.23), False), ((0.03, 0.34), False)]:
		O.bodies.append(utils.sphere((far + x, y, 0), 0.05, material='steel', fixed=fixed, mask=spheresMask))


def spheresMove():
	"""All that a sphere has of motion, as bits."""
	rows = []
	for body in O.bodies:
		if not isinstance(body.shape, Sphere): continue
		s = body.state
		rows.append([*s.pos, *s.vel, *s.angVel, *(s.ori[i] for i in range(4))])
	return np.array(rows)


def withSpheres(kind, boxes=False, joints=None):
	"""The scene of test_step under YADE's InteractionLoop, and spheres. boxes: whether the collider knows blocks, too."""
	m = scene(kind, native=True, joints=joints)
	addSpheres()
	loop, front = interactionLoop(), [engine for engine in O.engines if isinstance(engine, BlockContacts)]
	geom, phys, law = loop.geomDispatcher.functors, loop.physDispatcher.functors, loop.lawDispatcher.functors
	bounds = [Bo1_Sphere_Aabb()] + ([Bo1_Block_Aabb()] if boxes else [])
	behind = [engine for engine in O.engines if engine.__class__ in (BlockTimeStepper, BlockForces)]
	O.engines = [
		ForceResetter(),
		InsertionSortCollider(bounds, verletDist=0.01), *front,
		InteractionLoop(geom + [Ig2_Sphere_Sphere_ScGeom()], phys + [Ip2_FrictMat_FrictMat_FrictPhys()], law + [Law2_ScGeom_FrictPhys_CundallStrack()]),
		*behind,
		GravityEngine(gravity=(0, -9.81, 0), mask=spheresMask),
		NewtonIntegrator(damping=0.1), O.engines[-1]
	]
	return m


def spheresAlone():
	O.reset()
	addSpheres()
	O.dt = 5e-4
	O.engines = [
		ForceResetter(),
		InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0.01),
		InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
		GravityEngine(gravity=(0, -9.81, 0), mask=spheresMask),
		NewtonIntegrator(damping=0.1)
	]


@pytest.mark.parametrize('kind, boxes', [('tension', False), ('shear', False), ('shear', True), ('compression', False), ('compression', True)])
def test_spheresBesideBlocks(kind, boxes, tmp_path):
	"""Spheres and blocks know nothing of each other: the bits of either are those of a scene of its own, saved in the middle or not."""
	spheresAlone()
	O.run(3000, True)
	moved = spheresMove()
	assert sum(i.isReal for i in O.interactions) >= 4 and abs(moved[:, 8]).max() > 0 # they have met, and turned
	alone = scene(kind, native=True)
	O.run(3000, True)
	expected = alone.fingerprint()
	assert (np.array(alone.pointStatus) > 0).sum() > 5
	both = withSpheres(kind, boxes)
	O.run(3000, True)
	assert both.fingerprint() == expected and np.array_equal(spheresMove(), moved)
	withSpheres(kind, boxes)
	O.run(1737, True)
	saveAndLoad(tmp_path / 'middle.yade.bz2')
	O.run(3000 - 1737, True)
	assert model().fingerprint() == expected and np.array_equal(spheresMove(), moved)


def test_spheresBesideBlocksOfBlockLoop():
	"""The same spheres where BlockLoop steps the blocks: these leave O.interactions to the spheres."""
	spheresAlone()
	O.run(1000, True)
	moved = spheresMove()
	alone = scene('shear')
	O.run(1000, True)
	expected = alone.fingerprint()
	both = scene('shear', interactions=False)
	addSpheres()
	loop, motion = O.engines
	spheresAlone_ = [
		InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0.01),
		InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()])
	]
	gravity = GravityEngine(gravity=(0, -9.81, 0), mask=spheresMask)
	O.engines = [ForceResetter(), *spheresAlone_, loop, gravity, NewtonIntegrator(damping=0.1), motion]
	O.run(1000, True)
	assert both.fingerprint() == expected and np.array_equal(spheresMove(), moved)


def test_aColliderWithBlocks():
	"""Blocks in a collider need BlockContacts: said, not ignored."""
	withSpheres('tension', boxes=True)
	with pytest.raises(RuntimeError, match='a collider has found blocks .* near each other: O.engines needs BlockContacts'):
		O.run(10, True)


def falling(kind, mask, boxes):
	"""A sphere above the blocks that falls onto them."""
	m = withSpheres(kind, boxes)
	height = np.array(m.position)[:, 1].max()
	ball = O.bodies[O.bodies.append(utils.sphere((0.02, height + 0.06, 0), 0.05, material='steel', mask=mask))]
	return m, ball, height


@pytest.mark.parametrize('boxes', [False, True], ids=['collider without blocks', 'collider with blocks'])
def test_aSphereThatFallsOntoABlock(boxes):
	"""YADE's rule: a pair of shapes without a functor has no interaction. The sphere falls through, as freely as through nothing; the blocks feel nothing.
	With general contact a sphere whose mask is a block's is refused."""
	kind = 'shear' if boxes else 'tension'
	alone = scene(kind, native=True)
	O.run(600, True)
	expected = alone.fingerprint()
	m, ball, height = falling(kind, spheresMask if boxes else blocksMask | spheresMask, boxes)
	O.run(600, True)
	# NewtonIntegrator (damping 0.1): a = 0.9 g, leap-frog from rest: y = a dt^2 n (n + 1)/2
	assert height + 0.06 - ball.state.pos[1] == pytest.approx(0.9 * 9.81 * O.dt**2 * 600 * 601 / 2, rel=1e-12) # 600 roundings of 0.1 m
	assert ball.state.pos[1] + 0.05 < 0 and m.fingerprint() == expected # it is below them now
	if not boxes: return
	falling(kind, blocksMask, boxes)
	with pytest.raises(RuntimeError, match='is a Sphere, which blocks cannot touch: use BlockModel.addRigid, or give it a mask that no block has'):
		O.run(1, True)
