// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/model/BlockAssembly.hpp>
#include <blocks/kernel/model/JointCorners.hpp>
#include <numeric>

namespace blocks {
namespace {

	/// Sets that grow together.
	class Sets {
	public:
		explicit Sets(int count)
			: parent(count)
		{
			std::iota(parent.begin(), parent.end(), 0);
		}
		int of(int i)
		{
			while (parent[i] != i)
				i = parent[i] = parent[parent[i]];
			return i;
		}
		void join(int i, int j) { parent[of(i)] = of(j); }

	private:
		std::vector<int> parent;
	};

	/// Whether joints hold two blocks together at a corner.
	bool heldAt(const BlockAssembly& a, int corner, int block1, int block2)
	{
		constexpr int         most = 16; // at a corner with more blocks these count as apart
		std::array<int, most> reached { block1 };
		int                   count = 1;
		const JointCorners&   c     = a.contacts.corners;
		for (bool grows = true; grows;) {
			grows = false;
			for (int i = c.first[corner]; i < c.first[corner + 1]; ++i) {
				if (a.state.search.loosened[c.joints[i]]) continue;
				const auto& two = a.joints.segments[c.joints[i]].block;
				const auto  known
					= [&](int block) { return std::find(reached.begin(), reached.begin() + count, block) != reached.begin() + count; };
				const bool first = known(two[0]);
				if (first == known(two[1]) || count == most) continue;
				reached[count++] = two[first];
				if (reached[count - 1] == block2) return true;
				grows = true;
			}
		}
		return false;
	}

} // namespace

JointCorners cornersOf(const BlockAssembly& a)
{
	const int joints = a.joints.count(), nodes = a.nodeCount();
	Sets      sets(nodes + 2 * joints); // grid points, then ends of joints
	for (int i = 0; i < joints; ++i) {
		const Segment& g = a.joints.segments[i];
		for (int k : { 0, 1 })
			for (int side : { 0, 1 }) {
				const Real s = side == 0 ? g.s1[k] : g.s2[k];
				if (s == 0 || s == 1) sets.join(nodes + 2 * i + k, g.node[2 * side + int(s)]);
			}
	}
	JointCorners     c;
	std::vector<int> number(nodes + 2 * joints, -1); // of the set that a thing stands for
	int              count = 0;
	c.ofJoint.resize(joints);
	for (int i = 0; i < joints; ++i)
		for (int k : { 0, 1 }) {
			int& n = number[sets.of(nodes + 2 * i + k)];
			if (n < 0) n = count++;
			c.ofJoint[i][k] = n;
		}
	c.ofNode.resize(nodes);
	for (int n = 0; n < nodes; ++n)
		c.ofNode[n] = number[sets.of(n)];
	c.first.assign(count + 1, 0);
	for (const auto& ends : c.ofJoint)
		for (int corner : ends)
			++c.first[corner + 1];
	std::partial_sum(c.first.begin(), c.first.end(), c.first.begin());
	std::vector<int> next = c.first;
	c.joints.resize(2 * joints);
	for (int i = 0; i < joints; ++i)
		for (int corner : c.ofJoint[i])
			c.joints[next[corner]++] = i;
	return c;
}

bool isWhole(const BlockAssembly& a, int joint)
{
	return !a.state.released[joint] && a.state.status[2 * joint] == Joint::intact && a.state.status[2 * joint + 1] == Joint::intact;
}

bool heldTogether(const BlockAssembly& a, const std::array<int, 2>& blocks, const std::array<int, 2>& edges)
{
	const std::vector<int>& corner = a.contacts.corners.ofNode;
	for (int n : a.mesh.edgeNodes[edges[0]])
		for (int m : a.mesh.edgeNodes[edges[1]])
			if (corner[n] >= 0 && corner[n] == corner[m] && heldAt(a, corner[n], blocks[0], blocks[1])) return true;
	return false;
}

} // namespace blocks
