// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// Stresses that zones and joints have in situ, before anything moves.
///
/// A zone's elastic strain is U - 1 and what its stress in situ goes with; a joint's opening and slip count from where it has its stress in situ. So
/// forces, energies and limits need no other law. In a field that is in equilibrium the forces of the grid points are zero to rounding: a zone has
/// the stress at its centroid, and the two points of a joint have those stresses that pull at their edges as the linear field does, its values a third of
/// the way towards each other.
namespace blocks {

/// Stress in the plane, tension positive, linear in y.
struct InSituStress {
	ZoneStress at { 0, 0, 0 };       ///< at y = level [Pa]
	ZoneStress gradient { 0, 0, 0 }; ///< change with y [Pa/m]
	Real       level = 0;            ///< [m]

	ZoneStress operator()(Real y) const
	{
		const Real h = y - level;
		return { at.sxx + h * gradient.sxx, at.syy + h * gradient.syy, at.sxy + h * gradient.sxy };
	}
};

/// Gives all zones and joints their stress. Nothing may have moved, and joints must be whole or unbonded and able to carry it; free contacts have none.
void setInSitu(BlockAssembly&, const InSituStress&);

/// Adds to the dead loads what the field pulls at a boundary edge (an index into edgeNodes), each of its ends its share of the linear traction.
void addInSituTraction(BlockAssembly&, int edge, const InSituStress&);

} // namespace blocks
