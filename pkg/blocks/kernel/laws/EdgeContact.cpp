// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/laws/EdgeContactLaw.hpp>
#include <limits>

namespace blocks {
namespace {

	Corners plain(const FourPoints& p) { return { { { p[0].x(), p[0].y() }, { p[1].x(), p[1].y() }, { p[2].x(), p[2].y() }, { p[3].x(), p[3].y() } } }; }

	Vec2 turned(const Vec2& v) { return { -v.y(), v.x() }; }
	Vec2 outward(const Vec2& e) { return { e.y(), -e.x() }; }

} // namespace

FourPoints raised(const FourPoints& p, Real uplift)
{
	const Vec2 up = uplift * outward((p[1] - p[0]).normalized());
	return { p[0] + up, p[1] + up, p[2], p[3] };
}

FourPoints raisedVelocity(const FourPoints& p, Real uplift, const FourPoints& v)
{
	// the normal turns towards e as e turns towards its left
	const Vec2 A    = p[1] - p[0];
	const Vec2 more = uplift * turned(A).dot(v[1] - v[0]) / A.squaredNorm() * A.normalized();
	return { v[0] + more, v[1] + more, v[2], v[3] };
}

void lowerForces(const FourPoints& p, Real uplift, FourPoints& force)
{
	const Vec2 A      = p[1] - p[0];
	const Vec2 couple = uplift * (force[0] + force[1]).dot(A.normalized()) / A.squaredNorm() * turned(A);
	force[0] -= couple;
	force[1] += couple;
}

EdgeGeometry edgeGeometry(const FourPoints& p, const EdgeShape& shape) { return geometryOfEdges(plain(p), shape); }

Real freeDistance(const FourPoints& p, const EdgeShape& shape)
{
	const Vec2 &a0 = p[0], &a1 = p[1], &b0 = p[2], &b1 = p[3];
	const Vec2  A = a1 - a0, B = b1 - b0;
	const Real  lengthA = A.norm(), lengthB = B.norm(), facing = -A.dot(B);
	// A.B changes by at most 2 delta longest + delta^2, and delta <= longest
	if (!(facing > 0)) return -facing / (3 * std::max(lengthA, lengthB));

	// When vertices move by delta <= shortest/20, an edge turns by at most 2.2 delta / shortest (the bisector by half as much), so
	// a vertex' depth, x and y's first term change by at most `rate` delta.
	const Real                shortest = std::min(lengthA, lengthB), rate = 2 + 2.2 * (lengthA + lengthB + (a0 - b1).norm()) / shortest;
	const Vec2                eA = A / lengthA, eB = B / lengthB, t = (eA - eB).normalized();
	const std::array<Real, 2> x { (a0 - b1).dot(t), (b0 - a1).dot(t) };
	const std::array<Real, 2> depthA { -cross(a0 - b0, eB), -cross(a1 - b0, eB) }, depthB { -cross(b1 - a0, eA), -cross(b0 - a0, eA) };

	// No end of the overlap is a vertex with a depth. The blend r changes by at most half as much as a depth.
	Real                noDepth = std::numeric_limits<Real>::infinity(), y = (b0 - b1).dot(t);
	std::array<Real, 2> lead; // lambda x, whose slope is at most 1.25
	for (int k : { 0, 1 }) {
		const Real r = depthBlend * (positive(depthA[k]) + positive(depthB[k]));
		noDepth      = std::min({ noDepth, std::max(-depthA[k], (-x[k] - r) / 1.5), std::max(-depthB[k], (x[k] - r) / 1.5) });
		lead[k]      = smoothstep((x[k] / shape.rounding[k] + 1) / 2).value * x[k];
		y -= lead[k];
	}
	// No overlap.
	const Real noOverlap = (-y - std::max(shape.farRounding[0], shape.farRounding[1])) / 3.5;
	// Nothing left of the overlap between a sharp corner and its far end: y <= (1 - lambda) x or y <= -lambda x, neither negative.
	Real noReach = 0;
	for (int k : { 0, 1 }) {
		const int ofA = k, ofB = 3 - k;
		if (shape.sharpness[ofA] > 0) noReach = std::max(noReach, std::min((x[k] - lead[k] - y) / 4.75, x[k]));
		if (shape.sharpness[ofB] > 0) noReach = std::max(noReach, std::min((-lead[k] - y) / 4.75, -x[k]));
	}
	return std::min(std::max({ Real(0), noDepth, noOverlap, noReach }) / rate, shortest / 20);
}

Real edgePotential(const EdgeGeometry& g) { return potentialOfEdges(g); }

void addNormalForces(const FourPoints& p, const EdgeShape& shape, const EdgeGeometry& g, Real scale, FourPoints& force)
{
	Corners sum = plain(force);
	pushEdges(plain(p), shape, g, scale, sum);
	std::copy(sum.begin(), sum.end(), force.begin());
}

EdgeEnd edgeEnd(const FourPoints& p, const EdgeGeometry& g, int k) { return k == 0 ? endOfEdges<0>(plain(p), g) : endOfEdges<1>(plain(p), g); }

} // namespace blocks
