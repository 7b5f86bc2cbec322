# yade-blocks, GPL-2.0-or-later
"""How loads are brought on and runs are ended: elastic jump, servo, settling, approach, stop criteria."""
import pytest

from scenes import *
from yadeblocks import loading, recording


def top(m):
	return nodesWhere(m, lambda x, y: y > m.reference[:, 1].max() - 1e-9)


def test_jumpLeadsToTheFirstCrack():
	"""Behind the jump nothing is broken and nothing moves of itself; at the next 3 % of the loading the foretold point breaks first."""
	m = couplet(steps=20000)
	speed = 0.012e-3 / 1.5
	O.run(1, True)
	jump = m.elasticJump(fraction=0.97)
	assert m.groupTravelled('top') == pytest.approx(speed * jump['time'], rel=1e-9)
	assert m.groupVelocity('top') == pytest.approx(speed)
	jumped = O.time
	O.run(1, True)
	assert not m.pointStatus.any()
	assert m.unbalancedRatio() < 1e-5 # of the strains, 1e-4, and of one step's damping
	while not m.pointStatus.any():
		O.run(20, True)
	assert m.pointStatus[jump['point']]
	assert O.time - jumped == pytest.approx(jump['time'] * 0.03 / 0.97, rel=0.02) # inertia at this rate


def test_jumpKeepsTheEnergyAccount():
	m = couplet(steps=20000, trackEnergy=True)
	O.run(1, True)
	m.elasticJump()
	O.run(5000, True)
	assert m.pointStatus.any()
	energies = dict(O.energy.items())
	assert abs(sum(energies.values())) < 2e-4 * abs(energies['blockWork']) # work of the jump: force by path, up to its strains


def test_jumpIsRefused():
	m = couplet()
	with pytest.raises(RuntimeError, match='no properties yet'):
		m.elasticJump()
	O.run(1, True)
	with pytest.raises(ValueError, match=r'\(0, 1\).*1.5'):
		m.elasticJump(fraction=1.5)
	m.setTarget('top', 0)
	with pytest.raises(RuntimeError, match='driven'):
		m.elasticJump()


def test_servoSlowsWhatIsTooFast():
	"""The same specimen loaded twenty times too fast: with the servo, the peak is nearer to that of slow loading, and the ratio is near its target."""
	def peak(steps, servo):
		m, history = couplet(steps=steps, stroke=0.024e-3), []
		if servo:
			O.engines = O.engines[:-1] + [BlockServo(groups=['top'], floor=1e-3 * 0.6e6 * 0.04 * 0.05)] + O.engines[-1:]
		stop = loading.Stop(drop=0.5)

		def record():
			history.append((m.groupForce('top'), O.engines[-3].throttle if servo else 1))
			stop(0, history[-1][0], m.pointStatus.any())

		O.engines += [recording.runner('history', record, 5)]
		O.run(100000, True)
		forces, throttles = zip(*history)
		assert max(throttles) <= 1
		return max(forces), min(throttles)

	slow, fast = peak(20000, False)[0], peak(1000, False)[0]
	served, least = peak(1000, True)
	assert fast > 1.04 * slow
	assert slow < served < slow + 0.3 * (fast - slow)
	assert 0.05 <= least < 0.5


@pytest.mark.parametrize(
	'attribute, value, rule', [('target', 0, 'positive'), ('floor', -1, 'not be negative'), ('least', 0, '(0, 1]'), ('period', 0, 'at least 1')]
)
def test_servoRefuses(attribute, value, rule):
	servo = BlockServo(groups=['top'])
	before = getattr(servo, attribute)
	with pytest.raises(ValueError) as error:
		setattr(servo, attribute, value)
	assert 'BlockServo.' + attribute in str(error.value) and rule in str(error.value)
	assert getattr(servo, attribute) == before


@pytest.mark.parametrize('groups, text', [([], 'groups must name'), (['lid'], 'no motion group "lid"'), (['press'], 'pushed by a force')])
def test_servoNeedsDrivenGroups(groups, text):
	m = couplet()
	m.push('press', top(m), 'x', force=1)
	O.engines = O.engines[:-1] + [BlockServo(groups=groups)] + O.engines[-1:]
	with pytest.raises((RuntimeError, ValueError), match=text):
		O.run(1, True)


def test_settleUntilNothingMoves():
	"""Pressed by a platen: settled, the held edge carries its force to the ratio that was asked for."""
	materials()
	m = BlockModel(thickness=0.05)
	m.addVoronoi(rectangle(0, 0, 0.04, 0.03), 'mortar', size=8e-3, seed=3)
	m.bond()
	m.drive('low', nodesWhere(m, lambda x, y: y < 1e-9), 'xy')
	m.push('press', top(m), 'y', force=-500)
	m.insert()
	O.dt, O.engines = 1e-3, engines(strong(), alpha=0.5)
	steps = loading.settle(m, ratio=1e-6)
	assert 0 < steps == O.iter and m.unbalancedRatio() < 1e-6
	low = nodesWhere(m, lambda x, y: y < 1e-9)
	assert -m.force[low, 1].sum() == pytest.approx(500, rel=1e-4) # ratio 1e-6 of all contact forces, some fifty rows' worth
	with pytest.raises(RuntimeError, match='after 7 steps'):
		loading.settle(m, ratio=1e-30, period=5, maxSteps=7)
	with pytest.raises(ValueError, match='ratio'):
		loading.settle(m, ratio=0)


def test_approachIsSlowUpToThePeak():
	m = couplet()
	approach = loading.Approach(m, 'top', slow=0.25)
	for stress, broken in ((1, 0), (2, 0), (1, 0), (2, 1), (1.5, 1)): # elastic unloading is no failure
		approach(stress, broken)
		assert not approach.passed and approach.speed == 0.25
	approach(1.3, 1)
	assert approach.passed and approach.speed == pytest.approx(0.275)
	for _ in range(20):
		approach(2, 1)
	assert approach.speed == 1
	with pytest.raises(ValueError, match=r'slow.*\(0, 1\].*2'):
		loading.Approach(m, 'top', slow=2)


def test_approachGrowsAsItIsTold():
	m = couplet()
	approach = loading.Approach(m, 'top', slow=0.1, drop=0.9, growth=1.5)
	approach(1, 1)
	approach(0.8, 1)
	assert approach.speed == pytest.approx(0.15)
	for growth in 1, 0.5, float('nan'):
		with pytest.raises(ValueError, match='growth.*(above 1|finite)'):
			loading.Approach(m, 'top', slow=0.1, growth=growth)


@pytest.mark.parametrize('condition, reason, step', [(dict(drop=0.5), 'drop', 5), (dict(displacement=3), 'displacement', 3), (dict(cracks=2), 'cracks', 4)])
def test_stop(condition, reason, step):
	stop = loading.Stop(**condition)
	history = [(0, 0, 0), (1, 10, 0), (2, 4, 0), (3, 8, 1), (2.5, 6, 3), (2.6, 4, 3)] # displacement, stress, broken
	stopped = [stop(*state) for state in history]
	assert stopped.index(True) == step and stop.reason == reason


@pytest.mark.parametrize('condition, text', [({}, 'no condition'), (dict(drop=1), 'drop'), (dict(displacement=0), 'displacement'), (dict(cracks=0), 'cracks')])
def test_stopRefuses(condition, text):
	with pytest.raises(ValueError, match=text):
		loading.Stop(**condition)


@pytest.mark.parametrize('kind', ['function', 'table', 'accelerogram'])
def test_motionInTime(kind):
	"""A bar goes where the integral of the velocity is: the middle of each step is second order, dt^2 w^2 / 24 of the way, and the table is fine enough."""
	w, dt, steps = 20., 1e-3, 250
	materials()
	model = BlockModel(thickness=0.05)
	model.addRegion(rectangle(0, 0, 0.1, 0.1), 'unit', zoneSize=0.1)
	model.bond([])
	model.drive('base', nodesWhere(model, lambda x, y: y < 1e-9), 'x')
	model.insert()
	O.dt, O.engines = dt, [BlockLoop(), BlockMotion(alpha=0.3)]
	O.run(7, True) # times count from when it is made
	times = np.linspace(0, 1, 5001)
	values = {
		'function': lambda t: 0.1 * np.sin(w * t), 'table': (times, 0.1 * np.sin(w * times)),
		'accelerogram': loading.accelerogram(times, 0.1 * w * np.cos(w * times))
	}[kind]
	O.engines = [loading.Motion(model, 'base', values).engine()] + O.engines
	O.run(steps, True)
	assert model.groupTravelled('base') == pytest.approx(0.1 / w * (1 - np.cos(w * steps * dt)), rel=dt**2 * w**2 / 24 * 2)


def test_motionThatCannotBe():
	model = couplet()
	for values, words in ((([0, 1], [0]), 'a value for each'), (([0, 0], [0, 1]), 'times must grow'), (([0, 1], [0, np.nan]), 'finite')):
		with pytest.raises(ValueError, match=words):
			loading.Motion(model, 'top', values)
	motion = loading.Motion(model, 'top', ([0, 1e-3], [0, 1e-5]))
	O.engines = [motion.engine()] + O.engines
	with pytest.raises(RuntimeError): # YADE's own, of the command; it shows what was wrong
		O.run(10, True)
	with pytest.raises(ValueError, match="the table of 'top' goes from 0 to 0.001 s, and the time is 0.0[0-9]+ s"):
		motion()
