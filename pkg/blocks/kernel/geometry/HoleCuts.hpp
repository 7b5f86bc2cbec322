// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/geometry/Diagram.hpp>

namespace blocks {

/// Cuts pieces in two that surround holes, whole or but for less than a `shortest` edge; `size` is that of a cell [m].
void cutAroundHoles(Diagram&, const Walls& region, Real shortest, Real size);

} // namespace blocks
