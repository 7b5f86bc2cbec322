// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>

using namespace specimens;

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
