# yade-blocks, GPL-2.0-or-later
"""Rigid platens that are driven: ramp, servo and jump, as groups of grid points have them; and handles of such groups."""
import pytest

from scenes import *
from yadeblocks.engines import loopList
from yadeblocks.platen import Platen

firm = dict(kn=400e9, ks=200e9, frictionAngle=0.6)
width, height, thickness = 0.4, 0.5, 0.2


def between(velocity, **arguments):
	"""A block of 'unit' glued to a held rigid platen below and a driven one above: model, Platen."""
	O.reset()
	O.materials.append(BlockMat(label='unit', young=16.7e9, poisson=0, density=1900))
	O.materials.append(BlockMat(label='steel', young=210e9, poisson=0.3, density=7800))
	model = BlockModel(thickness=thickness)
	model.addRegion(rectangle(0, 0, width, height), 'unit', zoneSize=0.25, zoning='regular')
	low = model.addRigid(rectangle(-0.1, -0.1, 0.5, 0), 'steel')
	high = model.addRigid(rectangle(0, height, width, 0.6), 'steel')
	model.bond([JointMat(material1='unit', material2='steel', cohesion=2e6, tension=1e6, **firm)])
	model.insert()
	O.dt, O.engines = 1e-3, loopList(newton=dict(damping=0), alpha=0.5, rescueFile='')
	O.bodies[model.bodyOf(low)].state.blockedDOFs = 'xyzXYZ'
	platen = Platen(model, high, velocity, **arguments)
	O.engines = [platen.engine()] + O.engines
	return model, platen


def test_rampIsThatOfAGroup():
	"""A smooth start of 0.2 s, x x (3 - 2 x), taken at the middles of the steps: the way is half the ramp, then the velocity goes on. A driven
	group beside it goes the same way."""
	v, n = -1e-5, 200
	model, platen = between((0, v), rampTime=n * 1e-3)
	O.run(50, True)
	x = 49.5 / n # of the last step
	assert platen.body.state.vel[1] == pytest.approx(v * x * x * (3 - 2 * x), rel=1e-12)
	O.run(n + 50, True)
	assert platen.displacement == pytest.approx((0, v * (n * 1e-3 / 2 + 0.1)), rel=1e-6, abs=1e-16) # the midpoint rule errs by 1/(4 n^2) of x^2 (3 - 2 x)
	O.engines[0].dead = True
	platen.body.state.vel = (0, 0, 0)
	O.run(4000, True)
	spring = height / 16.7e9 + 2 / firm['kn'] # springs in a row [m/Pa]
	assert platen.force == pytest.approx((0, platen.displacement[1] / spring * width * thickness), rel=1e-6, abs=1e-2)


def test_jumpOfAPlaten():
	"""Pulled up: both joints stand at 0.97 of their strength, sigma = 0.97 ft, behind the jump, and a ramp is over; at the next 3 % they fail."""
	v = 1e-5
	model, platen = between((0, v), rampTime=1)
	jump = platen.jump()
	spring = height / 16.7e9 + 2 / firm['kn']
	assert jump['time'] == pytest.approx(0.97 * 1e6 * spring / v, rel=1e-9)
	O.run(1, True)
	assert platen.force[1] == pytest.approx(0.97e6 * width * thickness, rel=1e-3) and not model.pointStatus.any() # one step of 309 went by
	assert platen.body.state.vel[1] == v
	assert platen.displacement[1] == pytest.approx(v * jump['time'], rel=0.01)
	O.run(int(0.05 * jump['time'] / O.dt), True)
	assert (model.pointStatus == 1).any()


def test_jumpThatIsRefusedLeavesTheRamp():
	model, platen = between((0, 1e-5), rampTime=1)
	model.setJoints(tension=0, cohesion=0)
	model.gravity((0, 10.))
	with pytest.raises(RuntimeError):
		platen.jump()
	O.run(1, True)
	assert 0 < platen.body.state.vel[1] < 1e-9


def test_servoOfAPlaten():
	"""BlockServo's rule, look by look: 0.8 of the speed where the ratio of the last step is above its target, else 1.1, within [least, 1]; the velocity
	follows. Both happen, and the least speed is met."""
	v, target, least = -2e-3, 2e-3, 0.3
	model, platen = between((0, v), servo=dict(target=target, floor=10., least=least, period=10))
	expected, seen = 1.0, []
	O.run(10, True) # looks are in steps 10, 20, ...
	for _ in range(100):
		slower = model.unbalancedRatio(floor=10) > target
		expected = min(1.0, max(least, expected * (0.8 if slower else 1.1)))
		O.run(1, True)
		assert platen.throttle == pytest.approx(expected, rel=1e-12) and platen.body.state.vel[1] == pytest.approx(expected * v, rel=1e-12)
		seen.append(platen.throttle)
		O.run(9, True)
	assert min(seen) == least and max(seen[20:]) > 1.05 * least


def test_servoThatSeesNoForceThatCounts():
	"""Unbalanced forces by a floor far above all that there is: never slower."""
	model, platen = between((0, -2e-3), servo=dict(target=2e-3, floor=1e12))
	ratios = []
	for _ in range(30):
		O.run(10, True)
		ratios.append(model.unbalancedRatio(floor=10))
	assert platen.throttle == 1 and max(ratios) > 2e-3


@pytest.mark.parametrize(
	'arguments, words', [(dict(velocity=(0, np.nan)), r'Platen.velocity must be a pair of finite numbers \(x, y\), got \(0, nan\)'),
				(dict(rampTime=-1), 'Platen.rampTime must not be negative'),
				(dict(servo=dict(target=0)), 'Platen.servo: target must be positive'),
				(dict(servo=dict(least=2)), 'Platen.servo: least must lie in'), (dict(servo=dict(period=0)), 'Platen.servo: period must be'),
				(dict(servo=dict(floor=-1)), 'Platen.servo: floor must not be negative'), (dict(block=0), 'Platen.block must be rigid, got 0')]
)
def test_platenThatCannotBe(arguments, words):
	model, platen = between((0, 0))
	with pytest.raises(ValueError, match=words):
		Platen(model, **{'block': 2, 'velocity': (0, 1), **arguments})


# ---- handles of groups


def test_aHandleSaysWhatTheModelSays():
	m = couplet()
	top = m.group('top') # made by model.drive
	assert list(top.nodes) == list(m.groupNodes('top')) and top.moves and top.axes == 'y' and repr(top).startswith("<Group 'top', ")
	base = m.group('bottom', lambda x, y: y < 1e-9)
	gauge = m.group('gauge', [5, 3, 3])
	assert list(gauge.nodes) == [3, 5] and not gauge.moves
	O.run(200, True)
	assert tuple(top.force) == (0, m.groupForce('top')) and top.force[1] > 0
	assert tuple(base.force) == (m.groupForce('bottom', axis='x'), m.groupForce('bottom', axis='y')) and base.force[1] < 0
	assert base.moment((1, 2)) == m.groupMoment('bottom', (1, 2))
	assert top.travelled == m.groupTravelled('top') == pytest.approx(top.displacement[1], rel=1e-9) and top.work == m.groupWork('top') > 0
	assert top.velocity[1] == pytest.approx(m.groupVelocity('top'), rel=1e-12)
	assert gauge.displacement == pytest.approx(m.displacement[[3, 5]].mean(axis=0), rel=1e-12)
	with pytest.raises(ValueError, match='no motion group "gauge"'):
		gauge.force
	top.setThrottle(0.5)
	O.run(1, True)
	speed = m.groupVelocity('top')
	top.setThrottle(1)
	O.run(1, True)
	assert m.groupVelocity('top') == pytest.approx(2 * speed, rel=1e-2) # the ramp goes on a little
	top.setTarget(0)
	O.run(1, True)
	assert m.groupVelocity('top') == 0
	top.release()
	assert 'top' not in m.groups and not top.moves
	top.push('y', force=5., rampTime=0).setTarget(7.)
	O.run(1, True)
	assert tuple(top.force) == (0, 7) and m.group('top').axes == 'y'


def test_aHandleIsDriven():
	m = couplet()
	m.group('top').release()
	top = m.group('top', nodesWhere(m, lambda x, y: y > 0.03 - 1e-9)).drive('xy', velocity=0)
	motion = top.motion(lambda t: 1e-4 * t)
	O.engines = [motion.engine()] + O.engines
	O.run(10, True)
	assert top.displacement == pytest.approx(np.full(2, 1e-4 * (10 * O.dt)**2 / 2), rel=1e-9)


@pytest.mark.parametrize(
	'arguments, error, words', [(('lid', ), ValueError, 'no motion group "lid"'), ((3, [0]), TypeError, 'BlockModel.group.name must be a text, got 3'),
					(('a', []), ValueError, "BlockModel.group 'a': there must be at least one grid point"),
					(('a', [0.5]), ValueError, "BlockModel.group 'a': nodes must be indices"),
					(('a', ['b']), ValueError, "BlockModel.group 'a': nodes must be indices"),
					(('a', [-1]), ValueError, r"BlockModel.group 'a': grid points lie in \[0, "),
					(('a', [10**6]), ValueError, 'got 1000000'),
					(('top', [0, 1]), ValueError, "BlockModel.group 'top': there is a motion group of this name with other grid points"),
					(('a', lambda x, y: y > 9), ValueError, 'no grid point is chosen')]
)
def test_aHandleThatCannotBe(arguments, error, words):
	m = couplet()
	with pytest.raises(error, match=words):
		m.group(*arguments)
