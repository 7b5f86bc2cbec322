// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/Types.hpp>

/// Damping of the motion towards a static solution.
namespace blocks {

struct Damping {
	enum class Kind {
		none,
		local,   ///< a force of alpha |F| against the motion of each degree of freedom (Cundall)
		adaptive ///< viscous, -c m v; c follows the kinetic energy (paper, section 2.3)
	};
	Kind kind  = Kind::local;
	Real alpha = 0.3; ///< of the local damping [-]

	/// Smallest c that the adaptive damping starts from, as a fraction of 1/dt; 500 steps of 2 % lead from there to 1/dt.
	static constexpr Real floorFraction = 5e-5;
	static constexpr Real growth        = 1.02;
	static constexpr Real powerShare    = 0.5; ///< dissipated power over the rate of change of kinetic energy that is aimed at

	/// c for the next step: the power dissipated is kept at half the rate of change of kinetic energy, 0 < c <= 1/dt.
	static Real adapted(Real c, Real dissipatedPower, Real kineticRate, Real dt)
	{
		c = dissipatedPower < powerShare * kineticRate ? c * growth : c / growth;
		return std::min(std::max(c, floorFraction / dt), 1 / dt);
	}
};

/// Largest fraction of the stable time step that may be used: local damping lowers the limit by sqrt(1 + alpha).
inline Real largestSafety(const Damping& d) { return 0.95 / std::sqrt(1 + (d.kind == Damping::Kind::local ? d.alpha : 0)); }

} // namespace blocks
