// yade-blocks, GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <blocks/kernel/Types.hpp>
#include <cstdint>
#include <limits>

/// The brittle Mohr-Coulomb joint of the paper (section 2.2, Eqs. 1-3), one contact point at a time.
namespace blocks {

enum class Joint : std::uint8_t { intact = 0, brokenInTension = 1, brokenInShear = 2, unbonded = 3, softening = 4 };

/// Properties of a joint; strengths before and after it breaks.
struct JointParams {
	Real kn                = 0;                                ///< normal stiffness [Pa/m]
	Real ks                = 0;                                ///< shear stiffness [Pa/m]
	Real cohesion          = 0;                                ///< [Pa]
	Real tanPhi            = 0;                                ///< tangent of the friction angle [-]
	Real tension           = 0;                                ///< tension cut-off [Pa]
	Real cohesionResidual  = 0;                                ///< [Pa]
	Real tanPhiResidual    = 0;                                ///< [-]
	Real tensionResidual   = 0;                                ///< [Pa]
	Real tanDilation       = 0;                                ///< tangent of the dilation angle [-]
	Real dilationLimitSlip = std::numeric_limits<Real>::max(); ///< slip beyond which the joint dilates no further [m]

	bool operator==(const JointParams& o) const
	{
		return kn == o.kn && ks == o.ks && cohesion == o.cohesion && tanPhi == o.tanPhi && tension == o.tension
			&& cohesionResidual == o.cohesionResidual && tanPhiResidual == o.tanPhiResidual && tensionResidual == o.tensionResidual
			&& tanDilation == o.tanDilation && dilationLimitSlip == o.dilationLimitSlip;
	}
};

/// What is left of a joint between blocks that were never bonded: friction.
inline JointParams neverBonded(JointParams p)
{
	p.cohesionResidual = p.tensionResidual = 0;
	return p;
}

/// Refuses properties that no joint can have.
void validate(const JointParams&);

/// What a contact point remembers from step to step.
struct JointState {
	Real  slipPlastic = 0; ///< slip at which the shear stress is zero [m]
	Real  uplift      = 0; ///< opening that dilation has forced upon the joint [m]
	Joint status      = Joint::intact;
};

struct JointStep {
	Real       sigma; ///< normal stress, tension positive [Pa]
	Real       tau;   ///< shear stress [Pa]
	JointState state;
};

/// The uplift that goes with a plastic slip, if all of it was sliding under pressure.
inline Real uplift(const JointParams& p, Real slipPlastic) { return p.tanDilation * std::min(std::abs(slipPlastic), p.dilationLimitSlip); }

/// Friction of a broken joint that is closed, under the normal stress `sigma`.
inline JointStep rubbed(const JointParams& p, const JointState& old, Real us, Real sigma)
{
	const Real tau = p.ks * (us - old.slipPlastic), limit = std::max(Real(0), p.cohesionResidual - sigma * p.tanPhiResidual);
	JointStep  now { sigma, std::clamp(tau, -limit, limit), old };
	if (now.tau != tau) now.state.slipPlastic = us - now.tau / p.ks;
	return now;
}

/// Friction of a broken joint that is closed, where its slip lifts it: all at the end of the step, in which the pressure brings friction and friction takes
/// slip. `flat` is what it does if it is not lifted. What it slid in breaking, or while it was open, lifts nothing; reversal takes nothing back.
inline JointStep dilated(const JointParams& p, const JointState& old, Real un, Real us, const JointStep& flat)
{
	if (flat.state.slipPlastic == old.slipPlastic) return flat;
	const Real way = flat.state.slipPlastic < old.slipPlastic ? -1 : 1, without = std::max(Real(0), uplift(p, old.slipPlastic) - old.uplift);
	if (!(way * flat.state.slipPlastic > 0 && uplift(p, flat.state.slipPlastic) - without > old.uplift)) return flat;
	const Real smooth = p.kn * (un + without - p.tanDilation * way * us), share = p.kn * p.tanDilation / p.ks;
	const Real rough = std::max(Real(0), p.cohesionResidual - p.tanPhiResidual * smooth) / (1 + p.tanPhiResidual * share);
	JointStep  now   = rubbed(p, old, us, smooth + share * rough);
	if (!(std::abs(now.state.slipPlastic) < p.dilationLimitSlip)) now = rubbed(p, old, us, p.kn * (un + without - p.tanDilation * p.dilationLimitSlip));
	now.state.uplift = std::max(old.uplift, uplift(p, now.state.slipPlastic) - without);
	return now;
}

/// One step from `old`, for the opening un [m] and the slip us [m], both in total form:
///   sigma = kn (un - uplift),  tau = ks (us - slipPlastic).
/// An intact joint breaks where sigma > tension, or else where |tau| > cohesion - sigma tan(phi); the strengths drop to the
/// residual ones in the same step; a joint that was never bonded has them from the start. A broken joint that is open carries nothing; closed, |tau| <= c_res -
/// sigma tan(phi_res). Only what was broken before and is closed dilates, as far as it slides outwards. So the pressure that lifting costs comes from friction
/// alone, which is never less.
inline JointStep advance(const JointParams& p, JointState old, Real un, Real us)
{
	const Real sigma = p.kn * (un - old.uplift);
	const bool whole = old.status == Joint::intact;
	if (whole) {
		const Real tau = p.ks * (us - old.slipPlastic);
		if (sigma > p.tension)
			old.status = Joint::brokenInTension;
		else if (std::abs(tau) > p.cohesion - sigma * p.tanPhi)
			old.status = Joint::brokenInShear;
		else
			return { sigma, tau, old };
	}
	if (sigma > p.tensionResidual) return { 0, 0, { us, old.uplift, old.status } };
	const JointStep flat = rubbed(p, old, us, sigma); // it is closed at no stress, too
	return p.tanDilation > 0 && !whole ? dilated(p, old, un, us, flat) : flat;
}

/// Elastic energy per area that the two springs of a contact point hold [J/m2].
inline Real storedEnergy(const JointParams& p, Real sigma, Real tau) { return (sigma * sigma / p.kn + tau * tau / p.ks) / 2; }

} // namespace blocks
