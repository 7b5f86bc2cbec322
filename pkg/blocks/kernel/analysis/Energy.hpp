// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// Where the energy is and where it went [J].
namespace blocks {

Real zoneEnergy(const BlockAssembly&);              ///< elastic energy of the zones
Real sumOf(const std::vector<Real>&);               ///< in their order
Real jointEnergy(const BlockAssembly&);             ///< elastic energy of the joints' springs and of free contacts
Real bookedJointEnergy(const BlockAssembly&);       ///< the same of the last step, from the accounts where it kept them
Real kineticEnergy(const BlockAssembly&);           ///< from the velocities at the last half step and the inertia
Real gridPointsKineticEnergy(const BlockAssembly&); ///< kinetic energy without that of rigid blocks
Real loadWork(const BlockAssembly&);                ///< of the dead loads since the reference state
Real groupWork(const BlockAssembly&);               ///< of driven and pushed degrees of freedom, released ones included
Real rigidWork(const BlockAssembly&);               ///< of what moves rigid blocks, apart from their neighbours and dead loads

/// Sum of |F| over free degrees of freedom (moments on rigid blocks left out) by twice the sum of |F| over contact points, the latter at least `floor` [N].
Real unbalancedRatio(const BlockAssembly&, Real floor = 0);

/// How far the scene is from rest, by what every scene has: the unbalanced forces, of pushed groups too, by the largest of the sums of loads, of forces of
/// groups and twice those of contacts; or the kinetic energy by that of zones and joints, if this is more. Infinite while a group is within its ramp. 0 where
/// nothing moves and no force acts. floor: least sum of forces that counts [N].
Real unrest(const BlockAssembly&, Real time, Real floor = 0);

} // namespace blocks
