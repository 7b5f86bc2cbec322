// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/laws/Exponential.hpp>
#include <blocks/kernel/laws/SofteningLaw.hpp>

namespace blocks {
namespace {
	constexpr Real epsilon = 1e-5; ///< share of the exponential at which it ends
	constexpr Real eps     = std::numeric_limits<Real>::epsilon();

	struct Strength {
		Real tension, cohesion, tanPhi;
	};

	Strength strengthAt(const JointParams& p, Real f, bool closed)
	{
		const bool touching = closed || p.tensionResidual > 0; // the residual cohesion needs contact
		return { p.tensionResidual + (p.tension - p.tensionResidual) * f,
			 touching ? p.cohesionResidual + (p.cohesion - p.cohesionResidual) * f : p.cohesion * f,
			 p.tanPhiResidual + (p.tanPhi - p.tanPhiResidual) * f };
	}

	/// A root of g in (lo, hi], where g(lo) < 0 <= g(hi): secants, and halves where these are slow.
	template <class Function> Real rootBetween(const Function& g, Real lo, Real gLo, Real hi, Real gHi, Real guess)
	{
		Real last = lo, gLast = gLo, x = guess;
		for (int i = 0; i < 100 && hi - lo > 4 * eps * hi; ++i) {
			if (!(x > lo && x < hi) || i % 8 == 7) x = lo + (hi - lo) / 2;
			const Real gx = g(x);
			if (gx == 0) return x;
			if (gx < 0)
				lo = x, gLo = gx;
			else
				hi = x, gHi = gx;
			const Real step = gx * (x - last) / (gx - gLast);
			last = x, gLast = gx;
			if (std::abs(step) <= 2 * eps * x) return x;
			x -= step;
		}
		return -gLo < gHi ? lo : hi;
	}

	// ---- the cap, with the ellipse's centre moved to the origin: (sigma + m)^2 + Css tau^2 = (F - m)^2, m = Cn / 2

	Real capStrength(const CapParams& c, Real crushing)
	{
		const Real x = crushing / c.peakClosure;
		if (x < 1) return c.first + (c.strength - c.first) * std::sqrt(x * (2 - x));
		const Real above = c.strength - c.residual;
		return c.residual + above * decay((crushing - c.peakClosure) * above / c.energy);
	}

	/// Returns the stresses to the ellipse, if they lie beyond it; whether they did.
	bool crush(const JointParams& p, const CapParams& c, Real& crushing, Real& sigma, Real& tau)
	{
		const Real m = c.linear / 2, s0 = sigma + m, t0 = tau;
		const auto excess = [&](Real x) { // x = 2 lambda of the associated flow
			const Real s = s0 / (1 + p.kn * x), t = t0 / (1 + c.shear * p.ks * x);
			const Real path = x * std::sqrt(s * s + c.shear * c.shear * t * t);
			return capStrength(c, crushing + path) - m - std::sqrt(s * s + c.shear * t * t);
		};
		const Real atOnce = excess(0);
		if (!(atOnce < 0)) return false;
		Real hi = 1 / p.kn, gHi = excess(hi);
		while (gHi < 0)
			hi *= 2, gHi = excess(hi);
		const Real x = rootBetween(excess, 0, atOnce, hi, gHi, hi * atOnce / (atOnce - gHi));
		const Real s = s0 / (1 + p.kn * x), t = t0 / (1 + c.shear * p.ks * x);
		crushing += x * std::sqrt(s * s + c.shear * c.shear * t * t);
		sigma = s - m, tau = t;
		return true;
	}

	// ---- opening and slip

	/// Stresses and inelastic increments, were k the softening at the end of the step.
	struct Answer {
		Real f, opening, sigma, limit, more; ///< more: what dk would be
	};

	struct Point {
		const JointParams&     p;
		const SofteningParams& s;
		bool                   closed;
		Real                   e;        ///< opening since `base` [m]
		Real                   opening;  ///< w of the old state [m]
		Real                   pressing; ///< sigma if closed [Pa]
		Real                   trial;    ///< |tau| without slip [Pa]

		Answer at(Real k) const
		{
			Answer         a { leftStrength(k), opening, pressing, 0, 0 };
			const Strength now = strengthAt(p, a.f, closed);
			Real           l1  = 0;
			if (!closed) {
				l1 = e - now.tension / p.kn - opening;
				if (l1 > 0) {
					a.opening = e - now.tension / p.kn;
					a.sigma   = now.tension;
				} else {
					l1 = 0;
					// kn / (1 + kn (1 - lasting) w / ft): the secant
					const Real secant = p.kn * (1 - s.lastingShare) * opening;
					a.sigma           = secant == 0 ? p.kn * (e - s.lastingShare * opening)
									: p.kn * now.tension / (now.tension + secant) * (e - s.lastingShare * opening);
				}
			}
			a.limit        = std::max(Real(0), now.cohesion - a.sigma * now.tanPhi);
			const Real l2  = std::max(Real(0), trial - a.limit) / p.ks;
			const Real dk1 = p.tension * l1 / s.energyI, dk2 = p.cohesion * l2 / s.energyOfSlip(a.sigma);
			a.more = l1 == 0 ? dk2 : l2 == 0 ? dk1 : std::sqrt(dk1 * dk1 + dk2 * dk2);
			return a;
		}
	};

	/// The smallest k >= old for which the strengths suffice.
	Real softeningAtEnd(const Point& point, Real old, Real firstGuess)
	{
		const auto g = [&](Real k) { return k - old - point.at(k).more; };
		if (old + firstGuess == old) return old;
		const Real atEnd = g(softeningEnd);
		if (atEnd <= 0) return softeningEnd;
		return rootBetween(g, old, -firstGuess, softeningEnd, atEnd, old + firstGuess);
	}
} // namespace

const Real softeningEnd = 11.512925464970229; // -ln(epsilon)

Real leftStrength(Real k) { return k >= softeningEnd ? 0 : std::max(Real(0), (decay(k) - epsilon) / (1 - epsilon)); }

Real damage(const SofteningState& s) { return 1 - leftStrength(s.k); }

SofteningStep soften(const JointParams& p, const SofteningParams& s, const JointState& joint, const SofteningState& soft, Real un, Real us)
{
	SofteningStep now { 0, 0, joint, soft, false };
	const bool    closed = un <= joint.uplift;
	const bool    dry    = joint.status == Joint::unbonded;
	const Real    old    = dry ? softeningEnd : soft.k;
	Real          sigma = p.kn * (un - joint.uplift), tau = p.ks * (us - joint.slipPlastic);

	if (elastic(p, s, joint.status, sigma, tau)) {
		now.sigma = sigma, now.tau = tau;
		return now;
	}

	if (closed && s.cap.strength > 0 && crush(p, s.cap, now.soft.crushing, sigma, tau)) {
		now.joint.uplift      = un - sigma / p.kn;
		now.joint.slipPlastic = us - tau / p.ks;
		if (joint.status == Joint::intact) now.joint.status = Joint::softening;
	}

	if (!closed && old >= softeningEnd && p.tensionResidual == 0) { // parted
		now.joint.slipPlastic = us;
		now.soft.slipLargest  = std::max(soft.slipLargest, std::abs(us));
		return now;
	}

	const Real  base = now.joint.uplift - s.lastingShare * soft.opening;
	const Point point { p, s, closed, un - base, soft.opening, sigma, std::abs(tau) };
	Answer      a = point.at(old);
	if (a.more == 0) { // no more damage: elastic, or unloading
		now.sigma = closed || soft.opening == 0 ? sigma : a.sigma;
		now.tau   = tau;
		return now;
	}

	if (old < softeningEnd) {
		if (closed) {
			const Real steepest = (p.cohesion - p.cohesionResidual - sigma * (p.tanPhi - p.tanPhiResidual)) * (a.f + epsilon / (1 - epsilon));
			now.snappedBack     = p.cohesion * steepest > p.ks * s.energyOfSlip(sigma);
		}
		now.soft.k = softeningAtEnd(point, old, a.more);
		a          = point.at(now.soft.k);
	}
	now.sigma = a.sigma;
	now.tau   = std::abs(tau) > a.limit ? std::copysign(a.limit, tau) : tau;
	if (now.tau != tau) now.joint.slipPlastic = us - now.tau / p.ks;
	if (a.opening > soft.opening) {
		now.soft.opening = a.opening;
		now.joint.uplift = base + s.lastingShare * a.opening;
	}

	const Real slip = std::abs(now.joint.slipPlastic), before = soft.slipLargest;
	if (slip > before) {
		now.soft.slipLargest = slip;
		if (closed && p.tanDilation > 0) { // reversal of the slip takes nothing back, and raises nothing before it has gone farther than ever
			const Real from = std::min(before, p.dilationLimitSlip), to = std::min(slip, p.dilationLimitSlip);
			const Real path = s.dilationDecay > 0 ? (decay(s.dilationDecay * from) - decay(s.dilationDecay * to)) / s.dilationDecay : to - from;
			now.joint.uplift += p.tanDilation * std::max(Real(0), 1 + sigma / s.dilationPressure) * path;
		}
	}

	if (!dry && now.soft.k > 0) {
		const bool byOpening = p.tension * now.soft.opening / s.energyI >= p.cohesion * now.soft.slipLargest / s.energyOfSlip(now.sigma);
		if (joint.status == Joint::intact || joint.status == Joint::softening)
			now.joint.status = 1 - a.f < crackedFrom ? Joint::softening : byOpening ? Joint::brokenInTension : Joint::brokenInShear;
	}
	return now;
}

void validate(const JointParams& p, const SofteningParams& s)
{
	const auto named       = [](const char* name) { return std::string("joint parameter ") + name; };
	const auto notNegative = [&](Real v, const char* name, const char* unit) {
		require(v >= 0 && std::isfinite(v), named(name) + " must not be negative and must be finite " + unit, v);
	};
	notNegative(s.energyI, "GfI", "[J/m2]");
	notNegative(s.energyII, "GfII", "[J/m2]");
	notNegative(s.energyIIPressure, "GfIIPressure", "[m]");
	require(s.energyI > 0 || s.energyII == 0, named("GfI must be positive where GfII is (both 0: brittle) [J/m2]"), s.energyI);
	require(s.energyII > 0 || s.energyI == 0, named("GfII must be positive where GfI is (both 0: brittle) [J/m2]"), s.energyII);
	require(s.lastingShare >= 0 && s.lastingShare <= 1, named("lastingShare must lie in [0, 1]"), s.lastingShare);
	notNegative(s.dilationDecay, "dilationDecay", "[1/m]");
	require(s.dilationPressure > 0, named("dilationPressure must be positive [Pa]"), s.dilationPressure);
	const CapParams& c = s.cap;
	for (Real v : { c.strength, c.first, c.residual, c.peakClosure, c.energy, c.shear, c.linear })
		notNegative(v, "of the cap", "");
	if (!s.softens()) {
		for (const auto& [value, name] : { std::pair(s.energyIIPressure, "GfIIPressure"),
		                                   { s.lastingShare, "lastingShare" },
		                                   { s.dilationDecay, "dilationDecay" },
		                                   { c.strength, "capStrength" } })
			require(value == 0, named(name) + " needs softening: GfI and GfII must be positive with it", value);
		require(s.dilationPressure == SofteningParams().dilationPressure,
		        named("dilationPressure needs softening: GfI and GfII must be positive with it"),
		        s.dilationPressure);
	} else {
		require(p.tension > 0, named("tension must be positive where joints soften [Pa]"), p.tension);
		require(p.cohesion > 0, named("cohesion must be positive where joints soften [Pa]"), p.cohesion);
		require(p.cohesion >= p.tension * p.tanPhi,
		        named("cohesion must not be below tension tan(frictionAngle) = ") + shown(p.tension * p.tanPhi) + " where joints soften [Pa]",
		        p.cohesion);
		require(p.tanPhiResidual <= p.tanPhi,
		        named("frictionAngleResidual must not exceed frictionAngle where joints soften; tangent"),
		        p.tanPhiResidual);
		const Real opening = p.tension * p.tension / (p.kn * s.energyI), slip = p.cohesion * p.cohesion / (p.ks * s.energyII);
		require(opening * opening + slip * slip < (1 - epsilon) * (1 - epsilon),
		        "a joint snaps back unless (tension^2/(kn GfI))^2 + (cohesion^2/(ks GfII))^2 < 1: with tension " + shown(p.tension) + ", kn "
		                + shown(p.kn) + ", GfI " + shown(s.energyI) + ", cohesion " + shown(p.cohesion) + ", ks " + shown(p.ks) + ", GfII "
		                + shown(s.energyII) + " it is " + shown(opening) + "^2 + " + shown(slip) + "^2",
		        opening * opening + slip * slip);
	}
	if (c.strength == 0) {
		for (Real v : { c.first, c.residual, c.peakClosure, c.energy, c.shear, c.linear })
			require(v == 0, named("capStrength must be positive where other parameters of the cap are given [Pa]"), c.strength);
	} else {
		for (const auto& [value, name] : std::vector<std::pair<Real, const char*>> { { c.first, "capFirst [Pa]" },
		                                                                             { c.residual, "capResidual [Pa]" },
		                                                                             { c.peakClosure, "capPeakClosure [m]" },
		                                                                             { c.energy, "capEnergy [J/m2]" },
		                                                                             { c.shear, "capShear [-]" } })
			require(value > 0, named(name) + " must be positive with a cap", value);
		require(c.first <= c.strength, named("capFirst must not exceed capStrength [Pa]"), c.first);
		require(c.residual <= c.strength, named("capResidual must not exceed capStrength [Pa]"), c.residual);
		require(c.linear < 2 * std::min(c.first, c.residual), named("capLinear must be below twice capFirst and capResidual [Pa]"), c.linear);
		const Real above = c.strength - c.residual, needed = above * above / c.energy / std::min(Real(1), std::sqrt(c.shear));
		require(std::min(p.kn, p.ks) > needed,
		        "a joint snaps back in compression unless kn and ks exceed (capStrength - capResidual)^2/(capEnergy min(1, sqrt(capShear))) = "
		                + shown(needed) + " [Pa/m]",
		        std::min(p.kn, p.ks));
	}
}

Real storedEnergy(const JointParams& p, const SofteningParams& s, const SofteningState& soft, Real sigma, Real tau)
{
	Real flexibility = 1 / p.kn;
	if (sigma > 0 && s.softens()) flexibility += (1 - s.lastingShare) * soft.opening / strengthAt(p, leftStrength(soft.k), false).tension;
	return (sigma * sigma * flexibility + tau * tau / p.ks) / 2;
}

SofteningWork dissipated(
	const JointParams&     p,
	const SofteningParams& s,
	const SofteningStep&   before,
	Real                   openingBefore,
	Real                   slipBefore,
	const SofteningStep&   after,
	Real                   openingAfter,
	Real                   slipAfter)
{
	const Real    work = (before.sigma + after.sigma) / 2 * (openingAfter - openingBefore) + (before.tau + after.tau) / 2 * (slipAfter - slipBefore);
	Real          rest = work - (storedEnergy(p, s, after.soft, after.sigma, after.tau) - storedEnergy(p, s, before.soft, before.sigma, before.tau));
	SofteningWork d;
	const bool    crushed = after.soft.crushing > before.soft.crushing;
	const Real    plastic = after.joint.slipPlastic - before.joint.slipPlastic;
	if (plastic != 0) {
		const bool     dry   = after.joint.status == Joint::unbonded;
		const bool     open  = after.sigma > 0;
		const Strength now   = strengthAt(p, dry ? 0 : leftStrength(after.soft.k), !open);
		const Real     bond  = now.cohesion - (open ? after.sigma * now.tanPhi : 0); // what is no friction
		const Real     heat  = (before.tau + after.tau) / 2 * plastic;
		const Real     limit = bond + (open ? 0 : -after.sigma * now.tanPhi);
		if (crushed && std::abs(after.tau) < limit * (1 - 8 * eps)) { // the slip, too, is the cap's
			d.cap = rest;
			return d;
		}
		// the residual cohesion is part of what never ends, as friction is
		const Real share = limit > 0 ? (open ? bond : (p.cohesion - p.cohesionResidual) * (dry ? 0 : leftStrength(after.soft.k))) / limit : 0;
		d.slip           = share * heat;
		d.friction       = heat - d.slip;
		rest -= heat;
	}
	(crushed ? d.cap : after.soft.opening > before.soft.opening || after.sigma > 0 ? d.opening : d.friction) += rest;
	return d;
}

} // namespace blocks
