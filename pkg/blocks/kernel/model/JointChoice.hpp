// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// Joints by what they are between and by where they are.
namespace blocks {

/// Whether a joint is between blocks of these two materials, whichever comes first; twice the same: between blocks of one material.
bool isBetween(const BlockAssembly&, int joint, int material1, int material2);

/// Midway between a joint's two contact points, before anything has moved [m].
Vec2 builtAt(const BlockAssembly&, int joint);

/// Which of some joints were built within a region, or on its outline, in their order.
std::vector<int> jointsWithin(const BlockAssembly&, const Polygon& region, const std::vector<int>& joints);

} // namespace blocks
