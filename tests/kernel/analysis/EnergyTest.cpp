// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/analysis/StabilityWatch.hpp>

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
		const StepWork w = integrate(a, d, dt, time, true);
		damping += pending + w.dampingBefore;
		pending = w.dampingAfter;
		kinetic = w.kinetic;
		return stored + kinetic + damping + a.state.accounts.friction + a.state.accounts.fracture - groupWork(a) - loads;
	}
};

Damping damped(Damping::Kind kind)
{
	Damping d;
	d.kind = kind;
	return d;
}

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

// ---- the watch over runs that turn unstable

namespace {

/// Looks every 20 steps; the step of the first bad verdict, or -1.
long firstAlarm(BlockAssembly& a, StabilityWatch& watch, Real dt, int steps, StabilityWatch::Verdict& verdict)
{
	Damping none = damped(Damping::Kind::none);
	for (int i = 0; i < steps; ++i) {
		computeForces(a);
		if (i % 20 == 0 && !(verdict = watch.look(a, i, i * dt, dt)).stable) return i;
		integrate(a, none, dt, i * dt);
	}
	return -1;
}

BlockAssembly pulled()
{
	BlockAssembly a = column(3, 0.5, 0.2, 2, 2, stone(), elasticJoint(200e9, 80e9));
	a.addGroup(driven("foot", dofs(a, 1, [](const Vec2& x) { return x.y() == 0; }), 0));
	a.addGroup(driven("head", dofs(a, 1, [](const Vec2& x) { return x.y() > 0.6 - 1e-9; }), 0.01, 1e-4));
	return a;
}

} // namespace

TEST(StabilityWatch, SeesAnUnstableRunAndKeepsTheLastGoodState)
{
	// 1.05 times the true limit: the fastest mode grows by exp(2 acosh(1.05)) = exp(0.63) a step from rounding (1e-16 m). It has the
	// driven motion's energy (strain 1e-6, displacements 1e-7 m) after ln(1e9)/0.63 = 33 steps or so; two looks later it is seen.
	BlockAssembly           a  = pulled();
	const Real              dt = 1.05 * 2 / modes(a, 1e-7).omega.maxCoeff();
	StabilityWatch          watch;
	StabilityWatch::Verdict verdict;
	const long              step = firstAlarm(a, watch, dt, 400, verdict);
	ASSERT_GT(step, 0);
	EXPECT_LT(step, 200);
	EXPECT_NE(verdict.reason.find("energy grew without work"), std::string::npos) << verdict.reason;
	EXPECT_TRUE(verdict.block >= 0 && verdict.block < 3);
	EXPECT_EQ(a.firstBadNode(), -1) << "seen before numbers run out";

	const long good = watch.restore(a);
	EXPECT_GE(good, 0);
	EXPECT_LT(good, step);
	EXPECT_EQ(watch.goodTime(), good * dt);
	for (int n = 0; n < a.nodeCount(); ++n)
		EXPECT_LT(a.state.displacement[n].norm(), 1e-5);
}

TEST(StabilityWatch, LetsStableRunsBe)
{
	BlockAssembly           a = pulled();
	StabilityWatch          watch;
	StabilityWatch::Verdict verdict;
	EXPECT_EQ(firstAlarm(a, watch, 0.98 * 2 / modes(a, 1e-7).omega.maxCoeff(), 2000, verdict), -1) << verdict.reason;
}

/// `first` undamped steps, and then no alarm in 3000 more.
static void expectSilenceFrom(BlockAssembly& a, int first, Real dt)
{
	StabilityWatch          watch;
	StabilityWatch::Verdict verdict;
	Damping                 none = damped(Damping::Kind::none);
	for (int i = 0; i < first; ++i) {
		computeForces(a);
		integrate(a, none, dt, i * dt);
	}
	EXPECT_EQ(firstAlarm(a, watch, dt, 3000, verdict), -1) << verdict.reason;
}

TEST(StabilityWatch, LetsModesNearTheLimitSwing)
{
	// At 0.95 of the limit a mode's sum of elastic energy and m v_before^2 / 2 swings by up to 2/(1 - 0.95^2) = 20; a random
	// start is full of such modes, and nobody does work.
	BlockAssembly                        a  = pulled();
	const Real                           dt = 0.95 * 2 / modes(a, 1e-7).omega.maxCoeff();
	std::mt19937                         random(5);
	std::uniform_real_distribution<Real> shift(-1e-9, 1e-9);
	a.state.groups[1].target = 0;
	for (int n = 0; n < a.nodeCount(); ++n)
		a.state.displacement[n] += Vec2(shift(random), shift(random));
	for (const int first : { 0, 1, 7 }) // whatever state it begins with
		expectSilenceFrom(a, first, dt);
}

TEST(StabilityWatch, LetsAPlatenSwing)
{
	// A thin layer between a held foot and a platen that is pushed by nothing: one degree of freedom, k = E A/h = 4e11 N/m and half the
	// layer's mass, at 0.95 of its limit; it is the group that swings, the free grid points' share is none.
	BlockAssembly a;
	a.addMaterial({ 20e9, 0, 2000 });
	addGrid(a, { 0, 0 }, 0.5, 0.025, 2, 1);
	a.addGroup(driven("foot", dofs(a, 1, [](const Vec2& x) { return x.y() == 0; }), 0));
	a.addGroup(driven("aside", dofs(a, 0, [](const Vec2&) { return true; }), 0));
	a.addGroup(pushed("platen", dofs(a, 1, [](const Vec2& x) { return x.y() > 0; }), 0));
	const Real dt = 0.95 * 2 / std::sqrt(20e9 / 0.025 * 0.5 / (2000 * 0.5 * 0.025 / 2));
	for (int n = 0; n < a.nodeCount(); ++n)
		if (a.mesh.reference[n].y() > 0) a.state.displacement[n].y() += 1e-9;
	for (const int first : { 0, 1, 3, 7 })
		expectSilenceFrom(a, first, dt);
}

TEST(StabilityWatch, NamesTheBlockThatIsNotANumber)
{
	BlockAssembly  a = pulled();
	StabilityWatch watch;
	EXPECT_EQ(watch.restore(a), -1); // nothing to put back yet
	EXPECT_TRUE(watch.look(a, 0, 0, 0.005).stable);
	a.state.velocity[a.mesh.firstNode[1] + 2].x() = std::nan("");
	const auto verdict                            = watch.look(a, 20, 0.1, 0.005);
	EXPECT_FALSE(verdict.stable);
	EXPECT_EQ(verdict.block, 1);
	EXPECT_EQ(watch.restore(a), 0);
	EXPECT_EQ(a.firstBadNode(), -1);
}
