// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// How sharp and how deep the edges of blocks are, for contact. From the reference positions, so that it never changes.
namespace blocks {

/// Of all blocks, into the assembly's contacts.
void computeShapes(BlockAssembly&);

/// The nodes and shape of a pair of edges, from its two edges.
void nameEdges(const BlockAssembly&, EdgePair&);

} // namespace blocks
