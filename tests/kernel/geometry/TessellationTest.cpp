// yade-blocks, GPL-2.0-or-later
#include <CellChecks.hpp>
#include <chrono>

using namespace cellchecks;

TEST(Tessellation, tilesRegionsOfAllKinds)
{
	const struct {
		const char* what;
		Polygon     region;
		Real        size;
	} cases[] = {
		{ "brick", solid(brick), 0.006 },
		{ "thin mortar", solid(rectangle(0, 0, 0.285, 0.01)), 0.003 },
		{ "slanted", solid(slanted), 0.1 },
		{ "L", solid(lShape), 0.2 },
		{ "comb", solid(comb), 0.3 },
		{ "comb, coarse", solid(comb), 1.1 },
		{ "hole larger than cells", { slanted, { slantHole } }, 0.08 },
		{ "hole smaller than a cell", { slanted, { slantHole } }, 0.9 },
		{ "one cell", solid(slanted), 1.5 },
		{ "corner of 180 degrees", solid({ { 0, 0 }, { 0.7, 0 }, { 2, 0 }, { 2, 1 }, { 0, 1 } }), 0.2 },
		{ "far from the origin", solid(rectangle(100, 50, 101, 50.7)), 0.05 },
	};
	for (const auto& c : cases)
		for (int lloyd : { 0, 1, 4 })
			for (std::uint64_t seed : { 1, 2, 3 })
				expectTiling(
					c.region,
					tessellate(c.region, sized(c.size, lloyd, seed)),
					c.size,
					std::string(c.what) + ", lloyd " + std::to_string(lloyd) + ", seed " + std::to_string(seed));
}

TEST(Tessellation, gridOfSeedsGivesSquares)
{
	for (Real h : { 1.0, 0.1 }) { // 0.1 is no binary number: seeds are cocircular only up to rounding
		auto o               = sized(h, 0);
		o.seeds              = grid(7, 4, h);
		const Polygon region = solid(rectangle(0, 0, 7 * h, 4 * h));
		const Cells   cells  = tessellate(region, o);
		expectTiling(region, cells, h, "grid");
		ASSERT_EQ(cells.cells.size(), 28u);
		EXPECT_EQ(cells.vertices.size(), 40u);
		for (size_t i = 0; i < cells.cells.size(); ++i) {
			const Ring ring = ringOf(cells, i);
			ASSERT_EQ(ring.size(), 4u);
			for (size_t k = 0; k < 4; ++k) // seeds are rounded to eps 7h; a bisector of points h apart moves by as much, a merge averages
				EXPECT_NEAR((ring[(k + 1) % 4] - ring[k]).norm(), h, 100 * eps * h);
		}
		// 28 squares: 45 interior edges of length h
		EXPECT_NEAR(cells.meanEdge, h, 100 * eps * h);
		EXPECT_NEAR(cells.meanSqrtArea, h, 100 * eps * h);
	}
}

// Voronoi vertices on the region's corners and edges, Voronoi edges along the region's edges: everything coincides.
TEST(Tessellation, gridInDegenerateRegions)
{
	auto       o   = sized(1, 0);
	const auto all = grid(3, 2, 1);
	for (const Vec2& p : all)
		if (p.x() < 1 || p.y() < 1) o.seeds.push_back(p);
	Cells cells = tessellate(solid(lShape), o);
	expectTiling(solid(lShape), cells, 1, "L on grid lines");
	EXPECT_EQ(cells.cells.size(), 4u);
	EXPECT_EQ(cells.vertices.size(), 10u);

	const Polygon frame { rectangle(0, 0, 5, 4), { reversed(rectangle(2, 1, 3, 3)) } };
	o.seeds.clear();
	for (const Vec2& p : grid(5, 4, 1))
		if (!(p.x() > 2 && p.x() < 3 && p.y() > 1 && p.y() < 3)) o.seeds.push_back(p);
	cells = tessellate(frame, o);
	expectTiling(frame, cells, 1, "frame on grid lines");
	EXPECT_EQ(cells.cells.size(), 18u);
	for (size_t i = 0; i < cells.cells.size(); ++i)
		EXPECT_NEAR(signedArea(ringOf(cells, i)), 1, 100 * eps);

	// every reflex corner in the middle of an edge or of a vertex of the grid, four directions
	for (const Vec2& shift : { Vec2(0, 0), Vec2(0.5, 0), Vec2(0, 0.5), Vec2(0.5, 0.5) }) {
		const Vec2 c  = Vec2(2, 2) + shift;
		const Ring up = { { 0, 0 }, { 4, 0 }, { 4, 4 }, c, { 0, 4 } };
		o.seeds.clear();
		for (const Vec2& p : grid(4, 4, 1))
			if (p.y() < c.y() - std::abs(p.x() - c.x()) * 0.1 - 0.01 && std::abs(p.x() - c.x()) < 1.9) o.seeds.push_back(p);
		expectTiling(solid(up), tessellate(solid(up), o), 1, "notch");
	}

	// seeds on one line; a single seed; seeds on a circle with the region's corner in its centre
	o.seeds = { { 0.3, 0.5 }, { 1.1, 0.5 }, { 1.7, 0.5 }, { 2.8, 0.5 } };
	cells   = tessellate(solid(rectangle(0, 0, 3, 1)), o);
	expectTiling(solid(rectangle(0, 0, 3, 1)), cells, 1, "collinear seeds");
	EXPECT_EQ(cells.cells.size(), 4u);
	o.seeds = { { 0.3, 0.5 } };
	EXPECT_EQ(tessellate(solid(rectangle(0, 0, 3, 1)), o).cells.size(), 1u);
	o.seeds = { { 2, 0.5 }, { 0.5, 0.5 }, { 0.5, 1.5 }, { 1.5, 0.5 }, { 1, 0.25 } };
	expectTiling(solid(lShape), tessellate(solid(lShape), o), 1, "seeds around the reflex corner");
}

// Walls along the bisector of two seeds, on both sides of the neck between their cells.
TEST(Tessellation, wallsAlongBisectors)
{
	const Ring tee = { { 0, 0 }, { 3, 0 }, { 3, 1 }, { 2, 1 }, { 2, 2 }, { 1, 2 }, { 1, 1 }, { 0, 1 } };
	auto       o   = sized(1, 0);
	o.seeds        = { { 1.5, 0.5 }, { 1.5, 1.5 } };
	for (int turn = 0; turn < 4; ++turn) { // each way: ties are decided by a shift to the upper right
		const auto turned = [&](const Vec2& p) { return turn == 0 ? p : turn == 1 ? Vec2(-p.y(), p.x()) : turn == 2 ? Vec2(-p) : Vec2(p.y(), -p.x()); };
		Ring       region;
		auto       seeds = o;
		for (const Vec2& p : tee)
			region.push_back(turned(p));
		for (Vec2& p : seeds.seeds)
			p = turned(p);
		const Cells cells = tessellate(solid(region), seeds);
		expectTiling(solid(region), cells, 1, "T, turn " + std::to_string(turn));
		ASSERT_EQ(cells.cells.size(), 2u);
		Real areas[] = { signedArea(ringOf(cells, 0)), signedArea(ringOf(cells, 1)) };
		std::sort(areas, areas + 2);
		EXPECT_EQ(areas[0], 1);
		EXPECT_EQ(areas[1], 3);
	}
}

TEST(Tessellation, knownDiagramOfTwoSeeds)
{
	auto o            = sized(1, 0);
	o.seeds           = { { 0.5, 0.5 }, { 1.5, 0.9 } }; // bisector: x + 0.4 y = 1.28, through (1.28, 0) and (0.88, 1)
	const Cells cells = tessellate(solid(rectangle(0, 0, 2, 1)), o);
	ASSERT_EQ(cells.cells.size(), 2u);
	EXPECT_NEAR(signedArea(ringOf(cells, 0)), 1.08, 10 * eps);
	EXPECT_NEAR(signedArea(ringOf(cells, 1)), 0.92, 10 * eps);
	EXPECT_NEAR(cells.meanEdge, std::hypot(0.4, 1), 10 * eps);
	EXPECT_NEAR(cells.meanSqrtArea, (std::sqrt(1.08) + std::sqrt(0.92)) / 2, 10 * eps);
}

// Every point belongs to the cell of its nearest seed: the definition, without merging, in a non-convex region with a hole.
TEST(Tessellation, cellsAreVoronoi)
{
	const Polygon region { slanted, { slantHole } };
	Dice          dice { std::mt19937_64(5) };
	auto          o = sized(0.2, 0);
	o.mergeFraction = 0;
	while (o.seeds.size() < 60) {
		const Vec2 p(dice(-0.3, 2.1), dice(0.2, 2.3));
		if (strictlyInside(slanted, p) && !strictlyInside(slantHole, p)) o.seeds.push_back(p);
	}
	const Cells cells = tessellate(region, o);
	expectTiling(region, cells, 0.2, "voronoi");
	for (size_t i = 0; i < cells.cells.size(); ++i) {
		const Ring ring   = ringOf(cells, i);
		Vec2       middle = Vec2::Zero(); // not of a non-convex cell; edge midpoints moved inward would do, but few cells are
		for (const Vec2& p : ring)
			middle += p / Real(ring.size());
		const auto nearest = [&](const Vec2& p) {
			return std::min_element(o.seeds.begin(), o.seeds.end(), [&](const Vec2& a, const Vec2& b) { return (a - p).norm() < (b - p).norm(); })
				- o.seeds.begin();
		};
		const auto owner = nearest(middle);
		for (const Vec2& corner : ring) { // all corners of the cell are nearest to the same seed, up to rounding
			const Real own = (corner - o.seeds[owner]).norm();
			EXPECT_LE(own, (corner - o.seeds[nearest(corner)]).norm() + 1e-12);
		}
	}
}

TEST(Tessellation, countFollowsFromSizeInBothMeanings)
{
	const Polygon region = solid(rectangle(0, 0, 2, 1));
	auto          o      = sized(0.05, 3);
	EXPECT_EQ(tessellate(region, o).cells.size(), 800u); // 2 / 0.05^2
	const Cells bySqrtArea = tessellate(region, o);
	// mean of sqrt <= sqrt of mean (Jensen); after Lloyd the spread of areas is below 25 %, so they differ by less than 0.25^2/8 + ... < 2 %
	EXPECT_LT(bySqrtArea.meanSqrtArea, 0.05);
	EXPECT_GT(bySqrtArea.meanSqrtArea, 0.98 * 0.05);

	o.meaning          = SizeMeaning::edge;
	const Cells byEdge = tessellate(region, o); // 2 / (1.61 x 0.05)^2 = 308.6
	EXPECT_EQ(byEdge.cells.size(), 309u);
	// 1.61 holds for hexagons. Random cells have longer edges (Poisson-Voronoi: 0.667 s against 0.620 s, +7 %), and merging
	// removes the shortest; so the mean edge is the size, or up to a tenth more.
	EXPECT_GT(byEdge.meanEdge, 1.00 * 0.05);
	EXPECT_LT(byEdge.meanEdge, 1.12 * 0.05);

	// the same cells, whichever way the size is said
	o.size          = 0.08;
	const Cells one = tessellate(region, o);
	o.size          = 0.08 * sqrtAreaOfUnitEdge;
	o.meaning       = SizeMeaning::sqrtArea;
	const Cells two = tessellate(region, o);
	EXPECT_EQ(one.cells, two.cells);
}

TEST(Tessellation, sameSeedSameBits)
{
	const Polygon region { slanted, { slantHole } };
	const Cells   a = tessellate(region, sized(0.1, 2, 7)), b = tessellate(region, sized(0.1, 2, 7)), c = tessellate(region, sized(0.1, 2, 8));
	EXPECT_EQ(a.cells, b.cells);
	EXPECT_EQ(a.vertices, b.vertices);
	EXPECT_NE(a.vertices, c.vertices);
}

// The random numbers are ours: mt19937_64 is fixed by the standard (its 10000th output from the default seed is known),
// and so is the mapping to [0, 1).
TEST(Tessellation, seedsArePlainUniform)
{
	std::mt19937_64 random(42);
	auto            o      = sized(0.5, 0, 42);
	const Polygon   region = solid(rectangle(0, 0, 3, 1)); // 12 cells
	const Cells     cells  = tessellate(region, o);
	o.seeds.clear();
	for (int i = 0; i < 12; ++i) {
		const Real x = Real(random() >> 11) * 0x1p-53, y = Real(random() >> 11) * 0x1p-53;
		o.seeds.push_back({ 3 * x, y });
	}
	// the cells are numbered along a curve, given seeds as they come
	auto corners = [](const Cells& c) {
		std::vector<std::vector<std::array<Real, 2>>> all;
		for (size_t i = 0; i < c.cells.size(); ++i) {
			std::vector<std::array<Real, 2>> one;
			for (const Vec2& p : ringOf(c, i))
				one.push_back({ std::round(p.x() * 1e12), std::round(p.y() * 1e12) });
			std::sort(one.begin(), one.end());
			all.push_back(one);
		}
		std::sort(all.begin(), all.end());
		return all;
	};
	EXPECT_EQ(corners(cells), corners(tessellate(region, o)));
}

TEST(Tessellation, lloydEvensAreas)
{
	// Poisson-Voronoi cells have a spread of areas of 0.53; the iteration must bring it down each time.
	Real before = spreadOfAreas(tessellate(solid(brick), sized(0.002, 0)));
	EXPECT_NEAR(before, 0.53, 0.03); // 3461 cells: 0.53/sqrt(2 x 3461) = 0.007 x 4
	for (int lloyd : { 1, 2, 4, 8 }) {
		const Real now = spreadOfAreas(tessellate(solid(brick), sized(0.002, lloyd)));
		EXPECT_LT(now, 0.9 * before) << "lloyd " << lloyd;
		before = now;
	}
	EXPECT_LT(before, 0.2);
}

TEST(Tessellation, lloydStandsStillOnAGrid)
{
	auto o            = sized(1, 5); // the grid is centroidal, so iterations change nothing but by rounding
	o.seeds           = grid(4, 3, 1);
	const Cells cells = tessellate(solid(rectangle(0, 0, 4, 3)), o);
	ASSERT_EQ(cells.cells.size(), 12u);
	for (size_t i = 0; i < 12; ++i)
		EXPECT_NEAR(signedArea(ringOf(cells, i)), 1, 1e-13);
	o.seeds[5] += Vec2(0.2, -0.1); // and it leads back there
	o.lloyd = 60;
	EXPECT_LT(spreadOfAreas(tessellate(solid(rectangle(0, 0, 4, 3)), o)), 0.06);
}

// A few hundred random regions, half of them with a hole: whatever the shape, a tiling.
TEST(Tessellation, tilesRandomRegions)
{
	Dice dice { std::mt19937_64(2024) };
	for (int trial = 0; trial < 400; ++trial) {
		const Vec2 centre(dice(-3, 3), dice(-3, 3));
		Polygon    region = solid(randomStar(dice, centre, trial % 3 ? 0.5 : 0.15, 1, 4 + trial % 14));
		// A star's ring of n corners at angles <= 2 pi 1.8/n apart stays outside of a circle of its least radius times cos(half the
		// largest angle); 6 corners or more keep 0.5 cos(0.3 pi) = 0.29 free.
		if (trial % 2 && trial % 3 && region.outer.size() >= 6) region.holes.push_back(reversed(randomStar(dice, centre, 0.05, 0.25, 4 + trial % 5)));
		const Real size = std::sqrt(areaOf(region) / dice(1, 120));
		expectTiling(region, tessellate(region, sized(size, trial % 3, trial)), size, "trial " + std::to_string(trial));
		if (HasFatalFailure() || HasNonfatalFailure()) break;
	}
}

// Corners rounded to a coarse lattice, seeds on the same lattice: coincidences of every kind.
TEST(Tessellation, tilesRandomDegenerateRegions)
{
	Dice dice { std::mt19937_64(77) };
	int  tried = 0;
	for (int trial = 0; trial < 3000; ++trial) {
		Polygon region = solid(randomStar(dice, { 0, 0 }, 2, 8, 3 + trial % 9));
		for (Vec2& p : region.outer)
			p = Vec2(std::round(p.x()), std::round(p.y()));
		auto o = sized(1, 0);
		o.seeds.clear();
		const Real phase = trial % 2 ? 0.5 : 0;
		for (int i = -9; i < 9; ++i)
			for (int j = -9; j < 9; ++j)
				if (dice(0, 1) < 0.4 && strictlyInside(region.outer, Vec2(i + phase, j + phase))) o.seeds.push_back({ i + phase, j + phase });
		try { // rounding may have made corners coincide or edges touch
			requireSimple(region, "region");
		} catch (const std::invalid_argument&) {
			continue;
		}
		if (o.seeds.empty()) continue;
		++tried;
		expectTiling(region, tessellate(region, o), 1, "trial " + std::to_string(trial));
		if (HasFatalFailure() || HasNonfatalFailure()) break;
	}
	EXPECT_GT(tried, 400);
}

TEST(Tessellation, refusesBadRegions)
{
	const Real nan = std::numeric_limits<Real>::quiet_NaN(), inf = std::numeric_limits<Real>::infinity();
	const auto o = sized(0.1);
	expectRefused({}, o, { "Tessellation.region.outer", "at least 3 vertices", "got 0" });
	expectRefused(solid({ { 0, 0 }, { 1, 0 } }), o, { "at least 3 vertices", "got 2" });
	expectRefused(solid({ { 0, 0 }, { 1, 1 }, { 1, 0 }, { 0, 1 } }), o, { "area" }); // a symmetric bow tie
	expectRefused(solid({ { 0, 0 }, { 3, 2 }, { 3, 0 }, { 0, 1 } }), o, { "cross", "outer edge 0", "outer edge 2" });
	expectRefused(solid({ { 0, 0 }, { 2, 0 }, { 2, 1 }, { 1, 0 }, { 0, 1 } }), o, { "touch", "outer edge 0 from (0, 0) to (2, 0)" });
	expectRefused(solid({ { 0, 0 }, { 2, 0 }, { 1, 0 }, { 1, 1 } }), o, { "outer edge 0", "outer edge 1" }); // folds back
	expectRefused(solid({ { 0, 0 }, { 1, 0 }, { 2, 0 } }), o, { "must have an area" });
	expectRefused(solid({ { 0, 0 }, { 1, 0 }, { 1, 0 }, { 0, 1 } }), o, { "distinct vertices", "vertex 1" });
	expectRefused(solid(reversed(brick)), o, { "outer must be counter-clockwise" });
	expectRefused(solid({ { 0, 0 }, { nan, 0 }, { 0, 1 } }), o, { "finite coordinates", "vertex 1" });
	expectRefused(solid({ { 0, 0 }, { 1, 0 }, { 0, inf } }), o, { "finite coordinates", "vertex 2" });
	const Ring box = rectangle(0, 0, 2, 2), in = reversed(rectangle(0.5, 0.5, 1, 1));
	expectRefused({ box, { rectangle(0.5, 0.5, 1, 1) } }, o, { "holes[0] must be clockwise" });
	expectRefused({ box, { reversed(rectangle(3, 3, 4, 4)) } }, o, { "holes[0] must lie inside outer" });
	expectRefused({ box, { reversed(rectangle(-1, -1, 3, 3)) } }, o, { "holes[0] must lie inside outer" });
	expectRefused({ box, { reversed(rectangle(1, 1, 3, 1.5)) } }, o, { "cross", "outer edge 1", "holes[0] edge" });
	expectRefused({ box, { in, reversed(rectangle(0.7, 0.7, 1.5, 1.5)) } }, o, { "cross", "holes[0] edge", "holes[1] edge" });
	expectRefused({ box, { in, reversed(rectangle(0.6, 0.6, 0.9, 0.9)) } }, o, { "holes[1] must lie outside holes[0]" });
	expectRefused({ box, { Ring { { 0.5, 0.5 }, { 0.6, 0.6 } } } }, o, { "holes[0] must have at least 3 vertices" });
}

TEST(Tessellation, refusesBadOptions)
{
	const Real    nan    = std::numeric_limits<Real>::quiet_NaN();
	const Polygon region = solid(rectangle(0, 0, 2, 2));
	expectRefused(region, sized(0), { "Tessellation.size must be positive", "got 0" });
	expectRefused(region, sized(-1), { "Tessellation.size must be positive", "got -1" });
	expectRefused(region, sized(nan), { "Tessellation.size must be positive", "nan" });
	expectRefused(region, sized(2.5), { "Tessellation.size must not exceed 2", "got 2.5" });
	expectRefused(region, sized(1e-9), { "Tessellation.size", "too many" });
	expectRefused(region, sized(0.1, -1), { "Tessellation.lloyd", "got -1" });
	auto o    = sized(1.5);
	o.meaning = SizeMeaning::edge;
	expectRefused(region, o, { "Tessellation.size must not exceed 1.24", "got 1.5" }); // 2/1.61
	for (Real bad : { -0.1, 0.5, nan }) {
		o               = sized(0.5);
		o.mergeFraction = bad;
		expectRefused(region, o, { "Tessellation.mergeFraction" });
	}
	o       = sized(0.5);
	o.seeds = { { 1, 1 }, { 2.5, 1 } };
	expectRefused(region, o, { "Tessellation.seeds must lie inside", "index 1" });
	o.seeds = { { 1, 1 }, { 2, 1 } };
	expectRefused(region, o, { "Tessellation.seeds must lie inside", "index 1" });
	o.seeds = { { nan, 1 } };
	expectRefused(region, o, { "Tessellation.seeds must lie inside", "index 0" });
	o.seeds = { { 1, 1 }, { 0.5, 1 }, { 1, 1 } };
	expectRefused(region, o, { "Tessellation.seeds must be distinct" });
	o.seeds = { { 1, 1 }, { 0.5, 1 }, { 1, 1 + 1e-8 } };
	expectRefused(region, o, { "Tessellation.seeds must be farther apart" });
	o.seeds = { { 1, 1 } };
	expectRefused({ rectangle(0, 0, 2, 2), { reversed(rectangle(0.5, 0.5, 1.5, 1.5)) } }, o, { "Tessellation.seeds must lie inside" });
}

TEST(Tessellation, reportsItsCost)
{
	Real last = 0;
	for (int n : { 1000, 4000, 16000 }) {
		const auto start = std::chrono::steady_clock::now();
		EXPECT_EQ(tessellate(solid(rectangle(0, 0, 1, 1)), sized(1 / std::sqrt(n))).cells.size(), size_t(n));
		last = std::chrono::duration<Real>(std::chrono::steady_clock::now() - start).count();
		std::printf("%6d cells, lloyd 2: %.3f s\n", n, last);
	}
	EXPECT_LT(last, 15); // 0.2 s in an optimised build; a quadratic one would need minutes
}
