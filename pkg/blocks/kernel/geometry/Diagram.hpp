// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/geometry/Polygon.hpp>

/// A region cut into cells, as the steps of tessellate() hand it on: ClippedVoronoi makes it, HoleCuts and Merging change it.
namespace blocks {

using IntRing = std::vector<int>; ///< a closed line through nodes of a Diagram, by their numbers

/// Vertices nearer than this fraction of the cell size are one, and cells may be dented by so much: far above rounding, far below any use.
constexpr Real coincident = 1e-9;

/// The edges of the region, rings one after another: wall k leads from corner k to corner next[k], the material on its left.
struct Walls {
	std::vector<Vec2> corner;
	std::vector<int>  next;
	std::vector<int>  start; ///< first corner of each ring, and the number of corners at the end

	explicit Walls(const Polygon& region)
	{
		add(region.outer);
		for (const Ring& hole : region.holes)
			add(hole);
		start.push_back(int(corner.size()));
	}
	void add(const Ring& ring)
	{
		const int first = int(corner.size()), n = int(ring.size());
		start.push_back(first);
		for (int i = 0; i < n; ++i) {
			corner.push_back(ring[i]);
			next.push_back(first + (i + 1) % n);
		}
	}
	Vec2 along(int k) const { return corner[next[k]] - corner[k]; }
};

/// Where a vertex lies, and so how it may move.
struct Place {
	enum Kind { corner, onWall, inside } kind;
	int wall; ///< the wall it lies on (onWall), the corner's own number (corner)
};

/// One connected piece of a Voronoi cell.
struct Piece {
	IntRing              ring;
	int                  seed;
	std::vector<IntRing> holes; ///< holes of the region that lie in the piece, clockwise
};

struct Diagram {
	std::vector<Vec2>  position;
	std::vector<Place> place;
	std::vector<Piece> pieces;
};

inline Ring ringOf(const Diagram& d, const IntRing& nodes)
{
	Ring ring;
	for (int node : nodes)
		ring.push_back(d.position[node]);
	return ring;
}

inline Polygon outlineOf(const Diagram& d, const Piece& piece)
{
	Polygon outline { ringOf(d, piece.ring), {} };
	for (const IntRing& hole : piece.holes)
		outline.holes.push_back(ringOf(d, hole));
	return outline;
}

} // namespace blocks
