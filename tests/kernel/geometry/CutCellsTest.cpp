// yade-blocks, GPL-2.0-or-later
#include <CellChecks.hpp>

using namespace cellchecks;

// The hole's lowest side is the base of a thin cell; the cell round the hole's other side meets both of its ends, and is not beyond it.
TEST(Tessellation, holesStayEmpty)
{
	const Polygon region { rectangle(0, 0, 1, 1), { reversed({ { 0.4, 0.412 }, { 0.516, 0.412 }, { 0.516, 0.66 } }) } };
	auto          o = sized(0.541, 0);
	o.seeds         = { { 0.165, 0.12 }, { 0.432, 0.801 }, { 0.903, 0.328 } };
	expectTiling(region, tessellate(region, o), 0.541, "a hole");
}

// A seed below the two arms of a U owns parts of both: three seeds, but the part cut off is a cell of its own.
TEST(Tessellation, cutCellsBecomeSeveral)
{
	const Ring u      = { { 0, 0 }, { 3, 0 }, { 3, 3 }, { 2, 3 }, { 2, 1 }, { 1, 1 }, { 1, 3 }, { 0, 3 } };
	auto       o      = sized(1, 0);
	o.seeds           = { { 0.5, 2.5 }, { 0.5, 0.5 } };
	const Cells cells = tessellate(solid(u), o); // bisector y = 1.5 cuts both arms: the upper seed owns both tops
	expectTiling(solid(u), cells, 1, "U");
	ASSERT_EQ(cells.cells.size(), 3u);
	std::vector<Real> areas;
	for (size_t i = 0; i < 3; ++i)
		areas.push_back(signedArea(ringOf(cells, i)));
	std::sort(areas.begin(), areas.end());
	EXPECT_NEAR(areas[0], 1.5, 10 * eps);
	EXPECT_NEAR(areas[1], 1.5, 10 * eps);
	EXPECT_NEAR(areas[2], 4.0, 10 * eps);
}

// Of a cell in pieces the largest counts for Lloyd's iteration. Pieces and centroids by hand, the arms of a lopsided U.
TEST(Tessellation, lloydTakesTheLargestPiece)
{
	for (bool mirrored : { false, true }) {
		const auto flip = [&](Ring ring) {
			if (!mirrored) return ring;
			for (Vec2& p : ring)
				p.x() = 4 - p.x();
			return reversed(ring);
		};
		const Polygon u = solid(flip({ { 0, 0 }, { 4, 0 }, { 4, 3 }, { 2, 3 }, { 2, 1 }, { 1, 1 }, { 1, 3 }, { 0, 3 } }));
		auto          o = sized(1, 1);
		o.seeds         = flip({ { 0.5, 2.5 }, { 0.5, 0.5 } }); // the first owns both arms above y = 1.5
		const Cells one = tessellate(u, o);
		// [2,4] x [1.5,3], and below [0,4] x [0,1] with [0,1] x [1,1.5] and [2,4] x [1,1.5]: (8 + 0.25 + 3)/5.5, (2 + 0.625 + 1.25)/5.5
		o.lloyd         = 0;
		o.seeds         = flip({ { 3, 2.25 }, { 11.25 / 5.5, 3.875 / 5.5 } });
		const Cells two = tessellate(u, o);
		ASSERT_EQ(one.cells.size(), two.cells.size());
		for (size_t i = 0; i < one.cells.size(); ++i) // seeds differ by rounding, ~10 eps; areas react with factors of order 1
			EXPECT_NEAR(signedArea(ringOf(one, i)), signedArea(ringOf(two, i)), 1e-12);
	}
}

TEST(Tessellation, lloydKeepsASeedWhoseCentroidLiesOutside)
{
	// The second seed owns a U: the base and both arms up to y = 1.5. Its centroid, (1.91, 0.61), lies between the arms, so it stays. The first goes to
	// the centroid of [0,1] x [1.5,3], and the bisector of the two to y = (2.25 + 0.5) / 2.
	const Polygon u   = solid({ { 0, 0 }, { 4, 0 }, { 4, 1.3 }, { 3, 1.3 }, { 3, 0.3 }, { 1, 0.3 }, { 1, 3 }, { 0, 3 } });
	auto          o   = sized(1, 1);
	o.seeds           = { { 0.5, 2.5 }, { 0.5, 0.5 } };
	const Cells cells = tessellate(u, o);
	ASSERT_EQ(cells.cells.size(), 2u);
	std::vector<Real> areas { signedArea(ringOf(cells, 0)), signedArea(ringOf(cells, 1)) };
	std::sort(areas.begin(), areas.end());
	EXPECT_NEAR(areas[0], 3 - 1.375, 1e-13); // coordinates of order 1, ~100 roundings
	EXPECT_NEAR(areas[1], 4.9 - 1.625, 1e-13);
}

TEST(Tessellation, holesBelongToTheirPiece)
{
	// The first seed owns both arms above y = 1.5, two pieces, of which one has a hole.
	const Ring u { { 0, 0 }, { 4, 0 }, { 4, 3 }, { 2, 3 }, { 2, 1 }, { 1, 1 }, { 1, 3 }, { 0, 3 } };
	for (const Ring& hole : { rectangle(0.3, 2, 0.6, 2.4), rectangle(2.8, 2, 3.3, 2.4) }) {
		auto o  = sized(1, 0);
		o.seeds = { { 0.5, 2.5 }, { 0.5, 0.5 } };
		const Polygon region { u, { reversed(hole) } };
		expectTiling(region, tessellate(region, o), 1, hole[0].x() < 1 ? "left" : "right");
	}
}

// Found by the random test below: a Voronoi vertex on the reflex corner (1, 2), so that a cell passes it by a neck of width zero.
TEST(Tessellation, necksOfNoWidthAreDivided)
{
	const Polygon region = solid({ { 6, 1 }, { 1, 2 }, { 0, 6 }, { -4, 4 }, { -3, 0 }, { -2, -2 }, { -2, -5 }, { 1, -2 }, { 7, -2 } });
	auto          o      = sized(1, 0);
	o.seeds              = { { -2.5, -0.5 }, { -1.5, 2.5 }, { -0.5, -2.5 }, { -0.5, -1.5 }, { -0.5, 1.5 }, { -0.5, 2.5 },
		                 { 0.5, 3.5 },   { 1.5, -0.5 }, { 2.5, -1.5 },  { 3.5, 0.5 },   { 4.5, -0.5 }, { 4.5, 0.5 } };
	expectTiling(region, tessellate(region, o), 1, "neck");
}

TEST(Tessellation, cellsAroundHolesAreCut)
{
	const Ring small = reversed(rectangle(0.4, 0.3, 0.5, 0.45)), other = reversed(rectangle(0.6, 0.35, 0.7, 0.4)),
		   third = reversed(rectangle(0.42, 0.6, 0.55, 0.7));
	for (const auto& holes : { std::vector<Ring> { small }, std::vector<Ring> { small, other }, std::vector<Ring> { small, other, third } }) {
		const Polygon region { rectangle(0, 0, 1, 0.9), holes };
		auto          o   = sized(0.5, 0);
		o.seeds           = { { 0.2, 0.5 } };
		o.mergeFraction   = 0;
		const Cells cells = tessellate(region, o);
		expectTiling(region, cells, 0.5, std::to_string(holes.size()) + " holes in one cell");
		EXPECT_EQ(cells.cells.size(), holes.size() + 1); // each hole adds two cuts and so, by Euler, one cell
		o.mergeFraction = 0.05;
		expectTiling(region, tessellate(region, o), 0.5, std::to_string(holes.size()) + " holes in one cell, necks divided");
		o.seeds.push_back({ 0.9, 0.2 });
		o.seeds.push_back({ 0.8, 0.85 });
		expectTiling(region, tessellate(region, o), 0.5, "holes, with neighbours");
	}
}

// A hole with a notch, smaller than a short edge (as in case 58193 of seed 2026 of the fuzz). A wall cuts off a triangle of material in the notch, which
// reaches along the hole without surrounding it.
TEST(Tessellation, whatLiesInAHolesNotchIsNotRoundIt)
{
	const Polygon region { rectangle(0, 0, 1, 1), { reversed({ { 0.49, 0.49 }, { 0.51, 0.49 }, { 0.51, 0.51 }, { 0.5, 0.5 }, { 0.49, 0.51 } }) } };
	for (Real mergeFraction : { 0.0, 0.1, 0.3 }) { // short edges: none; as long as the hole's shorter sides and more
		auto o          = sized(0.4, 0);
		o.seeds         = { { 0.5, 0.255 }, { 0.5, 0.755 } };
		o.mergeFraction = mergeFraction;
		expectTiling(region, tessellate(region, o), 0.4, "notch, " + std::to_string(mergeFraction));
	}
}
