// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// Which edges of two blocks can touch soon.
namespace blocks {

/// A segment between bonded blocks as a pair of edges.
inline std::array<int, 2> edgesOf(const BlockAssembly& a, const Segment& g) { return { a.contacts.edgeFrom[g.node[0]], a.contacts.edgeFrom[g.node[2]] }; }

/// Edge pairs [sorted] that segments of two blocks occupy: those that are not released, or all.
std::vector<std::array<int, 2>> edgesOfJoints(const BlockAssembly&, const std::array<int, 2>& blocks, bool releasedToo);

/// Looks for the edge pairs of a contact; those that it had keep their slip.
void detectEdges(BlockAssembly&, FreeContact&);

/// Contacts of those pairs of blocks [sorted, without a contact] that have edges which can touch soon. Which contacts they are.
std::vector<int> makeNeighbours(BlockAssembly&, const std::vector<std::array<int, 2>>& pairs);

} // namespace blocks
