# yade-blocks, GPL-2.0-or-later
"""O.trackEnergy: where the energy is and where it went."""
import pytest

from scenes import *

entries = {'blockKinetic', 'blockZones', 'blockJoints', 'blockDamping', 'blockWork', 'blockFriction', 'blockFracture', 'blockScaling'}


def energies():
	return dict(O.energy.items())


def test_offNothingAppears():
	couplet()
	O.run(50, True)
	assert energies() == {}


@pytest.mark.parametrize('damping', ['local', 'adaptive', 'none'])
def test_balanceOfARunThatCracks(damping):
	m = couplet(damping=damping, trackEnergy=True)
	O.run(2000, True)
	e = energies()
	assert set(e) == entries and np.count_nonzero(m.pointStatus) > 10
	# Zones and joints are linear but for their rotation (below 1e-3 here: cracks open by 1e-5 m along cells of 6 mm), and leapfrog with the
	# trapezoidal rule is exact for what is linear (CentralDifference.hpp). What remains is of second order in the rotation of a single step,
	# relative to the energy that is set free: 1e-4. A lost term would show: each of zones, joints, fracture is several percent of the work.
	assert abs(sum(e.values())) < 1e-4 * -e['blockWork']
	assert e['blockWork'] == pytest.approx(-m.groupWork('top') - m.groupWork('bottom'), rel=1e-13)
	assert e['blockFracture'] > 0.05 * -e['blockWork']
	if damping == 'none': assert abs(e['blockDamping']) < 1e-12 * -e['blockWork'] # 2000 roundings
	else: assert e['blockDamping'] > 0.05 * -e['blockWork']


def test_elasticBalanceToRounding():
	"""Before the first crack, small strain: a linear system, whose balance is exact."""
	m = couplet(damping='none', trackEnergy=True)
	m.smallStrain = True
	O.run(800, True)
	e = energies()
	assert not m.pointStatus.any()
	# Frames still turn: by slip over edge, 1e-7/2e-3, so that forces err by 1e-4 of themselves in a direction that does hardly any work, per
	# step of relative length 1/800. Rounding: positions of 0.03 m by 4e-18, displacements 2e-9 a step: 2e-9 a step. Both are far below:
	assert abs(sum(e.values())) < 1e-6 * -e['blockWork']
	assert abs(e['blockDamping']) < 1e-12 * -e['blockWork'] # 800 roundings
	assert abs(e['blockFriction']) < 1e-6 * -e['blockWork'] and e['blockFracture'] == 0


def test_closedForm():
	"""Two bricks and a joint as springs in a row, stretched by hand: E = F^2/(2k) each."""
	materials(poisson=0)
	m = column(heights=(0.3, 0.5), width=0.4, thickness=0.2)
	m.drive('bottom', nodesWhere(m, lambda x, y: y < 1e-9), 'xy')
	m.drive('sides', nodesWhere(m, lambda x, y: y > 1e-9), 'x')
	m.drive('top', nodesWhere(m, lambda x, y: y > 0.8 - 1e-9), 'y', velocity=1e-4, rampTime=0.2)
	m.insert()
	O.dt, O.trackEnergy, O.engines = 1e-3, True, engines(strong(), alpha=0.5)
	O.run(1000, True)
	m.setTarget('top', 0)
	O.run(4000, True)
	assert m.unbalancedRatio() < 1e-10
	force, area, e = m.groupForce('top'), 0.4 * 0.2, energies()
	# the unbalanced forces are below 1e-10 of the contact forces, energies are their squares; openings of 2e-6 m round by 1e-16
	assert e['blockJoints'] == pytest.approx(force**2 / (2 * 400e9 * area), rel=1e-8)
	assert e['blockZones'] == pytest.approx(force**2 / (2 * brick['young'] * area / 0.8), rel=1e-8)
	assert e['blockKinetic'] < 1e-12 * e['blockZones']
	assert -e['blockWork'] == pytest.approx(e['blockZones'] + e['blockJoints'] + e['blockDamping'], rel=1e-8)
	assert m.kineticEnergy() < 1e-12 * e['blockZones']


def test_fallingBlock():
	"""Weight times height becomes kinetic energy."""
	materials()
	m = column(heights=(0.5, ))
	m.gravity((0.3, -9.81))
	m.insert()
	O.trackEnergy = True
	O.engines = engines(strong(), stepper=dict(quasiStatic=False), damping='none')
	O.run(101, True)
	e = energies()
	mass, square = 0.5 * 0.4 * 0.2 * 1900, 0.3**2 + 9.81**2
	# From v = 0 half a step before the start: v = g dt (n and n + 1) around step n, x = g dt^2 n (n + 1)/2, so K = m v v'/2 is the work.
	assert e['blockKinetic'] == pytest.approx(mass * square * O.dt**2 * 100 * 101 / 2, rel=1e-11) # 100 roundings each of v and x
	assert -e['blockWork'] == pytest.approx(mass * square * O.dt**2 * 100 * 101 / 2, rel=1e-8) # x of 1e-4 or less, rounded by 1e-16 a hundred times
	assert e['blockJoints'] == 0 and abs(e['blockZones']) < 1e-9 * e['blockKinetic']


def test_switchedOnInTheMiddle():
	couplet(damping='none')
	O.run(600, True)
	O.trackEnergy = True
	O.run(1, True)
	start = sum(energies().values())
	O.run(150, True)
	e = energies()
	assert set(e) == entries and abs(sum(e.values()) - start) < 1e-5 * e['blockZones'] # as above, with forces that turn in large strain


def test_anEngineForgetsTheAccountsOfAnEarlierScene():
	"""Also if energy was not tracked when the new scene began. The two couplets are alike, so nothing but the accounts tells them apart."""
	couplet(trackEnergy=True)
	kept = O.engines
	O.run(2000, True)
	assert O.energy['blockFracture'] > 0
	couplet()
	O.engines = kept
	O.run(10, True)
	O.trackEnergy = True
	O.run(10, True) # elastic yet
	assert O.energy['blockFracture'] == 0


def test_balanceWhereScaledMassesGrow():
	"""A free contact makes grid points stiffer, and so heavier, while they move: what they bring is told, and all the rest is in balance."""
	materials()
	m = column(heights=(0.2, 0.2))
	m.drive('low', nodesWhere(m, lambda x, y: y < 1e-9), 'xy')
	m.drive('top', nodesWhere(m, lambda x, y: y > 0.4 - 1e-9), 'y', velocity=25e-3)
	m.insert()
	O.dt, O.trackEnergy = 1e-3, True
	O.engines = [BlockContacts(), InsertionSortCollider([Bo1_Block_Aabb()], verletDist=0)] + engines(strong(cohesion=1e4, tension=1e4), damping='local')
	O.run(400, True)
	assert (m.segmentArea == 0).all() # broken, opened by 2 % of its length, and released
	e = energies()
	assert -e['blockScaling'] > 1e-3 * e['blockKinetic'] > 0
	turnover = sum(value for value in e.values() if value > 0)
	assert abs(sum(e.values())) < 1e-3 * turnover and abs(sum(e.values())) < 0.1 * -e['blockScaling']


def test_accountsGoWithTheLastGoodState(tmp_path):
	m = couplet(damping='local', trackEnergy=True, watchPeriod=100, rescueFile='')
	O.run(1500, True)
	before = energies()
	m.velocity[m.firstNode[4] + 1] = float('nan')
	with pytest.raises(RuntimeError, match='unstable'):
		O.run(200, True)
	assert np.count_nonzero(m.pointStatus) > 5
	O.run(50, True)
	e = energies()
	assert abs(sum(e.values())) < 1e-4 * -e['blockWork'] and e['blockDamping'] == pytest.approx(before['blockDamping'], rel=0.05)


@pytest.mark.parametrize('steps', [1, 2, 3, 15, 16, 50, 99, 100, 101, 150])
def test_releaseOfAMovingGroup(steps):
	"""What a group has done on the blocks stays in the accounts when it lets them go: the blocks fly on with the energy it gave them."""
	materials()
	m = column(heights=(0.3, 0.5))
	m.drive('pull', nodesWhere(m, lambda x, y: y > 0.8 - 1e-9), 'y', velocity=0.5, rampTime=0.02)
	m.insert()
	O.trackEnergy, O.engines = True, engines(strong(), dict(quasiStatic=False), damping='none', watchPeriod=10)
	O.run(steps, True)
	m.release('pull')
	assert m.groups == []
	O.run(1, True)
	work = -O.energy['blockWork']
	assert work > 0
	for _ in range(3):
		O.run(100, True)
		# Zones are linear in their strain, 1e-5 here, and the balance of leapfrog is exact for what is linear.
		assert -O.energy['blockWork'] == work and abs(sum(energies().values())) < 1e-4 * work


def test_releasedWorkIsSaved(tmp_path):
	materials()
	m = column()
	m.drive('pull', range(m.nodeCount), 'y', velocity=0.5)
	m.insert()
	O.trackEnergy, O.engines = True, engines(strong(), dict(quasiStatic=False), damping='none', watchPeriod=10)
	O.run(50, True)
	m.release('pull')
	O.save(str(tmp_path / 'flying.yade'))
	O.run(50, True)
	work, mass = -O.energy['blockWork'], m.mass.sum()
	assert work == pytest.approx(mass * 0.5**2 / 2, rel=1e-9) # all grid points at 0.5 m/s
	O.load(str(tmp_path / 'flying.yade'))
	O.run(50, True)
	assert -O.energy['blockWork'] == work
