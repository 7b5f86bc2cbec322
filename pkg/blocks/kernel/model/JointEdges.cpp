// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/model/JointEdges.hpp>

namespace blocks {

bool edgesTurned(const BlockAssembly& a, int joint)
{
	const auto& node = a.joints.segments[joint].node;
	return a.between(node[0], node[1]).dot(a.between(node[2], node[3])) > 0;
}

bool edgesPassed(const BlockAssembly& a, int joint)
{
	const auto& node = a.joints.segments[joint].node;
	const Real  slip = std::min(std::abs(a.state.slip[2 * joint]), std::abs(a.state.slip[2 * joint + 1]));
	return edgesTurned(a, joint) || slip > a.between(node[0], node[1]).norm() + a.between(node[2], node[3]).norm();
}

} // namespace blocks
