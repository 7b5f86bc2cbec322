// yade-blocks, GPL-2.0-or-later
#include <Rings.hpp>
#include <Specimens.hpp>
#include <algorithm>
#include <blocks/kernel/geometry/EdgeDivision.hpp>
#include <blocks/kernel/geometry/Zoning.hpp>
#include <gtest/gtest.h>
#include <random>

using namespace specimens;
using rings::rectangle, rings::reversed;

TEST(EdgeDivision, NeighboursGetTheSameBits)
{
	// Two cells on either side of an edge in any direction, their rings started anywhere: the points between are the same ones.
	std::mt19937                         random(3);
	std::uniform_real_distribution<Real> u(-1, 1);
	for (int i = 0; i < 200; ++i) {
		const Real ax = u(random), ay = u(random), bx = i % 3 ? u(random) : ax, by = u(random);
		const Vec2 a(ax, ay), b(bx, by), normal(by - ay, ax - bx);
		const Ring left { a, b, (a + b) / 2 - normal }, right { (a + b) / 2 + normal, b, a };
		for (int parts : { 2, 3, 7 }) {
			const Ring one = withEdgesDivided(left, parts), other = withEdgesDivided(right, parts);
			ASSERT_EQ(int(one.size()), 3 * parts);
			for (int k = 0; k <= parts; ++k) {
				EXPECT_EQ(one[k], other[2 * parts - k]);
				EXPECT_LT((one[k] - (a + (b - a) * k / parts)).norm(), 4 * eps); // coordinates below 1, three roundings
			}
		}
		EXPECT_TRUE(withEdgesDivided(left, 1) == left);
	}
}

TEST(EdgeDivision, TrianglesFillTheirCell)
{
	const Ring cell { { 0, 0 }, { 2, 0.1 }, { 2.3, 1.1 }, { 1, 1.9 }, { -0.2, 1 } };
	const auto triangles = trianglesOf(cell);
	ASSERT_EQ(triangles.size(), cell.size());
	Real area = 0;
	for (const Ring& t : triangles) {
		EXPECT_EQ(t.size(), 3u);
		EXPECT_GT(signedArea(t), 0);
		area += signedArea(t);
	}
	EXPECT_NEAR(area, signedArea(cell), 20 * eps);
}

TEST(EdgeDivision, BendingStiffnessFallsTowardsThatOfTheEdge)
{
	// Two blocks that turn about the middle of their common edge, by a small angle each way: moment / angle = kn T L^3/12 (1 + 2/n^2), with n joints.
	// Angle 1e-6: what is not linear in it is of its square, and openings of 1e-6 round by 1e-10.
	for (int parts : { 1, 2, 4, 8 }) {
		const JointParams joint = elasticJoint(1e9, 4e8);
		BlockAssembly     a;
		a.thickness = 0.7;
		a.addMaterial(stone());
		for (const Ring& ring : { Ring { { 0, 0 }, { 1, 0 }, { 1, 0.8 }, { 0, 0.8 } }, Ring { { 1, 0 }, { 2, 0 }, { 2, 0.8 }, { 1, 0.8 } } })
			addFan(a, withEdgesDivided(ring, parts));
		bondAll(a, joint);
		ASSERT_EQ(a.joints.count(), parts);
		const Real angle = 1e-6;
		rotateAbout(a, { 1, 0.4 }, angle, Vec2::Zero(), a.mesh.firstNode[1]);
		sweepForces(a, Brittle {});
		Real moment = 0;
		for (int i = 0; i < a.joints.count(); ++i)
			for (int p : { 2 * i, 2 * i + 1 })
				moment -= a.joints.segments[i].area * a.state.sigma[p] * (contactPosition(a, p).y() - 0.4);
		const Real edge = 1e9 * 0.7 * std::pow(0.8, 3) / 12;
		EXPECT_NEAR(moment / angle, edge * (1 + 2. / (parts * parts)), 1e-5 * edge) << parts;
	}
}

TEST(EdgeDivision, NoEdgeIsLongerThanWanted)
{
	const Polygon frame { rectangle(0, 0, 3, 2), { reversed(rectangle(1, 0.5, 2, 1.5)) } };
	const Polygon fine = divided(frame, 0.5);
	EXPECT_EQ(fine.outer.size(), 20u);
	EXPECT_EQ(fine.holes[0].size(), 8u);
	EXPECT_EQ(signedArea(fine), 5);
	EXPECT_EQ(divided(frame, 0.49).outer.size(), 7u + 5 + 7 + 5);
	EXPECT_EQ(divided(frame, 10).outer, frame.outer);
	EXPECT_EQ(partsOf(3 * 0.1, 0.1), 3); // 4e-16 more than three times as long
}

TEST(PointsOnEdges, areInsertedInOrder)
{
	const Ring triangle = { { 0, 0 }, { 2, 0 }, { 0, 1 } };
	const Ring out      = withPointsOnEdges(
                triangle, { { 1.5, 0 }, { 0.5, 1e-7 }, { 1, 0.5 }, { 0, 0.25 }, { 0, 0.5 }, { 3, 0 }, { -1, 0 }, { 1, 0.2 }, { 1.5, 0 }, { 2, 1e-7 } }, 1e-6);
	const Ring expected = { { 0, 0 }, { 0.5, 1e-7 }, { 1.5, 0 }, { 2, 0 }, { 1, 0.5 }, { 0, 1 }, { 0, 0.5 }, { 0, 0.25 } };
	EXPECT_EQ(out, expected); // the points' own bits; not those beyond an edge's ends, off it, at a vertex, or twice
	EXPECT_EQ(withPointsOnEdges(triangle, {}, 1e-6), triangle);
	EXPECT_THROW(withPointsOnEdges(triangle, {}, -1), std::invalid_argument);
	EXPECT_THROW(withPointsOnEdges(triangle, {}, std::nan("")), std::invalid_argument);
}

TEST(PointsOnEdges, makeNeighboursConform)
{
	TessellationOptions options;
	options.size       = 0.003;
	const Cells mortar = tessellate({ rectangle(0, 0, 0.2, 0.01), {} }, options);
	const Ring  unit   = rectangle(0, 0.01, 0.2, 0.06);
	const Ring  fitted = withPointsOnEdges(unit, mortar.vertices, 1e-9);
	size_t      shared = 0;
	for (const Vec2& v : mortar.vertices)
		if (v.y() == 0.01) {
			++shared;
			EXPECT_NE(std::find(fitted.begin(), fitted.end(), v), fitted.end());
		}
	EXPECT_EQ(fitted.size(), shared + 2); // its two corners at the top
}
