// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>

using namespace specimens;

namespace {

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
