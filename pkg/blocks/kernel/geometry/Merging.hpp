// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/geometry/Diagram.hpp>
#include <blocks/kernel/geometry/Tessellation.hpp>

namespace blocks {

/// Merges edges shorter than `shortest` [m], shortest first, and flattens cells thinner than it, where that is possible; nodes within
/// `tolerance` of each other are one [m].
Cells mergeShortEdges(Diagram&, const Walls& region, Real shortest, Real tolerance);

} // namespace blocks
