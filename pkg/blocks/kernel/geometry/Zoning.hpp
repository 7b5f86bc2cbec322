// yade-blocks, GPL-2.0-or-later
#pragma once

#include <blocks/kernel/geometry/Polygon.hpp>

namespace blocks {

/// The triangular constant-strain zones of one block.
struct Zones {
	std::vector<Vec2> points; ///< [m], first those of the outline, ring by ring in its order, then the interior ones
	/// The outline's nodes: ring 0 the outer one, counter-clockwise, then the holes, clockwise: the material on the left.
	std::vector<std::vector<int>>   rings;
	std::vector<std::array<int, 3>> triangles; ///< counter-clockwise
};

/// The polygon's rings as points and no triangle: what a block without zones is made of.
Zones outlineOf(const Polygon&);

/// One point within the block and a triangle to each edge. The point is the centroid; if that does not see every edge,
/// the centroid of the region that does. Refuses a ring that no point sees whole.
Zones fanZones(const Ring& ring);

/// The corners alone, joined by the constrained Delaunay triangulation. Works for any simple polygon, with holes.
Zones cornerZones(const Polygon& polygon);
Zones cornerZones(const Ring& ring);

/// A rectangle (in any direction) as a grid of cells with edges <= zoneSize, two triangles each, diagonals alternating. Further vertices on its sides
/// are kept: if one is not a point of that grid, the zones are those of delaunayZones(), whose outline is divided between the vertices.
Zones regularZones(const Ring& ring, Real zoneSize);

enum class Outline {
	kept, ///< the outline's vertices exactly as given; an edge much longer than zoneSize then carries one flat zone
	split ///< outline edges longer than zoneSize divided into equal parts
};

/// A constrained Delaunay mesh with edges of about zoneSize [m], graded: smaller near short edges of the outline.
/// The outline is never changed beyond what `outline` says. Same input, same bits.
Zones delaunayZones(const Polygon& polygon, Real zoneSize, Outline outline = Outline::split);
Zones delaunayZones(const Ring& ring, Real zoneSize, Outline outline = Outline::split);

enum class Zoning { fan, corners, regular, delaunay };

/// Zones of a block of its own: its outline divided until no edge is longer than zoneSize [m], and the zoning that is asked for. Refuses holes where the
/// zoning has no place for them.
Zones regionZones(const Polygon& region, Zoning zoning, Real zoneSize);

/// A cell's zones, and which ones they are.
struct CellZones {
	Zones  zones;
	Zoning zoning;
};

/// Zones flatter than this (longest edge by least height, 1 for an equilateral triangle) make a cell unfit for a zoning. A cell of a tessellation with
/// edges of a twentieth of its size has zones of about 10.
constexpr Real sliverAspect = 30;

/// Zones of a cell of a tessellation: the wanted ones, unless no point sees all of a cell that is to be a fan, or one of them is a sliver; then those of
/// all the zonings (delaunay: with the outline kept and zones of the cell's size) whose worst zone is the least flat.
CellZones cellZones(const Ring& cell, Zoning wanted);

/// The triangles of a cell, each as a ring of its own.
std::vector<Ring> trianglesOf(const Ring& cell);

struct ZoneQuality {
	Real minAngle;    ///< [rad]
	Real maxAngle;    ///< [rad]
	Real minArea;     ///< [m^2]
	Real maxArea;     ///< [m^2]
	Real worstAspect; ///< longest edge by least height, 1 for an equilateral triangle (which sets the unit)
};
ZoneQuality quality(const Zones& zones);

} // namespace blocks
