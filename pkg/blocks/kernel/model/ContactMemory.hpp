// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/Types.hpp>
#include <vector>

namespace blocks {

/// When neighbours were last looked for. It decides which contacts there are, and so masses; empty without general contact.
struct ContactMemory {
	std::vector<Vec2> detectedAt; ///< displacements at which the edge pairs of the grid point's block were last looked for [m]
	std::vector<Vec2> lookedAt;   ///< displacements at the last look [m]
	Real              mayGo = 0;  ///< until a grid point is this far from lookedAt, nobody need look [m]
	std::vector<char> loosened;   ///< of joints: whether corners know that it is not whole any more
};

} // namespace blocks
