// yade-blocks, GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <blocks/kernel/model/BlockAssembly.hpp>

/// Boxes about blocks and edges, where they are now.
namespace blocks {

struct Box {
	Vec2 low, high;

	void include(const Vec2& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); }
	bool meets(const Box& o, Real margin) const { return ((low - o.high).array() <= margin).all() && ((o.low - high).array() <= margin).all(); }
};

inline Box boxOf(const Vec2& p, const Vec2& q) { return { p.cwiseMin(q), p.cwiseMax(q) }; }

inline Box boxOf(const BlockAssembly& a, int block)
{
	Box box { a.position(a.mesh.firstNode[block]), a.position(a.mesh.firstNode[block]) };
	for (int e = a.mesh.firstEdge[block]; e < a.mesh.firstEdge[block + 1]; ++e)
		box.include(a.position(a.mesh.edgeNodes[e][0]));
	return box;
}

/// Blocks that have not been taken out.
inline std::vector<int> presentBlocks(const BlockAssembly& a)
{
	std::vector<int> list;
	for (int b = 0; b < a.blockCount(); ++b)
		if (!a.isRemoved(b)) list.push_back(b);
	return list;
}

} // namespace blocks
