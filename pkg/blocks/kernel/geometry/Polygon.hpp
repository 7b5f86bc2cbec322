// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/Types.hpp>

/// What polygons are asked: how large, whether simple, what lies inside, what they have in common. Decided by CGAL's exact predicates.
namespace blocks {

/// Area, centroid and second moment of what lies to the left of directed edges, which are added one by one and must make closed lines.
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
	}
	Real area() const { return size; }                                                ///< [m2]
	Vec2 centroid() const { return origin + first / size; }                           ///< [m]
	Real secondMoment() const { return polar - size * (first / size).squaredNorm(); } ///< polar, about the centroid [m4]

private:
	Vec2 origin;
	Real size  = 0;
	Vec2 first = Vec2::Zero();
	Real polar = 0;
};

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

/// Throws std::invalid_argument unless every ring is simple with an area, the outer one counter-clockwise, the holes clockwise, inside it and
/// apart from each other. Rings that cross or touch are refused, not repaired. `name` begins the message.
void requireSimple(const Polygon&, const std::string& name);

/// Throws std::invalid_argument if edges, of one ring or of two, come nearer to each other than `clearance` [m], apart from those that share a vertex or
/// are joined by one more edge.
void requireClear(const Polygon&, Real clearance, const std::string& name);

/// Throws std::invalid_argument if an edge is shorter than this share of the region's outline: two vertices were meant to be one, and rounding parted them.
void requireLongEdges(const Polygon&, Real share, const std::string& name);

/// The polygon with its holes turned clockwise, whichever way they ran.
Polygon holesClockwise(Polygon);

/// The ring with those of `points` that lie on its edges (within `tolerance` [m], and farther than that from its vertices
/// and from each other) as further vertices, in order. Points keep their bits, so a neighbour's vertices become the ring's own.
Ring    withPointsOnEdges(const Ring&, const std::vector<Vec2>& points, Real tolerance);
Polygon withPointsOnEdges(const Polygon&, const std::vector<Vec2>& points, Real tolerance);

/// Parts into which an edge must be divided so that none is longer than `longest`; a multiple of it is not one part more.
int partsOf(Real length, Real longest);

/// The polygon with every edge longer than `longest` [m] divided into equal parts.
Polygon divided(const Polygon&, Real longest);

/// How deep two polygons are in each other: the largest distance from both outlines that a point of their common interior is found to have, which is at
/// least a third of the largest there is in each triangle of it; 0 if they touch at most [m].
Real overlapDepth(const Polygon&, const Polygon&);

} // namespace blocks
