// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

namespace blocks {

/// Refuses blocks that come too fast for their contact with another one: they would be deep in it, or past it, before it acts.
void refuseTunnelling(const BlockAssembly&, Real dt);

} // namespace blocks
