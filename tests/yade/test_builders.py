# yade-blocks, GPL-2.0-or-later
"""Builders: blocks, areas and names of joints, against counting on paper and areas in closed form."""
import math

import numpy as np
import pytest

from scenes import *
from yadeblocks import jointsets, layout, outlines, pictures
from yadeblocks.brickwork import brickwork, englishBond, headerBond, runningBond, stackBond
from yadeblocks.jointsets import JointSet
from yadeblocks.results import Cracks
from yadeblocks.rubble import rubble
from yadeblocks.voussoirs import arch

dry = dict(kn=1e9, ks=1e9, bonded=False, frictionAngle=0.5)


def bonded(*layouts, rigid=True, thickness=0.3, more=()):
	"""A model with these layouts and rigid blocks with the outlines `more`; what was placed."""
	materials()
	model = BlockModel(thickness=thickness)
	placed = [some.addTo(model, 'unit', **(dict(rigid=True) if rigid else dict(zoneSize=0.2))) for some in layouts]
	for outline in more:
		model.addRigid(outline, 'mortar')
	present = set(model.materialLabels)
	model.bond([joint for joint in glued(**dry) if {joint.material1, joint.material2} <= present and (more or joint.material2 == 'unit')])
	return (model, *placed)


def lengths(model, joints):
	"""Length of each named group of joints, from the areas of their contact points [m]."""
	return {name: 2 * model.segmentArea[some].sum() / model.thickness for name, some in joints.items()}


@pytest.mark.parametrize('rigid', [True, False])
def test_runningBond(rigid):
	"""The wall of Ferris and Tin-Loi: courses of 6 blocks (half, 4 whole, half) and of 5; a bed joint between two halves of each brick."""
	wall = runningBond(bricks=5, courses=6, length=0.4, height=0.175, first='part')
	assert wall.counts == {'part': 6, 'whole': 27} and wall.bounds == pytest.approx((0, 0, 2, 1.05), abs=1e-12)
	model, placed = bonded(wall, rigid=rigid, more=[rectangle(-0.1, -0.1, 2.1, 0)])
	joints = placed.joints(model)
	assert {name: len(some) for name, some in joints.items() if name in ('bed', 'head', 'platen')
		} == ({'bed': 50, 'head': 27, 'platen': 6} if rigid else {name: len(some) for name, some in joints.items()} # zones divide the sides
			)
	assert lengths(model, joints) == pytest.approx({'bed': 5 * 2, 'head': 27 * 0.175, 'platen': 2}, rel=1e-9)
	assert sum(map(len, joints.values())) == len(model.segmentBlocks)
	assert len(placed.of('part')) == 6
	with pytest.raises(ValueError, match="no block of the kind 'half'; there are part, whole"):
		placed.of('half')


def test_namesReachProperties():
	"""Half of the joint's thickness on each side; joints in mid-brick; one call for a group."""
	wall = runningBond(bricks=2, courses=3, length=0.21, height=0.05, joint=0.01, crack=True)
	assert wall.counts == {'half': 10, 'part': 2} and wall.notes['coursing'] == pytest.approx(0.06)
	model, placed = bonded(wall)
	joints = placed.joints(model)
	assert lengths(model, joints) == pytest.approx({'bed': 2 * 0.44, 'head': 0.06 * (1 + 2 + 1), 'unit': 0.06 * 5}, rel=1e-9)
	model.setJoints(joints['unit'], kn=7e9)
	model.setJoints(joints['bed'], ks=3e9)
	properties = model.jointProperties
	assert set(np.flatnonzero(properties['kn'] == 7e9)) == set(joints['unit']) and set(np.flatnonzero(properties['ks'] == 3e9)) == set(joints['bed'])


def test_namesNeedJoints():
	materials()
	model = BlockModel(thickness=0.1)
	placed = stackBond(2, 2, 0.2, 0.1).addTo(model, 'unit', rigid=True)
	with pytest.raises(RuntimeError, match='bond'):
		placed.joints(model)


def test_otherBonds():
	stack, header = stackBond(3, 4, 0.2, 0.1), headerBond(3, 4, 0.1, 0.1)
	assert stack.counts == {'whole': 12} and header.counts == {'whole': 10, 'part': 4}
	assert header.bounds == pytest.approx((0, 0, 0.3, 0.4))
	english = englishBond(3, 2, 0.2, 0.1, 0.06, origin=(5, 7))
	assert english.counts == {'whole': 3 + 5, 'part': 2} and english.bounds == pytest.approx((5, 7, 5.6, 7.12))
	assert list(english.notes['courseOf']) == 3 * [0] + 7 * [1]
	third = runningBond(3, 2, 0.3, 0.1, offset=1 / 3)
	assert [round(1e3 * np.ptp(ring[:, 0])) for ring in third.outlines] == [300, 300, 300, 200, 300, 300, 100]


def test_openings():
	"""A door of one brick and a window of one and a half."""
	wall = runningBond(4, 6, 0.2, 0.1, openings=[(0.2, 0, 0.4, 0.2), (0.5, 0.3, 0.8, 0.5)])
	assert wall.areas.sum() == pytest.approx(0.8 * 0.6 - 0.2 * 0.2 - 0.3 * 0.2)
	for box, words in (((0.2, 0.05, 0.4, 0.2), 'begin and end at bed joints'), ((0.2, 0, 0.4, 0.8), 'lie in the wall'), ((0.21, 0, 0.4, 0.1),
																'piece of 10 mm')):
		with pytest.raises(ValueError, match=words):
			runningBond(4, 6, 0.2, 0.1, openings=[box])


@pytest.mark.parametrize(
	'change, words', [(dict(width=0), 'width must be positive'), (dict(courses=1.5), 'courses must be a whole number'),
				(dict(height=-1), 'height must be positive'), (dict(joint=-1), 'joint must not be negative'),
				(dict(pattern=[]), 'at least one course'), (dict(pattern=[(0.2, 1)]), r'shift must lie in \[0, 1\)'),
				(dict(least=0), 'least must lie'), (dict(width=1.01), 'piece of 10 mm')]
)
def test_impossibleWalls(change, words):
	with pytest.raises(ValueError, match=words):
		brickwork(**{**dict(width=1, courses=2, height=0.1, pattern=[(0.2, 0), (0.2, 0.5)]), **change})


def test_arch():
	"""Area of n voussoirs with straight sides: n sin(a) (Ro^2 - Ri^2) / 2, a the angle of one; with many chords that of the ring."""
	ring = arch(radius=2, thickness=0.3, count=9, angle=2.5, centre=(1, 3))
	assert ring.areas.sum() == pytest.approx(9 * math.sin(2.5 / 9) * (2.15**2 - 1.85**2) / 2, rel=1e-12)
	assert arch(2, 0.3, 9, 2.5, chords=50).areas.sum() == pytest.approx(2.5 * 2 * 0.3, rel=(2.5 / 450)**2 / 6 * 1.01)
	half = arch(2, 0.3, 9)
	assert half.bounds == pytest.approx((-2.15, 0, 2.15, 2.15 * math.cos(math.pi / 18))) # the crown is the middle of a chord
	model, placed = bonded(half, more=[rectangle(1.5, -0.2, 2.5, 0), rectangle(-2.5, -0.2, -1.5, 0)])
	joints = placed.joints(model)
	assert {name: len(some) for name, some in joints.items()} == {'platen': 2, 'radial': 8}
	assert lengths(model, joints) == pytest.approx({'platen': 0.6, 'radial': 8 * 0.3}, rel=1e-9)
	for change, words in ((dict(thickness=4), 'thickness'), (dict(count=0), 'count'), (dict(angle=7), 'angle')):
		with pytest.raises(ValueError, match='arch.' + words):
			arch(**{**dict(radius=2, thickness=0.3, count=9), **change})


def test_jointSets():
	"""Two sets at right angles: rows and columns on paper; a crack from corner to corner of one block parts that one."""
	sets = [JointSet('bedding', dip=0, spacing=1, through=(0.5, 0.5)), JointSet('cross', dip=90, spacing=1, through=(0.5, 0.5))]
	rock = jointsets.cut(rectangle(0, 0, 4, 3), sets, cracks={'fault': [(0.5, 0.5), (1.5, 1.5)]})
	assert rock.counts == {'block': 5 * 4 + 1} and rock.areas.sum() == pytest.approx(12) and rock.notes['lostLength'] == pytest.approx(0, abs=1e-9)
	model, placed = bonded(rock)
	assert lengths(model, placed.joints(model)) == pytest.approx({'bedding': 3 * 4, 'cross': 4 * 3, 'fault': math.sqrt(2)}, rel=1e-9)


def test_spacingAndDip():
	"""A set through a disc of many corners: the traces are `spacing` apart and dip as asked."""
	traces = jointsets.cut(rectangle(0, 0, 4, 3), [JointSet('bedding', dip=20, spacing=0.25)]).notes['traces']['bedding']
	direction = np.array([np.cos(np.radians(20)), np.sin(np.radians(20))])
	along = np.array([trace[1] - trace[0] for trace in traces])
	np.testing.assert_allclose(along / np.hypot(*along.T)[:, None], np.tile(direction, (len(traces), 1)), atol=1e-12)
	np.testing.assert_allclose(np.diff([trace[0] @ (-direction[1], direction[0]) for trace in traces]), 0.25, atol=1e-12)


def test_persistenceAndScatter():
	"""The share of the traces that is joint; mean and deviation of spacings; the same seed gives the same rock."""
	half = JointSet('some', dip=30, spacing=0.2, persistence=0.6, length=0.5)
	wide = jointsets.cut(rectangle(0, 0, 20, 20), [half])
	inside = sum(np.hypot(*(trace[1] - trace[0])) for trace in wide.notes['traces']['some'])
	full = sum(np.hypot(*(trace[1] - trace[0])) for trace in jointsets.cut(rectangle(0, 0, 20, 20), [half._replace(persistence=1)]).notes['traces']['some'])
	assert inside / full == pytest.approx(0.6, abs=0.5 / 0.6 / 57) # traces of 57 m, right to one joint and its gap
	assert wide.counts == {'block': 1} and wide.notes['lostLength'] > 0 # joints that end within the block do not part it
	spread = lambda seed: jointsets._tracesOf(JointSet('s', 0, 0.1, scatter=0.3, seed=seed), (0, 0, 100, 100))
	places = np.diff([trace.mean(axis=0)[1] for trace in spread(1)])
	lines = np.diff(sorted(trace.mean(axis=0)[1] for trace in spread(1)))
	assert lines.mean() == pytest.approx(0.1, rel=4 * 0.3 / 1000**0.5) and lines.std() == pytest.approx(0.03, rel=0.15) and len(places) > 900
	assert np.array_equal(spread(2), spread(2)) and not np.array_equal(spread(2)[:9], spread(1)[:9])


def test_smallBlocksJoin():
	sets = [JointSet('bedding', dip=0, spacing=1, through=(0, 0.05))]
	assert jointsets.cut(rectangle(0, 0, 1, 3), sets).counts == {'block': 4}
	joined = jointsets.cut(rectangle(0, 0, 1, 3), sets, least=0.1)
	assert joined.counts == {'block': 3} and joined.notes['merged'] == 1 and joined.areas.min() == pytest.approx(0.95)


@pytest.mark.parametrize('off', [0, 1.8e-15, -1.8e-15, 1e-13, -1e-13])
def test_linesThatMeetACorner(off):
	"""What rounding parts is one point: a line through a corner of the outline, and three through one point, leave no slivers."""
	cracks = {'rise': [(-1, -1 + off), (41, 41 + off)], 'fall': [(-1, 41), (41, -1 + off)], 'level': [(-1, 20 + off), (41, 20)]}
	for block in jointsets.cut(rectangle(0, 0, 40, 40), [JointSet('bed', dip=15, spacing=4, through=(off, 0))], cracks).outlines:
		assert np.hypot(*(np.roll(block, -1, axis=0) - block).T).min() > 1e-3, block
	materials()
	with pytest.raises(ValueError, match=r'vertices must be farther apart than 1.2e-07 m, got 1.8e-15 m .*leave one of the two out'):
		BlockModel().addRegion([(0, 0), (40, 0), (40, 20), (0, 20), (0, 1.8e-15)], 'unit', 4)


def test_impossibleCuts():
	box = rectangle(0, 0, 1, 1)
	for outline, sets, cracks, words in (([(0, 0), (1, 1), (1, 0),
						(0, 1)], [], {}, 'simple polygon'), (box, [
							JointSet('a', 0, 0)
						], {}, 'spacing must be positive'), (box, [
							JointSet('a', 0, 1, persistence=2)
						], {}, 'persistence must lie'), (box, 2 * [JointSet('a', 0, 1)], {}, 'given once'),
						(box, [JointSet('a', 0, 1)], {'a': [(0, 0), (1, 1)]}, 'given once')):
		with pytest.raises(ValueError, match=words):
			jointsets.cut(outline, sets, cracks)


# ---- mortar, rubble, names


def test_mortarBetweenBricks():
	"""Areas on paper: sides within stand back by half a joint, those outside and at the opening stay; nothing overlaps, nothing is missing."""
	gap, hole = 0.01, (0.11, 0.062, 0.33, 0.124)
	wall = runningBond(2.5, 4, 0.21, 0.052, gap, openings=[hole])
	both = layout.Mortared(wall, gap)
	mortar = sum(layout.area(layout.counterClockwise(ring)) - sum(abs(layout.area(hole)) for hole in holes) for ring, holes in both.mortar)
	beds, heads = 0.33 + 0.33 + 0.55, 0.062 + 3 * 0.057 + 0.052 + 0.057 # lengths; heads end at beds, of which there are none at the opening
	assert both.blocks.areas.sum() + mortar == pytest.approx(wall.areas.sum(), abs=1e-9)
	assert both.blocks.counts == wall.counts and mortar == pytest.approx(gap * (beds + heads) + 4 * (gap / 2)**2, abs=1e-9) # corners at the opening
	model = BlockModel(thickness=0.1)
	materials()
	placed = both.addTo(model, 'unit', 'mortar', zoneSize=0.03, size=6e-3, seed=2)
	model.bond(strong())
	pairs = np.asarray(model.blockMaterial)[np.asarray(model.segmentBlocks)]
	unit = model.materialLabels.index('unit')
	assert not (pairs == unit).all(axis=1).any() and set(placed.joints(model)) == {'mortar'} # mortar everywhere
	assert float(np.sum(model.zoneVolume)) == pytest.approx(0.1 * wall.areas.sum(), rel=1e-6)
	with pytest.raises(ValueError, match='Mortared.gap must leave something'):
		layout.Mortared(wall, 0.2)
	with pytest.raises(ValueError, match='Mortared.gap must be positive, got 0'):
		layout.Mortared(wall, 0)


def test_partsOfABrickStayTogether():
	wall = runningBond(2, 2, 0.21, 0.052, 0.01, crack=True)
	model = BlockModel(thickness=0.1)
	materials()
	placed = layout.Mortared(wall, 0.01).addTo(model, 'unit', 'mortar', zoneSize=0.06, size=6e-3)
	model.bond(strong())
	assert lengths(model, {'unit': placed.joints(model)['unit']})['unit'] == pytest.approx(3 * (0.062 - 0.005), rel=1e-9) # bed joints on one side


def test_rubble():
	"""Areas and sizes; flat stones are wider than high by what was asked for, within what 60 stones scatter; the same seed gives the same stones."""
	stones = rubble(rectangle(0, 0, 2, 1), size=0.18, seed=3, flatness=2)
	assert stones.areas.sum() == pytest.approx(2) and np.sqrt(stones.areas.mean()) == pytest.approx(0.18, rel=0.02)
	wide, high = np.array([np.ptp(ring, axis=0) for ring in stones.outlines]).mean(axis=0)
	assert wide / high == pytest.approx(2, rel=0.15)
	again = rubble(rectangle(0, 0, 2, 1), size=0.18, seed=3, flatness=2)
	assert all(np.array_equal(a, b) for a, b in zip(stones.outlines, again.outlines))
	model, placed = bonded(stones)
	assert set(placed.joints(model)) == {'stone'}
	round_ = layout.Mortared(rubble(rectangle(0, 0, 1, 0.6), 0.2, holes=[rectangle(0.4, 0.2, 0.5, 0.3)]), 0.01)
	model = BlockModel(thickness=0.1)
	materials()
	round_.addTo(model, 'unit', 'mortar', zoneSize=0.1, size=0.01)
	model.bond(strong())
	assert float(np.sum(model.zoneVolume)) == pytest.approx(0.1 * (0.6 - 0.01), rel=1e-6)
	for change, words in ((dict(size=-1), 'rubble.size must be positive'), (dict(lloyd=-1), 'rubble.lloyd'), (dict(flatness=0), 'rubble.flatness')):
		with pytest.raises(ValueError, match=words):
			rubble(rectangle(0, 0, 1, 1), **{**dict(size=0.3), **change})


def test_namesInBondResultsAndPictures(tmp_path):
	"""Properties by name at bond(); cracks are counted and drawn by name."""
	wall = runningBond(2, 2, 0.2, 0.1, crack=True)
	model = BlockModel(thickness=0.1)
	materials()
	placed = wall.addTo(model, 'unit', zoneSize=0.1)
	joints = placed.bond(model, strong()[:1], head=dict(tension=1e3, cohesion=2e3), unit=dict(kn=1e13))
	properties = model.jointProperties
	assert (properties['tension'][joints['head']] == 1e3).all() and (properties['tension'][joints['bed']] == 1e15).all()
	assert (properties['kn'][joints['unit']] == 1e13).all() and (properties['kn'][joints['head']] < 1e13).all()
	ends = np.asarray(model.reference)
	model.drive('left', np.flatnonzero(ends[:, 0] < 1e-9), 'xy')
	model.drive('right', np.flatnonzero(ends[:, 0] > 0.4 - 1e-9), 'x', velocity=1e-4)
	model.insert()
	O.dt, O.engines = 1e-3, [BlockLoop(), BlockMotion()]
	O.run(60, True)
	counts = Cracks(model, joints).counts()
	assert set(counts) == {'bed', 'head', 'unit'} and counts['head']['tension'] > 0 and not any(counts['bed'].values()) and not any(counts['unit'].values())
	assert Cracks(model, joints).share('head') == 1 and set(Cracks(model, {}).counts()) == {'unit-unit'}
	assert Cracks(model).counts() == counts # names are kept in the model
	assert pictures.drawCracks(tmp_path / 'a.png', model, names=joints).stat().st_size > 5000
	model = BlockModel(thickness=0.1)
	placed = wall.addTo(model, 'unit', zoneSize=0.1)
	with pytest.raises(ValueError, match="no joint has the name 'heads'; there are bed, head, unit"):
		placed.bond(model, strong()[:1], heads=dict(tension=1e3))


# ---- drawings


def test_csv(tmp_path):
	(tmp_path / 'a.csv').write_text('# mm\n0,0,left\n0,10,left\n10,0,left\n20,0,right\n30,0,right\n30,10,right\n\n40,0,right\n50,0,right\n50,10,right\n')
	found = outlines.read(tmp_path / 'a.csv', unit=1e-3)
	assert [some.name for some in found] == ['left', 'right', 'right'] and [layout.area(some.ring) for some in found] == pytest.approx(3 * [50e-6])
	(tmp_path / 'b.csv').write_text('0,zero\n')
	with pytest.raises(ValueError, match='line 1 of b.csv must be x,y'):
		outlines.read(tmp_path / 'b.csv')
	(tmp_path / 'c.csv').write_text('# nothing\n')
	with pytest.raises(ValueError, match='c.csv has no closed polygon'):
		outlines.read(tmp_path / 'c.csv')
	with pytest.raises(ValueError, match='must end in one of .csv .dxf .svg'):
		outlines.read(tmp_path / 'd.dwg')


def test_dxf(tmp_path):
	"""A square with one side bulged to a half circle, and a circle; chords within the sagitta, so areas within sagitta times perimeter."""
	import ezdxf
	drawing = ezdxf.new()
	space = drawing.modelspace()
	space.add_lwpolyline([(0, 0, 0), (2, 0, 1), (2, 2, 0), (0, 2, 0)], format='xyb', close=True, dxfattribs=dict(layer='stone'))
	space.add_circle((5, 5), 1)
	drawing.saveas(tmp_path / 'a.dxf')
	stone, disc = outlines.read(tmp_path / 'a.dxf', unit=0.1, sagitta=1e-4)
	assert stone.name == 'stone' and layout.area(stone.ring) == pytest.approx(0.01 * (4 + math.pi / 2), abs=1e-4 * 0.1 * math.pi)
	assert layout.area(disc.ring) == pytest.approx(0.01 * math.pi, abs=1e-4 * 0.2 * math.pi) and disc.ring.mean(axis=0) == pytest.approx((0.5, 0.5),
																		abs=1e-3)
	space.add_lwpolyline([(0, 0), (1, 0), (1, 1)])
	drawing.saveas(tmp_path / 'b.dxf')
	with pytest.raises(ValueError, match='open polyline on layer 0'):
		outlines.read(tmp_path / 'b.dxf')


def test_svg(tmp_path):
	"""A turned rectangle, a circle and a path of two triangles; y points down in the file."""
	(tmp_path / 'a.svg').write_text(
		'<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100"><g transform="translate(10,20)"><rect id="brick" width="30" height="10"'
		' transform="rotate(90)"/></g><circle cx="50" cy="50" r="10"/><path d="M 0 0 L 10 0 L 0 20 Z M 60 0 h 10 v 10 z"/></svg>'
	)
	brick, disc, first, second = outlines.read(tmp_path / 'a.svg', unit=1e-2, sagitta=1e-4)
	assert brick.name == 'brick' and layout.area(brick.ring) == pytest.approx(0.03)
	assert (*brick.ring.min(axis=0), *brick.ring.max(axis=0)) == pytest.approx((0, -0.5, 0.1, -0.2))
	assert layout.area(disc.ring) == pytest.approx(math.pi * 1e-2, abs=1e-4 * 0.2 * math.pi)
	assert [layout.area(some.ring) for some in (first, second)] == pytest.approx([0.01, 0.005]) and first.ring.min() == pytest.approx(-0.2)
	(tmp_path / 'b.svg').write_text('<svg xmlns="http://www.w3.org/2000/svg"><path d="M 0 0 L 10 0 L 0 20"/></svg>')
	with pytest.raises(ValueError, match='open path'):
		outlines.read(tmp_path / 'b.svg')
