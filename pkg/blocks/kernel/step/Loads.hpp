// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// Dead loads.
namespace blocks {

/// Adds a uniform acceleration to the dead loads: true masses times g [m/s2].
void addGravity(BlockAssembly&, const Vec2& g);

/// Adds a force [N] on a grid point to the dead loads.
void addLoad(BlockAssembly&, int node, const Vec2& force);

/// Adds a traction [Pa] on a boundary edge (an index into edgeNodes) to the dead loads, half on each of its nodes.
void addTraction(BlockAssembly&, int edge, const Vec2& traction);

} // namespace blocks
