// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/Types.hpp>
#include <cmath>
#include <vector>

namespace blocks {

/// How far blocks that have contacts have gone. Between two moments at which paths were brought up to date, a vertex moves by no more than its block's path
/// has grown.
struct Odometer {
	std::vector<Vec2> seenAt; ///< of grid points, displacements up to which the paths count [m]
	std::vector<Real> path;   ///< of blocks: the largest move of any of their grid points, summed [m]

	Real longest = 0; ///< the largest moves of all of them, summed [m]

	// ---- what the velocities say since then, for any grid point and along either axis
	int  steps     = 0; ///< since the paths were brought up to date
	Real unseen    = 0; ///< it may have gone this far since then [m]
	Real sinceLook = 0; ///< it may have gone this far since neighbours were last looked for [m]
	Real fastest   = 0; ///< largest velocity in the last step [m/s]

	/// By how much more two paths may add up to than they do [m].
	Real unseenOfTwo() const { return 2 * std::sqrt(Real(2)) * unseen; }
	/// Two paths add up to no more than what they did, and what this has grown by since [m].
	Real most() const { return 2 * longest + unseenOfTwo(); }
};

} // namespace blocks
