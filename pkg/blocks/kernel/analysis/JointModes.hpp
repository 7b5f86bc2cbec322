// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/laws/JointLaw.hpp>

/// The brittle joint law (JointLaw.hpp) piece by piece. As long as a contact point stays in one mode, its stresses are linear in opening and slip:
///   intact, stick:    sigma = kn (un - uplift),   tau = ks (us - slipPlastic)
///   slide, sign s:    tau = s (c - mu sigma), c and mu the residual ones,   slipPlastic = us - tau/ks,   and
///                     sigma = kn (un - uplift), or while it dilates, uplift = psi s slipPlastic - lag:
///                     sigma = ke (un + lag - psi (s us - c/ks)),   ke = kn / (1 + kn mu psi/ks)
///   open:             0,   slipPlastic = us
/// A mode ends where `nextLimit` says. Where an intact point breaks, the stress jumps; everywhere else it is continuous (but where a
/// joint with a residual cohesion or tension opens).
namespace blocks {

enum class Mode : std::uint8_t { intact, stick, slide, open };

/// What may happen to a contact point, in the order in which the law asks.
enum class PointEvent : std::uint8_t { none, tension, shearForward, shearBackward, opens, closes, slipsForward, slipsBackward, sticks, dilates, dilationEnds };

struct ModePoint {
	Mode       mode     = Mode::intact;
	bool       dilating = false;
	Real       sign     = 0; ///< of the slip, where it slides
	Real       lag      = 0; ///< while it dilates: uplift that its slip has not brought, see `dilated` [m]
	JointState state;
};

struct Stress {
	Real sigma = 0, tau = 0; ///< [Pa]
};

/// psi of a sliding point: zero unless it dilates.
inline Real psiOf(const JointParams& p, const ModePoint& m) { return m.dilating ? p.tanDilation : 0; }

/// ke of a point that slides and dilates; kn of any other that slides.
inline Real slidingStiffness(const JointParams& p, const ModePoint& m)
{
	return m.dilating ? p.kn / (1 + p.kn * p.tanPhiResidual * p.tanDilation / p.ks) : p.kn;
}

inline Stress stressOf(const JointParams& p, const ModePoint& m, Real un, Real us)
{
	switch (m.mode) {
	case Mode::open:
		return {};
	case Mode::slide: {
		const Real c     = p.cohesionResidual;
		const Real sigma = m.dilating ? slidingStiffness(p, m) * (un + m.lag - p.tanDilation * (m.sign * us - c / p.ks)) : p.kn * (un - m.state.uplift);
		return { sigma, m.sign * (c - p.tanPhiResidual * sigma) };
	}
	default:
		return { p.kn * (un - m.state.uplift), p.ks * (us - m.state.slipPlastic) };
	}
}

/// Change of the stresses with that of opening and slip.
inline Stress stressRate(const JointParams& p, const ModePoint& m, Real dun, Real dus)
{
	switch (m.mode) {
	case Mode::open:
		return {};
	case Mode::slide: {
		const Real sigma = slidingStiffness(p, m) * (dun - (m.dilating ? p.tanDilation * m.sign * dus : 0));
		return { sigma, -m.sign * p.tanPhiResidual * sigma };
	}
	default:
		return { p.kn * dun, p.ks * dus };
	}
}

/// Plastic slip and uplift of a point that slides or is open, at its present opening and slip.
inline void rememberSlip(const JointParams& p, ModePoint& m, Real un, Real us)
{
	if (m.mode != Mode::slide && m.mode != Mode::open) return;
	m.state.slipPlastic = us - stressOf(p, m, un, us).tau / p.ks;
	if (m.dilating) m.state.uplift = std::max(m.state.uplift, uplift(p, m.state.slipPlastic) - m.lag);
}

/// Whether more slip that way lifts the joint further.
inline bool dilatesBySliding(const JointParams& p, const JointState& s, Real sign)
{
	return p.tanDilation > 0 && sign * s.slipPlastic >= 0 && std::abs(s.slipPlastic) < p.dilationLimitSlip && uplift(p, s.slipPlastic) >= s.uplift;
}

/// The mode of a broken point that is closed and just reaches its limit.
inline ModePoint sliding(const JointParams& p, ModePoint m, Real sign)
{
	m.mode     = Mode::slide;
	m.sign     = sign;
	m.dilating = dilatesBySliding(p, m.state, sign);
	m.lag      = m.dilating ? uplift(p, m.state.slipPlastic) - m.state.uplift : 0;
	return m;
}

/// An intact point that breaks at this opening and slip: the law's answer in the same step.
inline ModePoint broken(const JointParams& p, ModePoint m, PointEvent how, Real un, Real us)
{
	const Stress trial = stressOf(p, m, un, us);
	m.state.status     = how == PointEvent::tension ? Joint::brokenInTension : Joint::brokenInShear;
	m.sign             = trial.tau < 0 ? -1 : 1;
	m.mode             = trial.sigma < p.tensionResidual && how != PointEvent::tension ? Mode::slide : Mode::open;
	rememberSlip(p, m, un, us);
	return m.mode == Mode::slide ? sliding(p, m, m.sign) : m;
}

/// The mode after an event of a broken point; `broken` for the others.
inline ModePoint after(const JointParams& p, ModePoint m, PointEvent what, Real un, Real us)
{
	switch (what) {
	case PointEvent::tension:
	case PointEvent::shearForward:
	case PointEvent::shearBackward:
		return broken(p, m, what, un, us);
	case PointEvent::opens:
		m.mode     = Mode::open;
		m.dilating = false;
		rememberSlip(p, m, un, us);
		return m;
	case PointEvent::closes:
	case PointEvent::sticks:
		m.mode     = Mode::stick;
		m.dilating = false;
		return m;
	case PointEvent::slipsForward:
		return sliding(p, m, 1);
	case PointEvent::slipsBackward:
		return sliding(p, m, -1);
	case PointEvent::dilates:
		m.dilating = true;
		m.lag      = 0;
		return m;
	case PointEvent::dilationEnds:
		m.dilating = false;
		return m;
	case PointEvent::none:
		break;
	}
	return m;
}

struct PointLimit {
	Real       at   = std::numeric_limits<Real>::infinity(); ///< how far along the rates; never negative
	PointEvent what = PointEvent::none;
};

/// How far opening and slip may go on at these rates until the mode ends, and by what. Rates up to `still` [m] are none. `except` is not asked for.
inline PointLimit nextLimit(const JointParams& p, const ModePoint& m, Real un, Real us, Real dun, Real dus, Real still, PointEvent except = PointEvent::none)
{
	PointLimit first;
	// slack: what is left up to a limit; speed: how fast it is used up; both in the same unit
	auto ask = [&](PointEvent what, Real slack, Real speed, Real least) {
		if (!(speed > least) || what == except) return;
		const Real at = std::max(Real(0), slack) / speed;
		if (at < first.at) first = { at, what };
	};
	const Stress now = stressOf(p, m, un, us), rate = stressRate(p, m, dun, dus);
	const Real   stillN = p.kn * still, stillT = p.ks * still;

	switch (m.mode) {
	case Mode::intact:
		ask(PointEvent::tension, p.tension - now.sigma, rate.sigma, stillN);
		for (Real s : { 1., -1. })
			ask(s > 0 ? PointEvent::shearForward : PointEvent::shearBackward,
			    p.cohesion - p.tanPhi * now.sigma - s * now.tau,
			    s * rate.tau + p.tanPhi * rate.sigma,
			    stillT + p.tanPhi * stillN);
		break;
	case Mode::stick:
		ask(PointEvent::opens, p.tensionResidual - now.sigma, rate.sigma, stillN);
		for (Real s : { 1., -1. })
			ask(s > 0 ? PointEvent::slipsForward : PointEvent::slipsBackward,
			    p.cohesionResidual - p.tanPhiResidual * now.sigma - s * now.tau,
			    s * rate.tau + p.tanPhiResidual * rate.sigma,
			    stillT + p.tanPhiResidual * stillN);
		break;
	case Mode::slide: {
		const Real slipRate = m.sign * (dus - rate.tau / p.ks), slip = m.sign * m.state.slipPlastic;
		ask(PointEvent::opens, p.tensionResidual - now.sigma, rate.sigma, stillN);
		ask(PointEvent::sticks, 0, -slipRate, still);
		if (m.dilating)
			ask(PointEvent::dilationEnds, p.dilationLimitSlip - slip, slipRate, still);
		else if (p.tanDilation > 0 && m.state.uplift < p.tanDilation * p.dilationLimitSlip && slip <= m.state.uplift / p.tanDilation)
			ask(PointEvent::dilates, m.state.uplift / p.tanDilation - slip, slipRate, still);
		break;
	}
	case Mode::open: {
		const Real     gap      = un - p.tensionResidual / p.kn;
		constexpr Real rounding = 1e-9;
		if (m.state.uplift > 0 && gap < m.state.uplift - rounding * (std::abs(un) + m.state.uplift))
			return { 0, PointEvent::closes }; // it broke that way
		ask(PointEvent::closes, gap - m.state.uplift, -dun, still);
		break;
	}
	}
	return first;
}

/// How far a point's stresses are beyond its limits, as a share of the larger of its strength and its stress: 0 where it is admissible.
inline Real inadmissibility(const JointParams& p, const ModePoint& m, Real un, Real us)
{
	const Stress s     = stressOf(p, m, un, us);
	const bool   whole = m.mode == Mode::intact;
	const Real   c = whole ? p.cohesion : p.cohesionResidual, mu = whole ? p.tanPhi : p.tanPhiResidual, t = whole ? p.tension : p.tensionResidual;
	const Real   scale = std::max({ p.tension, p.cohesion, std::abs(s.sigma), std::abs(s.tau) });
	Real         beyond;
	if (m.mode == Mode::open)
		beyond = p.kn * (m.state.uplift - un) + t;
	else
		beyond = std::max(s.sigma - t, std::abs(s.tau) - (c - mu * s.sigma));
	return scale > 0 ? std::max(Real(0), beyond) / scale : 0;
}

} // namespace blocks
