// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/Types.hpp>

/// Opening and slip at a contact point, and the forces on its edges.
///
/// With x1, x2 the point on the two edges and d = x2 - x1, the frame n = normalised(n1 - n2), t = n turned by +90 degrees:
///   opening = d.n - bondOpening,   slip = d.t - bondSlip.
/// The forces are work-conjugate to these two (f = -A (sigma d opening/dx + tau d slip/dx)), the turning of the frame
/// included; a rigid motion changes neither, so total force and moment vanish to rounding, broken or not.
namespace blocks {

/// The frame of a joint, turning with its hosts: n bisects the two edge normals and points out of the first block.
struct JointFrame {
	Real nx = 0, ny = 0;   ///< unit normal; the tangent is n turned by +90 degrees
	Real r1x = 0, r1y = 0; ///< n1 / L1, by which the first edge's nodes turn the frame [1/m]
	Real r2x = 0, r2y = 0; ///< n2 / L2 [1/m]
};

/// From the two edges as they are now. Always inline: only then is it compiled as wide as its caller.
inline __attribute__((always_inline)) JointFrame jointFrame(Real e1x, Real e1y, Real e2x, Real e2y)
{
	const Real inv1 = 1 / std::sqrt(e1x * e1x + e1y * e1y), inv2 = 1 / std::sqrt(e2x * e2x + e2y * e2y);
	const Real n1x = e1y * inv1, n1y = -e1x * inv1, n2x = e2y * inv2, n2y = -e2x * inv2;

	const Real sx = n1x - n2x, sy = n1y - n2y, square = sx * sx + sy * sy;
	const bool facing = square > 1e-6; // of 4: edges within 0.06 degrees of looking the same way have no bisector
	const Real inv    = 1 / std::sqrt(facing ? square : 1);
	return { facing ? sx * inv : n1x, facing ? sy * inv : n1y, n1x * inv1, n1y * inv1, n2x * inv2, n2y * inv2 };
}

} // namespace blocks
