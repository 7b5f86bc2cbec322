// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/geometry/Boxes.hpp>
#include <blocks/kernel/geometry/Polygon.hpp>
#include <blocks/kernel/model/BlockAssembly.hpp>

/// The outline of a block of the model.
namespace blocks {

/// As a polygon, as it is now, with its holes [m].
Polygon outlineOf(const BlockAssembly&, int block);

/// As it was built [m].
Polygon referenceOutlineOf(const BlockAssembly&, int block);

/// About a block, as it is now [m].
Box boxOf(const BlockAssembly&, int block);

/// Area, centroid, perimeter in the reference positions.
AreaSum referenceMoments(const BlockAssembly&, int block);

/// Mean length of its edges in the reference positions [m].
Real meanEdge(const BlockAssembly&, int block);

/// Triangles between the vertices of a block's outline, by their grid points: what rigid blocks, which have no zones, are drawn as.
std::vector<std::array<int, 3>> cornerTriangles(const BlockAssembly&, int block);

} // namespace blocks
