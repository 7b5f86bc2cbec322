// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// Finds the joints of an undeformed specimen.
namespace blocks {

/// Overlaps of boundary edges of different blocks: edges that look at each other, parallel and apart by no more than `tolerance`
/// times the shorter of the two or the narrower of their blocks (or than rounding). Every overlap longer than that becomes a Segment; their areas add up
/// to the common surface. Blocks that penetrate each other by more than the tolerance, or lie one within another, are refused. Works in n log n.
std::vector<Segment> detectSegments(const BlockAssembly&, Real tolerance = 1e-6);

/// Two blocks that touch, or nearly, and have no joint.
struct Unjoined {
	std::array<int, 2> block;
	Real               gap; ///< the least distance of the ends of their common edges [m]
};
/// All of them, by blocks: edges that face each other, apart by no more than this share of the shorter of the two or the narrower of their blocks.
std::vector<Unjoined> unjoinedBlocks(const BlockAssembly&, Real tolerance = 0.01);

} // namespace blocks
