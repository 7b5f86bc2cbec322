// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/laws/EdgeContactLaw.hpp>
#include <limits>

namespace blocks {

FourPoints raised(const FourPoints& p, Real uplift)
{
	Corners c = corners(p);
	raiseEdge(c, uplift);
	return points(c);
}

FourPoints raisedVelocity(const FourPoints& p, Real uplift, const FourPoints& velocity)
{
	Corners v = corners(velocity);
	raiseVelocity(corners(p), uplift, v);
	return points(v);
}

void lowerForces(const FourPoints& p, Real uplift, FourPoints& force)
{
	Corners f = corners(force);
	lowerEdgeForces(corners(p), uplift, f);
	force = points(f);
}

EdgeGeometry edgeGeometry(const FourPoints& p, const EdgeShape& shape) { return geometryOfEdges(corners(p), shape); }

Real freeDistance(const FourPoints& p, const EdgeShape& shape)
{
	const Vec2 &a0 = p[0], &a1 = p[1], &b0 = p[2], &b1 = p[3];
	const Vec2  A = a1 - a0, B = b1 - b0;
	const Real  lengthA = A.norm(), lengthB = B.norm(), facing = -A.dot(B);
	// A.B changes by at most 2 delta longest + delta^2, and delta <= longest
	if (!(facing > 0)) return -facing / (3 * std::max(lengthA, lengthB));

	// When vertices move by delta <= shortest/20, an edge turns by at most 2.2 delta/length, and the bisector by half as much as both. So a vertex' depth
	// and the lead x change by at most their rates times delta, and any of them, and y's first term, by at most `rate` times delta.
	const Real                shortest = std::min(lengthA, lengthB), turn = 1.1 / shortest, rate = 2 + 2 * turn * (lengthA + lengthB + (a0 - b1).norm());
	const Vec2                eA = A / lengthA, eB = B / lengthB, t = (eA - eB).normalized();
	const std::array<Real, 2> x { (a0 - b1).dot(t), (b0 - a1).dot(t) }, xRate { 1 + turn * (a0 - b1).norm(), 1 + turn * (b0 - a1).norm() };
	const std::array<Real, 2> depthA { -cross(a0 - b0, eB), -cross(a1 - b0, eB) }, depthB { -cross(b1 - a0, eA), -cross(b0 - a0, eA) };
	const std::array<Real, 2> rateA { 1 + 2.2 * (a0 - b0).norm() / lengthB, 1 + 2.2 * (a1 - b0).norm() / lengthB };
	const std::array<Real, 2> rateB { 1 + 2.2 * (b1 - a0).norm() / lengthA, 1 + 2.2 * (b0 - a0).norm() / lengthA };
	constexpr Real            infinity = std::numeric_limits<Real>::infinity();

	// As long as an end of the overlap is A's vertex for good, or B's, nothing is blended there.
	Real lasts = infinity;
	for (int k : { 0, 1 })
		lasts = std::min(lasts, (std::abs(x[k]) - shape.rounding[k]) / xRate[k]);
	const bool          plain = lasts > 0;
	std::array<Real, 2> lead; // lambda x, whose slope is at most 1.25
	for (int k : { 0, 1 })
		lead[k] = smoothstep((x[k] / shape.rounding[k] + 1) / 2).value * x[k];
	const Vec2 from = x[0] > 0 ? a0 : b1, to = x[1] > 0 ? a1 : b0; // the overlap
	const Real y     = plain ? (to - from).dot(t) : (b0 - b1).dot(t) - lead[0] - lead[1];
	const Real yRate = plain ? 2 + turn * (to - from).norm() : 3.5 * rate;
	if (!plain) lasts = infinity;

	// No end of the overlap is a vertex with a depth. The blend r changes by a quarter of what the depths do.
	std::array<Real, 2> leads, trails; // so long A's vertex is all that counts for an end's depth, or B's
	Real                noDepth = infinity;
	for (int k : { 0, 1 }) {
		const Real r = depthBlend * (positive(depthA[k]) + positive(depthB[k])), wayRate = xRate[k] + depthBlend * (rateA[k] + rateB[k]);
		leads[k] = (x[k] - r) / wayRate, trails[k] = (-x[k] - r) / wayRate;
		noDepth = std::min({ noDepth, std::max(-depthA[k] / rateA[k], trails[k]), std::max(-depthB[k] / rateB[k], leads[k]) });
	}
	// No overlap.
	const Real noOverlap = std::min((-y - std::max(shape.farRounding[0], shape.farRounding[1])) / yRate, lasts);
	// Nothing left of the overlap between a sharp corner and its far end, where the corner is the end: y <= (1 - lambda) x or y <= -lambda x, neither
	// negative.
	Real noReach = 0;
	for (int k : { 0, 1 }) {
		const bool sharpA = shape.sharpness[k] > 0, sharpB = shape.sharpness[3 - k] > 0;
		if (plain && (x[k] > 0 ? sharpA : sharpB)) noReach = std::max(noReach, std::min(-y / yRate, lasts));
		if (!plain && sharpA) noReach = std::max(noReach, std::min((x[k] - lead[k] - y) / 4.75, x[k]) / rate);
		if (!plain && sharpB) noReach = std::max(noReach, std::min((-lead[k] - y) / 4.75, -x[k]) / rate);
	}
	// Beyond the bisector of a sharp corner: q >= 6 while d^2/2 sharpness/X^2 is, d the depth of an end and X the corner's reach, which changes by the
	// overlap and what is between the corner and the end.
	Real beyond = 0;
	for (int k : { 0, 1 }) {
		struct Depth {
			Real depth, rate, lasts;
		};
		const Depth depths[] = { { std::min(depthA[k], depthB[k]), std::max(rateA[k], rateB[k]), infinity },
			                 { depthA[k], rateA[k], leads[k] },
			                 { depthB[k], rateB[k], trails[k] } };
		for (int end : { 0, 1 })
			for (bool ofA : { true, false }) {
				const Real steep     = std::sqrt(shape.sharpness[ofA ? end : 3 - end] / 12);
				const Real reach     = positive(y) + (plain ? positive(ofA ? -x[end] : x[end]) : lead[end] - (ofA ? x[end] : 0));
				const Real reachRate = plain ? yRate + xRate[end] : 5.75 * rate;
				for (const Depth& d : depths)
					beyond = std::max(
						beyond, std::min({ (d.depth * steep - positive(reach)) / (reachRate + d.rate * steep), d.lasts, lasts }));
			}
	}
	return std::min(std::max({ Real(0), noDepth, noOverlap, noReach, beyond }), shortest / 20);
}

Real edgePotential(const EdgeGeometry& g) { return potentialOfEdges(g); }

void addNormalForces(const FourPoints& p, const EdgeShape& shape, const EdgeGeometry& g, Real scale, FourPoints& force)
{
	Corners sum = corners(force);
	pushEdges(corners(p), shape, g, scale, sum);
	force = points(sum);
}

EdgeEnd edgeEnd(const FourPoints& p, const EdgeGeometry& g, int k) { return k == 0 ? endOfEdges<0>(corners(p), g) : endOfEdges<1>(corners(p), g); }

} // namespace blocks
