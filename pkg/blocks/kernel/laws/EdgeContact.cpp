// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/Wide.hpp>
#include <blocks/kernel/laws/EdgeContact.hpp>
#include <limits>

namespace blocks {
namespace {

	constexpr Real wholeUpTo = 0.04, goneFrom = 6; ///< q between which a contact fades out

	/// smoothstep(s) and its derivative: 0 up to s = 0, 1 from s = 1.
	struct Step {
		Real value, slope;
	};
	inline Step smoothstep(Real s)
	{
		if (s <= 0) return { 0, 0 };
		if (s >= 1) return { 1, 0 };
		return { s * s * (3 - 2 * s), 6 * s * (1 - s) };
	}

	constexpr Real depthBlend = 0.25; ///< r/(dA + dB)

	inline Vec2 turned(const Vec2& v) { return { -v.y(), v.x() }; }
	inline Vec2 outward(const Vec2& e) { return { e.y(), -e.x() }; }
	inline Real positive(Real v) { return v > 0 ? v : 0; }

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

WIDE void edgeGeometry(const FourPoints& p, const EdgeShape& shape, EdgeGeometry& g)
{
	g.active       = false;
	const Vec2 &a0 = p[0], &a1 = p[1], &b0 = p[2], &b1 = p[3];
	const Vec2  A = a1 - a0, B = b1 - b0;
	const Real  facing = -A.dot(B);
	if (!(facing > 0)) return;
	// depths times the length of the edge that they are measured from: their signs decide whether there is anything to do
	const Real a0B = cross(a0 - b0, B) * -1, a1B = cross(a1 - b0, B) * -1, b1A = cross(b1 - a0, A) * -1, b0A = cross(b0 - a0, A) * -1;
	if (!(a0B > 0 || a1B > 0 || b1A > 0 || b0A > 0)) return;

	const Real squareA = A.squaredNorm(), squareB = B.squaredNorm();
	g.invA     = 1 / std::sqrt(squareA);
	g.invB     = 1 / std::sqrt(squareB);
	g.eA       = A * g.invA;
	g.eB       = B * g.invB;
	g.c        = std::min(Real(1), facing * g.invA * g.invB);
	g.t        = g.eA - g.eB;
	g.bisector = std::sqrt(g.t.squaredNorm());
	g.t /= g.bisector;

	g.x      = { (a0 - b1).dot(g.t), (b0 - a1).dot(g.t) };
	g.depthA = { positive(a0B * g.invB), positive(a1B * g.invB) };
	g.depthB = { positive(b1A * g.invA), positive(b0A * g.invA) };
	g.y      = (b0 - b1).dot(g.t);
	g.sum    = 0;
	std::array<Real, 2> square;
	for (int k : { 0, 1 }) {
		const Step s = smoothstep((g.x[k] / shape.rounding[k] + 1) / 2);
		g.lambda[k]  = s.value;
		g.slope[k]   = s.slope / (2 * shape.rounding[k]);
		g.y -= g.lambda[k] * g.x[k];
		const Real r = depthBlend * (g.depthA[k] + g.depthB[k]);
		const Step m = r > 0 ? smoothstep((g.x[k] / r + 1) / 2) : Step { s.value, 0 };
		g.mu[k]      = m.value;
		g.muSlope[k] = m.slope / 2;
		square[k]    = m.value * g.depthA[k] * g.depthA[k] + (1 - m.value) * g.depthB[k] * g.depthB[k];
		g.sum += square[k];
	}
	if (!(g.sum > 0)) return;
	const Real rho = shape.farRounding[g.x[0] < g.x[1] ? 0 : 1]; // of the vertices that meet where the overlap ends
	if (g.y <= -rho) return;
	const Step ramp = smoothstep((g.y / rho + 1) / 2);
	g.length        = g.y * ramp.value;
	g.lengthSlope   = ramp.value + g.y * ramp.slope / (2 * rho);

	const Real overlap = positive(g.y);
	g.reach            = {
			   overlap - (1 - g.lambda[0]) * g.x[0], overlap - (1 - g.lambda[1]) * g.x[1], overlap + g.lambda[1] * g.x[1], overlap + g.lambda[0] * g.x[0]
	};
	g.q = goneFrom / (shape.depthLimit * shape.depthLimit);
	for (int i = 0; i < 4; ++i) {
		if (shape.sharpness[i] == 0) continue;
		if (!(g.reach[i] > 0)) return;
		g.q += shape.sharpness[i] / (g.reach[i] * g.reach[i]);
	}
	g.q *= g.sum / 2;
	if (!(g.q < goneFrom)) return;
	const Step fade = smoothstep((g.q - wholeUpTo) / (goneFrom - wholeUpTo));
	g.h             = 1 - fade.value;
	g.hSlope        = -fade.slope / (goneFrom - wholeUpTo);
	g.area          = g.c * g.c * positive(g.length) * positive(g.h + g.q * g.hSlope) / 2;
	g.depth         = { std::sqrt(square[0]), std::sqrt(square[1]) };
	g.active        = true;
}

WIDE Real freeDistance(const FourPoints& p, const EdgeShape& shape)
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

Real edgePotential(const EdgeGeometry& g) { return g.c * g.c * g.length * g.sum * g.h / 4; }

WIDE void addNormalForces(const FourPoints& p, const EdgeShape& shape, const EdgeGeometry& g, Real scale, FourPoints& force)
{
	const Vec2 &a0 = p[0], &a1 = p[1], &b0 = p[2], &b1 = p[3];
	const Real  w = scale * g.c * g.c / 4, wL = w * g.length;
	const Real  bySum  = wL * (g.h + g.q * g.hSlope); // dU/d(sum), by way of q too
	const Real  byC    = scale * g.c / 2 * g.length * g.sum * g.h;
	Real        byY    = w * g.sum * g.h * g.lengthSlope;
	Real        byX[2] = { 0, 0 }, byR[2] = { 0, 0 };
	for (int k : { 0, 1 })
		if (g.muSlope[k] != 0) {
			const Real r = depthBlend * (g.depthA[k] + g.depthB[k]);
			byX[k]       = bySum * g.muSlope[k] / r * (g.depthA[k] * g.depthA[k] - g.depthB[k] * g.depthB[k]);
			byR[k]       = -byX[k] * g.x[k] / r * depthBlend; // by either depth, both of which are positive here
		}

	if (g.hSlope != 0) {
		const Real byQ = wL * g.sum * g.hSlope;
		Real       byReach[4];
		for (int i = 0; i < 4; ++i) {
			byReach[i] = shape.sharpness[i] == 0 ? 0 : -byQ * g.sum * shape.sharpness[i] / (g.reach[i] * g.reach[i] * g.reach[i]);
			if (g.y > 0) byY += byReach[i];
		}
		const int ofA[2] = { 0, 1 }, ofB[2] = { 3, 2 };
		for (int k : { 0, 1 }) {
			const Real rate = g.lambda[k] + g.x[k] * g.slope[k]; // d(lambda x)/dx
			byX[k] += byReach[ofA[k]] * (rate - 1) + byReach[ofB[k]] * rate;
		}
	}
	for (int k : { 0, 1 })
		byX[k] -= byY * (g.lambda[k] + g.x[k] * g.slope[k]);

	// dU by the four vertices at fixed directions, and by the two directions' angles
	Real       byAngleA = -byC * cross(g.eA, g.eB), byAngleB = -byAngleA;
	Vec2       ga0 = byX[0] * g.t, gb1 = -(byX[0] + byY) * g.t, gb0 = (byX[1] + byY) * g.t, ga1 = -byX[1] * g.t;
	const Vec2 byT  = byX[0] * (a0 - b1) + byX[1] * (b0 - a1) + byY * (b0 - b1);
	const Real turn = byT.dot(turned(g.t)) / 2; // the bisector turns by half of what each edge turns
	byAngleA += turn;
	byAngleB += turn;

	const Vec2 mA = outward(g.eA), mB = outward(g.eB);
	const Real fA[2] = { 2 * bySum * g.mu[0] * g.depthA[0] + byR[0], 2 * bySum * g.mu[1] * g.depthA[1] + byR[1] };
	const Real fB[2] = { 2 * bySum * (1 - g.mu[0]) * g.depthB[0] + byR[0], 2 * bySum * (1 - g.mu[1]) * g.depthB[1] + byR[1] };
	// depthA_k = (b0 - a_k).mB, depthB_0 = (a0 - b1).mA, depthB_1 = (a0 - b0).mA; an edge that turns by 1 turns its normal by e
	ga0 += (fB[0] + fB[1]) * mA - fA[0] * mB;
	ga1 -= fA[1] * mB;
	gb0 += (fA[0] + fA[1]) * mB - fB[1] * mA;
	gb1 -= fB[0] * mA;
	byAngleB += (fA[0] * (b0 - a0) + fA[1] * (b0 - a1)).dot(g.eB);
	byAngleA += (fB[0] * (a0 - b1) + fB[1] * (a0 - b0)).dot(g.eA);

	const Vec2 coupleA = byAngleA * g.invA * turned(g.eA), coupleB = byAngleB * g.invB * turned(g.eB);
	force[0] -= ga0 - coupleA;
	force[1] -= ga1 + coupleA;
	force[2] -= gb0 - coupleB;
	force[3] -= gb1 + coupleB;
}

WIDE EdgeEnd edgeEnd(const FourPoints& p, const EdgeGeometry& g, int k)
{
	const Vec2 &a0 = p[0], &a1 = p[1], &b0 = p[2], &b1 = p[3];
	const Real  mu = g.mu[k];
	// shares of the far vertex in the end's points; the near ones are a0, b1 at end 0 and a1, b0 at end 1
	const Real farA = -(1 - mu) * g.x[k] * 2 / g.bisector * g.invA, farB = mu * g.x[k] * 2 / g.bisector * g.invB;
	const int  nearA = k == 0 ? 0 : 1, nearB = k == 0 ? 3 : 2;

	EdgeEnd end;
	end.onA       = p[nearA] + farA * (k == 0 ? Vec2(a1 - a0) : Vec2(a0 - a1));
	end.onB       = p[nearB] + farB * (k == 0 ? Vec2(b0 - b1) : Vec2(b1 - b0));
	end.direction = (1 - mu) * g.eA - mu * g.eB;

	const Vec2 &d = end.direction, gap = end.onB - end.onA;
	end.slipGradient[nearA]     = -(1 - farA) * d;
	end.slipGradient[1 - nearA] = -farA * d;
	end.slipGradient[nearB]     = (1 - farB) * d;
	end.slipGradient[5 - nearB] = farB * d;
	// the direction turns with the edges that it is made of
	const Vec2 tA = turned(g.eA), tB = turned(g.eB);
	const Vec2 coupleA = (1 - mu) * gap.dot(tA) * g.invA * tA, coupleB = -mu * gap.dot(tB) * g.invB * tB;
	end.slipGradient[0] -= coupleA;
	end.slipGradient[1] += coupleA;
	end.slipGradient[2] -= coupleB;
	end.slipGradient[3] += coupleB;
	return end;
}

} // namespace blocks
