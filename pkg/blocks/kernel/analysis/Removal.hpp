// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// Blocks that are taken out of a scene: excavation, construction in stages.
namespace blocks {

/// Takes deformable blocks out: their joints carry nothing any more, contacts with them are forgotten, they have no mass, weight or stress and do not
/// move. Indices stay valid. What they and their joints held, motion included, goes to the accounts as removed; what loads have done on them stays work.
/// Blocks that are rigid or gone, those with grid points of groups or viscous boundaries, and all that are left are refused; nothing is changed then.
void removeBlocks(BlockAssembly&, std::vector<int> blocks);

} // namespace blocks
