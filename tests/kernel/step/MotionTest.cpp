// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>

using namespace specimens;

namespace {

/// A lopsided triangle in small strain, so that forces are linear to rounding.
BlockAssembly triangle()
{
	BlockAssembly a;
	a.strain    = Strain::small;
	a.thickness = 0.4;
	a.addMaterial({ 2000, 0.3, 5 });
	a.addBlock({ { 0.1, 0 }, { 1.2, 0.3 }, { 0.4, 0.9 } }, { { 0, 1, 2 } }, { { 0, 1, 2 } }, 0);
	return a;
}

/// One degree of freedom left free: y of node 2.
BlockAssembly oscillator()
{
	BlockAssembly a = triangle();
	a.addGroup(driven("rest", { 0, 1, 2, 3, 4 }, 0));
	return a;
}

Damping damped(Damping::Kind kind, Real alpha = 0.3)
{
	Damping d;
	d.kind  = kind;
	d.alpha = alpha;
	return d;
}

/// One step of node 0's x, alone in its degree of freedom, with force f and velocity v before; mass 1/mobility is set to m.
Real velocityAfter(Damping damping, Real f, Real v, Real m, Real dt, Real viscosity, StepWork* work)
{
	BlockAssembly a = triangle();
	std::fill(a.state.inertia.begin(), a.state.inertia.end(), 0);
	a.state.inertia[0] = m;
	a.addGroup(driven("y", { 1 }, 0));
	a.forces.nodal[0].x()   = f;
	a.state.velocity[0].x() = v;
	a.state.viscosity       = viscosity;
	*work                   = integrate(a, damping, dt, 0, true);
	EXPECT_EQ(a.state.displacement[0].x(), dt * a.state.velocity[0].x());
	return a.state.velocity[0].x();
}

} // namespace

// ---- the scheme

TEST(CentralDifference, FollowsItsOwnExactSolution)
{
	// In mode phi of frequency omega the scheme's exact solution is x_n = X + phi cos(n theta), sin(theta/2) = omega dt/2.
	// omega comes from an eigenvalue solver: relative error below 100 eps; after 1000 steps of theta < 3 a phase error of 1000 x 3 x
	// 100 eps = 7e-11; each step's 10 roundings of strains of order 0.01 act for the rest of the run, 1000^2/2 x 10 eps x 0.01 = 1e-11
	// at worst. The amplitude is 0.01: 0.01 x 7e-11 is nothing beside it.
	const BlockAssembly start = triangle();
	const Modes         m     = modes(start, 0.1);
	ASSERT_EQ(m.free.size(), 6u);
	for (int mode : { 3, 4, 5 }) { // the first three are rigid motions
		SCOPED_TRACE(mode);
		BlockAssembly         a     = start;
		const Real            dt    = 1.7 / m.omega[5];
		const Real            theta = 2 * std::asin(m.omega[mode] * dt / 2);
		Real* const           u     = a.state.displacement.data()->data();
		const Eigen::VectorXd phi   = m.shape.col(mode) * (0.01 / m.shape.col(mode).cwiseAbs().maxCoeff());
		for (int i = 0; i < 6; ++i) {
			u[i]                           = phi[i];
			a.state.velocity[i / 2][i % 2] = phi[i] * (1 - std::cos(theta)) / dt; // (x_0 - x_-1)/dt
		}
		Damping none = damped(Damping::Kind::none);
		for (int n = 1; n <= 1000; ++n) {
			computeForces(a);
			integrate(a, none, dt, (n - 1) * dt);
			if (n % 100 == 0) {
				for (int i = 0; i < 6; ++i)
					ASSERT_NEAR(u[i], phi[i] * std::cos(n * theta), 1e-11) << "step " << n;
			}
		}
	}
}

TEST(CentralDifference, SecondOrderInTime)
{
	// Against cos(omega t): theta - omega dt = (omega dt)^3/24 a step, a phase error of omega t (omega dt)^2/24. Halving dt
	// quarters it, but for the next term, (omega dt)^2 x 9/80 of it: 0.0045 at omega dt = 0.2.
	const BlockAssembly start = oscillator();
	const Modes         m     = modes(start, 0.1);
	ASSERT_EQ(m.free, (std::vector<int> { 5 }));
	auto error = [&](int stepsPerRadian) {
		BlockAssembly a  = start;
		const Real    dt = 1 / (stepsPerRadian * m.omega[0]), amplitude = 0.01;
		a.state.displacement[2].y() += amplitude;
		// velocity at -dt/2 of the true solution, by Taylor's series to dt^4 (an error of 1e-5 of the amplitude's phase at most)
		a.state.velocity[2].y() = amplitude * m.omega[0] * std::sin(m.omega[0] * dt / 2);
		Damping   none          = damped(Damping::Kind::none);
		const int steps         = 20 * stepsPerRadian;
		for (int n = 0; n < steps; ++n) {
			computeForces(a);
			integrate(a, none, dt, n * dt);
		}
		return a.state.displacement[2].y() - amplitude * std::cos(20);
	};
	const Real coarse = error(5), fine = error(10);
	// the phase error as predicted, and of second order; the start's (omega dt)^2/24 adds a twentieth at most
	EXPECT_NEAR(fine, -0.01 * std::sin(20) * 20 * 0.01 / 24, 0.01 * 20 * 0.01 / 24 * 0.08);
	EXPECT_NEAR(coarse / fine, 4, 4 * 0.05);
}

TEST(CentralDifference, FreeFallIsExact)
{
	// With v = -g dt/2 half a step before the start, x_n = g (n dt)^2/2 exactly. Local damping acts on the force: (1 - alpha) g while
	// falling. 100 steps gather 100 roundings of positions of order 5, and velocities' roundings act for the rest of the run.
	for (const Real alpha : { 0.0, 0.35 }) {
		BlockAssembly a = twoBlocks(elasticJoint(1e9, 1e9));
		addGravity(a, { 0, -9.81 });
		const Real dt = 1e-5, g = -9.81 * (1 - alpha);
		for (Vec2& v : a.state.velocity)
			v.y() = -g * dt / 2;
		Damping local = damped(alpha > 0 ? Damping::Kind::local : Damping::Kind::none, alpha);
		for (int n = 0; n < 100; ++n) {
			computeForces(a);
			integrate(a, local, dt, n * dt);
		}
		const Real x = g * std::pow(100 * dt, 2) / 2;
		for (int n = 0; n < a.nodeCount(); ++n) {
			EXPECT_NEAR(a.state.displacement[n].y(), x, 1e3 * eps);
			EXPECT_NEAR(a.state.displacement[n].x(), 0, 1e3 * eps);
		}
	}
}

TEST(CentralDifference, KeepsMomentumWhileJointsBreak)
{
	// sum m v and sum m x_n x v_n-1/2 are kept exactly by the scheme, for internal forces have neither resultant nor moment.
	// 300 steps; forces up to 1e6 N a node x dt = 1e-6 s, 500 nodes with 50 roundings each, at random mostly: 300 x 1e0 x 500 x 50 eps
	// = 2e-9 at the very worst, against momenta of order 100.
	JointParams joint = elasticJoint(100e9, 40e9);
	joint.tension = joint.cohesion = 1e6;
	joint.tanPhi = joint.tanPhiResidual    = 0.7;
	joint.tanDilation                      = 0.1;
	BlockAssembly                        a = voronoi(1, 0.8, 5, 4, stone(), joint, 0.5);
	std::mt19937                         random(5);
	std::uniform_real_distribution<Real> speed(-1, 2);
	for (int block = 0; block < a.blockCount(); ++block) {
		const Real vx = speed(random), vy = speed(random);
		for (int n = a.mesh.firstNode[block]; n < a.mesh.firstNode[block + 1]; ++n) // and all towards the middle
			a.state.velocity[n] = Vec2(vx, vy) - 4 * (a.centroid(block) - Vec2(0.5, 0.4));
	}
	auto momentum = [&] {
		Eigen::Vector3d sum(0, 0, 0);
		for (int n = 0; n < a.nodeCount(); ++n)
			sum += a.mesh.mass[n] * Eigen::Vector3d(a.state.velocity[n].x(), a.state.velocity[n].y(), cross(a.position(n), a.state.velocity[n]));
		return sum;
	};
	const Eigen::Vector3d before = momentum();
	const Real            dt     = 0.5 * stableTimeStep(a, nodalStiffness(a), a.state.inertia);
	Damping               none   = damped(Damping::Kind::none);
	int                   broken = 0, sliding = 0;
	for (int i = 0; i < 300; ++i) {
		computeForces(a);
		integrate(a, none, dt, i * dt);
		broken = 0;
		for (int p = 0; p < a.pointCount(); ++p)
			broken += a.state.status[p] != Joint::intact, sliding += a.state.status[p] != Joint::intact && a.state.tau[p] != 0;
	}
	EXPECT_GT(broken, 20);
	EXPECT_GT(sliding, 0);
	EXPECT_GT(before.norm(), 100);
	EXPECT_LT((momentum() - before).norm(), 2e-9);
}

TEST(CentralDifference, SpinningBondedPairStaysTogether)
{
	// Two bonded blocks spin for a turn: the centrifugal stretch is rho omega^2 R^2 / E = 2000 x 100 x 1 / 2e10 = 1e-5 in strain and
	// joints of 1e12 Pa/m open by 2e5/1e12; nothing else happens: openings stay below ten times that, and energy stays.
	BlockAssembly a  = twoBlocks(elasticJoint(1e12, 0.4e12));
	const Real    dt = 0.5 * stableTimeStep(a, nodalStiffness(a), a.state.inertia), spin = 10;
	Vec2          centre = Vec2::Zero();
	Real          mass   = 0;
	for (int n = 0; n < a.nodeCount(); ++n)
		centre += a.mesh.mass[n] * a.position(n), mass += a.mesh.mass[n];
	centre /= mass;
	for (int n = 0; n < a.nodeCount(); ++n)
		a.state.velocity[n] = spin * Vec2(-(a.position(n) - centre).y(), (a.position(n) - centre).x());
	const Real energy = kineticEnergy(a);
	Damping    none   = damped(Damping::Kind::none);
	const int  steps  = int(2 * M_PI / spin / dt);
	Real       widest = 0;
	for (int i = 0; i < steps; ++i) {
		computeForces(a);
		for (int p = 0; p < a.pointCount(); ++p)
			widest = std::max({ widest, std::abs(a.state.opening[p]), std::abs(a.state.slip[p]) });
		integrate(a, none, dt, i * dt);
	}
	EXPECT_LT(widest, 2e-6);
	EXPECT_NEAR(kineticEnergy(a) + specimens::storedEnergy(a), energy, 1e-3 * energy); // half a step apart: strain energy/energy = 1e-5
	for (int n = 0; n < a.nodeCount(); ++n) // turned by the whole angle, but for the last fraction of a step and the stretch
		EXPECT_NEAR(a.state.displacement[n].norm(), 0, 2 * spin * dt + 1e-3);
}

// ---- damping

TEST(Damping, OneStepOfEach)
{
	//               force  v before  m   dt    expected velocity
	struct Row {
		const char* what;
		Damping     damping;
		Real        f, v, m, dt, expected;
	};
	const Damping viscous = damped(Damping::Kind::adaptive); // c = 4
	for (const Row& r : std::vector<Row> { { "none", damped(Damping::Kind::none), 6, 0.5, 2, 0.1, 0.8 },
	                                       { "local, with the motion: (1 - alpha) F", damped(Damping::Kind::local, 0.3), 6, 0.5, 2, 0.1, 0.71 },
	                                       { "local, against it: (1 + alpha) F", damped(Damping::Kind::local, 0.3), -6, 0.5, 2, 0.1, 0.11 },
	                                       { "local, from rest: the force decides", damped(Damping::Kind::local, 0.3), -6, 0, 2, 0.1, -0.21 },
	                                       // v + a dt/2 = 0.1 - 0.15 < 0: the motion has turned by mid-step, so the force drives it
	                                       { "local, turning: sign of v + a dt/2", damped(Damping::Kind::local, 0.3), -6, 0.1, 2, 0.1, -0.11 },
	                                       { "local, not yet turned", damped(Damping::Kind::local, 0.3), -6, 0.2, 2, 0.1, -0.19 },
	                                       // m (v' - v)/dt = F - c m (v' + v)/2: v' (1 + 0.2) = 0.5 (1 - 0.2) + 0.3
	                                       { "viscous", viscous, 6, 0.5, 2, 0.1, 0.7 / 1.2 } }) {
		SCOPED_TRACE(r.what);
		StepWork   work;
		const Real v = velocityAfter(r.damping, r.f, r.v, r.m, r.dt, 4, &work);
		EXPECT_NEAR(v, r.expected, 8 * eps);
		// dissipated = F.dx - change of kinetic energy, halves by the velocities before and after
		const Real drag = r.f - r.m * (r.expected - r.v) / r.dt;
		EXPECT_NEAR(work.dampingBefore, drag * r.v * r.dt / 2, 40 * eps);
		EXPECT_NEAR(work.dampingAfter, drag * r.expected * r.dt / 2, 40 * eps);
		EXPECT_NEAR(work.kinetic, r.m * r.v * r.expected / 2, 40 * eps);
	}
}

TEST(Damping, LocalDecrementOfAnOscillator)
{
	// Towards the middle the force drives with k (1 - alpha), from there on it brakes with k (1 + alpha): energies meet in the middle,
	// so that each half cycle leaves the amplitude times sqrt((1 - alpha)/(1 + alpha)). At omega dt = 0.01 peaks are missed by
	// (omega dt)^2/8, and every change of sign comes up to half a step off, where force or velocity are still omega dt small:
	// (omega dt)^2 each, 12 of them: 1.2e-3 of the amplitude in all.
	const Real          alpha = 0.3, amplitude = 0.01;
	const BlockAssembly start = oscillator();
	const Real          omega = modes(start, 0.1).omega[0], dt = 0.01 / omega;
	BlockAssembly       a = start;
	a.state.displacement[2].y() += amplitude;
	Damping           local = damped(Damping::Kind::local, alpha);
	std::vector<Real> peaks;
	Real              last = amplitude, dissipated = 0;
	const Real        stored = specimens::storedEnergy(a);
	for (int i = 0; peaks.size() < 6; ++i) {
		ASSERT_LT(i, 100000);
		const Real velocity = a.state.velocity[2].y();
		computeForces(a);
		const StepWork w = integrate(a, local, dt, i * dt, true);
		if (i > 0 && velocity * a.state.velocity[2].y() < 0) peaks.push_back(std::abs(last));
		dissipated += w.dampingBefore + w.dampingAfter;
		last = a.state.displacement[2].y();
	}
	for (int i = 0; i < 6; ++i)
		EXPECT_NEAR(peaks[i], amplitude * std::pow((1 - alpha) / (1 + alpha), (i + 1) / 2.), amplitude * 1.2e-3) << "half cycle " << i + 1;
	// At a peak, what was stored at first is dissipated but for (0.7/1.3)^6 of it
	EXPECT_NEAR(dissipated, stored * (1 - std::pow(0.7 / 1.3, 6)), stored * 2.4e-3);
}

TEST(Damping, AdaptiveCoefficient)
{
	const Real dt = 0.01;                                             // bounds: 0.005 and 100
	EXPECT_NEAR(Damping::adapted(2, 4.9, 10, dt), 2.04, 8 * eps);     // below half the rate: grows by 2 %
	EXPECT_NEAR(Damping::adapted(2, 5.1, 10, dt), 2 / 1.02, 8 * eps); // above: shrinks
	EXPECT_EQ(Damping::adapted(99.9, 0, 1, dt), 100);                 // c <= 1/dt
	EXPECT_GT(Damping::adapted(1e-30, 1, 0, dt), 0);                  // 0 < c
	EXPECT_NEAR(largestSafety(damped(Damping::Kind::local, 0.44)), 0.95 / 1.2, 4 * eps);
	EXPECT_EQ(largestSafety(damped(Damping::Kind::none, 0.44)), 0.95);
	EXPECT_EQ(largestSafety(damped(Damping::Kind::adaptive, 0.44)), 0.95);
}

TEST(Damping, EachFindsTheStaticSolution)
{
	// Three bonded bricks under gravity: Newton's method against dynamic relaxation. An unbalanced ratio of 1e-9 changes
	// displacements by 1e-9 x (nodes in the height = 9)^2 relatively at most. Gravity is 1000 g, so that rounding (E eps/zone = 1e-4 Pa)
	// stays well below 1e-9 of the stress (1e7 Pa).
	const auto build = [] {
		BlockAssembly a = column(3, 0.5, 0.2, 2, 2, stone(), elasticJoint(10e9, 4e9));
		a.addGroup(driven("foot", dofs(a, 1, [](const Vec2& x) { return x.y() == 0; }), 0));
		a.addGroup(driven("foot x", dofs(a, 0, [](const Vec2& x) { return x.y() == 0; }), 0));
		addGravity(a, { 3e3, -9.81e3 });
		return a;
	};
	BlockAssembly exact = build();
	solveStatics(exact, 1e-6, false, 5);
	Real most = 0;
	for (int n = 0; n < exact.nodeCount(); ++n)
		most = std::max(most, exact.state.displacement[n].norm());
	for (const auto kind : { Damping::Kind::local, Damping::Kind::adaptive }) {
		SCOPED_TRACE(int(kind));
		BlockAssembly a = build();
		scaleInertia(a, nodalStiffness(a), 1, 0.7);
		Damping damping = damped(kind, 0.5);
		int     steps   = 0;
		for (; steps < 20000; ++steps) {
			computeForces(a);
			if (steps > 0 && unbalancedRatio(a) < 1e-9) break;
			integrate(a, damping, 1, steps);
			if (kind == Damping::Kind::adaptive) {
				ASSERT_GT(a.state.viscosity, 0);
				ASSERT_LE(a.state.viscosity, 1);
			}
		}
		EXPECT_LT(steps, 20000) << "did not settle";
		for (int n = 0; n < a.nodeCount(); ++n)
			EXPECT_LT((a.state.displacement[n] - exact.state.displacement[n]).norm(), most * 1e-9 * 81 + 100 * eps) << "node " << n;
	}
}

// ---- groups

TEST(MotionGroup, SmoothStart)
{
	MotionGroup g = driven("g", { 0 }, 3, 2);
	g.startTime   = 10;
	EXPECT_EQ(g.ramp(9.9), 0);
	EXPECT_EQ(g.ramp(10), 0);
	EXPECT_NEAR(g.ramp(10.5), 0.15625, 4 * eps); // 3/16 - 2/64
	EXPECT_NEAR(g.ramp(11), 0.5, 4 * eps);
	EXPECT_EQ(g.ramp(12), 1);
	EXPECT_EQ(g.ramp(13), 1);
	g.rampTime = 0;
	EXPECT_EQ(g.ramp(9.9), 0);
	EXPECT_EQ(g.ramp(10), 1);
}

TEST(MotionGroup, DrivenBlocksGoWhereTheyAreTold)
{
	// After the ramp of T = 0.2 s the way is v (t - T/2): midpoint velocities integrate the ramp with an error of v dt^3/24 x [f''] =
	// v T (dt/T)^4 x 12/... below 1e-7 v T at 100 steps. The throttle halves the velocity from t = 0.5 s on.
	BlockAssembly a = triangle();
	const int     y = a.addGroup(driven("y", { 1, 3, 5 }, -0.6, 0.2));
	a.addGroup(driven("x", { 0, 2, 4 }, 0));
	const Real dt   = 0.002;
	Damping    none = damped(Damping::Kind::none);
	for (int i = 0; i < 500; ++i) {
		if (i == 250) a.state.groups[y].throttle = 0.5;
		integrate(a, none, dt, i * dt);
		if (i == 50) {
			EXPECT_NEAR(a.state.groups[y].velocity, -0.6 * a.state.groups[y].ramp(50.5 * dt), 4 * eps);
		}
	}
	const Real way = -0.6 * ((0.5 - 0.1) + 0.5 * 0.5);
	EXPECT_NEAR(a.state.groups[y].travelled, way, 0.6 * 0.2 * 1e-7);
	EXPECT_EQ(a.state.groups[y].velocity, -0.3);
	for (int n = 0; n < 3; ++n) {
		EXPECT_EQ(a.state.displacement[n].y(), a.state.groups[y].travelled); // the same sum
		EXPECT_EQ(a.state.displacement[n].x(), 0);
		EXPECT_EQ(a.state.velocity[n].y(), -0.3);
	}
}

TEST(MotionGroup, PlatenMovesAsOneUnderItsForce)
{
	// Two of three nodes joined in y, unequal in mass: acceleration = (sum of forces + applied) / sum of masses. The ramp counts at
	// the time of the forces.
	BlockAssembly a = triangle();
	a.state.inertia = { 2, 3, 5 };
	const int g     = a.addGroup(pushed("platen", { 5, 1 }, 40, 4));
	a.forces.nodal  = { { 1, -7 }, { 2, 6 }, { 3, 9 } };
	Damping none    = damped(Damping::Kind::none);
	integrate(a, none, 0.1, 2, true); // ramp(2) = 1/2
	EXPECT_NEAR(a.state.groups[g].velocity, (-7 + 9 + 20) / 7. * 0.1, 8 * eps);
	EXPECT_EQ(a.state.velocity[0].y(), a.state.groups[g].velocity);
	EXPECT_EQ(a.state.velocity[2].y(), a.state.groups[g].velocity);
	EXPECT_NEAR(a.state.velocity[1].y(), 6 / 3. * 0.1, 8 * eps);
	EXPECT_NEAR(a.state.velocity[2].x(), 3 / 5. * 0.1, 8 * eps);
	EXPECT_NEAR(a.state.groups[g].travelled, a.state.groups[g].velocity * 0.1, 8 * eps);
	EXPECT_EQ(a.state.groups[g].force, 20);

	// with damping: the group as a whole is what moves
	Damping local  = damped(Damping::Kind::local, 0.3);
	a.forces.nodal = { { 1, -7 }, { 2, 6 }, { 3, 9 } };
	Real before    = a.state.groups[g].velocity;
	integrate(a, local, 0.1, 4);
	EXPECT_NEAR(a.state.groups[g].velocity, before + 0.7 * (2 + 40) / 7. * 0.1, 16 * eps);
	Damping viscous   = damped(Damping::Kind::adaptive);
	a.state.viscosity = 4;
	before            = a.state.groups[g].velocity;
	integrate(a, viscous, 0.1, 4);
	EXPECT_NEAR(a.state.groups[g].velocity, (0.8 * before + 42 / 7. * 0.1) / 1.2, 16 * eps);
}

TEST(MotionGroup, ForceOnADrivenGroup)
{
	// What a driven group puts on the blocks: sum m a - sum F. From 0 to -0.5 m/s in one step of 0.1 s.
	BlockAssembly a = triangle();
	a.state.inertia = { 2, 3, 5 };
	const int g     = a.addGroup(driven("g", { 1, 5 }, -0.5));
	a.forces.nodal  = { { 1, -7 }, { 2, 6 }, { 3, 10 } };
	Damping none    = damped(Damping::Kind::none);
	integrate(a, none, 0.1, 0);
	EXPECT_NEAR(a.state.groups[g].force, -0.5 / 0.1 * 7 - 3, 40 * 4 * eps);
	integrate(a, none, 0.1, 0.1); // velocity kept: only -F
	EXPECT_NEAR(a.state.groups[g].force, -3, 40 * 4 * eps);
	// work: applied at n over half of each neighbouring step: -38 x (0 + -0.5)/2 x 0.1 at the first time, -3 x -0.5 x 0.05 so far
	EXPECT_NEAR(a.state.groups[g].work, 0.95 + 0.075, 40 * eps);
}

TEST(MotionGroup, RefusesBadInput)
{
	BlockAssembly a   = triangle();
	const Real    nan = std::nan("");
	a.addGroup(driven("foot", { 1, 3 }, 0));
	expectRefusal([&] { a.addGroup(driven("head", { 5, 3 }, 0)); }, { "\"head\"", "overlaps \"foot\"", "degree of freedom", "got 3" });
	expectRefusal([&] { a.addGroup(driven("head", {}, 0)); }, { "\"head\"", "at least one", "got 0" });
	expectRefusal([&] { a.addGroup(driven("head", { 4, 5, 4 }, 0)); }, { "\"head\"", "twice", "got 4" });
	expectRefusal([&] { a.addGroup(driven("head", { 6 }, 0)); }, { "\"head\"", "no such degree of freedom", "got 6" });
	expectRefusal([&] { a.addGroup(driven("head", { -1 }, 0)); }, { "\"head\"", "no such degree of freedom", "got -1" });
	expectRefusal([&] { a.addGroup(driven("head", { 5 }, nan)); }, { "\"head\"", "target", "finite", "nan" });
	expectRefusal([&] { a.addGroup(driven("head", { 5 }, 1, -0.25)); }, { "\"head\"", "rampTime", "not be negative [s]", "got -0.25" });
	const int rigid = a.addBlock({ { 0, -1 }, { 1, -1 }, { 0.5, -0.5 } }, { { 0, 1, 2 } }, {}, 0);
	expectRefusal([&] { a.addGroup(pushed("head", { 2 * a.mesh.firstNode[rigid] }, 1)); }, { "\"head\"", "rigid block", "got " });
	EXPECT_EQ(a.state.groups.size(), 1u);
	EXPECT_EQ(a.supports.mobility[2].y() > 0, true); // what was refused holds nothing
}
