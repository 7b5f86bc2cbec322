// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// What a group of grid points that move as one puts on the blocks, in the last step.
namespace blocks {

/// Along x and along y, 0 where it does not act [N]. The parts of two axes accelerate alike.
Vec2 groupForce(const BlockAssembly&, const MotionGroup&);

/// Of the forces on all its grid points, about a point, counter-clockwise [N m].
Real groupMoment(const BlockAssembly&, const MotionGroup&, const Vec2& about);

} // namespace blocks
