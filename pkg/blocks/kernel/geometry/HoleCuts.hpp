// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/geometry/Diagram.hpp>

namespace blocks {

/// Cuts pieces that surround whole holes in two, through the hole; `size` is that of a cell [m].
void cutAroundHoles(Diagram&, const Walls& region, Real size);

} // namespace blocks
