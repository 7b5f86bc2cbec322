// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/model/EdgeShapes.hpp>
#include <blocks/kernel/model/Outline.hpp>
#include <blocks/kernel/step/EdgeDetection.hpp>

namespace blocks {
namespace {

	/// Edges from how far out of the facing half-circle are kept as candidates: -e_A.e_B above this. Until they are looked for anew, vertices of a block
	/// move by 2 mayMove mean edges at most. A block whose vertices do so turns by less than that over half a mean edge, 0.064. Two blocks turn against
	/// each other by 0.13. What strains turn an edge by, whatever its length, comes to it: for the two blocks together 7 % are left.
	constexpr Real turnedAway = -0.2;
	/// Whether two edges touch, or can do so when their four vertices move by `margin` together.
	bool mayTouch(const Vec2& a0, const Vec2& a1, const Vec2& b0, const Vec2& b1, Real margin)
	{
		const Vec2 eA = (a1 - a0).normalized(), eB = (b1 - b0).normalized();
		const Real c = -eA.dot(eB);
		if (c < turnedAway) return false;
		const Real deepest = std::max({ cross(b0 - a0, eB), cross(b0 - a1, eB), cross(a0 - b1, eA), cross(a0 - b0, eA) });
		if (deepest < -margin) return false;
		if (c < 0.1) return true; // too far turned for a common direction to tell
		const Vec2 t    = (eA - eB).normalized();
		const Real side = std::min({ (a1 - a0).dot(t), (b0 - b1).dot(t), (a1 - b1).dot(t), (b0 - a0).dot(t) });
		// where an edge turns about its far end, the overlap changes by more than its vertices move; c >= 0.1 bounds it
		return side > -2 * margin - 0.05 * std::min((a1 - a0).norm(), (b1 - b0).norm());
	}

} // namespace

std::vector<std::array<int, 2>> edgesOfJoints(const BlockAssembly& a, const std::array<int, 2>& blocks, bool releasedToo)
{
	std::vector<std::array<int, 2>> list;
	const int                       pair = pairOf(a, blocks);
	if (pair < 0) return list;
	for (int s = a.joints.pairs[pair].first; s < a.joints.pairs[pair].last; ++s)
		if (releasedToo || !a.state.released[s]) list.push_back(edgesOf(a, a.joints.segments[s]));
	std::sort(list.begin(), list.end());
	return list;
}

void detectEdges(BlockAssembly& a, FreeContact& contact)
{
	const FreeContacts& f      = a.contacts;
	const auto          bonded = edgesOfJoints(a, contact.block, false), joined = edgesOfJoints(a, contact.block, true);
	// each block's vertices may have moved by mayMove since they were last looked at, and will again
	const Real margin = 2 * FreeContacts::mayMove * (f.meanEdge[contact.block[0]] + f.meanEdge[contact.block[1]]);
	const Real reach  = margin + 2 * std::min(f.depthLimit[contact.block[0]], f.depthLimit[contact.block[1]]); // a vertex may be this deep
	const Box  other  = boxOf(a, contact.block[1]);

	std::vector<EdgePair> found;
	auto                  old = contact.edges.begin();
	for (int i = a.mesh.firstEdge[contact.block[0]]; i < a.mesh.firstEdge[contact.block[0] + 1]; ++i) {
		const Vec2 a0 = a.position(a.mesh.edgeNodes[i][0]), a1 = a.position(a.mesh.edgeNodes[i][1]);
		const Box  box = boxOf(a0, a1);
		if (!meet(box, other, reach)) continue;
		for (int j = a.mesh.firstEdge[contact.block[1]]; j < a.mesh.firstEdge[contact.block[1] + 1]; ++j) {
			const Vec2               b0 = a.position(a.mesh.edgeNodes[j][0]), b1 = a.position(a.mesh.edgeNodes[j][1]);
			const std::array<int, 2> key { i, j };
			while (old != contact.edges.end() && old->edge < key)
				++old;
			const bool known = old != contact.edges.end() && old->edge == key;
			if (!meet(box, boxOf(b0, b1), reach) || !mayTouch(a0, a1, b0, b1, margin + (known ? old->uplift : 0))) continue;
			if (std::binary_search(bonded.begin(), bonded.end(), key)) continue;
			if (!std::binary_search(joined.begin(), joined.end(), key) && heldTogether(a, contact.block, key)) continue;
			if (known) {
				found.push_back(*old);
				continue;
			}
			EdgePair e {};
			e.edge = key;
			nameEdges(a, e);
			found.push_back(e);
		}
	}
	contact.edges = std::move(found);
	forgetActive(contact);
}

std::vector<int> makeNeighbours(BlockAssembly& a, const std::vector<std::array<int, 2>>& pairs)
{
	std::vector<std::array<int, 2>>    near;
	std::vector<std::vector<EdgePair>> edges;
	for (const auto& pair : pairs) {
		FreeContact candidate;
		candidate.block = pair;
		detectEdges(a, candidate);
		if (candidate.edges.empty()) continue;
		near.push_back(pair);
		edges.push_back(std::move(candidate.edges));
	}
	makeContacts(a, near);
	std::vector<int> made;
	for (size_t i = 0; i < near.size(); ++i) {
		made.push_back(contactOf(a, near[i][0], near[i][1]));
		FreeContact& contact = a.state.contacts[made.back()];
		contact.edges        = std::move(edges[i]);
		forgetActive(contact);
	}
	return made;
}

} // namespace blocks
