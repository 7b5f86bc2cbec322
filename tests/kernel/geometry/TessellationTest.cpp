// yade-blocks, GPL-2.0-or-later
#include <Rings.hpp>
#include <blocks/kernel/geometry/EdgeDivision.hpp>
#include <blocks/kernel/geometry/PolygonRules.hpp>
#include <blocks/kernel/geometry/Tessellation.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <map>
#include <random>
#include <set>

using namespace rings;

namespace {

Polygon solid(const Ring& outer) { return { outer, {} }; }

// Lopsided on purpose: nothing here is symmetric.
const Ring brick   = rectangle(0.013, -0.02, 0.226, 0.045);
const Ring lShape  = { { 0, 0 }, { 3, 0 }, { 3, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } };
const Ring comb    = { { 0, 0 }, { 7, 0 }, { 7, 3 }, { 6.5, 3 }, { 6, 0.6 }, { 5, 3 }, { 4, 3 }, { 3.2, 0.4 }, { 3, 3 }, { 1.5, 3 }, { 1, 0.5 }, { 0.3, 2.8 } };
const Ring slanted = { { 0.1, 0.2 }, { 1.7, 0.5 }, { 2.1, 1.9 }, { 1.0, 2.3 }, { -0.3, 1.1 } };
const Ring slantHole = reversed({ { 0.8, 0.9 }, { 1.2, 1.0 }, { 1.1, 1.5 } });

Real areaOf(const Polygon& region)
{
	Real area = signedArea(region.outer);
	for (const Ring& hole : region.holes)
		area += signedArea(hole); // clockwise: negative
	return area;
}

TessellationOptions sized(Real size, int lloyd = 2, std::uint64_t seed = 1)
{
	TessellationOptions o;
	o.size  = size;
	o.lloyd = lloyd;
	o.seed  = seed;
	return o;
}

std::vector<Ring> ringsOf(const Polygon& region)
{
	std::vector<Ring> rings { region.outer };
	rings.insert(rings.end(), region.holes.begin(), region.holes.end());
	return rings;
}

Real perimeterOf(const Polygon& region)
{
	Real length = 0;
	for (const Ring& ring : ringsOf(region))
		for (size_t k = 0; k < ring.size(); ++k)
			length += (ring[(k + 1) % ring.size()] - ring[k]).norm();
	return length;
}

/// How deep vertex b lies inside the chord a-c of its neighbours [m]; positive at a dent.
Real dent(const Vec2& a, const Vec2& b, const Vec2& c) { return -cross(b - a, c - b) / (c - a).norm(); }

bool isCornerOf(const Polygon& region, const Vec2& p)
{
	for (const Ring& ring : ringsOf(region))
		if (std::find(ring.begin(), ring.end(), p) != ring.end()) return true;
	return false;
}

/// Everything that makes a list of rings a tiling of `region`. s is the scale of a cell [m].
void expectTiling(const Polygon& region, const Cells& cells, Real s, const std::string& what)
{
	SCOPED_TRACE(what);
	ASSERT_FALSE(cells.cells.empty());

	// Interior edges cancel exactly but for rounding: each cell's sum has an error of ~10 operations on its own area. What
	// remains is that outline vertices are off their wall by the rounding of a coordinate (1/2 ulp, ~3 ulp after a merge).
	Real sum = 0;
	for (size_t i = 0; i < cells.cells.size(); ++i) {
		const Real area = signedArea(ringOf(cells, i));
		EXPECT_GT(area, 0) << "cell " << i;
		sum += area;
	}
	const Real area = areaOf(region);
	EXPECT_NEAR(sum, area, 10 * eps * area + 4 * eps * largestCoordinate(region) * perimeterOf(region));
	EXPECT_NEAR(sum, area, 1e-12 * area);

	// Edges: each directed side once; interior ones have their opposite, so exactly two cells share the same two vertices.
	std::set<std::pair<int, int>> sides;
	std::vector<char>             used(cells.vertices.size(), 0);
	for (const auto& ring : cells.cells) {
		ASSERT_GE(ring.size(), 3u);
		EXPECT_EQ(std::set<int>(ring.begin(), ring.end()).size(), ring.size()) << "a cell meets itself";
		for (size_t k = 0; k < ring.size(); ++k) {
			used[ring[k]] = 1;
			EXPECT_TRUE(sides.insert({ ring[k], ring[(k + 1) % ring.size()] }).second) << "two cells on the same side of an edge";
		}
	}
	EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0) << "vertices of no cell";
	std::set<std::pair<Real, Real>> distinct;
	for (const Vec2& v : cells.vertices)
		EXPECT_TRUE(distinct.insert({ v.x(), v.y() }).second) << "a vertex twice: " << v.transpose();

	// The sides without opposite make up the outline: all on walls, their total length the perimeter.
	Real               outline = 0;
	std::map<int, int> degree;
	size_t             edges = 0;
	const auto         rings = ringsOf(region);
	for (const auto& [a, b] : sides) {
		++degree[a];
		if (sides.count({ b, a })) {
			edges += a < b;
			continue;
		}
		++edges;
		++degree[b];
		outline += (cells.vertices[b] - cells.vertices[a]).norm();
	}
	EXPECT_NEAR(outline, perimeterOf(region), 1e-12 * perimeterOf(region) + 4 * eps * largestCoordinate(region) * Real(cells.vertices.size()));

	const auto    boundary = boundaryVertices(cells);
	std::set<int> onOutline(boundary.begin(), boundary.end());
	for (int v : boundary) {
		const Vec2& p       = cells.vertices[v];
		Real        nearest = std::numeric_limits<Real>::infinity();
		for (const Ring& ring : rings)
			for (size_t k = 0; k < ring.size(); ++k) {
				const Vec2 &a = ring[k], d = ring[(k + 1) % ring.size()] - a;
				const Real  along = (p - a).dot(d) / d.squaredNorm();
				if (along < -1e-12 || along > 1 + 1e-12) continue;
				if (d.x() == 0 && p.x() == a.x())
					nearest = 0; // exactly on walls that are parallel to an axis
				else if (d.y() == 0 && p.y() == a.y())
					nearest = 0;
				else if (d.x() != 0 && d.y() != 0)
					nearest = std::min(nearest, std::abs(cross(d, p - a)) / d.norm());
			}
		EXPECT_LE(nearest, 4 * eps * largestCoordinate(region)) << "vertex " << v << " is off the outline";
		EXPECT_TRUE(isCornerOf(region, p) || degree[v] >= 3) << "vertex " << v << " on the outline separates nothing";
	}
	for (size_t v = 0; v < cells.vertices.size(); ++v)
		EXPECT_TRUE(onOutline.count(int(v)) || degree[int(v)] >= 3) << "vertex " << v << " separates nothing";
	for (const Ring& ring : rings)
		for (const Vec2& corner : ring)
			EXPECT_TRUE(distinct.count({ corner.x(), corner.y() })) << "a corner of the region is no vertex";

	// Euler: V - E + F = 1 - holes for a connected region, F without the outer face.
	EXPECT_EQ(int(cells.vertices.size()) - int(edges) + int(cells.cells.size()), 1 - int(region.holes.size()));

	// Convex but at the region's own corners; 1e-9 s is what the header promises.
	for (size_t i = 0; i < cells.cells.size(); ++i) {
		const Ring ring = ringOf(cells, i);
		for (size_t k = 0; k < ring.size(); ++k) {
			const Vec2 &a = ring[k], &b = ring[(k + 1) % ring.size()], &c = ring[(k + 2) % ring.size()];
			EXPECT_TRUE(isCornerOf(region, b) || dent(a, b, c) <= 1e-9 * s) << "cell " << i << " is dented by " << dent(a, b, c);
		}
	}
}

Real shortestInteriorEdge(const Cells& cells)
{
	std::set<std::pair<int, int>> sides;
	for (const auto& ring : cells.cells)
		for (size_t k = 0; k < ring.size(); ++k)
			sides.insert({ ring[k], ring[(k + 1) % ring.size()] });
	Real shortest = std::numeric_limits<Real>::infinity();
	for (const auto& [a, b] : sides)
		if (sides.count({ b, a })) shortest = std::min(shortest, (cells.vertices[a] - cells.vertices[b]).norm());
	return shortest;
}

/// Standard deviation of the cells' areas by their mean.
Real spreadOfAreas(const Cells& cells)
{
	Real sum = 0, squares = 0;
	for (size_t i = 0; i < cells.cells.size(); ++i) {
		const Real a = signedArea(ringOf(cells, i));
		sum += a;
		squares += a * a;
	}
	const Real n = Real(cells.cells.size());
	return std::sqrt(squares / n - sum * sum / n / n) / (sum / n);
}

std::vector<Vec2> grid(int nx, int ny, Real h)
{
	std::vector<Vec2> seeds;
	for (int i = 0; i < nx; ++i)
		for (int j = 0; j < ny; ++j)
			seeds.push_back({ (i + 0.5) * h, (j + 0.5) * h });
	return seeds;
}

std::string refusal(const Polygon& region, const TessellationOptions& options)
{
	try {
		tessellate(region, options);
	} catch (const std::invalid_argument& e) {
		return e.what();
	}
	return "accepted";
}

void expectRefused(const Polygon& region, const TessellationOptions& options, const std::vector<std::string>& words)
{
	const std::string said = refusal(region, options);
	for (const std::string& word : words)
		EXPECT_NE(said.find(word), std::string::npos) << "expected '" << word << "' in: " << said;
}

// Our own randomness, for the same tests on every library.
struct Dice {
	std::mt19937_64 source;
	Real            operator()(Real low, Real high) { return low + (high - low) * Real(source() >> 11) * 0x1p-53; }
};

/// By the even-odd rule, and not on an edge.
bool strictlyInside(const Ring& ring, const Vec2& p)
{
	bool in = false;
	for (size_t k = 0; k < ring.size(); ++k) {
		const Vec2 &a = ring[k], &b = ring[(k + 1) % ring.size()];
		if (cross(b - a, p - a) == 0 && (a - p).dot(b - p) <= 0) return false;
		if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) in = !in;
	}
	return in;
}

/// A simple polygon, star-shaped about `centre`: sorted angles, random radii. Non-convex as a rule, with sharp corners.
Ring randomStar(Dice& dice, const Vec2& centre, Real smallest, Real largest, int corners)
{
	Ring ring;
	for (int k = 0; k < corners; ++k) {
		const Real angle = 2 * M_PI * (k + dice(0, 0.8)) / corners, radius = dice(smallest, largest);
		ring.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
	}
	return ring;
}

} // namespace

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

// The hole's lowest side is the base of a thin cell; the cell round the hole's other side meets both of its ends, and is not beyond it.
TEST(Tessellation, holesStayEmpty)
{
	const Polygon region { rectangle(0, 0, 1, 1), { reversed({ { 0.4, 0.412 }, { 0.516, 0.412 }, { 0.516, 0.66 } }) } };
	auto          o = sized(0.541, 0);
	o.seeds         = { { 0.165, 0.12 }, { 0.432, 0.801 }, { 0.903, 0.328 } };
	expectTiling(region, tessellate(region, o), 0.541, "a hole");
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

TEST(Tessellation, mergesShortEdges)
{
	// A grid sheared so that each vertex of four cells is two vertices of three, an edge of about 0.017 apart.
	auto o = sized(1, 0);
	for (const Vec2& p : grid(6, 5, 1))
		o.seeds.push_back(p + Vec2(0.012 * (int(p.y()) % 2 ? 1 : -1), 0.007 * (int(p.x()) % 2)));
	const Polygon region = solid(rectangle(0, 0, 6, 5));

	o.mergeFraction    = 0;
	const Cells before = tessellate(region, o);
	expectTiling(region, before, 1, "short edges kept");
	EXPECT_LT(shortestInteriorEdge(before), 0.05);
	EXPECT_GT(before.vertices.size(), 42u);

	o.mergeFraction   = 0.1;
	const Cells after = tessellate(region, o);
	expectTiling(region, after, 1, "short edges merged");
	EXPECT_GT(shortestInteriorEdge(after), 0.1);
	EXPECT_EQ(after.cells.size(), 30u);
	EXPECT_EQ(after.vertices.size(), 42u); // 7 x 6: every pair has become one
}

TEST(Tessellation, fewShortEdgesRemainInRandomCells)
{
	for (std::uint64_t seed : { 1, 2, 3 }) {
		const Real  s     = 0.003;
		const Cells cells = tessellate(solid(brick), sized(s, 0, seed)); // 1538 cells
		int         edges = 0, shorter = 0;
		for (size_t i = 0; i < cells.cells.size(); ++i) {
			const Ring ring = ringOf(cells, i);
			for (size_t k = 0; k < ring.size(); ++k) {
				++edges;
				shorter += (ring[(k + 1) % ring.size()] - ring[k]).norm() < 0.05 * s;
			}
		}
		// Without merging about 8 % are (checked below); a merge is refused only where it would dent a cell.
		EXPECT_LE(shorter, edges / 1000);
		auto o          = sized(s, 0, seed);
		o.mergeFraction = 0;
		EXPECT_LT(shortestInteriorEdge(tessellate(solid(brick), o)), 0.005 * s);
	}
}

// Pieces clipped to slivers along the outline have no short edge, but they must go all the same.
TEST(Tessellation, flattensThinCells)
{
	int thin = 0;
	for (int trial = 0; trial < 50; ++trial) { // some 10,000 cells
		const Cells cells = tessellate(solid(comb), sized(0.25, 0, 100 + trial));
		for (size_t i = 0; i < cells.cells.size(); ++i) {
			const Ring ring = ringOf(cells, i);
			bool       free = true; // corners may pin a thin cell
			for (const Vec2& p : ring)
				free = free && !isCornerOf(solid(comb), p);
			Real width = std::numeric_limits<Real>::infinity();
			for (size_t k = 0; k < ring.size(); ++k) {
				const Vec2 t        = (ring[(k + 1) % ring.size()] - ring[k]).normalized();
				Real       farthest = 0;
				for (const Vec2& p : ring)
					farthest = std::max(farthest, cross(t, p - ring[k]));
				width = std::min(width, farthest);
			}
			thin += free && width < 0.05 * 0.25;
		}
	}
	EXPECT_LE(thin, 2); // where flattening would dent a neighbour
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

// The bisector of two seeds mirrored on the line from (0.02, 0) to (1, 1) meets the outline 0.02 beside the region's corner.
TEST(Tessellation, mergesIntoCorners)
{
	const Vec2 p(0.02, 0), t = Vec2(0.98, 1).normalized(), across(-t.y(), t.x());
	auto       o         = sized(0.7, 0);
	o.seeds              = { p + 0.7 * t + 0.2 * across, p + 0.7 * t - 0.2 * across };
	const Polygon square = solid(rectangle(0, 0, 1.1, 1));
	EXPECT_EQ(tessellate(square, o).vertices.size(), 5u); // the four corners and (1, 1)
	expectTiling(square, tessellate(square, o), 0.7, "merged into the corner");
	o.mergeFraction = 0.01;
	EXPECT_EQ(tessellate(square, o).vertices.size(), 6u);
}

// Near the tip of a wedge every edge across is short, and has to stay: its ends lie on different walls.
TEST(Tessellation, edgesAcrossAThinRegionStay)
{
	auto o              = sized(0.7, 0);
	o.seeds             = { { 0.3, 0.01 }, { 0.6, 0.01 }, { 1.1, 0.01 }, { 2, 0.05 }, { 3, 0.1 } };
	const Polygon wedge = solid({ { 0, 0 }, { 4, 0 }, { 4, 0.3 } });
	o.mergeFraction     = 0.1; // of 0.7; the first edge across is 0.034 long
	const Cells cells   = tessellate(wedge, o);
	expectTiling(wedge, cells, 0.7, "wedge");
	EXPECT_EQ(cells.cells.size(), 5u);
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

// A turned T of squares with seeds on their lattice (case 128833 of seed 4711 of the fuzz): the wall between two seeds runs along the outline, and a
// cell of no width lay between them.
TEST(Tessellation, cellsOfNoWidthVanish)
{
	const Vec2 x(0.99691058499036012, 0.078544799536175533), y(-x.y(), x.x());
	const auto at     = [&](Real a, Real b) -> Vec2 { return a * x + b * y; };
	const auto region = solid({ { 1.0754553845265356, -0.91836578545418457 },
	                            at(1, 0),
	                            { 1.9938211699807202, 0.15708959907235107 },
	                            { 1.9152763704445448, 1.1540001840627112 },
	                            { 1.8367315709083691, 2.1509107690530711 },
	                            { 2.8336421558987297, 2.229455568589247 },
	                            { 2.7550973563625538, 3.2263661535796073 },
	                            { 1.7581867713721937, 3.1478213540434314 },
	                            { 0.76127618638183359, 3.069276554507256 },
	                            { 0.83982098591800902, 2.0723659695168957 },
	                            { 0.91836578545418457, 1.0754553845265356 },
	                            at(0, 1),
	                            { 0, 0 },
	                            { 0.078544799536175533, -0.99691058499036012 } });
	auto       o      = sized(1, 0);
	o.mergeFraction   = 0.1;
	o.seeds = { { 0.53772769226326778, -0.45918289272709228 }, { 1.2990038786451015, 2.6100936617801636 }, { 2.2959144636354614, 2.688638461316339 } };
	const Cells cells = tessellate(region, o);
	expectTiling(region, cells, 1, "turned T");
	EXPECT_EQ(cells.cells.size(), 3u);
}

// A sliver 1e5 from the origin (case 119974 of seed 4711 of the fuzz): its coordinates are rounded to more than a billionth of a cell.
TEST(Tessellation, farFromTheOriginWhatIsRoundedAlikeIsOne)
{
	const Polygon region
		= solid({ { 128436.08760368229, 205574.11375129572 }, { 128437.08760368229, 205574.1162184345 }, { 128436.8154463184, 205574.1554862945 } });
	for (Real mergeFraction : { 0.0, 0.1 }) {
		auto o          = sized(0.028100713397721831, 0);
		o.mergeFraction = mergeFraction;
		o.seeds = { { 128436.90010368229, 205574.11635973313 }, { 128436.65010368229, 205574.1424441074 },  { 128436.27510368229, 205574.11635973313 },
			    { 128436.65010368229, 205574.1320103577 },  { 128436.65010368229, 205574.12157660798 }, { 128436.65010368229, 205574.12679348284 },
			    { 128437.02510368229, 205574.12157660798 }, { 128436.77510368229, 205574.11635973313 }, { 128436.77510368229, 205574.13722723254 },
			    { 128436.40010368229, 205574.12679348284 }, { 128436.27510368229, 205574.12157660798 }, { 128436.15010368229, 205574.11635973313 },
			    { 128436.52510368229, 205574.12679348284 }, { 128436.40010368229, 205574.11635973313 }, { 128436.52510368229, 205574.13722723254 },
			    { 128436.52510368229, 205574.1320103577 } };
		const Cells cells = tessellate(region, o);
		Real        sum   = 0;
		for (size_t i = 0; i < cells.cells.size(); ++i) {
			const Ring ring = ringOf(cells, i);
			EXPECT_GT(signedArea(ring), 0);
			EXPECT_NO_THROW(requireSimple(solid(ring), "cell"));
			sum += signedArea(ring);
		}
		EXPECT_NEAR(sum, signedArea(region.outer), 1e-10); // a few roundings of a coordinate, 3e-11, by the perimeter of 2
	}
}

// Two holes with edges on one line (case 4599 of seed 402 of the fuzz): flattening left a cell whose arm of no width lay along that line, and blocks
// that overlap by rounding. No vertex of a cell lies on another of its edges.
TEST(Tessellation, flatteningLeavesNoArms)
{
	Polygon region { { { -11.746167013432753, 4.8068172746213902 },
		           { -12.871862836774095, 5.4384476387366787 },
		           { -14.27139640417289, 2.9441896344472043 },
		           { -13.145700580831548, 2.3125592703319162 } },
		         {} };
	region.holes      = { { { -13.897775289932088, 3.0101349983637102 },
		                { -13.905752444588458, 3.0146109971155326 },
		                { -13.901276445836636, 3.0225881517719024 },
		                { -13.893299291180266, 3.0181121530200805 } },
		              { { -13.904122507396524, 3.0189407594518749 },
		                { -13.911491599868919, 3.0230755731955394 },
		                { -13.909253600493006, 3.0270641505237252 },
		                { -13.901884508020613, 3.0229293367800603 } },
		              { { -13.740509353834359, 3.3210071427920465 },
		                { -13.738527263836456, 3.3212550494655186 },
		                { -13.736570854967653, 3.3181674833479144 },
		                { -13.738229418033439, 3.3160893649411167 },
		                { -13.741810304716363, 3.3163552898571913 },
		                { -13.743150190685968, 3.3178745256171362 } } };
	auto o            = sized(0.21002905215131454, 3, 695587);
	o.mergeFraction   = 0.45;
	const Cells cells = tessellate(region, o);
	for (size_t i = 0; i < cells.cells.size(); ++i) {
		const Ring   ring = ringOf(cells, i);
		const size_t n    = ring.size();
		for (size_t k = 0; k < n; ++k)
			for (size_t m = 1; m + 1 < n; ++m) { // edges that do not begin or end at k
				const Vec2 a = ring[(k + m) % n], b = ring[(k + m + 1) % n];
				const Real along = std::clamp((ring[k] - a).dot(b - a) / (b - a).squaredNorm(), Real(0), Real(1));
				EXPECT_GT((ring[k] - a - along * (b - a)).norm(), 1e-9 * o.size) << "cell " << i;
			}
	}
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

TEST(PointsOnEdges, makeNeighboursConform)
{
	const Cells mortar = tessellate(solid(rectangle(0, 0, 0.2, 0.01)), sized(0.003));
	const Ring  unit   = rectangle(0, 0.01, 0.2, 0.06);
	const Ring  fitted = withPointsOnEdges(unit, mortar.vertices, 1e-9);
	size_t      shared = 0;
	for (int v : boundaryVertices(mortar))
		if (mortar.vertices[v].y() == 0.01) {
			++shared;
			EXPECT_NE(std::find(fitted.begin(), fitted.end(), mortar.vertices[v]), fitted.end());
		}
	EXPECT_EQ(fitted.size(), shared + 2); // its two corners at the top
}

TEST(BoundaryVertices, ofAGrid)
{
	auto o            = sized(1, 0);
	o.seeds           = grid(3, 3, 1);
	const Cells cells = tessellate(solid(rectangle(0, 0, 3, 3)), o);
	ASSERT_EQ(cells.vertices.size(), 16u);
	const auto boundary = boundaryVertices(cells);
	EXPECT_EQ(boundary.size(), 12u);
	EXPECT_TRUE(std::is_sorted(boundary.begin(), boundary.end()));
}
