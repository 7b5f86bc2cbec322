# yade-blocks, GPL-2.0-or-later
"""The model's arrays in Python: views of its own memory, that keep it alive."""
import gc

import pytest

from scenes import *

shapes = {
	'position displacement reference velocity force': ('nodeCount', 2),
	'mass inertia': ('nodeCount', ),
	'zoneNodes': ('zoneCount', 3),
	'zoneVolume': ('zoneCount', ),
	'firstNode firstZone firstEdge': ('blockCount + 1', ),
	'blockMaterial': ('blockCount', ),
	'edgeNodes': ('firstEdge[-1]', 2),
	'segmentNodes segmentParameters': ('contactCount / 2', 4),
	'segmentBlocks normal': ('contactCount / 2', 2),
	'segmentArea segmentName': ('contactCount / 2', ),
	'pointOpening pointSlip pointSigma pointTau pointStatus pointDamage': ('contactCount', ),
	'removedBlocks': (0, ), # none has been
}
names = [name for group in shapes for name in group.split()]
indices = 'zoneNodes firstNode firstZone firstEdge blockMaterial edgeNodes segmentNodes segmentBlocks removedBlocks segmentName'.split()
writable = ['displacement', 'velocity']
copies = ['position', 'normal', 'pointDamage', 'removedBlocks', 'segmentName'] # worked out when asked for


def test_shapesAsDocumented():
	m = couplet()
	O.run(5, True)
	for group, shape in shapes.items():
		for name in group.split():
			array = getattr(m, name)
			assert array.shape == tuple(
				eval(str(n), {}, {k: getattr(m, k) for k in 'nodeCount zoneCount blockCount contactCount firstEdge'.split()}) for n in shape
			), name
			assert array.dtype == (np.int32 if name in indices else np.uint8 if name == 'pointStatus' else np.float64), name
	assert m.zoneStress().shape == (m.zoneCount, 3) and m.contactPositions().shape == (m.contactCount, 2)


def test_noArrayIsForgotten():
	m = couplet()
	assert {name for name in dir(m) if isinstance(getattr(m, name), np.ndarray)} == set(names)


def test_whatTheArraysSay():
	m = couplet()
	assert np.array_equal(m.position, m.reference) and not m.velocity.any() and not m.pointStatus.any()
	a, b, c = (m.reference[m.zoneNodes[:, i]] for i in range(3))
	volume = 0.05 * np.cross(b - a, c - a) / 2
	np.testing.assert_allclose(m.zoneVolume, volume, rtol=1e-15 / 1e-3) # coordinates of 0.04 known to 1e-17, zones of more than 1e-3 m
	np.testing.assert_allclose(m.zoneVolume.sum(), 0.04 * 0.03 * 0.05, rtol=1e-12)
	density = np.array([dict(unit=1900, mortar=1250)[m.materialLabels[i]] for i in m.blockMaterial])
	blockVolume = np.add.reduceat(m.zoneVolume, m.firstZone[:-1])
	np.testing.assert_allclose(m.mass.sum(), density @ blockVolume, rtol=1e-13)
	np.testing.assert_allclose(np.hypot(*m.normal.T), 1, rtol=1e-15)
	# normals point out of the first block; the points lie where the parameters say
	a1, b1, a2, b2 = np.moveaxis(m.reference[m.segmentNodes], 1, 0)
	outward = np.column_stack([(b1 - a1)[:, 1], -(b1 - a1)[:, 0]])
	assert (np.sum(outward * m.normal, axis=1) > 0).all()
	s = m.segmentParameters
	here, there = a1 + s[:, :1] * (b1 - a1), a2 + s[:, 2:3] * (b2 - a2)
	np.testing.assert_allclose(here, there, atol=1e-6 * 6e-3) # bond's tolerance
	np.testing.assert_allclose(m.contactPositions()[::2], (here + there) / 2, atol=1e-17)
	# a layer of 10 mm between two bricks of 40 mm: the areas along the bricks add up
	unit = [i for i, label in enumerate(m.materialLabels) if label == 'unit'][0]
	along = (m.blockMaterial[m.segmentBlocks] == unit).any(axis=1)
	np.testing.assert_allclose(2 * m.segmentArea[along].sum(), 2 * 0.04 * 0.05, rtol=1e-12)


def test_writingChangesTheModel():
	m = couplet()
	O.run(100, True)
	m.velocity[:] = 0
	assert not m.velocity.any() and m.velocity.base is not None
	m.displacement[5] += (1e-6, 2e-6)
	there = m.displacement[5].copy()
	O.run(1, True)
	assert not np.array_equal(there, m.displacement[5]) and abs(m.force[5]).max() > 0
	# one array seen twice is one memory; it follows the run
	seen = m.displacement
	before = seen.copy()
	O.run(10, True)
	assert np.array_equal(seen, m.displacement) and not np.array_equal(seen, before) and np.shares_memory(seen, m.displacement)


@pytest.mark.parametrize('name', sorted(set(names) - set(writable) - set(copies)))
def test_whatAScriptMustNotWrite(name):
	"""An index out of range would crash the next step; what each step computes anew, or has used for something else, would be lost without a word."""
	with pytest.raises(ValueError, match='read-only'):
		getattr(couplet(), name)[0] = 1


def test_viewsKeepTheModelAlive():
	m = couplet()
	moved, status = m.displacement, m.pointStatus
	expected = moved.copy()
	del m
	O.reset()
	gc.collect()
	ballast = [np.ones(size) for size in range(50, 5000, 50)] # would take freed memory
	assert np.array_equal(moved, expected) and not status.any() and len(ballast)
	moved[:] = 3


def test_viewsOfAModelThatIsStillGrowing():
	"""Vectors move when they grow: what was shown before must neither dangle nor change."""
	materials()
	m = BlockModel()
	m.addRegion(rectangle(0, 0, 1, 1), 'unit', zoneSize=0.5)
	early = m.reference
	expected = early.copy()
	for i in range(1, 6):
		m.addRegion(rectangle(0, i, 1, i + 1), 'unit', zoneSize=0.1)
	gc.collect()
	ballast = [np.ones(early.size) for _ in range(100)]
	assert np.array_equal(early, expected) and len(ballast)


def test_emptyModel():
	m = BlockModel()
	for name in names:
		array = getattr(m, name)
		assert len(array) == (1 if name.startswith('first') else 0), name


def test_readingCostsNoCopy():
	m = couplet()
	O.run(1, True)
	for name in set(names) - set(copies):
		one, two = getattr(m, name), getattr(m, name)
		assert one.__array_interface__['data'][0] == two.__array_interface__['data'][0], name


def test_zoneQualityIsThatOfTheZones():
	"""A square with a point in its middle: four right isosceles triangles."""
	materials()
	model = BlockModel(thickness=0.1)
	with pytest.raises(RuntimeError, match='no zones'):
		model.zoneQuality()
	model.addRegion(rectangle(0, 0, 2, 2), 'unit', zoneSize=2, zoning='fan')
	q = model.zoneQuality()
	# angles to rounding; longest edge 2 by least height 1, and an equilateral triangle has 2/sqrt(3)
	assert q['minAngle'] == pytest.approx(np.pi / 4) and q['maxAngle'] == pytest.approx(np.pi / 2)
	assert q['minArea'] == pytest.approx(1) and q['maxArea'] == pytest.approx(1)
	assert q['worstAspect'] == pytest.approx(2 / (2 / np.sqrt(3)))
