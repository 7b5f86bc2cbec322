// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/Types.hpp>

/// Contact of two boundary edges A = a0 -> a1 and B = b0 -> b1 that need not be joined, parallel or of equal length.
///
/// Along t, the bisector of e_A and -e_B, the edges overlap from lo = max(a0, b1).t to hi = min(a1, b0).t; these are the two
/// ends. At each end the depth is that of the vertex which is the end, under the line of the other edge. With W = (-e_A.e_B)^2,
///   U = 1/4 kn T W L (d0^2 + d1^2) h(q),   L = hi - lo,
/// and forces are -grad U, all terms included: frictionless contact neither makes nor loses energy. Parallel edges give the
/// point law, kn d (T L/2) at each end. What would jump is blended. With x0 = (a0 - b1).t, x1 = (b0 - a1).t (positive where A's
/// vertex is the end) and lambda_k = smoothstep((x_k/rho + 1)/2), the overlap is
///   y = (b0 - b1).t - lambda_0 x0 - lambda_1 x1,   L = y smoothstep((y/rho + 1)/2);
/// rho << L belongs to the two vertices that meet, so what one of two collinear edges loses the other gains. The depth is
///   d_k^2 = mu_k dA_k^2 + (1 - mu_k) dB_k^2,   mu_k = smoothstep((x_k/r_k + 1)/2),   r_k = (dA_k + dB_k)/4.
/// Within a length that does not shrink with the depth, the vertex that is not the end would lie far deeper under the other
/// edge's line than any vertex does: a bump of height rho where a corner passes from one block to the next.
/// h fades a contact out where its depth stops being one: beyond the bisector of a corner, and half-way into the block:
///   q = (d0^2 + d1^2)/2 (sum over the corners of 1/(X tan(beta/2))^2 + 6/limit^2),
/// X the distance from the corner to the far end of the overlap, beta the angle of the material there. h is 1 up to q = 0.04, 0 from q = 6.
namespace blocks {

/// rho of a vertex, as a fraction of the shorter of its two edges.
constexpr Real roundingFraction = 0.02;

/// What does not change about a pair of edges. Corners in the order a0, a1, b0, b1.
struct EdgeShape {
	std::array<Real, 4> sharpness;   ///< 1/tan^2(beta/2); 0 where the outline is straight or bends inward [-]
	std::array<Real, 2> rounding;    ///< rho of the vertices a0 and b1, a1 and b0 [m]
	std::array<Real, 2> farRounding; ///< rho of the vertices a1 and b1, a0 and b0 [m]
	Real                depthLimit;  ///< depth at which the contact is lost [m]
};

/// A vector as two numbers: what the compiler makes wide.
struct XY {
	Real x, y;

	operator Vec2() const { return { x, y }; }
};
using Corners = std::array<XY, 4>; ///< a0, a1, b0, b1

/// Where two edges are with respect to each other.
struct EdgeGeometry {
	Real                touches;             ///< 1 or 0; the rest counts only if it is 1
	XY                  eA, eB, t;           ///< unit vectors
	Real                invA, invB;          ///< 1/length [1/m]
	Real                c, bisector;         ///< -e_A.e_B; |e_A - e_B|
	std::array<Real, 2> x;                   ///< lead of A's vertex over B's at either end [m]
	std::array<Real, 2> lambda, slope;       ///< share of A's vertex in the length's end, and its derivative [1/m]
	std::array<Real, 2> mu, muSlope;         ///< share of A's vertex in the depth; derivative by x/r [-]
	std::array<Real, 2> depthA, depthB;      ///< of A's and B's vertices, not negative [m]
	std::array<Real, 2> depth;               ///< of the two ends [m]
	Real                y;                   ///< overlap; negative if there is none [m]
	Real                length, lengthSlope; ///< L, dL/dy
	Real                sum;                 ///< d0^2 + d1^2 [m2]
	Real                h, hSlope, q;        ///< validity, dh/dq
	std::array<Real, 4> reach;               ///< X of the corners [m]
	Real                area;                ///< of each end, per thickness: normal stiffness / kn [m]

	bool active() const { return touches > 0; }
};

using FourPoints = std::array<Vec2, 4>; ///< at a0, a1, b0, b1

/// The geometry of two edges at points a0, a1, b0, b1.
EdgeGeometry edgeGeometry(const FourPoints&, const EdgeShape&);

/// Edge A moved out of its block by `uplift`: what a joint has dilated before its edges became a free pair stays between them.
FourPoints raised(const FourPoints&, Real uplift);

/// Velocities with that of the raised edge, for the velocities of the four points.
FourPoints raisedVelocity(const FourPoints&, Real uplift, const FourPoints& velocity);

/// Forces on the raised edge's ends, and on B, as forces on the four points: the work is the same.
void lowerForces(const FourPoints&, Real uplift, FourPoints& force);

/// A distance that the four vertices may move, those of A and those of B taken together, while a pair that does not touch
/// surely goes on not touching; 0 if none is known [m].
Real freeDistance(const FourPoints&, const EdgeShape&);

/// U of an active pair, per kn and thickness [m3].
Real edgePotential(const EdgeGeometry&);

/// Adds `scale` times -grad U, per kn and thickness, to the forces on a0, a1, b0, b1.
void addNormalForces(const FourPoints&, const EdgeShape&, const EdgeGeometry&, Real scale, FourPoints& force);

/// The end k as points on A and on B, and how its slip changes with the four vertices.
/// The slip is the relative displacement of B's point, along B where A's vertex is the end and along A where B's is, in the
/// direction of e_A; the edges' turning is taken off, so that a rigid motion of both makes no slip.
struct EdgeEnd {
	XY      onA, onB;  ///< [m]
	XY      direction; ///< of positive slip of B
	Corners slipGradient;
};
EdgeEnd edgeEnd(const FourPoints&, const EdgeGeometry&, int k);

} // namespace blocks
