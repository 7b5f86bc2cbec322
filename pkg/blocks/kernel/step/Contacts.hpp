// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// The step of free contacts; sumForces adds the forces.
namespace blocks {

/// What rules the contact: validated joint parameters; only kn, ks and the residual values count.
void setContactJoint(BlockAssembly&, int contact, const JointParams&);

/// Where the edges of all contacts are, their stresses and their forces; dt times the nodes' velocities is the last step's motion [s].
void advanceContacts(BlockAssembly&, Real dt, int threads = 1);

/// The same for one of them, with the same bits.
void advanceContact(BlockAssembly&, int contact, Real dt);

/// Adds the contact forces on one block's grid points, in a fixed order.
void gatherContactForces(const BlockAssembly&, int block, Vec2* force);

/// The share of contacts, of those that touch and those that may, in the bound of nodalStiffness [N/m].
std::vector<Real> contactStiffness(const BlockAssembly&);

Real contactEnergy(const BlockAssembly&);   ///< elastic energy of all contacts [J]
Real contactFriction(const BlockAssembly&); ///< dissipated by friction in all contacts so far [J]

/// Energy of the normal springs of a pair of edges, where its grid points were dt ago [J].
Real normalEnergyBefore(const BlockAssembly&, const FreeContact&, const EdgePair&, Real dt);

/// An end of an active edge pair as Python sees it: where, which way, how deep, how much.
struct ContactEnd {
	Vec2 position;   ///< midway between the edges [m]
	Vec2 normal;     ///< out of the first block
	Real depth;      ///< [m]
	Real sigma, tau; ///< [Pa]
	Real area;       ///< [m2]
};
ContactEnd contactEnd(const BlockAssembly&, const FreeContact&, int active, int k);

/// Normal and shear stresses of contact points; where a joint has become a free contact, of the edges that took its place. Tension positive [Pa].
struct PointStresses {
	std::vector<Real> sigma, tau;
};
/// Of joints [first, last).
PointStresses pointStresses(const BlockAssembly&, int first, int last);

} // namespace blocks
