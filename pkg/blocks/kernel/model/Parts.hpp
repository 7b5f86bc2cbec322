// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/Joints.hpp>

/// How blocks are shared out among threads.
namespace blocks {

/// What a batch of joints does to the grid points a1, b1, a2, b2 of each [N].
struct JointForces {
	alignas(64) Real x[4][Joints::batch], y[4][Joints::batch];
};

/// A side of a joint in a crossing batch of an earlier part.
struct IncomingSide {
	int crossing, lane, side;
};

/// The blocks of one thread, and the batches of joints that begin with one of them.
struct Part {
	int                       firstBlock = 0, lastBlock = 0;
	int                       firstBatch = 0, lastBatch = 0;
	int                       firstCrossing = 0; ///< of its own, in Parts::crossing
	std::vector<IncomingSide> incoming;          ///< on its blocks, in the order of the joints
};

/// Batches that hold blocks of several parts are crossing: they are computed before the parts are, and their forces are kept.
struct Parts {
	int                      threads = 0, blocks = 0, joints = 0; ///< what it was made for
	std::vector<Part>        all;
	std::vector<int>         crossing; ///< batches, ascending
	std::vector<JointForces> forces;   ///< of each crossing batch
};

} // namespace blocks
