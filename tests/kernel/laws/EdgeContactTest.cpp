// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/laws/EdgeContact.hpp>
#include <blocks/kernel/laws/JointLaw.hpp>

#include <gtest/gtest.h>
#include <limits>
#include <random>

using namespace blocks;

namespace {

constexpr Real eps = std::numeric_limits<Real>::epsilon();

EdgeShape shapeOf(std::array<Real, 4> angles, Real rho = 0.02, Real limit = 0.25)
{
	EdgeShape s;
	for (int i = 0; i < 4; ++i)
		s.sharpness[i] = angles[i] < M_PI ? std::pow(std::tan(angles[i] / 2), -2) : 0;
	s.rounding = s.farRounding = { rho, rho };
	s.depthLimit               = limit;
	return s;
}

/// Edges of length 0.4 to 1.4 in any position in which they overlap by a little, up to 60 degrees from parallel.
struct RandomEdges {
	std::mt19937 random { 11 };

	Real between(Real lo, Real hi) { return std::uniform_real_distribution<Real>(lo, hi)(random); }

	FourPoints points()
	{
		const Real angle = between(0, 2 * M_PI), tilt = between(-1, 1), LA = between(0.4, 1.4), LB = between(0.4, 1.4);
		const Vec2 eA(std::cos(angle), std::sin(angle)), eB(-std::cos(angle + tilt), -std::sin(angle + tilt));
		const Vec2 a0(between(-1, 1), between(-1, 1)), a1 = a0 + LA * eA;
		// a point of A and a point of B, which lies by `depth` inside A; often two vertices meet
		const int  where = int(between(0, 3));
		const Real sA = where == 0 ? 0 : where == 1 ? 1 : between(0, 1), sB = where == 0 ? 1 : where == 1 ? 0 : between(0, 1);
		const Vec2 onA = a0 + (sA + between(-0.03, 0.03)) * (a1 - a0), onB = onA + between(0, 0.08) * Vec2(-eA.y(), eA.x());
		const Vec2 b0 = onB - sB * LB * eB;
		return { a0, a1, b0, b0 + LB * eB };
	}
	EdgeShape shape()
	{
		std::array<Real, 4> angles;
		for (Real& a : angles)
			a = between(0, 1) < 0.2 ? 4 : between(0.6, M_PI);
		EdgeShape s = shapeOf(angles);
		for (auto* list : { &s.rounding, &s.farRounding })
			for (Real& rho : *list)
				rho = between(0.003, 0.03);
		return s;
	}
};

Real potential(const FourPoints& p, const EdgeShape& s)
{
	const EdgeGeometry g = edgeGeometry(p, s);
	return g.active() ? edgePotential(g) : 0;
}

FourPoints forces(const FourPoints& p, const EdgeShape& s)
{
	FourPoints f;
	f.fill(Vec2::Zero());
	const EdgeGeometry g = edgeGeometry(p, s);
	if (g.active()) addNormalForces(p, s, g, 1, f);
	return f;
}

Real largest(const FourPoints& f)
{
	Real m = 0;
	for (const Vec2& v : f)
		m = std::max(m, v.norm());
	return m;
}

} // namespace

TEST(EdgeContact, ForcesAreTheGradient)
{
	// Central differences of step d: truncation d^2/6 U'''/U' ~ (1e-6)^2/6 x (1/rho^2 ~ 1e5) = 2e-8 of the force, rounding
	// eps U/(d U') ~ 2e-16 x 0.1/1e-6 = 2e-11. Where a blend begins or ends, U'' jumps by up to U'/rho, and the error is d/rho ~ 3e-4 at
	// worst; that happens with a chance of d/rho a pose. Poses whose force is below 1e-5 (of kn T = 1) are as good as not in contact.
	RandomEdges edges;
	const Real  d     = 1e-6;
	int         poses = 0, blended = 0, faded = 0, poor = 0;
	for (int i = 0; i < 20000; ++i) {
		FourPoints       p     = edges.points();
		const EdgeShape  s     = edges.shape();
		const FourPoints f     = forces(p, s);
		const Real       scale = largest(f);
		if (scale < 1e-5) continue;
		const EdgeGeometry g = edgeGeometry(p, s);
		++poses;
		blended += g.muSlope[0] != 0 || g.muSlope[1] != 0;
		faded += g.hSlope != 0;
		Real worst = 0;
		for (int n = 0; n < 4; ++n)
			for (int axis : { 0, 1 }) {
				const Real at    = p[n][axis];
				p[n][axis]       = at + d;
				const Real ahead = potential(p, s);
				p[n][axis]       = at - d;
				worst            = std::max(worst, std::abs(f[n][axis] + (ahead - potential(p, s)) / (2 * d)) / scale);
				p[n][axis]       = at;
			}
		EXPECT_LT(worst, 1e-3) << "pose " << i;
		poor += worst > 1e-6;
	}
	EXPECT_GT(poses, 5000);
	EXPECT_GT(blended, 500); // the poses must be such that every term counts
	EXPECT_GT(faded, 500);
	EXPECT_LT(poor, poses / 100);
}

TEST(EdgeContact, ForceAndMomentVanish)
{
	RandomEdges edges;
	for (int i = 0; i < 5000; ++i) {
		const FourPoints p = edges.points(), f = forces(p, edges.shape());
		Vec2             force  = Vec2::Zero();
		Real             moment = 0;
		for (int n = 0; n < 4; ++n)
			force += f[n], moment += cross(p[n], f[n]);
		// some 50 roundings of forces; positions up to 2.5; couples are small differences of large ones: x 10
		ASSERT_LT(force.norm(), 1000 * eps * largest(f) + 1e-18);
		ASSERT_LT(std::abs(moment), 2500 * eps * largest(f) + 1e-18);
	}
}

TEST(EdgeContact, ParallelEdgesGiveThePointLaw)
{
	// A from (0, 0) to (2, 0) looks down upon B from (2.6, d) to (0.7, d): overlap 1.3, of which either end has half.
	const Real         d = 1e-3;
	const EdgeShape    s = shapeOf({ 1.5, 1.6, 1.7, 1.4 });
	const FourPoints   p { Vec2(0, 0), Vec2(2, 0), Vec2(2.6, d), Vec2(0.7, d) };
	const EdgeGeometry g = edgeGeometry(p, s);
	ASSERT_TRUE(g.active());
	EXPECT_NEAR(g.area, 0.65, 10 * eps);
	EXPECT_NEAR(g.depth[0], d, 10 * eps);
	EXPECT_NEAR(g.depth[1], d, 10 * eps);
	const FourPoints f = forces(p, s);
	EXPECT_NEAR((f[0] + f[1]).y(), 1.3 * d, 100 * eps * d);
	// the law's ends, at x = 0.7 and 2 with 0.65 d each, as loads on the vertices; the overhang's push d^2/2 sideways, and its
	// small couple, are the only difference: relative d/L = 1e-3
	EXPECT_NEAR(f[1].y(), 0.65 * d * (0.7 + 2) / 2, d * d);
	EXPECT_NEAR(f[0].y(), 0.65 * d * (2 - 0.7) / 2, d * d);
	EXPECT_NEAR((f[0] + f[1]).x(), -d * d / 2, 10 * eps); // the overlap grows as A moves to the right: -dU/dx = -d^2/2
}

TEST(EdgeContact, CollinearEdgesShareWithoutLossOrGain)
{
	// A slides over the grid point between B1 and B2: whatever the blends do, areas and forces add up to those of one edge. If A
	// ends in a right angle there, the fading of its tip takes force from a length of order d.
	const Real d = 2e-3, flat = M_PI;
	for (Real corner : { flat, M_PI / 2 })
		for (Real x : { -0.5, -0.019, -0.011, -0.003, 0.0, 0.003, 0.011, 0.019, 0.3 }) {
			const Vec2       a0(x - 0.6, 0), a1(x, 0), left(-1.5, d), middle(0, d), right(0.8, d);
			const EdgeShape  s  = shapeOf({ flat, corner, flat, flat });
			const FourPoints f1 = forces({ a0, a1, middle, left }, s), f2 = forces({ a0, a1, right, middle }, s);
			EXPECT_NEAR((f1[0] + f1[1] + f2[0] + f2[1]).y(), 0.6 * d, corner == flat ? 100 * eps : d * d) << x;
			EXPECT_NEAR((f1[0] + f1[1] + f2[0] + f2[1]).x(), 0, corner == flat ? 100 * eps : d * d) << x;
		}
}

TEST(EdgeContact, NothingWhereNothingFaces)
{
	const EdgeShape s     = shapeOf({ 1.5, 1.5, 1.5, 1.5 });
	auto            touch = [&](const FourPoints& p) {
                const EdgeGeometry g = edgeGeometry(p, s);
                return g.active();
	};
	EXPECT_FALSE(touch({ Vec2(0, 0), Vec2(1, 0), Vec2(1, -0.1), Vec2(0, -0.1) }));    // a gap
	EXPECT_FALSE(touch({ Vec2(0, 0), Vec2(1, 0), Vec2(0, 0.01), Vec2(1, 0.01) }));    // the same way
	EXPECT_FALSE(touch({ Vec2(0, 0), Vec2(1, 0), Vec2(0.5, 0), Vec2(0.5, 1) }));      // at a right angle
	EXPECT_FALSE(touch({ Vec2(0, 0), Vec2(1, 0), Vec2(2, 0.01), Vec2(1.03, 0.01) })); // beside each other
	EXPECT_FALSE(touch({ Vec2(0, 0), Vec2(1, 0), Vec2(1, 0.6), Vec2(0, 0.6) }));      // through the block
	EXPECT_FALSE(touch({ Vec2(0, 0), Vec2(1, 0), Vec2(1, 0), Vec2(0, 0) }));          // touching without depth
	EXPECT_TRUE(touch({ Vec2(0, 0), Vec2(1, 0), Vec2(1, 0.01), Vec2(0, 0.01) }));
}

TEST(EdgeContact, SharpTipsFade)
{
	// Two right angles overlap by dx and dy. Below dy = 0.14 dx the horizontal edges have all (q = 2 dy^2/dx^2 < 0.04), beyond
	// dy = sqrt(3) dx nothing (q > 6); the limit of 0.25 adds 6 dy^2/0.25^2 to q.
	const EdgeShape s     = shapeOf({ M_PI / 2, M_PI / 2, M_PI / 2, M_PI / 2 }, 1e-4);
	auto            value = [&](Real dx, Real dy) {
                const EdgeGeometry g = edgeGeometry({ Vec2(-1, 0), Vec2(0, 0), Vec2(1 - dx, dy), Vec2(-dx, dy) }, s);
                return g.active() ? g.h : 0;
	};
	EXPECT_EQ(value(0.01, 0.0013), 1);
	EXPECT_LT(value(0.01, 0.01), 1);
	EXPECT_GT(value(0.01, 0.01), 0);
	EXPECT_EQ(value(0.01, 0.0175), 0);
}

TEST(EdgeContact, WhatIsFreeStaysFree)
{
	// A pair that does not touch still does not after its vertices have moved by the free distance, shared out between the two
	// edges, each in any direction.
	RandomEdges edges;
	auto        direction = [&] {
                const Real angle = edges.between(0, 2 * M_PI);
                return Vec2(std::cos(angle), std::sin(angle));
	};
	auto touches = [](const FourPoints& p, const EdgeShape& s) {
		const EdgeGeometry g = edgeGeometry(p, s);
		return g.active();
	};
	int apart = 0, free = 0, soon = 0;
	for (int i = 0; i < 20000; ++i) {
		FourPoints p     = edges.points();
		EdgeShape  s     = edges.shape();
		Vec2       shift = edges.between(0, 0.1) * direction();
		if (i % 2) shift = p[2 + i / 4 % 2] - p[i / 2 % 2] + std::pow(10, edges.between(-9, -2)) * direction(); // corners that all but meet
		p[0] += shift, p[1] += shift;
		if (touches(p, s)) continue;
		++apart;
		const Real distance = freeDistance(p, s);
		ASSERT_GE(distance, 0);
		free += distance > 0;
		bool reached = false;
		for (int k = 0; k < 40; ++k) {
			const Real share    = edges.between(0, 1);
			Vec2       moves[4] = { direction(), direction(), direction(), direction() };
			for (int n = 0; n < 4 && k < 16; ++n) { // edges turn fastest where their ends move across them
				const Vec2 e = (p[n < 2 ? 1 : 3] - p[n < 2 ? 0 : 2]).normalized();
				moves[n]     = (k >> n & 1 ? 1 : -1) * Vec2(e.y(), -e.x());
			}
			auto moved = [&](Real by) {
				FourPoints q = p;
				for (int n = 0; n < 4; ++n)
					q[n] += by * (n < 2 ? share : 1 - share) * moves[n];
				return q;
			};
			ASSERT_FALSE(touches(moved(distance), s)) << i;
			ASSERT_FALSE(touches(moved(distance * edges.between(0, 1)), s)) << i;
			reached = reached || touches(moved(30 * distance), s);
		}
		soon += distance > 0 && reached;
	}
	std::printf("apart: %d, free for some distance: %d, touching at 30 times that: %d\n", apart, free, soon);
	EXPECT_GT(free, apart * 6 / 10); // the others overlap, and have faded out in the middle of a block
	EXPECT_GT(soon, free / 2);       // no bound that is safe because it is tiny
}

TEST(EdgeContact, SlipIsObjective)
{
	// Any rigid velocity of both edges makes no slip; the friction's nodal forces are the same vectors, so they have neither a
	// sum nor a moment.
	RandomEdges edges;
	for (int i = 0; i < 2000; ++i) {
		const FourPoints   p = edges.points();
		const EdgeGeometry g = edgeGeometry(p, edges.shape());
		if (!g.active()) continue;
		for (int k : { 0, 1 }) {
			const EdgeEnd end    = edgeEnd(p, g, k);
			Vec2          sum    = Vec2::Zero();
			Real          moment = 0;
			for (int n = 0; n < 4; ++n)
				sum += Vec2(end.slipGradient[n]), moment += cross(p[n], Vec2(end.slipGradient[n]));
			ASSERT_LT(sum.norm(), 100 * eps);
			ASSERT_LT(std::abs(moment), 1000 * eps);
		}
	}
}

TEST(EdgeContact, SlipRunsAlongTheFaceThatIsSlidOn)
{
	// A's vertex a1 slides on B, which is tilted by 0.4 against A. Moving A by u along e_B is a slip of u; moving it across is none.
	const Vec2         eB(-std::cos(0.4), -std::sin(0.4)), b0 = Vec2(1, 0.01) - 0.3 * eB;
	const FourPoints   p { Vec2(0, 0), Vec2(1, 0), b0, b0 + 1.5 * eB };
	const EdgeGeometry g = edgeGeometry(p, shapeOf({ 2, 2, 2, 2 }));
	ASSERT_TRUE(g.active());
	ASSERT_EQ(g.mu[1], 1);
	const EdgeEnd end = edgeEnd(p, g, 1);
	EXPECT_NEAR((Vec2(end.onA) - p[1]).norm(), 0, 10 * eps);
	EXPECT_NEAR(cross(Vec2(end.onB) - p[2], eB), 0, 10 * eps);
	auto slip = [&](const Vec2& u) { return u.dot(Vec2(end.slipGradient[0]) + Vec2(end.slipGradient[1])); };
	EXPECT_NEAR(slip(eB), 1, 10 * eps); // B slips by 1 along -e_B with respect to A
	EXPECT_NEAR(slip({ eB.y(), -eB.x() }), 0, 10 * eps);
}

TEST(EdgeContact, NothingExplodesWhereEdgesAreTinyOrTouchExactly)
{
	// Vertices upon each other, edges of 1e-9 of the others' length, exact right angles: finite, and never more than a flat
	// contact of the shorter edge would give with its depth and the blends' slopes (depth/rho) on top.
	const Real big = 1, tiny = 1e-9;
	for (Real LA : { big, tiny })
		for (Real LB : { big, tiny })
			for (Real depth : { 0.0, 1e-12, 1e-6, 1e-2 })
				for (Real tilt : { 0.0, 1e-12, 0.7, M_PI / 2, -M_PI / 2 })
					for (int meet : { 0, 1, 2 }) {
						const Vec2         eB(-std::cos(tilt), -std::sin(tilt));
						const Vec2         a0(0, 0), a1(LA, 0);
						const Vec2         b0 = (meet == 0 ? a1 : meet == 1 ? Vec2(a0 - LB * eB) : Vec2(0.5 * LA, 0)) + Vec2(0, depth);
						const EdgeShape    s  = shapeOf({ 1.5, 0.1, 2, M_PI }, 0.02 * std::min(LA, LB), 0.25 * std::min(LA, LB));
						const FourPoints   p { a0, a1, b0, b0 + LB * eB }, f = forces(p, s);
						const EdgeGeometry g = edgeGeometry(p, s);
						for (const Vec2& v : f) {
							ASSERT_TRUE(v.allFinite());
							if (g.active()) {
								ASSERT_LE(v.norm(), 60 * std::min(LA, LB) * std::sqrt(g.sum));
							}
						}
						if (!g.active()) continue;
						for (int k : { 0, 1 })
							for (const Vec2 v : edgeEnd(p, g, k).slipGradient)
								ASSERT_TRUE(v.allFinite());
					}
}
