// yade-blocks, GPL-2.0-or-later

#include <blocks/kernel/geometry/Cgal.hpp>
#include <blocks/kernel/geometry/Diagram.hpp>
#include <blocks/kernel/geometry/PolygonRules.hpp>

#include <algorithm>

namespace blocks {
namespace {

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
			const bool within = strictlyInside(region.holes[h][0], { r == 0 ? region.outer : region.holes[r - 1], {} });
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
	const auto  toWall = [&](int corner, int k) { return awayFrom(walls.corner[k], walls.corner[walls.next[k]], walls.corner[corner]).norm(); };
	const auto  joined = [&](int a, int b) { return walls.next[a] == b || walls.next[b] == a; };
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

} // namespace blocks
