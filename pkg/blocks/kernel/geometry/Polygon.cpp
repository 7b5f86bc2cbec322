// yade-blocks, GPL-2.0-or-later

#include <blocks/kernel/geometry/Cgal.hpp>
#include <blocks/kernel/geometry/Diagram.hpp>
#include <blocks/kernel/geometry/Polygon.hpp>

#include <CGAL/Polygon_2_algorithms.h>

#include <algorithm>
#include <limits>

namespace blocks {
namespace {

	template <class Visit> void forEachEdge(const Polygon& polygon, const Visit& visit)
	{
		const auto go = [&](const Ring& ring) {
			for (size_t k = 0, n = ring.size(); k < n; ++k)
				visit(ring[k], ring[(k + 1) % n]);
		};
		go(polygon.outer);
		for (const Ring& hole : polygon.holes)
			go(hole);
	}

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

	std::string shownPoint(const Vec2& p) { return "(" + shown(p.x()) + ", " + shown(p.y()) + ")"; }

	std::string ringName(int ring) { return ring == 0 ? "outer" : "holes[" + std::to_string(ring - 1) + "]"; }

	/// Visits all pairs of walls whose x-ranges are nearer than a margin; a sweep leaves few of them.
	template <class Visit> void forEachNearPair(const Walls& walls, Real margin, const Visit& visit)
	{
		const int        n = int(walls.corner.size());
		std::vector<int> byLeft(n), open;
		for (int i = 0; i < n; ++i)
			byLeft[i] = i;
		const auto left  = [&](int k) { return std::min(walls.corner[k].x(), walls.corner[walls.next[k]].x()) - margin; };
		const auto right = [&](int k) { return std::max(walls.corner[k].x(), walls.corner[walls.next[k]].x()); };
		std::sort(byLeft.begin(), byLeft.end(), [&](int a, int b) { return std::make_pair(left(a), a) < std::make_pair(left(b), b); });
		for (int k : byLeft) {
			open.erase(std::remove_if(open.begin(), open.end(), [&](int o) { return right(o) < left(k); }), open.end());
			for (int o : open)
				visit(std::min(o, k), std::max(o, k));
			open.push_back(k);
		}
	}

	/// "holes[0] edge 2 from (0, 1) to (3, 1)"
	std::string wallName(const Walls& walls, int k)
	{
		const int ring = int(std::upper_bound(walls.start.begin(), walls.start.end(), k) - walls.start.begin()) - 1;
		return ringName(ring) + " edge " + std::to_string(k - walls.start[ring]) + " from " + shownPoint(walls.corner[k]) + " to "
			+ shownPoint(walls.corner[walls.next[k]]);
	}

	/// Refuses walls that cross, touch or fold back, naming both.
	void requireApart(const Walls& walls, const std::string& name)
	{
		const auto wall  = [&](int k) { return K::Segment_2(toK(walls.corner[k]), toK(walls.corner[walls.next[k]])); };
		const auto clash = [&](int a, int b) { // do they share more than the corner they should share?
			if (walls.next[a] == b || walls.next[b] == a) {
				if (walls.next[b] == a) std::swap(a, b);
				if (walls.next[b] == a) return true; // a ring of two edges
				const auto p = toK(walls.corner[a]), q = toK(walls.corner[b]), r = toK(walls.corner[walls.next[b]]);
				return CGAL::collinear(p, q, r) && !CGAL::collinear_are_strictly_ordered_along_line(p, q, r);
			}
			return CGAL::do_intersect(wall(a), wall(b));
		};
		forEachNearPair(walls, 0, [&](int a, int b) {
			if (clash(a, b))
				throw std::invalid_argument(name + " must not cross or touch itself, got " + wallName(walls, a) + " and " + wallName(walls, b));
		});
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
	forEachEdge(polygon, [&](const Vec2& a, const Vec2& b) {
		const Real s = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), Real(0), Real(1));
		least        = std::min(least, (p - a - s * (b - a)).norm());
	});
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

void requireSimple(const Polygon& region, const std::string& name)
{
	const Walls walls(region);
	for (int r = 0; r + 1 < int(walls.start.size()); ++r) {
		const int         n    = walls.start[r + 1] - walls.start[r];
		const std::string ring = name + "." + ringName(r);
		require(n >= 3, ring + " must have at least 3 vertices", n);
		Real perimeter = 0;
		for (int k = walls.start[r]; k < walls.start[r + 1]; ++k) {
			const Vec2& p = walls.corner[k];
			if (!p.allFinite())
				throw std::invalid_argument(
					ring + " must have finite coordinates, got " + shownPoint(p) + " at vertex " + std::to_string(k - walls.start[r]));
			if (p == walls.corner[walls.next[k]])
				throw std::invalid_argument(
					ring + " must have distinct vertices, got " + shownPoint(p) + " twice, at vertex " + std::to_string(k - walls.start[r])
					+ " and the next");
			perimeter += walls.along(k).norm();
		}
		const Real area = signedArea(r == 0 ? region.outer : region.holes[r - 1]);
		require(std::abs(area) > 1e-12 * perimeter * perimeter, ring + " must have an area", area);
	}
	requireApart(walls, name);
	require(signedArea(region.outer) > 0, name + ".outer must be counter-clockwise (area positive)", signedArea(region.outer));
	for (size_t h = 0; h < region.holes.size(); ++h) {
		const std::string hole = name + "." + ringName(int(h) + 1);
		require(signedArea(region.holes[h]) < 0, hole + " must be clockwise (area negative)", signedArea(region.holes[h]));
		for (size_t r = 0; r <= region.holes.size(); ++r) {
			if (r == h + 1) continue;
			const bool within = sideOf(region.holes[h][0], r == 0 ? region.outer : region.holes[r - 1]) == CGAL::ON_BOUNDED_SIDE;
			if (within != (r == 0))
				throw std::invalid_argument(
					hole + (r == 0 ? " must lie inside " : " must lie outside ") + ringName(int(r)) + ", got its vertex "
					+ shownPoint(region.holes[h][0]));
		}
	}
}

void requireLongEdges(const Polygon& region, Real share, const std::string& name)
{
	const Walls walls(region);
	const Real  shortest = share * perimeter(region);
	for (int k = 0; k < int(walls.corner.size()); ++k)
		if (const Real length = walls.along(k).norm(); length < shortest)
			throw std::invalid_argument(
				name + "'s vertices must be farther apart than " + shown(shortest, 3) + " m, got " + shown(length, 3) + " m at "
				+ wallName(walls, k) + ": leave one of the two out");
}

void requireClear(const Polygon& region, Real clearance, const std::string& name)
{
	const Walls walls(region);
	const auto  toWall = [&](int corner, int k) {
                const Vec2& p = walls.corner[corner];
                const Vec2  a = walls.corner[k], t = walls.along(k);
                return (p - a - std::clamp((p - a).dot(t) / t.squaredNorm(), Real(0), Real(1)) * t).norm();
	};
	const auto joined = [&](int a, int b) { return walls.next[a] == b || walls.next[b] == a; };
	forEachNearPair(walls, clearance, [&](int a, int b) {
		const int afterA = walls.next[a], afterB = walls.next[b];
		if (joined(a, b) || joined(afterA, b) || joined(afterB, a)) return; // a short wall is no gap
		const Real gap = std::min({ toWall(a, b), toWall(afterA, b), toWall(b, a), toWall(afterB, a) });
		if (gap < clearance)
			throw std::invalid_argument(
				name + "'s edges must be farther apart than " + shown(clearance) + " m, got " + shown(gap) + " m between " + wallName(walls, a)
				+ " and " + wallName(walls, b));
	});
}

Polygon holesClockwise(Polygon polygon)
{
	for (Ring& hole : polygon.holes)
		if (!hole.empty() && signedArea(hole) > 0) std::reverse(hole.begin(), hole.end());
	return polygon;
}

Ring withPointsOnEdges(const Ring& ring, const std::vector<Vec2>& points, Real tolerance)
{
	require(tolerance >= 0 && std::isfinite(tolerance), "withPointsOnEdges: tolerance must be positive", tolerance);
	Ring out;
	for (size_t k = 0, n = ring.size(); k < n; ++k) {
		const Vec2 &a = ring[k], &b = ring[(k + 1) % n];
		const Real  length = (b - a).norm();
		const Vec2  t      = (b - a) / length;

		std::vector<std::pair<Real, const Vec2*>> onEdge; // by distance from a
		for (const Vec2& p : points) {
			const Real along = t.dot(p - a);
			if (along > tolerance && along < length - tolerance && std::abs(cross(t, p - a)) <= tolerance) onEdge.emplace_back(along, &p);
		}
		std::stable_sort(onEdge.begin(), onEdge.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
		out.push_back(a);
		Real last = 0;
		for (const auto& [along, p] : onEdge) {
			if (along - last <= tolerance) continue;
			out.push_back(*p);
			last = along;
		}
	}
	return out;
}

Polygon withPointsOnEdges(const Polygon& polygon, const std::vector<Vec2>& points, Real tolerance)
{
	Polygon out { withPointsOnEdges(polygon.outer, points, tolerance), {} };
	for (const Ring& hole : polygon.holes)
		out.holes.push_back(withPointsOnEdges(hole, points, tolerance));
	return out;
}

int partsOf(Real length, Real longest) { return std::max(1, int(std::ceil(length / longest * (1 - 1e-9)))); }

Polygon divided(const Polygon& polygon, Real longest)
{
	const auto divide = [&](const Ring& ring) {
		Ring out;
		for (size_t k = 0, n = ring.size(); k < n; ++k) {
			const Vec2 &a = ring[k], &b = ring[(k + 1) % n];
			const int   parts = partsOf((b - a).norm(), longest);
			for (int p = 0; p < parts; ++p)
				out.push_back(a + (b - a) * p / parts);
		}
		return out;
	};
	Polygon out { divide(polygon.outer), {} };
	for (const Ring& hole : polygon.holes)
		out.holes.push_back(divide(hole));
	return out;
}

} // namespace blocks
