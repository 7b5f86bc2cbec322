// yade-blocks, GPL-2.0-or-later
#pragma once

#include <blocks/kernel/geometry/Polygon.hpp>

#include <cstdint>

namespace blocks {

/// What the user's `size` is: the average edge of a cell, or the square root of its average area.
enum class SizeMeaning { edge, sqrtArea };

/// Edge length to sqrt(area) of hexagon-like cells: a regular hexagon of edge e has the area 3 sqrt(3)/2 e^2 = (1.61 e)^2.
constexpr Real sqrtAreaOfUnitEdge = 1.61;

struct TessellationOptions {
	Real          size;                            ///< mean cell size [m]; see `meaning`
	SizeMeaning   meaning = SizeMeaning::sqrtArea; ///< number of cells = area/size^2, or area/(1.61 size)^2
	int           lloyd   = 2;                     ///< iterations: each seed moves to the centroid of its clipped cell
	std::uint64_t seed    = 1;                     ///< of the random points; the same seed gives the same bits
	/// Edges shorter than this fraction of s are merged, and cells thinner than it flattened, where that is possible;
	/// s = size (sqrtArea) or 1.61 size (edge), so that both meanings give the same cells. At 0 only what coincides is merged.
	Real              mergeFraction = 0.05;
	std::vector<Vec2> seeds; ///< explicit points [m] instead of random ones, one a cell; then `size` is only the scale of merging
};

/// A tiling of the region: every interior edge belongs to exactly two cells, every other edge lies on the region's outline.
struct Cells {
	std::vector<Vec2>             vertices;         ///< [m], each shared vertex once
	std::vector<std::vector<int>> cells;            ///< counter-clockwise rings of vertex indices
	Real                          meanEdge     = 0; ///< measured mean length of interior edges [m], 0 if there are none
	Real                          meanSqrtArea = 0; ///< measured mean of the cells' sqrt(area) [m]
};

/// Voronoi cells of `region`, which must pass requireSimple() and be nowhere thinner than a millionth of the cell size.
///  - Random seeds are plain uniform (a Poisson process of fixed number); what regularity is wanted comes from `lloyd`.
///  - Region corners (also those of 180 degrees) are vertices and never move. Vertices on an edge of the region stay
///    on it: exactly if it is parallel to an axis, else to the rounding of their coordinates.
///  - A Voronoi cell that a non-convex region cuts in pieces gives one cell a piece. A cell around a whole hole is cut
///    in two through the hole, one that passes a reflex corner by a neck narrower than a short edge at that neck. So there
///    may be more cells than seeds; merging may leave fewer.
///  - Cells are convex except at the region's own reflex corners; merging is refused where it would dent a cell by
///    more than 1e-9 s. Short edges are therefore rare, not impossible.
/// Throws std::logic_error if the cells' areas do not add up to the region's.
Cells tessellate(const Polygon& region, const TessellationOptions& options);

/// Cell `index` as coordinates.
Ring ringOf(const Cells& cells, size_t index);

} // namespace blocks
