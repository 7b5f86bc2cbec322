// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/analysis/StabilityWatch.hpp>

using namespace specimens;

namespace {

/// Looks every 20 steps; the step of the first bad verdict, or -1.
long firstAlarm(BlockAssembly& a, StabilityWatch& watch, Real dt, int steps, StabilityWatch::Verdict& verdict)
{
	Damping none = damped(Damping::Kind::none);
	for (int i = 0; i < steps; ++i) {
		computeForces(a);
		if (i % 20 == 0 && !(verdict = watch.look(a, i, i * dt, dt)).stable) return i;
		move(a, none, dt, i * dt);
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

/// `first` undamped steps, and then no alarm in 3000 more.
static void expectSilenceFrom(BlockAssembly& a, int first, Real dt)
{
	StabilityWatch          watch;
	StabilityWatch::Verdict verdict;
	Damping                 none = damped(Damping::Kind::none);
	for (int i = 0; i < first; ++i) {
		computeForces(a);
		move(a, none, dt, i * dt);
	}
	EXPECT_EQ(firstAlarm(a, watch, dt, 3000, verdict), -1) << verdict.reason;
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
