// yade-blocks, GPL-2.0-or-later

#include <blocks/kernel/geometry/Cgal.hpp>
#include <blocks/kernel/geometry/Polygon.hpp>

#include <CGAL/Polygon_2_algorithms.h>

#include <algorithm>
#include <limits>

namespace blocks {
namespace {

	/// A vertex of a ring as CGAL's point, so that CGAL reads our rings as they are.
	struct Points {
		using iterator_category = std::random_access_iterator_tag;
		using value_type        = K::Point_2;
		using difference_type   = std::ptrdiff_t;
		using pointer           = const K::Point_2*;
		using reference         = K::Point_2;

		const Vec2* at = nullptr;

		K::Point_2 operator*() const { return toK(*at); }
		Points&    operator++() { return ++at, *this; }
		Points     operator++(int) { return { at++ }; }
		bool       operator==(const Points& other) const { return at == other.at; }
		bool       operator!=(const Points& other) const { return at != other.at; }
	};

	CGAL::Bounded_side sideOf(const Vec2& p, const Ring& ring)
	{
		return CGAL::bounded_side_2(Points { ring.data() }, Points { ring.data() + ring.size() }, toK(p), K());
	}

} // namespace

AreaSum moments(const Ring& ring) { return moments(Polygon { ring, {} }); }

AreaSum moments(const Polygon& polygon)
{
	AreaSum sum(polygon.outer[0]);
	forEachEdge(polygon, [&](const Vec2& a, const Vec2& b) { sum.add(a, b); });
	return sum;
}

Real signedArea(const Polygon& polygon)
{
	Real area = signedArea(polygon.outer);
	for (const Ring& hole : polygon.holes)
		area += signedArea(hole);
	return area;
}

Real perimeter(const Polygon& polygon)
{
	Real length = 0;
	forEachEdge(polygon, [&](const Vec2& a, const Vec2& b) { length += (b - a).norm(); });
	return length;
}

Real meanWidth(const Polygon& polygon) { return 2 * signedArea(polygon) / perimeter(polygon); }

Real largestCoordinate(const Polygon& polygon)
{
	Real largest = 0;
	for (const Vec2& p : polygon.outer)
		largest = std::max(largest, p.lpNorm<Eigen::Infinity>());
	return largest;
}

Real distanceFromOutline(const Vec2& p, const Polygon& polygon)
{
	Real least = std::numeric_limits<Real>::infinity();
	forEachEdge(polygon, [&](const Vec2& a, const Vec2& b) { least = std::min(least, awayFrom(a, b, p).norm()); });
	return least;
}

bool strictlyInside(const Vec2& p, const Polygon& polygon)
{
	if (sideOf(p, polygon.outer) != CGAL::ON_BOUNDED_SIDE) return false;
	for (const Ring& hole : polygon.holes)
		if (sideOf(p, hole) != CGAL::ON_UNBOUNDED_SIDE) return false;
	return true;
}

Vec2 innerPoint(const Polygon& polygon)
{
	std::vector<Real> heights; // of vertices
	forEachEdge(polygon, [&](const Vec2& a, const Vec2&) { heights.push_back(a.y()); });
	std::sort(heights.begin(), heights.end());
	Vec2 best    = moments(polygon).centroid();
	Real deepest = strictlyInside(best, polygon) ? distanceFromOutline(best, polygon) : 0;
	for (size_t i = 0; i + 1 < heights.size(); ++i) { // midway between the places where a level line enters and leaves
		const Real y = (heights[i] + heights[i + 1]) / 2;
		if (!(heights[i] < y && y < heights[i + 1])) continue;
		std::vector<Real> crossings;
		forEachEdge(polygon, [&](const Vec2& a, const Vec2& b) {
			if ((a.y() < y) != (b.y() < y)) crossings.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
		});
		std::sort(crossings.begin(), crossings.end());
		for (size_t k = 0; k + 1 < crossings.size(); k += 2) {
			const Vec2 p((crossings[k] + crossings[k + 1]) / 2, y);
			const Real depth = distanceFromOutline(p, polygon);
			if (depth > deepest && strictlyInside(p, polygon)) best = p, deepest = depth;
		}
	}
	return best;
}

Polygon holesClockwise(Polygon polygon)
{
	for (Ring& hole : polygon.holes)
		if (!hole.empty() && signedArea(hole) > 0) std::reverse(hole.begin(), hole.end());
	return polygon;
}

} // namespace blocks
