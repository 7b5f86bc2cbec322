// yade-blocks, GPL-2.0-or-later

// How it works. Seeds, random or given, and their clipped Voronoi diagram; Lloyd's iteration, which moves each seed to the centroid of its cell
// and computes the diagram anew; then cells around whole holes are cut, and short edges merged.

#include <blocks/kernel/geometry/ClippedVoronoi.hpp>
#include <blocks/kernel/geometry/HoleCuts.hpp>
#include <blocks/kernel/geometry/Merging.hpp>
#include <blocks/kernel/geometry/PolygonRules.hpp>
#include <blocks/kernel/geometry/Tessellation.hpp>

#include <CGAL/hilbert_sort.h>
#include <algorithm>
#include <blocks/kernel/geometry/Cgal.hpp>
#include <limits>
#include <random>

namespace blocks {
namespace {

	/// A region, and what lies between its edges, may be no thinner than this fraction of the cell size: the tolerance with which blocks are bonded.
	/// Across a slit that is narrower, edges would be taken for a joint.
	constexpr Real thinnest = 1e-6;

	/// Each seed goes to the centroid of the largest piece of its cell; it stays where it is if that lies outside the piece.
	std::vector<Vec2> centroids(const Diagram& d, const std::vector<Vec2>& old)
	{
		std::vector<Real> largest(old.size(), 0);
		std::vector<Vec2> seeds = old;
		for (const Piece& piece : d.pieces) {
			const Polygon outline = outlineOf(d, piece);
			const AreaSum sum     = moments(outline);
			if (!(sum.area() > largest[piece.seed])) continue;
			largest[piece.seed] = sum.area();
			seeds[piece.seed]   = strictlyInside(sum.centroid(), outline) ? sum.centroid() : old[piece.seed];
		}
		return seeds;
	}

	int cellCount(Real area, Real s) { return std::max(1, int(std::lround(area / (s * s)))); }

	/// The same numbers on every machine and library, unlike std::uniform_real_distribution: 53 bits, in [0, 1).
	Real uniform(std::mt19937_64& random) { return Real(random() >> 11) * 0x1p-53; }

	/// Neighbours get numbers close to one another, so that a step finds them close in memory.
	std::vector<Vec2> alongHilbertCurve(const std::vector<Vec2>& seeds)
	{
		std::vector<K::Point_2> points = toK(seeds);
		CGAL::hilbert_sort(points.begin(), points.end(), CGAL::Hilbert_sort_middle_policy());
		std::vector<Vec2> sorted;
		for (const K::Point_2& p : points)
			sorted.push_back(fromK(p));
		return sorted;
	}

	std::vector<Vec2> randomSeeds(const Polygon& region, int count, std::uint64_t seed)
	{
		std::mt19937_64 random(seed);
		Vec2            low = region.outer[0], high = low;
		for (const Vec2& p : region.outer) {
			low  = low.cwiseMin(p);
			high = high.cwiseMax(p);
		}
		std::vector<Vec2> seeds;
		while (int(seeds.size()) < count) {
			const Real x = uniform(random), y = uniform(random);
			const Vec2 p = low + Vec2(x, y).cwiseProduct(high - low);
			if (strictlyInside(p, region)) seeds.push_back(p);
		}
		return alongHilbertCurve(seeds);
	}

	/// Checks the options and returns s, the nominal sqrt(area) of a cell [m].
	Real requireOptions(const Polygon& region, const TessellationOptions& o)
	{
		const bool edge = o.meaning == SizeMeaning::edge;
		const Real area = signedArea(region), s = edge ? sqrtAreaOfUnitEdge * o.size : o.size, largest = std::sqrt(area);
		require(o.size > 0 && std::isfinite(o.size), "Tessellation.size must be positive", o.size);
		require(s <= largest,
		        "Tessellation.size must not exceed " + shown(edge ? largest / sqrtAreaOfUnitEdge : largest) + ", at which the region is one cell",
		        o.size);
		require(area / (s * s) < 1e8, "Tessellation.size must be larger than sqrt(area)/1e4, as 1e8 cells are too many", o.size);
		require(o.lloyd >= 0, "Tessellation.lloyd must not be negative", o.lloyd);
		require(o.mergeFraction >= 0 && o.mergeFraction < 0.5, "Tessellation.mergeFraction must lie in [0, 0.5)", o.mergeFraction);
		for (size_t i = 0; i < o.seeds.size(); ++i)
			if (!o.seeds[i].allFinite() || !strictlyInside(o.seeds[i], region))
				throw std::invalid_argument(
					"Tessellation.seeds must lie inside the region, got (" + shown(o.seeds[i].x()) + ", " + shown(o.seeds[i].y())
					+ ") at index " + std::to_string(i));
		return s;
	}

	/// Whatever went wrong above: cells that do not fill the region, or reach beyond it, are not handed out.
	void requireWhole(const Cells& cells, const Polygon& region)
	{
		Real sum = 0;
		for (size_t i = 0; i < cells.cells.size(); ++i)
			sum += signedArea(ringOf(cells, i));
		const Real area = signedArea(region), eps = std::numeric_limits<Real>::epsilon();
		// Interior edges cancel. Vertices on the outline are off their wall by a few roundings of a coordinate.
		const Real rounding = eps * (16 * largestCoordinate(region) * perimeter(region) + 16 * area);
		if (!(std::abs(sum - area) <= rounding))
			throw std::logic_error("Tessellation: the cells' areas must add up to that of the region, " + shown(area) + " m2, got " + shown(sum));
	}

} // namespace

Cells tessellate(const Polygon& region, const TessellationOptions& options)
{
	requireSimple(region, "Tessellation.region");
	const Real s = requireOptions(region, options);
	requireClear(region, thinnest * s, "Tessellation.region");
	const Walls walls(region);
	auto        seeds = options.seeds.empty() ? randomSeeds(region, cellCount(signedArea(region), s), options.seed) : options.seeds;

	for (int i = 0;; ++i) {
		ClippedVoronoi voronoi = clippedVoronoi(walls, seeds);
		if (i == 0 && !options.seeds.empty())
			require(voronoi.closestSeeds > 1e-6 * s, "Tessellation.seeds must be farther apart than 1e-6 of the cell size", voronoi.closestSeeds);
		if (i < options.lloyd) {
			seeds = centroids(voronoi.diagram, seeds);
			continue;
		}
		// far from the origin, coordinates are rounded to more than that
		const Real tolerance = std::max(coincident * s, 16 * std::numeric_limits<Real>::epsilon() * largestCoordinate(region));
		const Real shortest  = std::max(options.mergeFraction * s, tolerance);
		cutAroundHoles(voronoi.diagram, walls, shortest, tolerance);
		const Cells cells = mergeShortEdges(voronoi.diagram, walls, shortest, tolerance);
		requireWhole(cells, region);
		return cells;
	}
}

Ring ringOf(const Cells& cells, size_t index)
{
	Ring ring;
	for (int node : cells.cells[index])
		ring.push_back(cells.vertices[node]);
	return ring;
}

} // namespace blocks
