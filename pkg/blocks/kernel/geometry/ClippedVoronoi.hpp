// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/geometry/Diagram.hpp>

namespace blocks {

/// A region's part of a Voronoi diagram, with the shortest distance between two of its seeds [m].
struct ClippedVoronoi {
	Diagram diagram;
	Real    closestSeeds;
};

/// Throws std::invalid_argument if two seeds coincide.
ClippedVoronoi clippedVoronoi(const Walls& region, const std::vector<Vec2>& seeds);

} // namespace blocks
