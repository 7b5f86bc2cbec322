// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/laws/EdgeContact.hpp>
#include <blocks/kernel/model/EdgeColumns.hpp>

/// The arithmetic of free contacts, a batch of edge pairs side by side: plain loops over columns, without indirections. The compiler makes them as wide as
/// the processor; without fused operations the bits are the same at any width.
namespace blocks {

/// What a step works out for the pairs of EdgeColumns.
struct EdgeBatch {
	using Lane = EdgeColumns::Lane;

	// ---- gathered: corners and how fast they move
	alignas(64) Lane px[4] {}, py[4] {}, vx[4] {}, vy[4] {}; ///< [m], [m/s]
	// ---- results
	alignas(64) Lane touches {};                ///< all else counts only where this is not 0
	alignas(64) Lane sigma[2] {}, tau[2] {};    ///< [Pa]
	alignas(64) Lane fx[4] {}, fy[4] {};        ///< forces on the corners [N]
	alignas(64) Lane friction {}, potential {}; ///< dissipated in this step [J]; U per kn and thickness [m3]
};

/// Stresses and forces of all pairs of a batch, at their corners where edges are not raised, slips and areas of the columns; dt times the velocities is the
/// last step's motion.
void advanceEdges(EdgeColumns&, EdgeBatch&, Real thickness, Real dt);

} // namespace blocks
