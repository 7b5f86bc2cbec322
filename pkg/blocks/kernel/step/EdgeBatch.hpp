// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/laws/EdgeContact.hpp>
#include <cstdint>

/// The arithmetic of free contacts, a batch of edge pairs side by side: plain loops over columns, without indirections. The compiler makes them as wide as
/// the processor; without fused operations the bits are the same at any width.
namespace blocks {

/// Up to so many edge pairs in work. Arrays of four belong to the corners a0, a1, b0, b1, arrays of two to the ends of the overlap.
struct EdgeBatch {
	static constexpr int size = 32;
	using Lane                = Real[size];

	int count = 0;
	int contact[size], pair[size]; ///< which edge pair of which contact of those in work

	// ---- gathered: corners and how fast they move, shape (see EdgeShape) and joint
	alignas(64) Lane px[4] {}, py[4] {}, vx[4] {}, vy[4] {}; ///< [m], [m/s]
	alignas(64) Lane sharpness[4] {}, rounding[2] {}, farRounding[2] {}, depthLimit {};
	alignas(64) Lane kn {}, ks {}, cohesion {}, tanPhi {}; ///< residual values
	// ---- from step to step
	alignas(64) Lane slip[2] {}, area {}; ///< see EdgePair
	// ---- results
	alignas(64) Lane touches {};                ///< all else counts only where this is not 0
	alignas(64) Lane sigma[2] {}, tau[2] {};    ///< [Pa]
	alignas(64) Lane fx[4] {}, fy[4] {};        ///< forces on the corners [N]
	alignas(64) Lane friction {}, potential {}; ///< dissipated in this step [J]; U per kn and thickness [m3]
};

/// Stresses and forces of all pairs of a batch; dt times the velocities is the last step's motion.
void advanceEdges(EdgeBatch&, Real thickness, Real dt);

} // namespace blocks
