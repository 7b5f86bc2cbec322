// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/laws/JointLaw.hpp>

/// A joint whose strengths fall gradually, by a fracture energy (Lourenco and Rots 1997, with tension and shear coupled), one contact point at a time.
///
/// One scalar k says how far a point has softened:
///   f = (e^-k - epsilon)/(1 - epsilon),  epsilon = 1e-5, and 0 from k = 11.5 on: an exponential that ends,
///   ft = ft_res + (ft0 - ft_res) f,   c = c_res + (c0 - c_res) f,   tan(phi) = tan(phi_res) + (tan(phi0) - tan(phi_res)) f.
/// With l1, l2 >= 0 the inelastic opening and slip of a step,
///   dk = sqrt((ft0 l1/GfI)^2 + (c0 l2/(GfII + a p))^2),
/// so pure opening dissipates GfI, and pure slip under a constant pressure p of the cohesion GfII + a p, both to 1.2e-4 (epsilon ln epsilon).
/// k is solved for at the end of the step.
///
///       sigma                           w: inelastic opening, the largest so far; a w of it lasts (a: lasting share)
///     ft0 |  /\                         loading: sigma = ft(k) = kn (un - base - w)
///         | /   \ .  envelope ft(k)     unloading, reloading: straight to sigma = 0 at un = base + a w
///         |/   /     ' .                closed, un < base + a w: sigma = kn (un - base - a w)
///      ---+---+-------------' . un      base: what dilation has raised and the cap has crushed
///        /   a w
///
/// The residual cohesion needs contact: open, c = c0 f. Shear is plastic: tau = ks (us - slipPlastic), |tau| <= c - sigma tan(phi).
/// JointState::uplift is the opening at which the point closes, base + a w.
namespace blocks {

/// Elliptic cap for a joint that stands for a whole bed joint: sigma^2 + Css tau^2 + Cn sigma = s^2, s^2 = F^2 - Cn F, through sigma = -F at tau = 0.
/// Associated flow. kappa is the length of the path of inelastic closure and slip; F rises along a parabola from `first` to `strength` at kappa =
/// `peakClosure`, then falls to `residual` as an exponential that dissipates `energy` above it.
struct CapParams {
	Real strength    = 0; ///< [Pa]; 0: no cap
	Real first       = 0; ///< at which it begins to yield [Pa]
	Real residual    = 0; ///< [Pa]
	Real peakClosure = 0; ///< inelastic closure at the peak [m]
	Real energy      = 0; ///< dissipated after the peak, above the residual strength [J/m2]
	Real shear       = 0; ///< Css [-]
	Real linear      = 0; ///< Cn [Pa]

	bool operator==(const CapParams& o) const
	{
		return strength == o.strength && first == o.first && residual == o.residual && peakClosure == o.peakClosure && energy == o.energy
			&& shear == o.shear && linear == o.linear;
	}
};

/// Whether stresses are beyond the cap before it has yielded at all.
inline bool beyondCap(const CapParams& c, Real sigma, Real tau)
{
	return c.strength > 0 && sigma * sigma + c.shear * tau * tau + c.linear * sigma > c.first * (c.first - c.linear);
}

/// What softening adds to a joint's properties. Without it (both energies 0) a joint is brittle.
struct SofteningParams {
	Real      energyI          = 0;                                ///< fracture energy of opening GfI [J/m2]
	Real      energyII         = 0;                                ///< fracture energy of slip GfII without pressure [J/m2]
	Real      energyIIPressure = 0;                                ///< a: what GfII rises by with pressure [J/m2 by Pa = m]
	Real      lastingShare     = 0;                                ///< of the inelastic opening: 0 closes at the origin, 1 where it was unloaded [-]
	Real      dilationDecay    = 0;                                ///< delta: dilatancy falls as e^(-delta slip) [1/m]
	Real      dilationPressure = std::numeric_limits<Real>::max(); ///< sigma_u: pressure at which dilatancy is 0 [Pa]
	CapParams cap;

	bool softens() const { return energyI > 0; }
	Real energyOfSlip(Real sigma) const { return energyII + energyIIPressure * std::max(Real(0), -sigma); } ///< under this normal stress [J/m2]
	bool operator==(const SofteningParams& o) const
	{
		return energyI == o.energyI && energyII == o.energyII && energyIIPressure == o.energyIIPressure && lastingShare == o.lastingShare
			&& dilationDecay == o.dilationDecay && dilationPressure == o.dilationPressure && cap == o.cap;
	}
};

/// What a point that softens remembers besides its JointState.
struct SofteningState {
	Real k           = 0; ///< softening, from 0 to softeningEnd [-]
	Real opening     = 0; ///< w, the largest inelastic opening [m]
	Real slipLargest = 0; ///< of |slipPlastic| so far; dilatancy goes on from there [m]
	Real crushing    = 0; ///< kappa of the cap [m]
};

struct SofteningStep {
	Real           sigma = 0; ///< normal stress, tension positive [Pa]
	Real           tau   = 0; ///< shear stress [Pa]
	JointState     joint;
	SofteningState soft;
	bool           snappedBack = false; ///< whether the pressure was too high for the step to follow the curve: the stress dropped to it
};

constexpr Real crackedFrom = 0.9; ///< damage from which a joint counts as cracked [-]

/// k from which nothing but residual strength is left.
extern const Real softeningEnd;

/// Share f of the strengths (above the residual ones) that is left.
Real leftStrength(Real k);

/// 1 - f: 0 whole, 1 only residual strength is left.
Real damage(const SofteningState&);

/// Refuses properties that no joint can have, and those with which a single point would snap back. The JointParams must be validated before.
void validate(const JointParams&, const SofteningParams&);

/// Whether a point stays elastic under these trial stresses, sigma = kn (un - uplift) and tau = ks (us - slipPlastic): then they are the answer and
/// nothing changes. Exact and the same as for the brittle law, but for the cap. Points that have yielded, ever so little, are not intact.
inline bool elastic(const JointParams& p, const SofteningParams& s, Joint status, Real sigma, Real tau)
{
	return status == Joint::intact && sigma <= p.tension && std::abs(tau) <= p.cohesion - sigma * p.tanPhi && !beyondCap(s.cap, sigma, tau);
}

/// One step of a point that is not elastic in it (or of any: the answer is the same).
SofteningStep soften(const JointParams&, const SofteningParams&, const JointState&, const SofteningState&, Real un, Real us);

/// One step from the old state, for the opening un [m] and the slip us [m], both in total form.
inline SofteningStep advanceSoftening(const JointParams& p, const SofteningParams& s, const JointState& joint, const SofteningState& soft, Real un, Real us)
{
	const Real sigma = p.kn * (un - joint.uplift);
	const Real tau   = p.ks * (us - joint.slipPlastic);
	if (elastic(p, s, joint.status, sigma, tau)) return { sigma, tau, joint, soft, false };
	return soften(p, s, joint, soft, un, us);
}

/// Elastic energy per area that a contact point holds [J/m2].
Real storedEnergy(const JointParams&, const SofteningParams&, const SofteningState&, Real sigma, Real tau);

/// What one step of a point turned into heat [J/m2]. The sum is the work done on it (by the mean of the stresses before and after) less what is stored.
struct SofteningWork {
	Real opening  = 0; ///< mode I: breaking of the bond by opening
	Real slip     = 0; ///< mode II: breaking of the bond by slip, the share of the cohesion in the shear strength
	Real friction = 0; ///< the rest of the slip's work, less dilation's work against the pressure
	Real cap      = 0; ///< crushing
};
SofteningWork dissipated(
	const JointParams&,
	const SofteningParams&,
	const SofteningStep& before,
	Real                 openingBefore,
	Real                 slipBefore,
	const SofteningStep& after,
	Real                 openingAfter,
	Real                 slipAfter);

} // namespace blocks
