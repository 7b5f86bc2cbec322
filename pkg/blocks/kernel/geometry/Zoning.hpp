// yade-blocks, GPL-2.0-or-later
#pragma once

#include <blocks/kernel/Types.hpp>

namespace blocks {

/// The triangular constant-strain zones of one block.
struct Zones {
	std::vector<Vec2> points; ///< [m], first those of the outline, ring by ring in its order, then the interior ones
	/// The outline's nodes: ring 0 the outer one, counter-clockwise, then the holes, clockwise: the material on the left.
	std::vector<std::vector<int>>   rings;
	std::vector<std::array<int, 3>> triangles; ///< counter-clockwise
};

/// One point within the block and a triangle to each edge. The point is the centroid; if that does not see every edge,
/// the centroid of the region that does. Refuses a ring that no point sees whole.
Zones fanZones(const Ring& ring);

/// The corners alone, joined by the constrained Delaunay triangulation. Works for any simple polygon, with holes.
Zones cornerZones(const Polygon& polygon);
Zones cornerZones(const Ring& ring);

/// A rectangle (in any direction) as a grid of cells with edges <= zoneSize, two triangles each, diagonals alternating.
/// A ring of more than 4 vertices gives delaunayZones() with the outline kept, so that a brick keeps its neighbours' vertices.
Zones regularZones(const Ring& ring, Real zoneSize);

enum class Outline {
	kept, ///< the outline's vertices exactly as given; an edge much longer than zoneSize then carries one flat zone
	split ///< outline edges longer than zoneSize divided into equal parts
};

/// A constrained Delaunay mesh with edges of about zoneSize [m], graded: smaller near short edges of the outline.
/// The outline is never changed beyond what `outline` says. Same input, same bits.
Zones delaunayZones(const Polygon& polygon, Real zoneSize, Outline outline = Outline::split);
Zones delaunayZones(const Ring& ring, Real zoneSize, Outline outline = Outline::split);

struct ZoneQuality {
	Real minAngle;    ///< [rad]
	Real maxAngle;    ///< [rad]
	Real minArea;     ///< [m^2]
	Real maxArea;     ///< [m^2]
	Real worstAspect; ///< longest edge by least height, 1 for an equilateral triangle (which sets the unit)
};
ZoneQuality quality(const Zones& zones);

} // namespace blocks
