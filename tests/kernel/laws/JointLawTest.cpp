// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>

using namespace specimens;

namespace {

constexpr Real inf = std::numeric_limits<Real>::infinity();

/// Round numbers, all different, so that no two can be taken for each other.
JointParams mortar()
{
	JointParams p;
	p.kn               = 100e9;
	p.ks               = 40e9;
	p.cohesion         = 2e6;
	p.tanPhi           = 0.8;
	p.tension          = 1e6;
	p.cohesionResidual = 0.3e6;
	p.tanPhiResidual   = 0.5;
	return p;
}

struct JointCase {
	const char* what;
	JointState  old;
	Real        un, us; // [m]
	Joint       status;
	Real        sigma, tau;  // [Pa]
	Real        slipPlastic; // [m]
};

// Every number is a sum of a few products of numbers given with 2 digits: some 5 roundings of the largest term in it,
// which is at most 5e6 Pa (or 1.3e-4 m).
constexpr Real stressTolerance = 5 * eps * 5e6, slipTolerance = 5 * eps * 1.3e-4;

void check(const JointParams& p, const std::vector<JointCase>& table)
{
	for (const JointCase& c : table) {
		SCOPED_TRACE(c.what);
		const JointStep now = advance(p, c.old, c.un, c.us);
		EXPECT_EQ(int(now.state.status), int(c.status));
		EXPECT_NEAR(now.sigma, c.sigma, stressTolerance);
		EXPECT_NEAR(now.tau, c.tau, stressTolerance);
		EXPECT_NEAR(now.state.slipPlastic, c.slipPlastic, slipTolerance);
		EXPECT_EQ(now.state.uplift, 0);
	}
}

const JointState intact {}, tensile { 0, 0, Joint::brokenInTension }, sheared { 0, 0, Joint::brokenInShear }, unbonded { 0, 0, Joint::unbonded };

} // namespace

TEST(JointLaw, OneStepPerThingThePaperSays)
{
	//   what                                       old       un        us       status                  sigma    tau       slipPlastic
	check(mortar(),
	      {
		      { "elastic, open", intact, 0.8e-5, 1.0e-5, Joint::intact, 0.8e6, 0.4e6, 0 },
		      { "elastic, closed: beyond c, not c + friction", intact, -2.0e-5, -8.0e-5, Joint::intact, -2.0e6, -3.2e6, 0 },
		      { "tension lowers the shear strength", intact, 0.8e-5, 3.5e-5, Joint::brokenInShear, 0, 0, 3.5e-5 },
		      { "tensile failure drops to nothing", intact, 1.1e-5, 0.5e-5, Joint::brokenInTension, 0, 0, 0.5e-5 },
		      { "tension is tested before shear", intact, 1.1e-5, 9.0e-5, Joint::brokenInTension, 0, 0, 9.0e-5 },
		      { "no tensile failure just below the strength", intact, 0.999e-5, 1.0e-5, Joint::intact, 0.999e6, 0.4e6, 0 },
		      // |tau| = 4 > 2 + 2 x 0.8 = 3.6; residual 0.3 + 2 x 0.5 = 1.3 in the same step; slip 1e-4 - 1.3e6/ks
		      { "shear failure under pressure", intact, -2.0e-5, 1.0e-4, Joint::brokenInShear, -2.0e6, 1.3e6, 6.75e-5 },
		      { "shear failure, other way", intact, -2.0e-5, -1.0e-4, Joint::brokenInShear, -2.0e6, -1.3e6, -6.75e-5 },
		      { "broken, open: nothing, slip follows", tensile, 3.0e-5, 2.0e-5, Joint::brokenInTension, 0, 0, 2.0e-5 },
		      { "broken, closed again, sticking", tensile, -1.0e-5, 1.0e-5, Joint::brokenInTension, -1.0e6, 0.4e6, 0 },
		      { "broken, closed again, sliding", tensile, -1.0e-5, 5.0e-5, Joint::brokenInTension, -1.0e6, 0.8e6, 3.0e-5 },
		      { "broken joints do not break again", sheared, -4.0e-5, 1.0e-4, Joint::brokenInShear, -4.0e6, 2.3e6, 4.25e-5 },
		      { "slip memory: stress from slip - plastic",
	                { 4e-5, 0, Joint::brokenInShear },
	                -2.0e-5,
	                3.0e-5,
	                Joint::brokenInShear,
	                -2.0e6,
	                -0.4e6,
	                4e-5 },
		      { "reversal slides at the opposite limit",
	                { 6.75e-5, 0, Joint::brokenInShear },
	                -2.0e-5,
	                1.0e-5,
	                Joint::brokenInShear,
	                -2.0e6,
	                -1.3e6,
	                4.25e-5 },
		      { "unbonded, open", unbonded, 1.0e-7, 1.0e-5, Joint::unbonded, 0, 0, 1.0e-5 },
	      });
}

TEST(JointLaw, ResidualStrengths)
{
	JointParams keepsTension     = mortar();
	keepsTension.tensionResidual = 0.5e6;
	check(keepsTension,
	      {
		      { "beyond the peak", intact, 1.1e-5, 0, Joint::brokenInTension, 0, 0, 0 },
		      { "below the residual: carried", tensile, 0.4e-5, 0.2e-5, Joint::brokenInTension, 0.4e6, 0.08e6, 0 },
		      { "friction limit falls in tension", tensile, 0.4e-5, 1.0e-5, Joint::brokenInTension, 0.4e6, 0.1e6, 0.75e-5 }, // 0.3 - 0.4 x 0.5
		      { "beyond the residual", tensile, 0.6e-5, 0.2e-5, Joint::brokenInTension, 0, 0, 0.2e-5 },
	      });

	JointParams dry = mortar(); // as two blocks that merely touch
	dry.cohesion = dry.tension = dry.cohesionResidual = 0;
	check(dry,
	      {
		      { "sticking", unbonded, -2.0e-5, 2.0e-5, Joint::unbonded, -2.0e6, 0.8e6, 0 },
		      { "sliding: sigma tan", unbonded, -2.0e-5, -9.0e-5, Joint::unbonded, -2.0e6, -1.0e6, -6.5e-5 },
	      });

	JointParams slippery      = mortar();
	slippery.cohesionResidual = slippery.tanPhiResidual = 0;
	check(slippery, { { "no strength is left", intact, -2.0e-5, 1.0e-4, Joint::brokenInShear, -2.0e6, 0, 1.0e-4 } });
}

TEST(JointLaw, ClosesAfterOpeningAtTheNewPlace)
{
	// Breaks in tension, moves 7e-5 while open, closes: no shear stress until it moves on from there.
	const JointParams p    = mortar();
	JointStep         step = advance(p, intact, 2e-5, 1e-5);
	step                   = advance(p, step.state, 5e-5, 7e-5);
	step                   = advance(p, step.state, -1e-5, 7e-5);
	EXPECT_NEAR(step.sigma, -1e6, stressTolerance);
	EXPECT_NEAR(step.tau, 0, stressTolerance);
	step = advance(p, step.state, -1e-5, 7.5e-5);
	EXPECT_NEAR(step.tau, 40e9 * 0.5e-5, stressTolerance);
	EXPECT_NEAR(step.state.slipPlastic, 7e-5, slipTolerance);
}

TEST(JointLaw, CycleOfSlipDissipatesItsLoop)
{
	// Broken, sigma = -2e6: limit 1.3e6 Pa. A closed cycle between -+1e-4 m encloses the parallelogram
	// 2 limit x (2 x 1e-4 - 2 limit / ks) = 2 x 1.3e6 x (2e-4 - 6.5e-5) = 351 J/m2.
	const JointParams p     = mortar();
	JointState        state = sheared;
	Real              us = 1e-4, tau = 0, work = 0;
	const int         n    = 200; // steps between the ends
	auto              move = [&](Real to, bool count) {
                const Real from = us;
                for (int i = 1; i <= n; ++i) {
                        const Real      next = from + (to - from) * i / n;
                        const JointStep now  = advance(p, state, -2e-5, next);
                        if (count) work += (tau + now.tau) / 2 * (next - us);
                        us = next, tau = now.tau, state = now.state;
                }
	};
	move(-1e-4, false);
	move(1e-4, true);
	move(-1e-4, true);
	// The trapezoidal rule is exact but in the two steps with a kink, each wrong by at most ks du^2/8 = 40e9 x (1e-6)^2 / 8.
	EXPECT_NEAR(work, 351, 2 * 40e9 * 1e-12 / 8 + 1e-9);
	EXPECT_NEAR(state.slipPlastic, -6.75e-5, slipTolerance * n); // 1e-4 - limit / ks; every step adds its rounding
}

TEST(JointLaw, Dilation)
{
	JointParams p       = mortar();
	p.tanDilation       = 0.2;
	p.dilationLimitSlip = 5e-5;
	const auto old      = [](Real plastic, Real raised) { return JointState { plastic, raised, Joint::brokenInShear }; };
	EXPECT_EQ(uplift(p, 0), 0);
	EXPECT_NEAR(uplift(p, 3e-5), 0.6e-5, slipTolerance);
	EXPECT_NEAR(uplift(p, -3e-5), 0.6e-5, slipTolerance);
	EXPECT_NEAR(uplift(p, 9e-5), 1.0e-5, slipTolerance); // beyond the limit slip: no more

	// At un = 0 the dilated joint presses, at the end of the step: slip 3.8e-5, uplift 0.76e-5, sigma = -0.76e6, friction 0.3e6 + 0.38e6 = ks (5.5e-5
	// - 3.8e-5).
	const JointStep on = advance(p, old(3e-5, 0.6e-5), 0, 5.5e-5);
	EXPECT_NEAR(on.sigma, -0.76e6, stressTolerance);
	EXPECT_NEAR(on.tau, 0.68e6, stressTolerance);
	EXPECT_NEAR(on.state.slipPlastic, 3.8e-5, slipTolerance);
	EXPECT_NEAR(on.state.uplift, 0.76e-5, slipTolerance);

	// Farther, up to the limit slip: uplift 1.0e-5, friction 0.3e6 + 0.5e6.
	const JointStep slid = advance(p, old(3e-5, 0.6e-5), 0, 7.5e-5);
	EXPECT_NEAR(slid.sigma, -1.0e6, stressTolerance);
	EXPECT_NEAR(slid.tau, 0.8e6, stressTolerance);
	EXPECT_NEAR(slid.state.slipPlastic, 5.5e-5, slipTolerance);
	EXPECT_NEAR(slid.state.uplift, 1.0e-5, slipTolerance);

	// Reversal: back to a smaller plastic slip; what it was raised by stays.
	const JointStep back = advance(p, slid.state, 0, 1e-5);
	EXPECT_NEAR(back.sigma, -1.0e6, stressTolerance);
	EXPECT_NEAR(back.tau, -0.8e6, stressTolerance); // 0.3 + 0.5
	EXPECT_NEAR(back.state.slipPlastic, 3e-5, slipTolerance);
	EXPECT_EQ(back.state.uplift, slid.state.uplift);

	p.dilationLimitSlip = inf;
	EXPECT_NEAR(uplift(p, 9e-5), 1.8e-5, slipTolerance);
}

TEST(JointLaw, DilatesByWhatItSlidesClosedAlone)
{
	// Breaking sets free a slip of (|tau| - tau_res)/ks, and an open joint follows the blocks: neither works against a pressure, and neither lifts.
	JointParams p          = mortar();
	p.tanDilation          = 0.2;
	const JointStep breaks = advance(p, intact, -1e-6, 2e-4);
	ASSERT_EQ(breaks.state.status, Joint::brokenInShear);
	ASSERT_GT(breaks.state.slipPlastic, 1e-5);
	EXPECT_EQ(breaks.state.uplift, 0);
	const JointStep opens = advance(p, breaks.state, 1e-6, 3e-4);
	EXPECT_EQ(opens.state.slipPlastic, 3e-4);
	EXPECT_EQ(opens.state.uplift, 0);
	const JointStep closes = advance(p, opens.state, -1e-6, 4e-4);
	ASSERT_LT(closes.sigma, 0);
	EXPECT_NEAR(closes.state.uplift, 0.2 * (closes.state.slipPlastic - 3e-4), slipTolerance);
	// Back and forth: lifted anew only where it slides farther out than at its return.
	const JointStep back = advance(p, closes.state, -1e-6, 2e-4);
	EXPECT_EQ(back.state.uplift, closes.state.uplift);
}

TEST(JointLaw, FrictionPaysForWhatDilationLifts)
{
	// Work less what the springs hold, step by step on random paths that open, close and turn round: never negative, as the dilation angle is the smaller
	// one. A leg has 400 steps; where a step passes a change of mode, the mean of both ends is off by its stress times its length, 1/400 of the turnover at
	// most.
	std::mt19937                         random(11);
	std::uniform_real_distribution<Real> unit(0, 1);
	constexpr int                        steps = 400;
	for (int c = 0; c < 1000; ++c) {
		JointParams p;
		p.kn = 1e9, p.ks = p.kn * std::pow(10, 1.3 * unit(random) - 1);
		p.tanPhiResidual = 1.2 * unit(random), p.tanDilation = p.tanPhiResidual * unit(random);
		p.cohesionResidual  = c % 3 ? 0 : 3e2 * unit(random);
		p.dilationLimitSlip = c % 4 ? std::numeric_limits<Real>::max() : 1e-6;
		JointStep at { 0, 0, { 0, 0, Joint::unbonded } };
		Real      un = 0, us = 0, turnover = 0;
		for (int leg = 0; leg < 8; ++leg) {
			const Real dun = (1e-6 * (1.3 * unit(random) - 1) - un) / steps, dus = (6e-6 * (unit(random) - 0.5) - us) / steps;
			Real       given = 0;
			for (int i = 0; i < steps; ++i) {
				un += dun, us += dus;
				const JointStep now  = advance(p, at.state, un, us);
				const Real      work = (at.sigma + now.sigma) / 2 * dun + (at.tau + now.tau) / 2 * dus;
				given += std::min(Real(0), work - storedEnergy(p, now.sigma, now.tau) + storedEnergy(p, at.sigma, at.tau));
				turnover += std::abs(work);
				at = now;
			}
			ASSERT_GT(given, -turnover / steps - 1e-12) << "case " << c << " leg " << leg;
		}
	}
}

TEST(JointLaw, StoredEnergyIsTheWorkOfTheElasticSprings)
{
	// Straight from (0, 0) to (un, us): work = (sigma un + tau us) / 2; three roundings of each term.
	const JointStep s = advance(mortar(), intact, -1.5e-5, 2e-5);
	EXPECT_NEAR(blocks::storedEnergy(mortar(), s.sigma, s.tau), (1.5e6 * 1.5e-5 + 0.8e6 * 2e-5) / 2, 6 * eps * 20);
}

TEST(JointLaw, RefusesImpossibleParameters)
{
	struct Case {
		Real JointParams::*member;
		Real               value;
		const char *       name, *rule, *shown;
	};
	const Real nan = std::nan("");
	for (const Case& c : std::vector<Case> { { &JointParams::kn, 0, "kn", "positive and finite [Pa/m]", "0" },
	                                         { &JointParams::kn, inf, "kn", "positive and finite [Pa/m]", "inf" },
	                                         { &JointParams::kn, nan, "kn", "positive and finite [Pa/m]", "nan" },
	                                         { &JointParams::ks, -3, "ks", "positive and finite [Pa/m]", "-3" },
	                                         { &JointParams::cohesion, -1e-9, "cohesion", "not be negative [Pa]", "1.0000000000000001e-09" },
	                                         { &JointParams::tension, nan, "tension", "not be negative [Pa]", "nan" },
	                                         { &JointParams::cohesionResidual, -1, "cohesionResidual", "not be negative [Pa]", "-1" },
	                                         { &JointParams::tensionResidual, -2, "tensionResidual", "not be negative [Pa]", "-2" },
	                                         { &JointParams::dilationLimitSlip, -0.5, "dilationLimitSlip", "not be negative [m]", "-0.5" },
	                                         { &JointParams::tanPhi, -0.25, "friction", "[0, 90) degrees", "-0.25" },
	                                         { &JointParams::tanPhiResidual, inf, "friction", "[0, 90) degrees", "inf" },
	                                         { &JointParams::tanDilation, nan, "dilation", "[0, 90) degrees", "nan" },
	                                         { &JointParams::cohesionResidual, 2.5e6, "cohesionResidual", "not exceed cohesion [Pa]", "2500000" },
	                                         { &JointParams::tensionResidual, 1.5e6, "tensionResidual", "not exceed tension [Pa]", "1500000" } }) {
		JointParams p = mortar();
		p.*c.member   = c.value;
		expectRefusal([&] { validate(p); }, { c.name, c.rule, c.shown });
	}
	EXPECT_NO_THROW(validate(mortar()));
	EXPECT_NO_THROW(validate(elasticJoint(1, 1)));

	// A broken joint that slides by ds under the pressure p takes p tan(phi_res) ds from friction and gives p tan(psi) ds back by rising.
	JointParams dilating = mortar();
	dilating.tanDilation = dilating.tanPhiResidual;
	EXPECT_NO_THROW(validate(dilating));
	dilating.tanDilation = std::tan(0.3), dilating.tanPhiResidual = 0;
	expectRefusal([&] { validate(dilating); }, { "dilationAngle", "not exceed frictionAngleResidual", shown(std::atan(std::tan(0.3))) + " and 0 rad" });
}
