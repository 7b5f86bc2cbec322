// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// Opening and slip of the two contact points of a segment, and the nodal forces that belong to their stresses.
///
/// With x1, x2 the points on the two edges and d = x2 - x1, the frame n = normalised(n1 - n2), t = n turned by +90 degrees:
///   opening = d.n - bondOpening,   slip = d.t - bondSlip.
/// The nodal forces are work-conjugate to these two (f = -A (sigma d opening/dx + tau d slip/dx)), the turning of the frame
/// included; a rigid motion changes neither, so total force and moment vanish to rounding, broken or not.
namespace blocks {

inline __attribute__((always_inline)) SegmentFrame segmentFrame(const Segment& g, const Vec2* x)
{
	const Vec2 e1 = x[g.node[1]] - x[g.node[0]], e2 = x[g.node[3]] - x[g.node[2]];
	const Real inv1 = 1 / std::sqrt(e1.squaredNorm()), inv2 = 1 / std::sqrt(e2.squaredNorm());
	const Real n1x = e1.y() * inv1, n1y = -e1.x() * inv1, n2x = e2.y() * inv2, n2y = -e2.x() * inv2;

	Real       nx = n1x - n2x, ny = n1y - n2y;
	const Real square = nx * nx + ny * ny;
	const bool facing = square > 1e-6; // of 4: edges within 0.06 degrees of looking the same way have no bisector
	const Real inv    = facing ? 1 / std::sqrt(square) : 1;
	nx                = facing ? nx * inv : n1x;
	ny                = facing ? ny * inv : n1y;
	return { nx, ny, n1x * inv1, n1y * inv1, n2x * inv2, n2y * inv2 };
}

/// x2 - x1 of contact point k, along n and t.
inline __attribute__((always_inline)) Vec2 hostDistance(const Segment& g, const SegmentFrame& f, const Vec2* x, int k)
{
	const Vec2 d = x[g.node[2]] + g.s2[k] * (x[g.node[3]] - x[g.node[2]]) - x[g.node[0]] - g.s1[k] * (x[g.node[1]] - x[g.node[0]]);
	return { d.x() * f.nx + d.y() * f.ny, d.y() * f.nx - d.x() * f.ny };
}

/// Contact point i of the assembly, midway between its two hosts [m].
inline Vec2 contactPosition(const BlockAssembly& a, int i)
{
	const Segment& g = a.segments[i / 2];
	const int      k = i % 2;
	const Vec2*    x = a.position.data();
	return (x[g.node[0]] + g.s1[k] * (x[g.node[1]] - x[g.node[0]]) + x[g.node[2]] + g.s2[k] * (x[g.node[3]] - x[g.node[2]])) / 2;
}

/// Always inline: only then is it compiled as wide as its caller.
inline __attribute__((always_inline)) void updateKinematics(const Segment& g, const Vec2* x, SegmentFrame& frame, ContactPoint* two)
{
	frame = segmentFrame(g, x);
	for (int k = 0; k < 2; ++k) {
		const Vec2 d   = hostDistance(g, frame, x, k);
		two[k].opening = d.x() - two[k].bondOpening;
		two[k].slip    = d.y() - two[k].bondSlip;
	}
}

/// Forces on a1, b1, a2, b2 [N].
inline void segmentForces(const Segment& g, const SegmentFrame& f, const ContactPoint* two, std::array<Vec2, 4>& out)
{
	Real a1x = 0, a1y = 0, b1x = 0, b1y = 0, a2x = 0, a2y = 0, b2x = 0, b2y = 0, moment = 0;
	for (int k = 0; k < 2; ++k) {
		const Real n = g.area * two[k].sigma, t = g.area * two[k].tau;
		const Real fx = n * f.nx - t * f.ny, fy = n * f.ny + t * f.nx; // on the first block
		const Real w1 = g.s1[k], w2 = g.s2[k];
		a1x += (1 - w1) * fx, a1y += (1 - w1) * fy, b1x += w1 * fx, b1y += w1 * fy;
		a2x -= (1 - w2) * fx, a2y -= (1 - w2) * fy, b2x -= w2 * fx, b2y -= w2 * fy;
		moment += n * (two[k].slip + two[k].bondSlip) - t * (two[k].opening + two[k].bondOpening);
	}
	const Real half = moment / 2; // each edge turns the frame by half its own rotation
	a1x -= half * f.r1x, a1y -= half * f.r1y, b1x += half * f.r1x, b1y += half * f.r1y;
	a2x -= half * f.r2x, a2y -= half * f.r2y, b2x += half * f.r2x, b2y += half * f.r2y;
	out[0] = { a1x, a1y }, out[1] = { b1x, b1y }, out[2] = { a2x, a2y }, out[3] = { b2x, b2y };
}

} // namespace blocks
