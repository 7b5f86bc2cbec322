// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// Damping proportional to stiffness (Rayleigh's beta): zones and intact joints resist the rates of their strain, opening and slip by beta times their
/// stiffness. A mode of angular frequency omega is damped by beta omega / 2 of the critical damping, and rigid motion not at all.
namespace blocks {

/// beta [s]; 0: none.
void setStiffnessDamping(BlockAssembly&, Real beta);

/// Adds the forces at the velocities of the last half step to those of the grid points; a.forces.rate gets them alone. Joints of rigid blocks have none.
void addStiffnessDamping(BlockAssembly&, int threads = 1);

/// Sum of force times velocity of what addStiffnessDamping() has added, at the present velocities [W].
Real stiffnessDampingPower(const BlockAssembly&);

} // namespace blocks
