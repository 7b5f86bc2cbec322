# yade-blocks, GPL-2.0-or-later
"""What is known from elsewhere, through YADE's engines: springs in a row, weight and reaction, free fall, joints of a pair's own."""
import pytest

from scenes import *


def bottom(m):
	return nodesWhere(m, lambda x, y: y < 1e-9)


def top(m):
	return nodesWhere(m, lambda x, y: y > m.reference[:, 1].max() - 1e-9)


@pytest.mark.parametrize('planeStress', [False, True])
def test_stiffnessOfABar(planeStress):
	"""Two blocks and a joint in a row: 1/K = h1/M1 + h2/M2 + 1/kn, with M = lambda + 2 mu since the sides are held; linear at any stretch."""
	materials()
	m = BlockModel(thickness=0.2, planeStress=planeStress)
	m.addRegion(rectangle(0, 0, 0.4, 0.3), 'unit', zoneSize=0.15)
	m.addRegion(rectangle(0, 0.3, 0.4, 0.8), 'mortar', zoneSize=0.2)
	m.bond()
	m.drive('bottom', bottom(m), 'y')
	m.drive('sides', np.arange(m.nodeCount), 'x')
	m.drive('top', top(m), 'y', velocity=1e-3, rampTime=0.3)
	m.insert()
	O.dt, O.engines = 1e-3, engines(strong(), alpha=0.5)
	O.run(1000, True)
	m.setTarget('top', 0)
	O.run(4000, True)

	def modulus(young, poisson, density):
		shear = young / (2 * (1 + poisson))
		return young * poisson / (1 - poisson**2 if planeStress else (1 + poisson) * (1 - 2 * poisson)) + 2 * shear

	K = 1 / (0.3 / modulus(**brick) + 0.5 / modulus(**mortar) + 1 / glue['kn'])
	force = K * m.groupTravelled('top') * 0.4 * 0.2
	# Strains of 1e-3 over zones of 0.1 m, positions rounded by 1e-16 m: 1e-12; what is left of the motion: below 1e-10
	assert m.unbalancedRatio() < 1e-10
	assert m.groupTravelled('top') == pytest.approx(0.85e-3, rel=1e-3) # a ramp is half its time worth
	assert m.groupForce('top') == pytest.approx(force, rel=1e-9)
	assert m.groupForce('bottom', axis='y') == pytest.approx(-force, rel=1e-9)
	np.testing.assert_allclose(m.pointOpening, force / (0.08 * glue['kn']), rtol=1e-8) # 1e-5 m, known to 1e-16 m and 1e-9
	np.testing.assert_allclose(m.zoneStress()[:, 1] * 1, force / 0.08, rtol=1e-8) # the sides are held: areas stay
	assert abs(m.pointSlip).max() < 1e-8 * m.pointOpening.max()


def test_reactionIsTheForceApplied():
	"""Pushed by a platen that stays parallel, loaded by a traction: below, minus their sum, for a wall of Voronoi blocks."""
	materials()
	m = BlockModel(thickness=0.2)
	m.addVoronoi(rectangle(0, 0, 0.4, 0.5), 'mortar', size=0.12, seed=5)
	m.bond()
	m.drive('low', bottom(m), 'xy')
	m.push('high', top(m), 'y', force=-7e4, rampTime=0.2)
	m.insert()
	right = np.flatnonzero((m.reference[m.edgeNodes][:, :, 0] > 0.4 - 1e-9).all(axis=1))
	m.traction(right, (2e5, -1e5)) # over 0.5 x 0.2 m2: (2e4, -1e4) N
	O.dt, O.engines = 1e-3, engines(strong(), alpha=0.5)
	O.run(6000, True)
	assert m.unbalancedRatio() < 1e-10
	# the held grid points' forces, on both axes; 50 grid points, each unbalanced by less than 1e-10 of all contact forces, ten times 1e5 N
	held = m.force[bottom(m)].sum(axis=0)
	assert m.groupForce('high') == pytest.approx(-7e4, rel=1e-15)
	np.testing.assert_allclose(held, (2e4, -8e4), atol=1e-10 * 1e6 * 10)
	assert [m.groupForce('low', axis=axis) for axis in 'xy'] == pytest.approx(-held, rel=1e-11)
	assert np.ptp(m.position[top(m), 1]) < 1e-15 # parallel
	assert m.groupTravelled('high') == pytest.approx(m.position[top(m)[0], 1] - 0.5, rel=1e-9)


def test_weightOfABlockUponAnother():
	"""A dry joint carries the upper block, the ground both; the paper's adaptive damping brings them to rest."""
	materials()
	m = column(heights=(0.3, 0.5), labels=['unit', 'mortar'])
	m.drive('ground', bottom(m), 'xy')
	m.gravity((0, -9.81))
	m.insert()
	O.dt, O.engines = 1e-3, engines(glued(bonded=False), damping='adaptive')
	O.run(8000, True)
	lower, upper = 0.3 * 0.08 * 1900 * 9.81, 0.5 * 0.08 * 1250 * 9.81
	ratio = m.unbalancedRatio()
	# openings are 6e-9 m, known to 1e-16: no better than 2e-8
	assert ratio < 1e-6 and (m.pointStatus == 3).all() and (m.pointSigma < 0).all()
	assert m.groupForce('ground', axis='y') == pytest.approx(lower + upper, rel=1e-5) # the unbalanced forces of 30 grid points
	assert -(m.pointSigma * np.repeat(m.segmentArea, 2)).sum() == pytest.approx(upper, rel=1e-5)
	assert m.kineticEnergy() < 1e-9 * 0.5 * (lower + upper) * 6e-9
	assert list(O.bodies[1].state.pos)[2] == 0 and 0.55 - 1e-6 < O.bodies[1].state.pos[1] < 0.55


def test_freeFall():
	"""At true masses nothing but gravity acts: x = g dt^2 n (n + 1)/2, the scheme's own answer, for every grid point and the centroid."""
	materials()
	m = column(heights=(0.5, ))
	m.gravity((0.7, -9.81))
	m.insert()
	O.engines = engines(strong(), stepper=dict(quasiStatic=False), damping='none')
	O.run(1000, True)
	fall = np.array([0.7, -9.81]) * O.dt**2 * 1000 * 1001 / 2
	# 1000 additions to a position of order 0.5, rounded by 5e-17 each; strain from rounding stays below it
	np.testing.assert_allclose(m.position - m.reference, np.broadcast_to(fall, m.position.shape), atol=1000 * 1e-16)
	np.testing.assert_allclose(np.array(O.bodies[0].state.pos)[:2] - (0.2, 0.25), fall, atol=1000 * 1e-16)
	limit = O.engines[1].stableStep
	assert O.dt == 0.7 * limit and np.array_equal(m.inertia, m.mass)
	# the bound is below 2/omega of the fastest wave across a zone: c = sqrt(M/density), zones of 0.2 m and less
	assert 0.02 * 0.2 / 3300 < limit < 0.2 / 3300


def test_scaledMassesDoNotMoveTheEquilibrium():
	"""Whatever dt, quasi-static answers are the same; scaled masses go with dt^2."""
	found = []
	for dt in 1e-3, 1.0:
		materials()
		m = column()
		m.drive('ground', bottom(m), 'xy')
		m.push('high', top(m), 'y', force=-5e4)
		m.insert()
		O.dt, O.engines = dt, engines(strong(), alpha=0.5)
		O.run(3000, True)
		found.append((m.position - m.reference, m.inertia / dt**2, m.mass.sum()))
	np.testing.assert_allclose(found[0][0], found[1][0], atol=1e-14) # displacements of 3e-5 m, both rounded by 1e-16 of 0.8 m in 3000 steps of decay
	np.testing.assert_allclose(found[0][1], found[1][1], rtol=1e-14)
	assert found[0][2] == found[1][2] == pytest.approx(0.8 * 0.08 * 1900, rel=1e-13)


def test_jointsByRegion():
	"""i.phys sets the joint of one pair, here by its place: of two equal joints the weakened one breaks, at its own strength."""
	materials()
	m = column(heights=(0.2, 0.2, 0.2))
	m.drive('low', bottom(m), 'xy')
	m.drive('high', top(m), 'y', velocity=2e-5, rampTime=0.1)
	m.drive('sides', nodesWhere(m, lambda x, y: (y > 1e-9)), 'x')
	m.insert()
	O.dt, O.engines = 1e-3, engines(glued(), alpha=0.5)
	O.run(1, True)
	for i in O.interactions:
		if i.geom.positions[0][1] > 0.3: i.phys.tension = 0.25e6
	upper, lower = O.interactions[1, 2], O.interactions[0, 1]
	peak = 0
	for _ in range(60):
		O.run(20, True)
		if any(upper.phys.status): break
		peak = max(peak, max(upper.phys.sigma))
	assert set(upper.phys.status) == {1} and set(lower.phys.status) == {0}
	assert 0.9 * 0.25e6 < peak <= 0.25e6 # looked at every 20 of some 500 steps

	# a softer joint takes a larger mass scale away: the stepper has noticed, and the step is checked anew
	before = m.inertia.copy()
	lower.phys.kn *= 0.5
	O.run(1, True)
	assert (m.inertia <= before).all() and (m.inertia < before).any()


def test_released():
	"""A group that lets go: nothing holds the blocks any more, they fly on with what they had."""
	materials()
	m = column()
	m.drive('all', np.arange(m.nodeCount), 'y', velocity=-2.)
	m.insert()
	O.engines = engines(strong(), stepper=dict(quasiStatic=False), damping='none')
	O.run(100, True)
	assert m.groups == ['all'] and m.groupVelocity('all') == -2 and m.groupTravelled('all') == pytest.approx(-200 * O.dt, rel=1e-13)
	m.release('all')
	O.run(100, True)
	assert m.groups == [] and m.velocity[:, 1] == pytest.approx(-2, rel=1e-10) # stresses of rounding: E eps/h over rho c
	assert (m.position - m.reference)[:, 1] == pytest.approx(-400 * O.dt, rel=1e-10)


def test_throttle():
	materials()
	m = column()
	m.drive('all', np.arange(m.nodeCount), 'y', velocity=3.)
	m.insert()
	O.dt, O.engines = 1e-3, engines(strong())
	O.run(10, True)
	m.setThrottle('all', 0.25)
	O.run(10, True)
	assert m.groupTravelled('all') == pytest.approx(0.03 + 0.0075, rel=1e-13)
