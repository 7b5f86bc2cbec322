// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// The outline of a block of the model as a polygon.
namespace blocks {

/// As it is now, with its holes [m].
Polygon outlineOf(const BlockAssembly&, int block);

/// Triangles between the vertices of a block's outline, by their grid points: what rigid blocks, which have no zones, are drawn as.
std::vector<std::array<int, 3>> cornerTriangles(const BlockAssembly&, int block);

} // namespace blocks
