// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// From the motion of the grid points to the forces of the zones.
namespace blocks {

/// Adds the zones' forces on the grid points of blocks [first, last), all of one material, in a fixed order. `energy`, if it is not
/// null, gets the elastic energy of every block's zones [J].
void addZoneForces(const BlockAssembly&, int firstBlock, int lastBlock, Vec2* force, Real* energy = nullptr);

/// What a look at all zones shows.
struct ZoneLook {
	Real energy = 0;    ///< elastic [J]
	bool sound  = true; ///< false: one is inside out, to rounding, or not a number
};
ZoneLook lookAtZones(const BlockAssembly&);

/// So many zones are worked on side by side.
constexpr int zoneBatch = 64;

/// Strain of a zone in its own axes.
ZoneStrain strainOf(const BlockAssembly&, int zone);

/// Strain of a zone with that of stresses in situ: what its stress follows from.
ZoneStrain elasticStrainOf(const BlockAssembly&, int zone);

/// Stress of a zone in the axes of the plane, per present area [Pa].
ZoneStress cauchyStress(const BlockAssembly&, int block, int zone);

/// Elastic moduli of a block's zones.
inline Moduli moduliOf(const BlockAssembly& a, int block)
{
	const Material& m = a.mesh.materials[a.mesh.blockMaterial[block]];
	return planeModuli(m.young, m.poisson, a.plane);
}

} // namespace blocks
