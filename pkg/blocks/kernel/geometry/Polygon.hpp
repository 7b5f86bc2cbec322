// yade-blocks, GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <blocks/kernel/Types.hpp>

/// What polygons are asked: how large, what lies inside, what they have in common. What is inside is decided by CGAL's exact predicates.
namespace blocks {

/// Of a triangle, positive if it is counter-clockwise [m2].
inline Real twiceArea(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a); }

/// Area of what lies to the left of a closed line through n points at(0), at(1), ... Seen from the first one, so that far from (0, 0) nothing is lost [m2].
template <class At> Real signedArea(size_t n, const At& at)
{
	Real twice = 0;
	for (size_t i = 0; i < n; ++i)
		twice += twiceArea(at(0), at(i), at((i + 1) % n));
	return twice / 2;
}
inline Real signedArea(const Ring& ring)
{
	return signedArea(ring.size(), [&](size_t i) -> const Vec2& { return ring[i]; });
}

/// From the nearest point of the line from a to b [m].
inline Vec2 awayFrom(const Vec2& a, const Vec2& b, const Vec2& p)
{
	const Vec2 along = b - a;
	return p - a - std::clamp((p - a).dot(along) / along.squaredNorm(), Real(0), Real(1)) * along;
}

/// Area, centroid, second moment and perimeter of what lies to the left of directed edges, which are added one by one and must make closed lines.
class AreaSum {
public:
	/// From a point nearby, so that far from (0, 0) nothing is lost in rounding [m].
	explicit AreaSum(const Vec2& nearby)
		: origin(nearby)
	{
	}
	void add(const Vec2& a, const Vec2& b)
	{
		const Vec2 p = a - origin, q = b - origin;
		const Real twice = cross(p, q);
		size += twice / 2;
		first += twice / 6 * (p + q);
		polar += twice / 12 * (p.squaredNorm() + q.squaredNorm() + p.dot(q));
		length += (q - p).norm();
	}
	Real area() const { return size; }                                                ///< [m2]
	Vec2 centroid() const { return origin + first / size; }                           ///< [m]
	Real secondMoment() const { return polar - size * (first / size).squaredNorm(); } ///< polar, about the centroid [m4]
	Real perimeter() const { return length; }                                         ///< [m]

private:
	Vec2 origin;
	Real size  = 0;
	Vec2 first = Vec2::Zero();
	Real polar = 0, length = 0;
};

/// Of closed lines that are given as edges, by the numbers of their points.
template <class Edges> AreaSum moments(const std::vector<Vec2>& points, Edges edge, Edges last)
{
	AreaSum sum(points[(*edge)[0]]);
	for (; edge != last; ++edge)
		sum.add(points[(*edge)[0]], points[(*edge)[1]]);
	return sum;
}

AreaSum moments(const Ring&);
AreaSum moments(const Polygon&);
Real    signedArea(const Polygon&); ///< the holes, clockwise, taken off [m2]
Real    perimeter(const Polygon&);  ///< with the holes' [m]
Real    meanWidth(const Polygon&);  ///< twice the area by the perimeter: half the side of a square, the width of a long strip [m]

/// The largest absolute coordinate [m]; its rounding is that of the polygon's vertices.
Real largestCoordinate(const Polygon&);

/// The least distance of a point from the outline, that of holes included [m].
Real distanceFromOutline(const Vec2&, const Polygon&);

/// Whether a point is inside, and neither on the outline nor in a hole. Exact.
bool strictlyInside(const Vec2&, const Polygon&);

/// Some point strictly inside, as far from the outline as is easily found.
Vec2 innerPoint(const Polygon&);

/// The polygon with its holes turned clockwise, whichever way they ran.
Polygon holesClockwise(Polygon);

/// work(a, b) for every edge from a to b, ring by ring.
template <class Work> void forEachEdge(const Polygon& polygon, const Work& work)
{
	const auto go = [&](const Ring& ring) {
		for (size_t k = 0, n = ring.size(); k < n; ++k)
			work(ring[k], ring[(k + 1) % n]);
	};
	go(polygon.outer);
	for (const Ring& hole : polygon.holes)
		go(hole);
}

/// How deep two polygons are in each other: the largest distance from both outlines that a point of their common interior is found to have, which is at
/// least a third of the largest there is in each triangle of it; 0 if they touch at most [m].
Real overlapDepth(const Polygon&, const Polygon&);

} // namespace blocks
