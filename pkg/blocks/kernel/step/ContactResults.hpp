// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// What free contacts hold and carry, as of the last step.
namespace blocks {

/// What the springs of a pair of edges hold in shear [J].
Real shearEnergy(const FreeContact&, const EdgePair&);

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
