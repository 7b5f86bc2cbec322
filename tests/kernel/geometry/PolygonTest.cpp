// yade-blocks, GPL-2.0-or-later
#include <Rings.hpp>
#include <blocks/kernel/geometry/Polygon.hpp>
#include <blocks/kernel/geometry/PolygonRules.hpp>

#include <gtest/gtest.h>

#include <limits>

using namespace rings;

namespace {

} // namespace

TEST(Polygon, MomentsOfARectangleWithAHole)
{
	// 3 x 2 less 1 x 1 about (0.5 + 0.5, 0.25 + 0.5): areas and first moments by hand, second moments b h (b^2 + h^2) / 12 + A d^2.
	const Vec2 shift(1e3, -2e3);
	Polygon    p { rectangle(0, 0, 3, 2), { reversed(rectangle(0.5, 0.25, 1.5, 1.25)) } };
	for (Vec2& v : p.outer)
		v += shift;
	for (Vec2& v : p.holes[0])
		v += shift;
	const AreaSum sum = moments(p);
	const Vec2    centroid((6 * 1.5 - 1 * 1) / 5, (6 * 1 - 1 * 0.75) / 5);
	EXPECT_NEAR(sum.area(), 5, 20 * eps);
	EXPECT_EQ(signedArea(p), 5);
	EXPECT_NEAR((sum.centroid() - shift - centroid).norm(), 0, 4e3 * eps);
	const Real polar = 6 * (9 + 4) / 12. + 6 * (centroid - Vec2(1.5, 1)).squaredNorm() - (1 * 2 / 12. + (centroid - Vec2(1, 0.75)).squaredNorm());
	EXPECT_NEAR(sum.secondMoment(), polar, 200 * eps);
	EXPECT_EQ(perimeter(p), 14);
	EXPECT_EQ(meanWidth(p), 2 * 5 / 14.);
	EXPECT_EQ(largestCoordinate(p), 2000);
}

TEST(Polygon, InsideAndDistance)
{
	const Polygon frame { rectangle(0, 0, 3, 2), { reversed(rectangle(1, 0.5, 2, 1.5)) } };
	EXPECT_TRUE(strictlyInside({ 0.5, 1 }, frame));
	EXPECT_FALSE(strictlyInside({ 1.5, 1 }, frame)); // in the hole
	EXPECT_FALSE(strictlyInside({ 1, 1 }, frame));   // on its edge
	EXPECT_FALSE(strictlyInside({ 0, 1 }, frame));
	EXPECT_FALSE(strictlyInside({ 3.5, 1 }, frame));
	EXPECT_EQ(distanceFromOutline({ 0.25, 1 }, frame), 0.25);
	EXPECT_EQ(distanceFromOutline({ 0.75, 1 }, frame), 0.25);
	EXPECT_EQ(distanceFromOutline({ -3, -4 }, frame), 5);
}

TEST(Polygon, InnerPoints)
{
	const Ring hook = { { 0, 0 }, { 3, 0 }, { 3, 3 }, { 2.5, 3 }, { 2.5, 0.5 }, { 0.5, 0.5 }, { 0.5, 3 }, { 0, 3 } }; // its centroid is outside
	EXPECT_FALSE(strictlyInside(moments(hook).centroid(), { hook, {} }));
	for (const Polygon& p : { Polygon { hook, {} },
	                          Polygon { rectangle(0, 0, 3, 2), { reversed(rectangle(1, 0.5, 2, 1.5)) } },
	                          Polygon { { { 0, 0 }, { 1, 1e-9 }, { 0.5, 2e-9 } }, {} } }) {
		EXPECT_TRUE(strictlyInside(innerPoint(p), p));
		EXPECT_GT(distanceFromOutline(innerPoint(p), p), 0.1 * meanWidth(p));
	}
}

TEST(Polygon, OverlapDepth)
{
	const Polygon square { rectangle(0, 0, 2, 2), {} };
	const auto    depth = [&](const Polygon& other) {
                EXPECT_EQ(overlapDepth(square, other), overlapDepth(other, square));
                return overlapDepth(square, other);
	};
	const auto expectDepth = [&](const Polygon& other, Real deepest) { // a third of it at least, where it is a triangle's height
		EXPECT_LE(depth(other), deepest * (1 + 4 * eps));
		EXPECT_GE(depth(other), deepest / 3);
	};
	EXPECT_EQ(depth({ rectangle(2, 0, 3, 2), {} }), 0);                                              // beside it
	EXPECT_EQ(depth({ rectangle(2, 2, 3, 3), {} }), 0);                                              // at its corner
	EXPECT_EQ(depth({ rectangle(5, 5, 6, 6), {} }), 0);                                              // far from it
	EXPECT_EQ(depth({ { { 2, 1 }, { 3, 0 }, { 3, 2 } }, {} }), 0);                                   // a tip on its side
	EXPECT_EQ(depth({ rectangle(-1, -1, 3, 3), { reversed(rectangle(0, 0, 2, 2)) } }), 0);           // in its hole
	expectDepth(square, 1);                                                                          // the same twice
	expectDepth({ rectangle(0, 0, 2, 2), { reversed(rectangle(0.5, 0.5, 1.5, 1.5)) } }, 0.25 * 1.2); // a frame and the full square; corners are deeper
	expectDepth({ rectangle(-1, -1, 3, 3), {} }, 1);                                                 // within another
	expectDepth({ rectangle(0.75, 0.75, 1.25, 1.25), {} }, 0.25);                                    // another within it
	expectDepth({ rectangle(1.999, 0, 3, 2), {} }, 0.0005);                                          // beyond its side by a thousandth
	expectDepth({ rectangle(0.5, -1, 1.5, 3), {} }, 0.5);                                            // a cross
	expectDepth({ { { 1, 0 }, { 2, 1 }, { 1, 2 }, { 0, 1 } }, {} }, std::sqrt(0.5));                 // touching all sides from within
}

TEST(Polygon, HolesMayRunEitherWay)
{
	const Polygon frame { rectangle(0, 0, 3, 2), { reversed(rectangle(1, 0.5, 2, 1.5)) } }, other { frame.outer, { rectangle(1, 0.5, 2, 1.5) } };
	EXPECT_EQ(signedArea(holesClockwise(frame)), 5);
	EXPECT_EQ(signedArea(holesClockwise(other)), 5);
	EXPECT_EQ(holesClockwise(frame).holes[0], frame.holes[0]);
}

TEST(LongEdges, AVertexThatRoundingPartedIsRefused)
{
	// Of the outline, 12 m long, 1e-9: just longer ones stay. In a hole as well.
	const auto corner = [](Real gap) { return Ring { { 0, 0 }, { 3, 0 }, { 3, 3 }, { 0, 3 }, { 0, gap } }; };
	const auto hole   = [](Real gap) { return Ring { { 1, 1 + gap }, { 1, 2 }, { 2, 2 }, { 2, 1 }, { 1, 1 } }; };
	const Ring square { { 0, 0 }, { 3, 0 }, { 3, 3 }, { 0, 3 } };
	for (const Polygon& region : { Polygon { corner(1.8e-15), {} }, Polygon { corner(1.1e-8), {} }, Polygon { square, { hole(1.3e-8) } } })
		EXPECT_THROW(requireLongEdges(region, 1e-9, "region"), std::invalid_argument);
	for (const Polygon& region : { Polygon { square, {} }, Polygon { corner(1.3e-8), {} }, Polygon { square, { hole(1.7e-8) } } })
		EXPECT_NO_THROW(requireLongEdges(region, 1e-9, "region"));
}

TEST(Polygon, AwayFromALine)
{
	// Beside it, beyond either end, and on it.
	const Vec2 a(1, 1), b(4, 5); // 5 m long
	EXPECT_LT((awayFrom(a, b, a + 0.3 * (b - a) + Vec2(-4, 3)) - Vec2(-4, 3)).norm(), 8 * eps);
	EXPECT_LT((awayFrom(a, b, a - (b - a)) - (a - b)).norm(), 8 * eps);
	EXPECT_LT((awayFrom(a, b, b + Vec2(3, 1)) - Vec2(3, 1)).norm(), 8 * eps);
	EXPECT_LT(awayFrom(a, b, a + 0.7 * (b - a)).norm(), 8 * eps);
}

TEST(Polygon, PerimeterOfASumIsThatOfThePolygon)
{
	// Far from (0, 0) as near to it, with a hole: 10 and 4 m around, 5 m2.
	for (const Real far : { 0.0, 1e6 }) {
		const Polygon frame { rectangle(far, far, far + 3, far + 2), { reversed(rectangle(far + 1, far + 0.5, far + 2, far + 1.5)) } };
		EXPECT_EQ(moments(frame).perimeter(), 14);
		EXPECT_EQ(moments(frame).perimeter(), perimeter(frame));
		EXPECT_EQ(moments(frame).area(), 5);
		EXPECT_EQ(signedArea(frame), 5);
	}
}
