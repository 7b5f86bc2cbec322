// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/FreeContact.hpp>
#include <limits>

namespace blocks {

/// In place of Rest::until: the pair rests so close to touching that its columns are asked in every step.
constexpr Real restsClose = std::numeric_limits<Real>::max();

/// Edge pairs that rest so close to touching that they are asked in every step, side by side: what their Rest says of where their corners were.
struct RestColumns {
	static constexpr int size = 16;
	using Lane                = Real[size];

	int                count = 0;
	int                place[size]; ///< of its contact in FreeContacts::order
	int                pair[size];  ///< in the contact
	std::array<int, 4> node[size];  ///< grid points of the corners

	alignas(64) Lane fromX[3] {}, fromY[3] {}, free {}; ///< see Rest

	/// The pair of this place rests in this lane.
	void set(int lane, int placeOfContact, int pairOfContact, const Rest& rest)
	{
		place[lane] = placeOfContact, pair[lane] = pairOfContact, node[lane] = rest.node;
		for (int k : { 0, 1, 2 })
			fromX[k][lane] = rest.from[k].x(), fromY[k][lane] = rest.from[k].y();
		free[lane] = rest.free;
	}
};

} // namespace blocks
