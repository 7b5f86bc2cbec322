// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// The step of free contacts; the sweep adds the forces (Sweep.hpp).
namespace blocks {

/// What rules the contact: validated joint parameters; only kn, ks and the residual values count.
void setContactJoint(BlockAssembly&, int contact, const JointParams&);

/// Where the edges of all contacts are, their stresses and their forces; dt times the nodes' velocities is the last step's motion [s].
void advanceContacts(BlockAssembly&, Real dt, int threads = 1);

/// Advances one contact, with the same bits.
void advanceContact(BlockAssembly&, int contact, Real dt);

/// Adds the contact forces on one block's grid points, in a fixed order.
void gatherContactForces(const BlockAssembly&, int block, Vec2* force);

} // namespace blocks
