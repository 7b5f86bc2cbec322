// yade-blocks, GPL-2.0-or-later
#pragma once
#include <array>
#include <vector>

/// Where joints end: places at which several blocks meet. Blocks that whole joints hold together at such a corner move apart by no more than these joints
/// yield, so what they have there is no contact.
namespace blocks {

struct BlockAssembly;

struct JointCorners {
	std::vector<int>                ofNode;  ///< grid point -> its corner, or -1
	std::vector<std::array<int, 2>> ofJoint; ///< joint -> the corners at its two ends
	std::vector<int>                first;   ///< corner -> where its joints begin; one more entry than there are corners
	std::vector<int>                joints;  ///< those that end at a corner, corner by corner
};

/// From the segments alone: ends that lie at a common grid point are one corner.
JointCorners cornersOf(const BlockAssembly&);

/// Whether both contact points of a joint are bonded as at first.
bool isWhole(const BlockAssembly&, int joint);

/// Whether an edge of either block has a corner in common with the other at which the blocks are held together: there is a way from one to the other by joints
/// that end there and were whole when corners were last looked at (ContactMemory::loosened).
bool heldTogether(const BlockAssembly&, const std::array<int, 2>& blocks, const std::array<int, 2>& edges);

} // namespace blocks
