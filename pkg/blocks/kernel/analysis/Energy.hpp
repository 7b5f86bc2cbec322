// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// Where the energy is and where it went [J].
namespace blocks {

Real zoneEnergy(const BlockAssembly&);              ///< elastic energy of the zones
Real jointEnergy(const BlockAssembly&);             ///< elastic energy of the joints' springs and of free contacts
Real kineticEnergy(const BlockAssembly&);           ///< from the velocities at the last half step and the inertia
Real gridPointsKineticEnergy(const BlockAssembly&); ///< ... without that of rigid blocks
Real loadWork(const BlockAssembly&);                ///< of the dead loads since the reference state
Real groupWork(const BlockAssembly&);               ///< of driven and pushed degrees of freedom, released ones included
Real rigidWork(const BlockAssembly&);               ///< of what moves rigid blocks, apart from their neighbours and dead loads

/// Dissipation at the contact points (free contacts book their own, see contactFriction), by the trapezoidal rule from step to step. Exists only where somebody
/// keeps accounts.
struct JointDissipation {
	/// Takes the present state as the start.
	void start(const BlockAssembly&);
	/// After a law: books what the joints took in and do not hold. To be called every step.
	void book(const BlockAssembly&);

	Real friction = 0; ///< of broken joints; dilation's work against the pressure is taken off [J]
	Real fracture = 0; ///< set free in the step in which a contact point broke [J]

	struct Before {
		Real  opening, slip, sigma, tau;
		Joint status;
	};
	std::vector<Before> before; ///< of each contact point, at the last step
};

/// Sum of |F| over free degrees of freedom (moments on rigid blocks left out) by twice the sum of |F| over contact points, the latter at least `floor` [N].
Real unbalancedRatio(const BlockAssembly&, Real floor = 0);

} // namespace blocks
