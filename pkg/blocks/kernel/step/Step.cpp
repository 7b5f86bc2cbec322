// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/step/Step.hpp>

namespace blocks {

void sumForces(BlockAssembly& a, bool account, int threads)
{
	const auto forcesOfBatch = [&](int batch, JointBatch& b) {
		const int first = batch * Joints::batch, count = step::jointsIn(a, batch);
		gatherDisplacements(a, first, count, b);
		moveJoints(a.joints.columns, first, count, b);
		step::loadStresses(a, first, count, b);
		loadEdges(a.joints.columns, first, count, b);
	};
	step::sweep(a, forcesOfBatch, account, threads);
}

} // namespace blocks
