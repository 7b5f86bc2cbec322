// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>

using namespace specimens;

namespace {

/// All accounts of a run, kept as a user would.
struct Books {
	Real damping = 0, pending = 0, kinetic = 0;

	/// Forces and one step; returns stored + kinetic + dissipated - work at the time of the forces.
	Real step(BlockAssembly& a, Damping& d, Real dt, Real time)
	{
		blocks::computeForces(a, Brittle {}, dt, true);
		const Real     stored = specimens::storedEnergy(a), loads = loadWork(a);
		const StepWork w = move(a, d, dt, time, true);
		damping += pending + w.dampingBefore;
		pending = w.dampingAfter;
		kinetic = w.kinetic;
		return stored + kinetic + damping + a.state.accounts.friction + a.state.accounts.fracture - groupWork(a) - loads;
	}
};

void shake(BlockAssembly& a, Real speed)
{
	std::mt19937                         random(5);
	std::uniform_real_distribution<Real> v(-speed, speed);
	for (int n = 0; n < a.nodeCount(); ++n) {
		const Real vx = v(random), vy = v(random);
		a.state.velocity[n] = { vx, vy };
	}
}

} // namespace

TEST(Energy, LinearSystemBalancesToRounding)
{
	// One brick in small strain (linear), held and driven, pushed and loaded; every kind of damping. The balance of the scheme is exact:
	// m v- v+/2 + U changes by the trapezoidal work of all other forces. 400 steps, each with 100 roundings of the turnover.
	for (const auto kind : { Damping::Kind::none, Damping::Kind::local, Damping::Kind::adaptive }) {
		SCOPED_TRACE(int(kind));
		BlockAssembly a;
		a.strain    = Strain::small;
		a.thickness = 0.3;
		a.addMaterial(stone());
		addGrid(a, { 0, 0 }, 0.5, 0.4, 3, 2);
		addGravity(a, { 2, -9.81 });
		addTraction(a, 4, { 3e4, 1e4 });
		const Real dt = 0.5 * stableTimeStep(a, nodalStiffness(a), a.state.inertia);
		a.addGroup(driven("foot", dofs(a, 1, [](const Vec2& x) { return x.y() == 0; }), 0.02, 100 * dt));
		a.addGroup(driven("foot x", dofs(a, 0, [](const Vec2& x) { return x.y() == 0; }), 0));
		a.addGroup(pushed("head", dofs(a, 1, [](const Vec2& x) { return x.y() == 0.4; }), -2e4, 50 * dt));
		Books      accounts;
		Damping    damping = damped(kind);
		const Real first   = accounts.step(a, damping, dt, 0);
		Real       worst = 0, turnover = 0;
		for (int i = 1; i < 400; ++i) {
			worst    = std::max(worst, std::abs(accounts.step(a, damping, dt, i * dt) - first));
			turnover = std::max(turnover, specimens::storedEnergy(a) + std::abs(accounts.kinetic));
		}
		EXPECT_GT(turnover, 1e-3);
		if (kind != Damping::Kind::none)
			EXPECT_GT(accounts.damping, 0.05 * turnover);
		else
			EXPECT_LT(std::abs(accounts.damping), 400 * 100 * eps * turnover);
		// energies are differences of positions of order 1 with strains of 1e-5 or so: U rounds by E V strain eps
		EXPECT_LT(worst, 400 * 100 * eps * turnover + 400 * 20e9 * 0.06 * 1e-5 * eps);
	}
}

TEST(Energy, BondedBlocksBalanceToSecondOrder)
{
	// Turning frames and zones make the system non-linear: the error of a run of fixed length falls as dt^2 (dt/2: a quarter). Steps of
	// a quarter of the limit and less, where the highest modes count (omega dt)^2/8 = 3 % or less: orders within 0.15 of 2.
	auto error = [](int half) {
		BlockAssembly a = voronoi(0.5, 0.4, 3, 2, { 1e6, 0.2, 2000 }, elasticJoint(8e6, 3e6), 0.3);
		shake(a, 0.8); // strains of v/c = 0.8/22 = 4 %
		const Real dt = 0.5 * stableTimeStep(a, nodalStiffness(a), a.state.inertia) / half;
		Books      accounts;
		Damping    none  = damped(Damping::Kind::none);
		const Real first = accounts.step(a, none, dt, 0);
		Real       sum   = 0;
		for (int i = 1; i < 400 * half; ++i)
			sum += std::pow((accounts.step(a, none, dt, i * dt) - first) / first, 2);
		return std::sqrt(sum / (400 * half)); // root mean square, relative
	};
	const Real coarse = error(2), fine = error(4), finer = error(8);
	EXPECT_LT(coarse, 1e-3); // strain x (omega dt)^2/24
	EXPECT_NEAR(std::log2(coarse / fine), 2, 0.15);
	EXPECT_NEAR(std::log2(fine / finer), 2, 0.1);
}

TEST(Energy, BalanceWhileJointsBreakAndSlide)
{
	// A wall crushed between two platens with all that joints can do. Joints are booked by the trapezoidal rule, as the scheme does work,
	// so that the balance holds through every kink of the law; what is left is geometry: a step turns a frame or a zone by
	// 0.5 m/s x dt / 0.1 m = 1e-6, and the error is second order in that and in the strain (1e-4): below 1e-8, and at half the
	// step at most a third of it.
	auto error = [](int half) {
		JointParams joint = elasticJoint(100e9, 40e9);
		joint.tension = 1e6, joint.cohesion = 2e6, joint.tanPhi = 0.8;
		joint.cohesionResidual = 0.2e6, joint.tanPhiResidual = 0.6, joint.tanDilation = 0.1;
		BlockAssembly a  = voronoi(0.5, 0.6, 4, 5, stone(), joint, 0.3);
		const Real    dt = 0.4 * stableTimeStep(a, nodalStiffness(a), a.state.inertia) / half;
		a.addGroup(driven("foot", dofs(a, 1, [](const Vec2& x) { return x.y() == 0; }), 0));
		a.addGroup(driven("head", dofs(a, 1, [](const Vec2& x) { return x.y() == 0.6; }), -0.5, 500 * half * dt));
		Books      accounts;
		Damping    damping = damped(Damping::Kind::local);
		const Real first   = accounts.step(a, damping, dt, 0);
		Real       worst   = 0;
		for (int i = 1; i < 3000 * half; ++i)
			worst = std::max(worst, std::abs(accounts.step(a, damping, dt, i * dt) - first));
		int broken = 0;
		for (Joint status : a.state.status)
			broken += status != Joint::intact;
		EXPECT_GT(broken, 10);
		EXPECT_GT(a.state.accounts.fracture, 1e-3 * groupWork(a));
		EXPECT_GT(a.state.accounts.friction, 1e-3 * groupWork(a));
		EXPECT_GT(accounts.damping, 1e-3 * groupWork(a));
		return worst / groupWork(a);
	};
	const Real coarse = error(1), fine = error(2);
	EXPECT_LT(coarse, 1e-8);
	EXPECT_LT(fine, coarse / 3);
}

TEST(Energy, PartsInClosedForm)
{
	// A column of two bricks, 0.8 x 0.5, thickness 2, nu = 0: stretched by e in y, upper one moved by (0, 1e-5) more.
	// Zones: E e^2/2 each volume 0.8; joint: kn un^2/2 on 1.6 m2.
	BlockAssembly a = column(2, 0.8, 0.5, 1, 2, { 20e9, 0, 2000 }, elasticJoint(100e9, 40e9), 2);
	const Real    e = 1e-4;
	for (int n = 0; n < a.nodeCount(); ++n) {
		a.state.displacement[n].y() += e * a.mesh.reference[n].y() + (n >= a.mesh.firstNode[1] ? 1e-5 : 0);
		a.state.velocity[n] = { 0.3, -0.4 };
	}
	computeForces(a);
	// strains round by 20 eps/0.25, relative to 1e-4: 2e-10; openings by 10 eps of 1e-5: 2e-10; twice that in energies
	EXPECT_NEAR(zoneEnergy(a), 20e9 * e * e / 2 * 1.6, 160 * 4e-10);
	EXPECT_NEAR(jointEnergy(a), 100e9 * 1e-10 / 2 * 1.6, 8 * 4e-10);
	EXPECT_NEAR(kineticEnergy(a), 0.5 * 2000 * 1.6 * 0.25, 400 * 100 * eps);
	EXPECT_EQ(loadWork(a), 0);
	addGravity(a, { 0, -10 });
	// lumped masses: the mean displacement of each brick, e (0.25), e (0.75) + 1e-5
	EXPECT_NEAR(loadWork(a), -10 * 2000 * 0.8 * (e * 0.25 + e * 0.75 + 1e-5), 2 * 1e-9);
}

TEST(Energy, FractureAndFrictionOfOneJoint)
{
	// One joint, moved by hand: stretched to 1.2e-5 in steps, beyond its strength of 1e6 Pa (1.0e-5 m); then closed, pressed and
	// dragged. Fracture sets free what was stored and taken in within the step of breaking; friction is limit x slip.
	JointParams joint = elasticJoint(100e9, 40e9);
	joint.tension = 1e6, joint.tanPhiResidual = 0.5;
	BlockAssembly   a      = column(2, 0.8, 0.5, 1, 1, { 20e9, 0, 2000 }, joint, 2); // 1.6 m2
	const Accounts& d      = a.state.accounts;
	auto            moveTo = [&](Real un, Real us) {
                for (int n = a.mesh.firstNode[1]; n < a.nodeCount(); ++n)
                        a.state.displacement[n] = Vec2(-us, un); // n = (0,1), t = (-1,0)
                blocks::computeForces(a, Brittle {}, 0, true);
	};
	moveTo(0.9e-5, 0);                // elastic: work = stored
	EXPECT_NEAR(d.friction, 0, 1e-9); // energies of 6 J, strokes of 1e-5 known to 2e-10
	EXPECT_NEAR(d.fracture, 0, 1e-9);
	// breaks between 0.9e-5 and 1.2e-5: work (0.9e6 + 0)/2 x 0.3e-5 = 1.35, set free 0.9e6 x 0.9e-5/2 = 4.05: 5.4 J/m2
	moveTo(1.2e-5, 0);
	EXPECT_NEAR(d.fracture, 5.4 * 1.6, 1e-8);
	EXPECT_NEAR(d.friction, 0, 1e-9);
	// closed to -2e-5 in 100 steps: only the step that closes errs, by kn du^2/8-ish: it works with the mean of 0 and sigma
	const Real fracture = d.fracture;
	for (int i = 1; i <= 100; ++i)
		moveTo(1.2e-5 - 3.2e-5 * i / 100, 0);
	EXPECT_NEAR(d.friction, 0, 100e9 * std::pow(3.2e-7, 2) / 2 * 1.6);
	// dragged by 1e-4 under 2e6 x 0.5 = 1e6 Pa: elastic to 2.5e-5, then 7.5e-5 of sliding: 75 J/m2
	const Real closing = d.friction;
	for (int i = 1; i <= 100; ++i)
		moveTo(-2e-5, 1e-4 * i / 100);
	EXPECT_NEAR(d.friction - closing, 75 * 1.6, 40e9 * 1e-12 / 8 * 1.6 + 1e-6);
	EXPECT_EQ(d.fracture, fracture);
}

TEST(Energy, UnbalancedRatio)
{
	// Joint of 1.6 m2 under sigma = 3, tau = -0.8 (frame n = (0,1), t = (-1,0)): sum |F| = 1.6 (3 + 0.8) = 6.08.
	BlockAssembly a = column(2, 0.8, 0.5, 1, 1, { 20e9, 0, 2000 }, elasticJoint(100, 40), 2);
	std::fill(a.state.sigma.begin(), a.state.sigma.end(), 3);
	std::fill(a.state.tau.begin(), a.state.tau.end(), -0.8);
	a.addGroup(driven("held", { 0 }, 0));
	a.forces.nodal[0] = { 100, -0.5 }; // x is held: does not count
	a.forces.nodal[5] = { 0.2, 0.3 };
	EXPECT_NEAR(unbalancedRatio(a), 1.0 / (2 * 6.08), 8 * eps);
	EXPECT_NEAR(unbalancedRatio(a, 10), 1.0 / 20, 8 * eps);
	EXPECT_NEAR(unbalancedRatio(a, 5), 1.0 / (2 * 6.08), 8 * eps);
	std::fill(a.state.sigma.begin(), a.state.sigma.end(), 0);
	std::fill(a.state.tau.begin(), a.state.tau.end(), 0);
	EXPECT_EQ(unbalancedRatio(a), 0); // no contact force and no floor: no scale
}
