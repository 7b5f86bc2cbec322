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

/// The uplift that goes with a plastic slip, so far the largest.
inline Real uplift(const JointParams& p, Real slipPlastic) { return p.tanDilation * std::min(std::abs(slipPlastic), p.dilationLimitSlip); }

/// One step from `old`, for the opening un [m] and the slip us [m], both in total form:
///   sigma = kn (un - uplift),  tau = ks (us - slipPlastic).
/// An intact joint breaks where sigma > tension, or else where |tau| > cohesion - sigma tan(phi); the strengths drop to the
/// residual ones in the same step; a joint that was never bonded has them from the start. A broken joint that is open carries nothing; closed, |tau| <= c_res -
/// sigma tan(phi_res).
inline JointStep advance(const JointParams& p, JointState old, Real un, Real us)
{
	const Real sigma = p.kn * (un - old.uplift);
	const Real tau   = p.ks * (us - old.slipPlastic);

	if (old.status == Joint::intact) {
		if (sigma > p.tension)
			old.status = Joint::brokenInTension;
		else if (std::abs(tau) > p.cohesion - sigma * p.tanPhi)
			old.status = Joint::brokenInShear;
		else
			return { sigma, tau, old };
	}

	JointStep now { 0, 0, old };
	if (sigma <= p.tensionResidual) { // closed: friction; it is closed at no stress, too
		const Real limit = std::max(Real(0), p.cohesionResidual - sigma * p.tanPhiResidual);
		now.sigma        = sigma;
		now.tau          = std::clamp(tau, -limit, limit);
	}
	if (now.tau != tau) now.state.slipPlastic = us - now.tau / p.ks;
	now.state.uplift = std::max(old.uplift, uplift(p, now.state.slipPlastic)); // reversal of the slip takes nothing back
	return now;
}

/// Elastic energy per area that the two springs of a contact point hold [J/m2].
inline Real storedEnergy(const JointParams& p, Real sigma, Real tau) { return (sigma * sigma / p.kn + tau * tau / p.ks) / 2; }

} // namespace blocks
