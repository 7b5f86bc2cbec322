# yade-blocks, GPL-2.0-or-later
"""The step over flat arrays: the same bits as through YADE's InteractionLoop, on any number of threads, and after saving in the middle; and the bits
that it had when this was written."""
import numpy as np
import pytest

import yadeblocks # noqa: F401 (it loads the plugin)
from yade import *
from yadeblocks.engines import engineList, loopList
from yadeblocks.specimen import nodesWhere, rectangle

from scenes import glued, materials


def scene(kind, native=False, energy=False, interactions=True, joints=None):
	"""A couplet of 40 x 50 mm with 13 mortar blocks: pulled, sheared under pressure, or crushed, until joints have broken."""
	materials()
	model = BlockModel(thickness=0.05)
	model.addVoronoi(rectangle(0, 0.01, 0.04, 0.02), 'mortar', size=6e-3, seed=3)
	model.addRegion(rectangle(0, 0, 0.04, 0.01), 'unit', zoneSize=5e-3)
	model.addRegion(rectangle(0, 0.02, 0.04, 0.03), 'unit', zoneSize=5e-3)
	properties = joints or (glued(cohesion=0.3e6, dilationAngle=0) if kind == 'compression' else glued(cohesion=0.6e6))
	model.bond([] if native and not joints else properties)
	top = nodesWhere(model, lambda x, y: y > 0.03 - 1e-9)
	model.drive('bottom', nodesWhere(model, lambda x, y: y < 1e-9), 'xy')
	if kind == 'tension': model.drive('top', top, 'y', velocity=8e-6, rampTime=0.075)
	if kind == 'compression': model.drive('top', top, 'y', velocity=-5e-4, rampTime=0.075)
	if kind == 'shear':
		model.push('press', top, 'y', force=-1000, rampTime=0.1)
		model.drive('top', top, 'x', velocity=1e-3, startTime=0.1, rampTime=0.1)
	model.insert(interactions)
	contact = kind != 'tension'
	O.trackEnergy = energy
	O.dt = 5e-4
	motion = dict(alpha=0.3, rescueFile='')
	O.engines = engineList([] if joints else properties, contact=contact, **motion) if native else loopList(contact=contact, **motion)
	return model


kinds = pytest.mark.parametrize('kind', ['tension', 'shear', 'compression'])

# Fingerprints of the state after 3000 steps, on any x86-64 processor. They change only where CHANGELOG says that bits have moved.
golden = {'tension': 'e383eccb14868e8a', 'shear': 'b83ba0d7b99e5194', 'compression': 'ebb262bb8bc3755e'}


@kinds
def test_interactionLoopHasTheSameBits(kind):
	flat = scene(kind)
	O.run(3000, True)
	assert (flat.pointStatus > 0).sum() > 5 # there is something to compare
	expected = flat.fingerprint(), np.array(flat.force)
	native = scene(kind, native=True)
	O.run(3000, True)
	assert native.fingerprint() == expected[0] and np.array_equal(native.force, expected[1])


@kinds
def test_accountsAreTheSame(kind):
	sums = []
	for native in False, True:
		model = scene(kind, native, energy=True)
		O.run(3000, True)
		sums.append({name: value for name, value in O.energy.items() if name.startswith('block')})
		sums[-1]['bits'] = model.fingerprint()
	flat, native = sums
	assert flat.pop('blockJoints') == pytest.approx(native.pop('blockJoints'), rel=1e-13) # summed in another order
	assert flat == native and flat['blockFracture'] > 0


@kinds
def test_savedInTheMiddle(kind, tmp_path):
	whole = scene(kind)
	O.run(3000, True)
	expected = whole.fingerprint()
	scene(kind)
	O.run(1737, True)
	O.save(str(tmp_path / 'middle.yade.bz2'))
	O.reset()
	O.load(str(tmp_path / 'middle.yade.bz2'))
	O.run(3000 - 1737, True)
	model = next(b.shape.model for b in O.bodies)
	assert model.fingerprint() == expected


@kinds
def test_goldenFingerprints(kind):
	model = scene(kind)
	O.run(3000, True)
	broken, free = np.count_nonzero(model.pointStatus), 2 * np.count_nonzero(model.segmentArea == 0)
	assert 5 < broken - free and (free > 0 or kind == 'tension') # joints that stay and some that have become free contacts
	assert kind == 'tension' or len(model.freeContacts()['blocks']) > 0 # which touch
	assert model.fingerprint() == golden[kind]


def test_propertiesByJoint():
	"""Columns in, columns out; the weaker joints break."""
	model = scene('tension')
	weak = np.arange(0, model.contactCount // 2, 3)
	model.setJoints(weak, tension=1e4, frictionAngle=np.full(len(weak), 0.8))
	properties = model.jointProperties
	assert (properties['tension'][weak] == 1e4).all() and np.count_nonzero(properties['tension'] == 1e4) == len(weak)
	np.testing.assert_allclose(properties['frictionAngle'][weak], 0.8, rtol=1e-15)
	while not model.pointStatus.any():
		O.run(50, True)
		assert O.iter < 3000
	broken = np.unique(np.flatnonzero(model.pointStatus) // 2)
	assert set(broken) <= set(weak)


@pytest.mark.parametrize(
	'change, words', [(dict(kn=-1.), ['kn', 'positive', '-1']), (dict(stiffness=1.), ['stiffness', 'kn']),
				(dict(joints=[10**6], kn=1.), ['joint', '1000000']), (dict(cohesion=[1., 2.]), ['cohesion', 'one number'])]
)
def test_impossiblePropertiesChangeNothing(change, words):
	model = scene('tension')
	before = model.jointProperties
	with pytest.raises(ValueError) as caught:
		model.setJoints(**change)
	assert all(word in str(caught.value) for word in words), caught.value
	after = model.jointProperties
	assert all(np.array_equal(before[name], after[name]) for name in before)


def test_bondRefuses():
	materials()
	model = BlockModel(thickness=0.05)
	model.addRegion(rectangle(0, 0, 1, 1), 'unit', zoneSize=1)
	model.addRegion(rectangle(0, 1, 1, 2), 'mortar', zoneSize=1)
	joint = dict(kn=1e9, ks=1e9)
	with pytest.raises(ValueError, match='no JointMat for the pair of materials "mortar" and "unit"'):
		model.bond([JointMat(material1='unit', material2='unit', **joint)])
	with pytest.raises(ValueError, match='"clay", which no block has'):
		model.bond([JointMat(material1='unit', material2='mortar', **joint), JointMat(material1='clay', material2='mortar', **joint)])
	assert model.contactCount == 0
	assert model.bond([JointMat(material1='unit', material2='mortar', **joint)]) == 1


def test_elasticJumpNeedsNoFirstStep():
	model = scene('tension')
	assert model.elasticJump()['time'] > 0
	O.run(10, True)


def test_withoutInteractions():
	model = scene('shear')
	assert len(O.interactions) > 0
	O.run(1500, True)
	expected = model.fingerprint()
	bare = scene('shear', interactions=False)
	O.run(1500, True)
	assert bare.fingerprint() == expected and len(O.interactions) == 0


def test_aLawInNumpy():
	"""Elastic joints written in numpy: the same forces as joints that are too strong to break, to rounding."""
	def elastic(columns):
		properties = model.jointProperties
		columns['sigma'][:] = np.repeat(properties['kn'], 2) * columns['opening']
		columns['tau'][:] = np.repeat(properties['ks'], 2) * columns['slip']

	model = scene('tension')
	model.setJoints(cohesion=1e15, tension=1e15)
	O.run(500, True)
	expected = np.array(model.velocity)
	model = scene('tension')
	O.engines[0].law = NumpyLaw(elastic)
	O.run(500, True)
	np.testing.assert_allclose(model.velocity, expected, atol=1e-12 * abs(expected).max())
	O.engines[0].law = NumpyLaw()
	with pytest.raises(RuntimeError, match='NumpyLaw.function is None'):
		O.run(1, True)


def test_farFromTheOrigin():
	"""Surveyors' coordinates: what moves 4e-10 m in a step does move, and forces are those at the origin to the rounding of the corners."""
	forces = []
	for x, y in ((0, 0), (5e5, 5.6e6)):
		materials()
		model = BlockModel(thickness=1)
		model.addRegion(rectangle(x, y, x + 1, y + 1), 'unit', zoneSize=0.5)
		model.bond()
		model.drive('base', nodesWhere(model, lambda _, h: h < y + 1e-6), 'xy')
		model.drive('top', nodesWhere(model, lambda _, h: h > y + 1 - 1e-6), 'y', velocity=4e-4)
		model.insert()
		O.dt = 1e-6
		O.engines = loopList(alpha=0.3, rescueFile='')
		O.run(1000, True)
		moved = model.displacement[nodesWhere(model, lambda _, h: h > y + 1 - 1e-6), 1]
		np.testing.assert_allclose(moved, model.groupTravelled('top'), rtol=1e-12)
		forces.append(model.groupForce('top'))
	# corners are known to 5.6e6 x 2e-16 = 1e-9 m of 0.5 m
	assert forces[1] == pytest.approx(forces[0], rel=1e-7) and forces[0] > 0
