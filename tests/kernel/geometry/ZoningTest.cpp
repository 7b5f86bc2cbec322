// yade-blocks, GPL-2.0-or-later
#include <Rings.hpp>
#include <blocks/kernel/geometry/EdgeDivision.hpp>
#include <blocks/kernel/geometry/Tessellation.hpp>
#include <blocks/kernel/geometry/Zoning.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>
#include <set>

using namespace rings;

namespace {

// Lopsided on purpose.
const Ring pentagon = { { 0.1, 0.2 }, { 1.7, 0.5 }, { 2.1, 1.9 }, { 1.0, 2.3 }, { -0.3, 1.1 } };
const Ring lShape   = { { 0, 0 }, { 3, 0 }, { 3, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } };
const Ring hook     = { { 0, 0 }, { 3, 0 }, { 3, 3 }, { 2, 3 }, { 2, 1 }, { 1, 1 }, { 1, 3 }, { 0, 3 } }; // a U: no point sees all of it
const Ring arrow    = { { 0, 0 }, { 4, 0 }, { 4, 4 }, { 3.6, 0.5 } };                                     // its centroid lies outside

Real areaOf(const Polygon& polygon)
{
	Real area = signedArea(polygon.outer);
	for (const Ring& hole : polygon.holes)
		area += signedArea(hole);
	return area;
}

/// Everything that makes triangles a conforming mesh of the polygon, with the outline `rings` says.
void expectMesh(const Polygon& polygon, const Zones& zones, const std::string& what)
{
	SCOPED_TRACE(what);
	Real                          sum = 0;
	std::set<std::pair<int, int>> sides;
	std::vector<char>             used(zones.points.size(), 0);
	for (const auto& t : zones.triangles) {
		const Vec2 &a = zones.points[t[0]], &b = zones.points[t[1]], &c = zones.points[t[2]];
		EXPECT_GT(cross(b - a, c - a), 0);
		sum += cross(b - a, c - a) / 2;
		for (int k = 0; k < 3; ++k) {
			used[t[k]] = 1;
			EXPECT_TRUE(sides.insert({ t[k], t[(k + 1) % 3] }).second) << "two zones on the same side of an edge";
		}
	}
	EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0) << "points of no zone";
	// Interior edges cancel; each term has ~4 roundings, sums grow as the number of zones at worst, and outline points made
	// by splitting are off their edge by the rounding of a coordinate: all far below the 1e-12 asked for.
	EXPECT_NEAR(sum, areaOf(polygon), 1e-12 * areaOf(polygon));

	// The sides without opposite are those of the rings, in their direction.
	std::set<std::pair<int, int>> outline;
	ASSERT_EQ(zones.rings.size(), 1 + polygon.holes.size());
	int expected = 0;
	for (size_t r = 0; r < zones.rings.size(); ++r) {
		const auto& ring  = zones.rings[r];
		const Ring& given = r == 0 ? polygon.outer : polygon.holes[r - 1];
		Ring        points;
		for (size_t k = 0; k < ring.size(); ++k) {
			EXPECT_EQ(ring[k], expected++) << "the outline's points come first, in order";
			outline.insert({ ring[k], ring[(k + 1) % ring.size()] });
			points.push_back(zones.points[ring[k]]);
		}
		EXPECT_NEAR(signedArea(points), signedArea(given), 1e-12 * std::abs(signedArea(given)));
		size_t at = 0; // the given vertices, bit by bit, among the ring's, in order
		for (const Vec2& p : points)
			at += at < given.size() && p == given[at];
		EXPECT_EQ(at, given.size());
	}
	std::set<std::pair<int, int>> open;
	for (const auto& [a, b] : sides)
		if (!sides.count({ b, a })) open.insert({ a, b });
	EXPECT_EQ(open, outline);

	// Euler: V - E + F = 1 - holes
	const int edges = int(sides.size() + open.size()) / 2;
	EXPECT_EQ(int(zones.points.size()) - edges + int(zones.triangles.size()), 1 - int(polygon.holes.size()));
}
void expectMesh(const Ring& ring, const Zones& zones, const std::string& what) { expectMesh(Polygon { ring, {} }, zones, what); }

std::string refusal(const std::function<void()>& call)
{
	try {
		call();
	} catch (const std::invalid_argument& e) {
		return e.what();
	}
	return "accepted";
}

void expectRefused(const std::function<void()>& call, const std::vector<std::string>& words)
{
	const std::string said = refusal(call);
	for (const std::string& word : words)
		EXPECT_NE(said.find(word), std::string::npos) << "expected '" << word << "' in: " << said;
}

Real degrees(Real angle) { return angle * 180 / M_PI; }

} // namespace

TEST(FanZones, joinTheCentroidToEachEdge)
{
	const Zones zones = fanZones(pentagon);
	expectMesh(pentagon, zones, "pentagon");
	EXPECT_EQ(zones.points.size(), 6u);
	EXPECT_EQ(zones.triangles.size(), 5u);

	// A trapezium's centroid from the textbook: height h = 1, parallel sides 3 (below) and 1: h (b + 2a) / 3 (a + b) above the longer.
	const Zones trapezium = fanZones({ { 1, 2 }, { 4, 2 }, { 2, 3 }, { 1, 3 } });
	EXPECT_NEAR(trapezium.points[4].y(), 2 + (3 + 2.0) / 12, 16 * eps);
	EXPECT_NEAR(trapezium.points[4].x(), 1 + (9 + 3 + 1) / 12.0, 16 * eps); // (b^2 + ab + a^2) / 3 (a + b)
}

TEST(FanZones, findAPointThatSeesAll)
{
	expectMesh(lShape, fanZones(lShape), "L"); // its kernel is [0,1] x [0,1], its centroid (1.25, 0.75) sees not all
	const Vec2 point = fanZones(lShape).points[6];
	EXPECT_NEAR(point.x(), 0.5, 8 * eps); // the kernel's centroid
	EXPECT_NEAR(point.y(), 0.5, 8 * eps);
	expectMesh(arrow, fanZones(arrow), "arrow");
	expectRefused([] { fanZones(hook); }, { "fanZones", "see every edge", "cornerZones" });
}

TEST(FanZones, takeCollinearVertices)
{
	const Ring ring = { { 0, 0 }, { 1, 0 }, { 1.5, 0 }, { 2, 0 }, { 1, 1 } };
	expectMesh(ring, fanZones(ring), "collinear");
	EXPECT_EQ(fanZones(ring).triangles.size(), 5u);
}

TEST(CornerZones, addNoPoint)
{
	for (const Ring& ring : { pentagon,
	                          lShape,
	                          hook,
	                          arrow,
	                          Ring { { 0, 0 }, { 2, 0 }, { 1, 1 } },
	                          Ring { { 0, 0 }, { 1, 0 }, { 1.5, 0 }, { 2, 0 }, { 1, 1 }, { 0.5, 0.5 } } }) {
		const Zones zones = cornerZones(ring);
		expectMesh(ring, zones, "corners");
		EXPECT_EQ(zones.points.size(), ring.size());
		EXPECT_EQ(zones.triangles.size(), ring.size() - 2); // every triangulation of a simple polygon
	}
}

TEST(CornerZones, goRoundHoles)
{
	const Polygon plate { { { 0, 0 }, { 4, 0 }, { 4, 4 }, { 0, 4 } },
		              { { { 1, 1 }, { 1, 3 }, { 2, 3 }, { 2, 1 } }, { { 2.5, 1 }, { 2.5, 2 }, { 3, 1.5 } } } };
	const Zones   zones = cornerZones(plate);
	EXPECT_EQ(zones.points.size(), 11u);
	EXPECT_EQ(zones.triangles.size(), 11u + 2 * 2 - 2); // every triangulation of a polygon with two holes
	Real area = 0;
	for (const auto& t : zones.triangles) {
		const Vec2 &a = zones.points[t[0]], &b = zones.points[t[1]], &c = zones.points[t[2]];
		area += cross(b - a, c - a) / 2;
		const Vec2 centre = (a + b + c) / 3;
		EXPECT_FALSE(centre.x() > 1 && centre.x() < 2 && centre.y() > 1 && centre.y() < 3) << "within the hole";
	}
	EXPECT_NEAR(area, 16 - 2 - 0.25, 1e-14);
	expectRefused([&] { cornerZones(Polygon { plate.outer, { { { 3, 3 }, { 3, 5 }, { 3.5, 3 } } } }); }, { "cornerZones" });
}

TEST(CornerZones, areDelaunay)
{
	// Of a quadrilateral's two diagonals, the one whose opposite angles add up to less than 180 degrees: here 0-2 or 1-3.
	const Zones flat = cornerZones({ { 0, 0 }, { 2, -0.5 }, { 4, 0 }, { 2, 0.5 } });
	EXPECT_TRUE(flat.triangles == (std::vector<std::array<int, 3>> { { 0, 1, 3 }, { 1, 2, 3 } }));
	const Zones tall = cornerZones({ { 0, 0 }, { 0.5, -2 }, { 1, 0 }, { 0.5, 2 } });
	EXPECT_TRUE(tall.triangles == (std::vector<std::array<int, 3>> { { 0, 1, 2 }, { 0, 2, 3 } }));
}

TEST(RegularZones, areTheirOwnMirrorImage)
{
	// With an even number of columns and of rows: diagonals that all ran one way would make a block stiffer along them.
	const Zones zones = regularZones(rectangle(-0.4, -0.2, 0.4, 0.2), 0.2);
	ASSERT_EQ(zones.triangles.size(), 2u * 4 * 2);
	const auto centroids = [&](Real x, Real y) {
		std::set<std::pair<long, long>> all; // in units of 1e-6 m
		for (const auto& t : zones.triangles) {
			const Vec2 c = (zones.points[t[0]] + zones.points[t[1]] + zones.points[t[2]]) / 3;
			all.insert({ std::lround(1e6 * x * c.x()), std::lround(1e6 * y * c.y()) });
		}
		return all;
	};
	EXPECT_EQ(centroids(-1, 1), centroids(1, 1));
	EXPECT_EQ(centroids(1, -1), centroids(1, 1));
}

TEST(RegularZones, fillARectangle)
{
	const Ring  brick = rectangle(0.1, 0.2, 2.1, 1.2);
	const Zones zones = regularZones(brick, 0.25);
	expectMesh(brick, zones, "brick");
	EXPECT_EQ(zones.triangles.size(), 2u * 8 * 4);
	EXPECT_EQ(zones.points.size(), 9u * 5);
	EXPECT_EQ(zones.rings[0].size(), 24u);
	const auto q = quality(zones);
	EXPECT_NEAR(q.minArea, 0.25 * 0.25 / 2, 1e-14);
	EXPECT_NEAR(q.maxArea, 0.25 * 0.25 / 2, 1e-14);
	EXPECT_NEAR(q.minAngle, M_PI / 4, 1e-13);
	EXPECT_NEAR(q.maxAngle, M_PI / 2, 1e-13);

	EXPECT_EQ(regularZones(brick, 5).triangles.size(), 2u);
	EXPECT_EQ(regularZones(brick, 0.24).triangles.size(), 2u * 9 * 5); // edges no longer than the size

	Ring       turned;
	const Real c = std::cos(0.3), s = std::sin(0.3);
	for (const Vec2& p : brick)
		turned.push_back({ c * p.x() - s * p.y(), s * p.x() + c * p.y() });
	expectMesh(turned, regularZones(turned, 0.3), "turned");
	expectMesh(rectangle(0, 0, 0.3, 0.1), regularZones(rectangle(0, 0, 0.3, 0.1), 0.1 / 3), "sizes without exact number");
	EXPECT_EQ(regularZones(rectangle(0, 0, 0.3, 0.1), 0.1 / 3).triangles.size(), 2u * 9 * 3);
	EXPECT_EQ(regularZones(rectangle(0, 0, 3 * 0.1, 0.1), 0.1).triangles.size(), 6u); // 3 x 0.1 / 0.1 is 4e-16 more than 3: no fourth column
}

TEST(RegularZones, keepFurtherVertices)
{
	const Ring  brick = withPointsOnEdges(rectangle(0, 0, 2, 1), { { 0.33, 0 }, { 0.81, 0 }, { 1.4, 0 }, { 2, 0.4 } }, 1e-9);
	const Zones zones = regularZones(brick, 0.25);
	expectMesh(brick, zones, "brick with mortar's vertices");
	// 0.33, 0.48, 0.59, 0.6 | 0.4, 0.6 | 2 | 1 in pieces of 0.25 at most
	EXPECT_EQ(zones.rings[0].size(), 2u + 2 + 3 + 3 + 2 + 3 + 8 + 4);
	EXPECT_LT(quality(zones).worstAspect, 4);

	// A neighbour's vertices at the grid's own places leave it a grid, and keep their bits.
	const Vec2  nearly(0.5 + 1e-13, 0);
	const Ring  met   = withPointsOnEdges(rectangle(0, 0, 2, 1), { nearly, { 2, 0.25 }, { 1.75, 1 } }, 1e-9);
	const Zones plain = regularZones(met, 0.25);
	expectMesh(met, plain, "brick with a neighbour of the same grid");
	EXPECT_EQ(plain.triangles.size(), 2u * 8 * 4);
	EXPECT_EQ(plain.points[2], nearly);
}

TEST(DelaunayZones, meshAllKindsOfBlocks)
{
	const Polygon holed { lShape, { reversed(rectangle(0.3, 0.3, 0.6, 0.7)), reversed(rectangle(1.5, 0.2, 1.8, 0.4)) } };
	for (Real size : { 5.0, 0.7, 0.2, 0.05 })
		for (Outline outline : { Outline::split, Outline::kept }) {
			for (const Ring& ring : { pentagon, lShape, hook, arrow }) {
				const Zones zones = delaunayZones(ring, size, outline);
				expectMesh(ring, zones, "size " + std::to_string(size));
				EXPECT_TRUE(outline == Outline::split || zones.rings[0].size() == ring.size());
			}
			expectMesh(holed, delaunayZones(holed, size, outline), "holes, size " + std::to_string(size));
		}
}

TEST(DelaunayZones, haveTheSizeAskedFor)
{
	for (Real size : { 0.1, 0.05, 0.02 }) {
		const Zones zones   = delaunayZones(rectangle(0, 0, 1.03, 0.71), size);
		Real        longest = 0, sum = 0;
		int         sides = 0;
		for (const auto& t : zones.triangles)
			for (int k = 0; k < 3; ++k) {
				const Real length = (zones.points[t[(k + 1) % 3]] - zones.points[t[k]]).norm();
				longest           = std::max(longest, length);
				sum += length;
				++sides;
			}
		// Circumradii stay below size/(0.75 sqrt 3) = 0.77 size, save next to the outline, so edges below 1.54 size; smoothing adds a little.
		EXPECT_LT(longest, 1.8 * size);
		EXPECT_NEAR(sum / sides, size, 0.15 * size);
		const auto q = quality(zones);
		EXPECT_GT(degrees(q.minAngle), 25); // Delaunay refinement promises 20.7 with its outline split at will; measured 33
		EXPECT_LT(degrees(q.maxAngle), 125);
		EXPECT_LT(q.worstAspect, 3.5);
		for (size_t k = 0; k < zones.rings[0].size(); ++k)
			EXPECT_LE((zones.points[zones.rings[0][k]] - zones.points[zones.rings[0][(k + 1) % zones.rings[0].size()]]).norm(), size * (1 + 1e-9));
	}
}

TEST(DelaunayZones, areGraded)
{
	Ring ring; // a floor with vertices 0.01 apart, the rest coarse
	for (int i = 0; i < 100; ++i)
		ring.push_back({ i / 100.0, 0 });
	ring.insert(ring.end(), { { 1, 0 }, { 1, 1 }, { 0, 1 } });
	const Zones zones = delaunayZones(ring, 0.15);
	expectMesh(ring, zones, "graded");
	Real low = 0, high = 0; // mean areas near the floor and far from it
	int  nLow = 0, nHigh = 0;
	for (const auto& t : zones.triangles) {
		const Vec2 &a = zones.points[t[0]], &b = zones.points[t[1]], &c = zones.points[t[2]];
		const Real  y = (a + b + c).y() / 3, area = cross(b - a, c - a) / 2;
		if (y < 0.03) low += area, ++nLow;
		if (y > 0.6) high += area, ++nHigh;
	}
	EXPECT_GT(high / nHigh, 20 * low / nLow); // (0.15 / 0.01)^2 = 225 between the ends of the grading
	EXPECT_GT(degrees(quality(zones).minAngle), 10);
	EXPECT_LT(zones.triangles.size(), 1500u); // uniform zones of 0.01 would be 23000
}

// Long outline edges that must be kept stand in the way of circumcentres; the zones get their size all the same.
TEST(DelaunayZones, haveTheirSizeWithinLongEdgesToo)
{
	for (Real width : { 0.3, 0.5, 1.0 }) {
		const Ring  ring  = rectangle(0, 0, width, 1);
		const Zones zones = delaunayZones(ring, 0.1, Outline::kept);
		expectMesh(ring, zones, "long edges");
		EXPECT_EQ(zones.rings[0].size(), 4u);
		// Equilateral zones of 0.1 would be width/0.00433 in number; those along the four edges are necessarily larger.
		EXPECT_GT(Real(zones.triangles.size()), 0.5 * width / 0.00433 - 40);
		// The zone on an edge of length 1 is about half a zone size high, not less by much: (sqrt(3)/2) 1/0.05 = 17.
		EXPECT_LT(quality(zones).worstAspect, 20);
	}
}

TEST(DelaunayZones, sameInputSameBits)
{
	const Polygon                 holed { lShape, { reversed(rectangle(0.3, 0.3, 0.6, 0.7)) } };
	const Zones                   a = delaunayZones(holed, 0.1);
	std::vector<std::vector<int>> clutter; // other addresses the second time
	for (int i = 0; i < 1000; ++i)
		clutter.emplace_back(i);
	const Zones b = delaunayZones(holed, 0.1);
	EXPECT_EQ(a.points, b.points);
	EXPECT_EQ(a.rings, b.rings);
	EXPECT_TRUE(a.triangles == b.triangles);
}

TEST(Zones, ofAWholeTessellation)
{
	TessellationOptions o;
	o.size            = 0.05;
	o.lloyd           = 1;
	const Cells cells = tessellate({ pentagon, {} }, o);
	for (size_t i = 0; i < cells.cells.size(); ++i) {
		const Ring ring = ringOf(cells, i);
		expectMesh(ring, fanZones(ring), "fan of cell " + std::to_string(i));
		expectMesh(ring, cornerZones(ring), "corners of cell " + std::to_string(i));
		if (i % 10 == 0) expectMesh(ring, delaunayZones(ring, 0.02), "Delaunay of cell " + std::to_string(i));
	}
}

TEST(Zones, ofRandomBlocks)
{
	std::mt19937_64 source(3);
	const auto      dice = [&](Real low, Real high) { return low + (high - low) * Real(source() >> 11) * 0x1p-53; };
	for (int trial = 0; trial < 200; ++trial) {
		Ring      ring;
		const int n = 4 + trial % 9;
		for (int k = 0; k < n; ++k) {
			const Real angle = 2 * M_PI * (k + dice(0, 0.8)) / n, radius = dice(0.3, 1);
			ring.push_back({ 2 + radius * std::cos(angle), -1 + radius * std::sin(angle) });
		}
		expectMesh(ring, cornerZones(ring), "corners, trial " + std::to_string(trial));
		expectMesh(ring, delaunayZones(ring, dice(0.1, 0.5), trial % 2 ? Outline::split : Outline::kept), "Delaunay, trial " + std::to_string(trial));
		if (HasFailure()) break;
	}
}

// No interior point comes so near to an outline edge that it makes a needlessly flat zone there.
TEST(DelaunayZones, keepAwayFromTheOutline)
{
	std::mt19937_64 source(3);
	const auto      dice = [&](Real low, Real high) { return low + (high - low) * Real(source() >> 11) * 0x1p-53; };
	for (int trial = 0; trial < 100; ++trial) {
		Ring      ring; // fairly round, with 5 to 11 corners: edges of 0.5 and more
		const int n = 5 + trial % 7;
		for (int k = 0; k < n; ++k) {
			const Real angle = 2 * M_PI * (k + dice(0, 0.3)) / n, radius = dice(0.8, 1);
			ring.push_back({ 2 + radius * std::cos(angle), -1 + radius * std::sin(angle) });
		}
		const Real  size  = dice(0.1, 0.3);
		const Zones zones = delaunayZones(ring, size, Outline::kept);
		for (size_t i = ring.size(); i < zones.points.size(); ++i)
			for (int k = 0; k < n; ++k) {
				const Vec2 &a = ring[k], &b = ring[(k + 1) % n], &p = zones.points[i];
				// placed at 0.5 size or farther; smoothing may take a little of it
				EXPECT_TRUE((a - p).dot(b - p) >= 0 || cross(b - a, p - a) > 0.3 * size * (b - a).norm()) << "trial " << trial;
			}
	}
}

TEST(Zones, qualityOfKnownTriangles)
{
	Zones z; // a 3-4-5 triangle and half an equilateral one of edge 2, on its side
	z.points    = { { 0, 0 }, { 4, 0 }, { 0, 3 }, { 10, 0 }, { 11, 0 }, { 10, std::sqrt(3.0) } };
	z.triangles = { { 0, 1, 2 } };
	auto q      = quality(z);
	EXPECT_NEAR(q.minAngle, std::asin(0.6), 4 * eps);
	EXPECT_NEAR(q.maxAngle, M_PI / 2, 4 * eps);
	EXPECT_NEAR(q.minArea, 6, 8 * eps);
	EXPECT_NEAR(q.worstAspect, std::sqrt(3.0) / 2 * 5 / 2.4, 8 * eps); // height on the hypotenuse 12/5
	z.triangles.push_back({ 3, 4, 5 });
	q = quality(z);
	EXPECT_NEAR(q.minAngle, M_PI / 6, 8 * eps);
	EXPECT_NEAR(q.minArea, std::sqrt(3.0) / 2, 4 * eps);
	EXPECT_NEAR(q.maxArea, 6, 8 * eps);
	z.points    = { { 0, 0 }, { 1, 0 }, { 0.5, std::sqrt(3.0) / 2 } };
	z.triangles = { { 0, 1, 2 } };
	EXPECT_NEAR(quality(z).worstAspect, 1, 4 * eps);
}

TEST(Zones, refuseBadInput)
{
	const Real nan    = std::nan("");
	const Ring bowTie = { { 0, 0 }, { 3, 2 }, { 3, 0 }, { 0, 1 } };
	expectRefused([&] { fanZones(bowTie); }, { "fanZones", "cross" });
	expectRefused([&] { cornerZones(bowTie); }, { "cornerZones", "cross" });
	expectRefused([&] { delaunayZones(bowTie, 1); }, { "delaunayZones", "cross" });
	expectRefused([&] { cornerZones({ { 0, 0 }, { 1, 0 } }); }, { "cornerZones", "at least 3 vertices" });
	expectRefused([&] { cornerZones({ { 0, 0 }, { 1, 0 }, { 2, 0 } }); }, { "cornerZones", "area" });
	expectRefused([&] { fanZones(reversed(pentagon)); }, { "fanZones", "counter-clockwise" });
	expectRefused([&] { fanZones({ { 0, 0 }, { 1, nan }, { 0, 1 } }); }, { "fanZones", "finite" });
	for (Real bad : { 0.0, -1.0, nan, std::numeric_limits<Real>::infinity() }) {
		expectRefused([&] { delaunayZones(pentagon, bad); }, { "delaunayZones: zoneSize must be positive" });
		expectRefused([&] { regularZones(rectangle(0, 0, 1, 1), bad); }, { "regularZones: zoneSize must be positive" });
	}
	expectRefused([&] { delaunayZones(pentagon, 1e-6); }, { "delaunayZones: zoneSize", "too many" });
	expectRefused([&] { regularZones({ { 0, 0 }, { 1, 0 }, { 0, 1 } }, 1); }, { "regularZones", "rectangle", "got 3" });
	expectRefused([&] { regularZones(lShape, 1); }, { "regularZones", "rectangle", "got 6" });
	expectRefused([&] { regularZones({ { 0, 0 }, { 1, 0 }, { 1.1, 1 }, { 0, 1 } }, 1); }, { "regularZones", "rectangle" });
	expectRefused([&] { regularZones({ { 0, 0 }, { 1, 0 }, { 1.2, 1 }, { 0.2, 1 } }, 1); }, { "regularZones", "rectangle" }); // a parallelogram
}

TEST(RegionZones, divideTheOutlineInEveryZoning)
{
	const Ring brick = withPointsOnEdges(rectangle(0, 0, 1, 1), { { 0.45, 1 }, { 0.55, 1 } }, 1e-9);
	for (Zoning zoning : { Zoning::delaunay, Zoning::regular, Zoning::fan, Zoning::corners }) {
		const Zones zones = regionZones({ brick, {} }, zoning, 0.1);
		expectMesh(brick, zones, "zoning " + std::to_string(int(zoning)));
		EXPECT_EQ(zones.rings[0].size(), 30u + 5 + 1 + 5); // 0.45, 0.1, 0.45 above
		if (zoning == Zoning::delaunay || zoning == Zoning::regular) {
			EXPECT_LT(quality(zones).worstAspect, 2.5);
		}
	}
}

TEST(RegionZones, honourHolesOrRefuse)
{
	const Polygon frame { rectangle(0, 0, 1, 1), { reversed(rectangle(0.4, 0.4, 0.6, 0.6)) } };
	for (Zoning zoning : { Zoning::delaunay, Zoning::corners })
		expectMesh(frame, regionZones(frame, zoning, 0.1), "zoning " + std::to_string(int(zoning)));
	for (Zoning zoning : { Zoning::fan, Zoning::regular })
		expectRefused([&] { regionZones(frame, zoning, 0.1); }, { "holes", "delaunay", "got 1" });
	for (Zoning zoning : { Zoning::delaunay, Zoning::corners, Zoning::fan, Zoning::regular })
		expectRefused([&] { regionZones({ rectangle(0, 0, 1, 1), {} }, zoning, 0); }, { "zoneSize", "positive", "got 0" });
}

TEST(CellZones, takeAnotherZoningWhereAFanDoesNotSuit)
{
	const CellZones round = cellZones(pentagon, Zoning::fan);
	EXPECT_EQ(round.zoning, Zoning::fan);
	EXPECT_EQ(cellZones(pentagon, Zoning::corners).zoning, Zoning::corners);
	const CellZones u = cellZones(hook, Zoning::fan); // no point sees all of it
	EXPECT_NE(u.zoning, Zoning::fan);
	expectMesh(hook, u.zones, "hook");
	// The fan's point would be in the small square that sees both arms, near (0.005, 0.005): zones as flat as 1 by 0.005.
	const Ring thinL = { { 0, 0 }, { 1, 0 }, { 1, 0.01 }, { 0.01, 0.01 }, { 0.01, 1 }, { 0, 1 } };
	EXPECT_GT(quality(fanZones(thinL)).worstAspect, 100);
	const CellZones l = cellZones(thinL, Zoning::fan);
	expectMesh(thinL, l.zones, "thin L");
	EXPECT_LE(quality(l.zones).worstAspect, quality(fanZones(thinL)).worstAspect);
}

// Seeds of which cells passed a corner of the hole by a narrow neck, ran round it but for a tiny edge of a neighbour, or had a vertex in the middle of
// a neighbour's edge. An edge may be as short as a twentieth of a cell's size; a zone from it to what lies two sizes away has an aspect of 40.
TEST(CellZones, areNoSliversRoundAHole)
{
	const Polygon region { rectangle(0, 0, 1, 1), { reversed(rectangle(0.45, 0.45, 0.55, 0.55)) } };
	for (int seed : { 14, 34, 476, 498, 526, 698, 797, 844, 1313, 1949 }) {
		TessellationOptions options;
		options.size      = 0.3;
		options.seed      = seed;
		const Cells cells = tessellate(region, options);
		for (size_t i = 0; i < cells.cells.size(); ++i)
			EXPECT_LT(quality(cellZones(ringOf(cells, i), Zoning::fan).zones).worstAspect, 2 / options.mergeFraction) << "seed " << seed;
	}
}
