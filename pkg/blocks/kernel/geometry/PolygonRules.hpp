// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/geometry/Polygon.hpp>

/// What a polygon must be to become blocks. Each throws std::invalid_argument; `name` begins the message.
namespace blocks {

/// Every ring is simple with an area, the outer one counter-clockwise, the holes clockwise, inside it and apart from each other. Rings that cross or touch
/// are refused, not repaired.
void requireSimple(const Polygon&, const std::string& name);

/// Edges, of one ring or of two, come nowhere nearer to each other than `clearance` [m], apart from those that share a vertex or are joined by one more edge.
void requireClear(const Polygon&, Real clearance, const std::string& name);

/// No edge is shorter than this share of the region's outline: two vertices were meant to be one, and rounding parted them.
void requireLongEdges(const Polygon&, Real share, const std::string& name);

} // namespace blocks
