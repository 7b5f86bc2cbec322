// yade-blocks, GPL-2.0-or-later
#pragma once
#include <Rings.hpp>
#include <algorithm>
#include <array>
#include <blocks/kernel/geometry/PolygonRules.hpp>
#include <blocks/kernel/geometry/Tessellation.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <random>
#include <set>

/// Regions, and what makes cells a tiling of one.
namespace cellchecks {

using namespace rings;

inline Polygon solid(const Ring& outer) { return { outer, {} }; }

// Lopsided on purpose: nothing here is symmetric.
inline const Ring brick  = rectangle(0.013, -0.02, 0.226, 0.045);
inline const Ring lShape = { { 0, 0 }, { 3, 0 }, { 3, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } };
inline const Ring comb
	= { { 0, 0 }, { 7, 0 }, { 7, 3 }, { 6.5, 3 }, { 6, 0.6 }, { 5, 3 }, { 4, 3 }, { 3.2, 0.4 }, { 3, 3 }, { 1.5, 3 }, { 1, 0.5 }, { 0.3, 2.8 } };
inline const Ring slanted   = { { 0.1, 0.2 }, { 1.7, 0.5 }, { 2.1, 1.9 }, { 1.0, 2.3 }, { -0.3, 1.1 } };
inline const Ring slantHole = reversed({ { 0.8, 0.9 }, { 1.2, 1.0 }, { 1.1, 1.5 } });

inline Real areaOf(const Polygon& region)
{
	Real area = signedArea(region.outer);
	for (const Ring& hole : region.holes)
		area += signedArea(hole); // clockwise: negative
	return area;
}

inline TessellationOptions sized(Real size, int lloyd = 2, std::uint64_t seed = 1)
{
	TessellationOptions o;
	o.size  = size;
	o.lloyd = lloyd;
	o.seed  = seed;
	return o;
}

inline std::vector<Ring> ringsOf(const Polygon& region)
{
	std::vector<Ring> rings { region.outer };
	rings.insert(rings.end(), region.holes.begin(), region.holes.end());
	return rings;
}

inline Real perimeterOf(const Polygon& region)
{
	Real length = 0;
	for (const Ring& ring : ringsOf(region))
		for (size_t k = 0; k < ring.size(); ++k)
			length += (ring[(k + 1) % ring.size()] - ring[k]).norm();
	return length;
}

/// How deep vertex b lies inside the chord a-c of its neighbours [m]; positive at a dent.
inline Real dent(const Vec2& a, const Vec2& b, const Vec2& c) { return -cross(b - a, c - b) / (c - a).norm(); }

inline bool isCornerOf(const Polygon& region, const Vec2& p)
{
	for (const Ring& ring : ringsOf(region))
		if (std::find(ring.begin(), ring.end(), p) != ring.end()) return true;
	return false;
}

/// Everything that makes a list of rings a tiling of `region`. s is the scale of a cell [m].
inline void expectTiling(const Polygon& region, const Cells& cells, Real s, const std::string& what)
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
	std::set<int>      onOutline;
	for (const auto& [a, b] : sides) {
		++degree[a];
		if (sides.count({ b, a })) {
			edges += a < b;
			continue;
		}
		++edges;
		++degree[b];
		onOutline.insert(a); // each vertex of the outline begins one such side
		outline += (cells.vertices[b] - cells.vertices[a]).norm();
	}
	EXPECT_NEAR(outline, perimeterOf(region), 1e-12 * perimeterOf(region) + 4 * eps * largestCoordinate(region) * Real(cells.vertices.size()));

	for (int v : onOutline) {
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

inline Real shortestInteriorEdge(const Cells& cells)
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
inline Real spreadOfAreas(const Cells& cells)
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

inline std::vector<Vec2> grid(int nx, int ny, Real h)
{
	std::vector<Vec2> seeds;
	for (int i = 0; i < nx; ++i)
		for (int j = 0; j < ny; ++j)
			seeds.push_back({ (i + 0.5) * h, (j + 0.5) * h });
	return seeds;
}

inline std::string refusal(const Polygon& region, const TessellationOptions& options)
{
	try {
		tessellate(region, options);
	} catch (const std::invalid_argument& e) {
		return e.what();
	}
	return "accepted";
}

inline void expectRefused(const Polygon& region, const TessellationOptions& options, const std::vector<std::string>& words)
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
inline bool strictlyInside(const Ring& ring, const Vec2& p)
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
inline Ring randomStar(Dice& dice, const Vec2& centre, Real smallest, Real largest, int corners)
{
	Ring ring;
	for (int k = 0; k < corners; ++k) {
		const Real angle = 2 * M_PI * (k + dice(0, 0.8)) / corners, radius = dice(smallest, largest);
		ring.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
	}
	return ring;
}

} // namespace cellchecks
