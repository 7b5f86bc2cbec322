// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/analysis/JointModes.hpp>

using namespace specimens;

namespace {

JointParams params(Real psi, Real limitSlip, Real cohesionResidual)
{
	JointParams p;
	p.kn = 2e9, p.ks = 0.7e9;
	p.tension = 1.1e3, p.cohesion = 1.7e3, p.tanPhi = 0.9;
	p.cohesionResidual = cohesionResidual, p.tanPhiResidual = 0.6;
	p.tanDilation = psi, p.dilationLimitSlip = limitSlip;
	return p;
}

/// Opening and slip on a straight way, mode by mode; the stress at the end.
Stress walkByModes(const JointParams& p, ModePoint& m, Vec2 from, const Vec2& to)
{
	Real done = 0;
	for (int events = 0; events < 100; ++events) {
		const Vec2       at = from + done * (to - from), rate = to - from;
		const PointLimit next = nextLimit(p, m, at[0], at[1], rate[0], rate[1], 1e-12 * rate.norm());
		const bool       last = !(done + next.at < 1);
		done                  = last ? 1 : done + next.at;
		const Vec2 there      = from + done * rate;
		rememberSlip(p, m, there[0], there[1]);
		if (last) return stressOf(p, m, there[0], there[1]);
		m = after(p, m, next.what, there[0], there[1]);
	}
	ADD_FAILURE() << "modes follow each other without end";
	return {};
}

} // namespace

TEST(JointModes, FollowTheLawOnAnyPath)
{
	// The law in steps of 1/20000 of a leg against modes: what a step misses of an event is one step's stress, kn x 1e-6 m / 20000 = 0.1 Pa here,
	// and a law that is history-dependent may miss one at each of 2 legs x 4 events; slip moves by as much.
	std::mt19937                         random(5);
	std::uniform_real_distribution<Real> place(-1, 1);
	constexpr int                        steps = 20000;
	int                                  kinds[4] {};
	for (int c = 0; c < 200; ++c) {
		const JointParams p = params(c % 4 ? 0.07 * (c % 4) : 0, c % 3 ? 1e30 : 0.6e-6, 0);
		ModePoint         m;
		JointState        s;
		Vec2              x(0, 0);
		for (int leg = 0; leg < 4; ++leg) {
			const Vec2   to(1e-6 * (place(random) - 0.3), 3e-6 * place(random));
			const Stress byModes = walkByModes(p, m, x, to);
			JointStep    byLaw {};
			for (int i = 1; i <= steps; ++i) {
				const Vec2 at = x + Real(i) / steps * (to - x);
				byLaw         = advance(p, s, at[0], at[1]);
				s             = byLaw.state;
			}
			const Real step = (to - x).norm() / steps, stress = 20 * p.kn * step * (1 + p.tanPhi);
			ASSERT_NEAR(byModes.sigma, byLaw.sigma, stress) << "case " << c << " leg " << leg;
			ASSERT_NEAR(byModes.tau, byLaw.tau, stress) << "case " << c << " leg " << leg;
			ASSERT_NEAR(m.state.slipPlastic, s.slipPlastic, 20 * step * 3) << "case " << c << " leg " << leg;
			ASSERT_NEAR(m.state.uplift, s.uplift, 20 * step * 3) << "case " << c << " leg " << leg;
			ASSERT_EQ(m.state.status, s.status) << "case " << c << " leg " << leg;
			++kinds[int(m.mode)];
			x = to;
		}
	}
	for (int kind : kinds)
		EXPECT_GT(kind, 30); // every mode is an end often enough for the test to mean something
}

TEST(JointModes, WhatSlidWhileItWasOpenLiftsNothing)
{
	// It closes at its old uplift, slides on at once, since an open point has no friction, and lifts by what it slides from there on.
	const JointParams p = params(0.1, 1e30, 0);
	for (Real sign : { 1., -1. }) {
		ModePoint m;
		m.mode  = Mode::open;
		m.state = { sign * 3e-6, 0.1e-6, Joint::brokenInTension };
		Vec2       at(0.1e-6 + 1e-6, sign * 3e-6);
		const Vec2 rate(-0.5, sign);
		PointLimit next = nextLimit(p, m, at[0], at[1], rate[0], rate[1], 1e-12);
		ASSERT_EQ(next.what, PointEvent::closes);
		ASSERT_NEAR(next.at, 2e-6, 1e-15);
		at += next.at * rate;
		rememberSlip(p, m, at[0], at[1]);
		const Real   was   = m.state.slipPlastic;
		const Vec2   to    = at + 1e-6 * rate;
		const Stress there = walkByModes(p, m, at, to);
		EXPECT_EQ(m.mode, m.dilating ? Mode::slide : Mode::stick);
		EXPECT_NEAR(m.state.uplift, 0.1e-6 + 0.1 * sign * (m.state.slipPlastic - was), 1e-15);
		EXPECT_NEAR(there.sigma, p.kn * (to[0] - m.state.uplift), 1e-9 * p.kn * 1e-6);
	}
}

TEST(JointModes, RatesAreThoseOfTheStresses)
{
	std::mt19937                         random(7);
	std::uniform_real_distribution<Real> place(-1e-6, 1e-6);
	for (int c = 0; c < 40; ++c) {
		const JointParams p = params(0.1, 1e30, 300);
		ModePoint         m;
		m.mode          = Mode(c % 4);
		m.sign          = c % 8 < 4 ? 1 : -1;
		m.dilating      = c % 16 < 8;
		m.state         = { 0.3e-6, 0.02e-6, Joint::brokenInShear };
		const Real   un = place(random), us = place(random), dun = place(random), dus = place(random);
		const Stress a = stressOf(p, m, un, us), b = stressOf(p, m, un + dun, us + dus), rate = stressRate(p, m, dun, dus);
		EXPECT_NEAR(b.sigma - a.sigma, rate.sigma, 1e-9 * p.kn * 1e-6); // linear: rounding only
		EXPECT_NEAR(b.tau - a.tau, rate.tau, 1e-9 * p.kn * 1e-6);
		if (m.mode == Mode::slide) { // tau on its limit, sigma by the uplift that its own slip brings
			EXPECT_NEAR(m.sign * a.tau, p.cohesionResidual - p.tanPhiResidual * a.sigma, 1e-9 * p.cohesion);
			const Real lifted = m.dilating ? p.tanDilation * m.sign * (us - a.tau / p.ks) : m.state.uplift;
			EXPECT_NEAR(a.sigma, p.kn * (un - lifted), 1e-9 * p.kn * 1e-6);
		}
	}
}
