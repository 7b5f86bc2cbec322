// yade-blocks, GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <array>
#include <blocks/kernel/laws/EdgeContact.hpp>
#include <blocks/kernel/laws/JointLaw.hpp>
#include <limits>
#include <utility>
#include <vector>

/// Two blocks that are not joined, and the pairs of their edges.
namespace blocks {

/// Two edges of two blocks that touch or may do so soon. What a step writes lies in one cache line.
struct alignas(64) EdgePair {
	std::array<Real, 2> slip { 0, 0 };  ///< elastic slip of the two ends: tau / ks [m]
	std::array<Real, 2> sigma { 0, 0 }; ///< normal stress of the ends, tension positive [Pa]
	std::array<Real, 2> tau { 0, 0 };   ///< shear stress; positive drags the first block along e_A [Pa]
	Real                area      = 0;  ///< of each end, in the step of the stresses [m2]
	Real                potential = 0;  ///< of the normal stresses, per kn and thickness, while the edges touch [m3]

	std::array<int, 2> edge; ///< of the first block and of the second
	std::array<int, 4> node; ///< a0, a1, b0, b1
	bool               touching = false;
	Real               uplift   = 0; ///< see raised(): what the joint had dilated that became this pair; below 0 what overlapped then [m]
	EdgeShape          shape;
};

/// In place of when to ask a pair whether it rests on: it does not rest, it is in work.
constexpr Real inWork = std::numeric_limits<Real>::infinity();

/// What is known of a pair of edges that does not touch: as long as its corners are close to where they were, it goes on not touching.
struct Rest {
	Real                until = 0; ///< it does not touch before the paths of the two blocks add up to this, or is inWork [m]
	Real                free  = 0; ///< so close, the corners of A and those of B taken together; 0 where nothing is known [m]
	std::array<int, 4>  node {};   ///< a0, a1, b0, b1
	std::array<Vec2, 3> from;      ///< displacements of a1, b0, b1 less that of a0 when `free` was measured; none while it is 0 [m]
};

/// All that happens between two blocks, apart from their bonds.
struct FreeContact {
	std::array<int, 2>    block { -1, -1 }; ///< first < second; -1: an empty slot
	Real                  friction = 0;     ///< dissipated so far [J]
	std::vector<EdgePair> edges;            ///< sorted by edge
	std::vector<Rest>     rests;            ///< of each of `edges`
	std::vector<int>      active;           ///< those of `edges` that touch, as of the last step
	JointParams           joint;            ///< residual values count; kn = 0 until they are known

	/// The pair of these two edges, or none.
	const EdgePair* find(const std::array<int, 2>& edge) const
	{
		const auto at = std::lower_bound(edges.begin(), edges.end(), edge, [](const EdgePair& e, const std::array<int, 2>& k) { return e.edge < k; });
		return at != edges.end() && at->edge == edge ? &*at : nullptr;
	}
	EdgePair* find(const std::array<int, 2>& edge) { return const_cast<EdgePair*>(std::as_const(*this).find(edge)); }
};

} // namespace blocks
