// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/laws/EdgeContact.hpp>

/// The law of EdgeContact.hpp as arithmetic without branches, so that loops over many pairs run in lanes. All of it is always inline: only then is it
/// compiled as wide as its caller. What does not touch gets numbers too, or none; nobody reads them.
#define ALWAYS inline __attribute__((always_inline))
#define INLINE __attribute__((always_inline)) // of a lambda

namespace blocks {

ALWAYS XY  operator+(const XY& a, const XY& b) { return { a.x + b.x, a.y + b.y }; }
ALWAYS XY  operator-(const XY& a, const XY& b) { return { a.x - b.x, a.y - b.y }; }
ALWAYS XY  operator*(Real f, const XY& a) { return { f * a.x, f * a.y }; }
ALWAYS XY  operator*(const XY& a, Real f) { return { a.x * f, a.y * f }; }
ALWAYS XY& operator+=(XY& a, const XY& b)
{
	a.x += b.x;
	a.y += b.y;
	return a;
}
ALWAYS XY& operator-=(XY& a, const XY& b)
{
	a.x -= b.x;
	a.y -= b.y;
	return a;
}
ALWAYS Real dot(const XY& a, const XY& b) { return a.x * b.x + a.y * b.y; }
ALWAYS Real cross(const XY& a, const XY& b) { return a.x * b.y - a.y * b.x; }

inline FourPoints points(const Corners& c) { return { c[0], c[1], c[2], c[3] }; }
inline Corners corners(const FourPoints& p) { return { { { p[0].x(), p[0].y() }, { p[1].x(), p[1].y() }, { p[2].x(), p[2].y() }, { p[3].x(), p[3].y() } } }; }

constexpr Real wholeUpTo = 0.04, goneFrom = 6; ///< q between which a contact fades out
constexpr Real depthBlend = 0.25;              ///< r/(dA + dB)

/// f(0) ... f(n - 1) with constants: an array that is only indexed so needs no memory.
template <int n, class F> ALWAYS void eachOf(const F& f)
{
	if constexpr (n > 0) {
		eachOf<n - 1>(f);
		f(std::integral_constant<int, n - 1> {});
	}
}

/// smoothstep(s) and its derivative: 0 up to s = 0, 1 from s = 1.
struct Blend {
	Real value, slope;
};
ALWAYS Blend smoothstep(Real s)
{
	const Real value = s * s * (3 - 2 * s), slope = 6 * s * (1 - s);
	const bool below = s <= 0, above = s >= 1;
	const Real most = above ? 1 : value, flat = above ? 0 : slope;
	return { below ? 0 : most, below ? 0 : flat };
}

ALWAYS Real positive(Real v) { return v > 0 ? v : 0; }
ALWAYS XY   turned(const XY& v) { return { -v.y, v.x }; }
ALWAYS XY   outward(const XY& e) { return { e.y, -e.x }; }

/// Depths times the length of the edge that they are measured from, and how far the edges face each other, times both lengths.
struct EdgeDepths {
	Real a0, a1, b1, b0, facing;

	/// 1 if they may touch, 0 if they surely do not.
	ALWAYS Real touch() const
	{
		const Real ofA = a0 > a1 ? a0 : a1, ofB = b0 > b1 ? b0 : b1, deepest = ofA > ofB ? ofA : ofB;
		const Real facingAnd = facing > 0 ? 1 : 0;
		return deepest > 0 ? facingAnd : 0;
	}
};
ALWAYS EdgeDepths edgeDepths(const Corners& p)
{
	const XY &a0 = p[0], &a1 = p[1], &b0 = p[2], &b1 = p[3];
	const XY  A = a1 - a0, B = b1 - b0;
	return { -cross(a0 - b0, B), -cross(a1 - b0, B), -cross(b1 - a0, A), -cross(b0 - a0, A), -dot(A, B) };
}

ALWAYS EdgeGeometry geometryOfEdges(const Corners& p, const EdgeShape& shape)
{
	EdgeGeometry     g;
	const EdgeDepths depths = edgeDepths(p);
	const XY &       a0 = p[0], &a1 = p[1], &b0 = p[2], &b1 = p[3];
	const XY         A = a1 - a0, B = b1 - b0;
	g.invA            = 1 / std::sqrt(A.x * A.x + A.y * A.y);
	g.invB            = 1 / std::sqrt(B.x * B.x + B.y * B.y);
	g.eA              = A * g.invA;
	g.eB              = B * g.invB;
	const Real cosine = depths.facing * g.invA * g.invB;
	g.c               = cosine < 1 ? cosine : 1;
	const XY both     = g.eA - g.eB;
	g.bisector        = std::sqrt(both.x * both.x + both.y * both.y);
	g.t               = { both.x / g.bisector, both.y / g.bisector };

	g.x      = { dot(a0 - b1, g.t), dot(b0 - a1, g.t) };
	g.depthA = { positive(depths.a0 * g.invB), positive(depths.a1 * g.invB) };
	g.depthB = { positive(depths.b1 * g.invA), positive(depths.b0 * g.invA) };
	g.y      = dot(b0 - b1, g.t);
	g.sum    = 0;
	Real square[2];
	eachOf<2>([&](auto k) INLINE {
		const Blend s = smoothstep((g.x[k] / shape.rounding[k] + 1) / 2);
		g.lambda[k]   = s.value;
		g.slope[k]    = s.slope / (2 * shape.rounding[k]);
		g.y -= g.lambda[k] * g.x[k];
		const Real  r    = depthBlend * (g.depthA[k] + g.depthB[k]);
		const bool  deep = r > 0;
		const Blend m    = smoothstep((g.x[k] / r + 1) / 2);
		g.mu[k]          = deep ? m.value : s.value;
		g.muSlope[k]     = deep ? m.slope / 2 : 0;
		square[k]        = g.mu[k] * g.depthA[k] * g.depthA[k] + (1 - g.mu[k]) * g.depthB[k] * g.depthB[k];
		g.sum += square[k];
	});
	const Real  rho  = g.x[0] < g.x[1] ? shape.farRounding[0] : shape.farRounding[1]; // of the vertices that meet where the overlap ends
	const Blend ramp = smoothstep((g.y / rho + 1) / 2);
	g.length         = g.y * ramp.value;
	g.lengthSlope    = ramp.value + g.y * ramp.slope / (2 * rho);

	const Real overlap = positive(g.y);
	g.reach            = {
			   overlap - (1 - g.lambda[0]) * g.x[0], overlap - (1 - g.lambda[1]) * g.x[1], overlap + g.lambda[1] * g.x[1], overlap + g.lambda[0] * g.x[0]
	};
	g.q          = goneFrom / (shape.depthLimit * shape.depthLimit);
	Real reaches = 1;
	eachOf<4>([&](auto i) INLINE {
		const bool blunt = shape.sharpness[i] == 0;
		const Real more = shape.sharpness[i] / (g.reach[i] * g.reach[i]), reach = blunt ? 1 : g.reach[i];
		reaches = reach > 0 ? reaches : 0;
		g.q += blunt ? 0 : more;
	});
	g.q *= g.sum / 2;
	const Blend fade = smoothstep((g.q - wholeUpTo) / (goneFrom - wholeUpTo));
	g.h              = 1 - fade.value;
	g.hSlope         = -fade.slope / (goneFrom - wholeUpTo);
	g.area           = g.c * g.c * positive(g.length) * positive(g.h + g.q * g.hSlope) / 2;
	g.depth          = { std::sqrt(square[0]), std::sqrt(square[1]) };
	Real touches     = depths.touch() * reaches;
	touches          = g.sum > 0 ? touches : 0;
	touches          = g.y > -rho ? touches : 0;
	g.touches        = g.q < goneFrom ? touches : 0;
	return g;
}

/// See raised(), raisedVelocity() and lowerForces(). p: the raised corners, of which the length of A is that of the others.
ALWAYS XY   unit(const XY& v) { return { v.x / std::sqrt(dot(v, v)), v.y / std::sqrt(dot(v, v)) }; }
ALWAYS void raiseEdge(Corners& p, Real uplift)
{
	const XY up = uplift * outward(unit(p[1] - p[0]));
	p[0] += up, p[1] += up;
}
ALWAYS void raiseVelocity(const Corners& p, Real uplift, Corners& v)
{
	// the normal turns towards e as e turns towards its left
	const XY A = p[1] - p[0], more = uplift * dot(turned(A), v[1] - v[0]) / dot(A, A) * unit(A);
	v[0] += more, v[1] += more;
}
ALWAYS void lowerEdgeForces(const Corners& p, Real uplift, Corners& force)
{
	const XY A = p[1] - p[0], couple = uplift * dot(force[0] + force[1], unit(A)) / dot(A, A) * turned(A);
	force[0] -= couple, force[1] += couple;
}

ALWAYS Real potentialOfEdges(const EdgeGeometry& g) { return g.c * g.c * g.length * g.sum * g.h / 4; }

ALWAYS void pushEdges(const Corners& p, const EdgeShape& shape, const EdgeGeometry& g, Real scale, Corners& force)
{
	const XY & a0 = p[0], &a1 = p[1], &b0 = p[2], &b1 = p[3];
	const Real w = scale * g.c * g.c / 4, wL = w * g.length;
	const Real bySum = wL * (g.h + g.q * g.hSlope); // dU/d(sum), by way of q too
	const Real byC   = scale * g.c / 2 * g.length * g.sum * g.h;
	Real       byY   = w * g.sum * g.h * g.lengthSlope;
	Real       byX[2], byR[2];
	eachOf<2>([&](auto k) INLINE {
		const bool blended = g.muSlope[k] != 0;
		const Real r       = depthBlend * (g.depthA[k] + g.depthB[k]);
		const Real x       = bySum * g.muSlope[k] / r * (g.depthA[k] * g.depthA[k] - g.depthB[k] * g.depthB[k]);
		const Real depth   = -x * g.x[k] / r * depthBlend; // by either depth, both of which are positive here
		byX[k]             = blended ? x : 0;
		byR[k]             = blended ? depth : 0;
	});

	const bool fading = g.hSlope != 0;
	const Real byQ    = wL * g.sum * g.hSlope;
	Real       byReach[4];
	eachOf<4>([&](auto i) INLINE {
		const Real reach = -byQ * g.sum * shape.sharpness[i] / (g.reach[i] * g.reach[i] * g.reach[i]);
		byReach[i]       = shape.sharpness[i] == 0 ? 0 : reach;
		const Real over  = fading ? byReach[i] : 0;
		byY += g.y > 0 ? over : 0;
	});
	eachOf<2>([&](auto k) INLINE {
		const Real rate  = g.lambda[k] + g.x[k] * g.slope[k]; // d(lambda x)/dx
		const Real faded = byX[k] + (byReach[k] * (rate - 1) + byReach[std::size_t(3 - k)] * rate);
		byX[k]           = (fading ? faded : byX[k]) - byY * rate;
	});

	// dU by the four vertices at fixed directions, and by the two directions' angles
	Real       byAngleA = -byC * cross(g.eA, g.eB), byAngleB = -byAngleA;
	XY         ga0 = byX[0] * g.t, gb1 = -(byX[0] + byY) * g.t, gb0 = (byX[1] + byY) * g.t, ga1 = -byX[1] * g.t;
	const XY   byT  = byX[0] * (a0 - b1) + byX[1] * (b0 - a1) + byY * (b0 - b1);
	const Real turn = dot(byT, turned(g.t)) / 2; // the bisector turns by half of what each edge turns
	byAngleA += turn;
	byAngleB += turn;

	const XY   mA = outward(g.eA), mB = outward(g.eB);
	const Real fA[2] = { 2 * bySum * g.mu[0] * g.depthA[0] + byR[0], 2 * bySum * g.mu[1] * g.depthA[1] + byR[1] };
	const Real fB[2] = { 2 * bySum * (1 - g.mu[0]) * g.depthB[0] + byR[0], 2 * bySum * (1 - g.mu[1]) * g.depthB[1] + byR[1] };
	// depthA_k = (b0 - a_k).mB, depthB_0 = (a0 - b1).mA, depthB_1 = (a0 - b0).mA; an edge that turns by 1 turns its normal by e
	ga0 += (fB[0] + fB[1]) * mA - fA[0] * mB;
	ga1 -= fA[1] * mB;
	gb0 += (fA[0] + fA[1]) * mB - fB[1] * mA;
	gb1 -= fB[0] * mA;
	byAngleB += dot(fA[0] * (b0 - a0) + fA[1] * (b0 - a1), g.eB);
	byAngleA += dot(fB[0] * (a0 - b1) + fB[1] * (a0 - b0), g.eA);

	const XY coupleA = byAngleA * g.invA * turned(g.eA), coupleB = byAngleB * g.invB * turned(g.eB);
	force[0] -= ga0 - coupleA;
	force[1] -= ga1 + coupleA;
	force[2] -= gb0 - coupleB;
	force[3] -= gb1 + coupleB;
}

/// End k of the overlap, 0 or 1.
template <int k> ALWAYS EdgeEnd endOfEdges(const Corners& p, const EdgeGeometry& g)
{
	const XY & a0 = p[0], &a1 = p[1], &b0 = p[2], &b1 = p[3];
	const Real mu = g.mu[k];
	// shares of the far vertex in the end's points; the near ones are a0, b1 at end 0 and a1, b0 at end 1
	const Real    farA = -(1 - mu) * g.x[k] * 2 / g.bisector * g.invA, farB = mu * g.x[k] * 2 / g.bisector * g.invB;
	constexpr int nearA = k == 0 ? 0 : 1, nearB = k == 0 ? 3 : 2;

	EdgeEnd end;
	end.onA       = p[nearA] + farA * (k == 0 ? XY(a1 - a0) : XY(a0 - a1));
	end.onB       = p[nearB] + farB * (k == 0 ? XY(b0 - b1) : XY(b1 - b0));
	end.direction = (1 - mu) * g.eA - mu * g.eB;

	const XY d = end.direction, gap = end.onB - end.onA;
	end.slipGradient[nearA]     = -(1 - farA) * d;
	end.slipGradient[1 - nearA] = -farA * d;
	end.slipGradient[nearB]     = (1 - farB) * d;
	end.slipGradient[5 - nearB] = farB * d;
	// the direction turns with the edges that it is made of
	const XY tA = turned(g.eA), tB = turned(g.eB);
	const XY coupleA = (1 - mu) * dot(gap, tA) * g.invA * tA, coupleB = -mu * dot(gap, tB) * g.invB * tB;
	end.slipGradient[0] -= coupleA;
	end.slipGradient[1] += coupleA;
	end.slipGradient[2] -= coupleB;
	end.slipGradient[3] += coupleB;
	return end;
}

} // namespace blocks
