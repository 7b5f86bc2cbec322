// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/geometry/Diagram.hpp>

namespace blocks {

/// Cuts pieces in two that surround holes, whole or but for less than a `shortest` edge; nodes within
/// `tolerance` of each other are one [m].
void cutAroundHoles(Diagram&, const Walls& region, Real shortest, Real tolerance);

} // namespace blocks
