// yade-blocks, GPL-2.0-or-later
#pragma once
#include <array>
#include <blocks/kernel/model/RestColumns.hpp>
#include <vector>

/// Edge pairs that are worked on in every step, side by side: those that touch, and those of which is not known how far they are from it.
/// What a step needs of them was copied from the State; EdgePair says what it is. It stays from step to step, until somebody else changes a pair or it is
/// asked anew who rests.
namespace blocks {

/// Up to so many edge pairs. Arrays of four belong to the corners a0, a1, b0, b1, arrays of two to the ends of the overlap.
struct EdgeColumns {
	static constexpr int size = 16;
	using Lane                = Real[size];

	int                count = 0;
	int                place[size]; ///< of its contact in FreeContacts::order
	FreeContact*       contact[size];
	EdgePair*          pair[size];
	std::array<int, 4> node[size]; ///< grid points of the corners
	std::array<int, 2> side[size]; ///< where the forces on either block go, see FreeContacts::forces

	// ---- what does not change while a pair is in work
	alignas(64) Lane fromX[3] {}, fromY[3] {};                                          ///< a1, b0 and b1 as seen from a0, without stress [m]
	alignas(64) Lane sharpness[4] {}, rounding[2] {}, farRounding[2] {}, depthLimit {}; ///< see EdgeShape
	alignas(64) Lane kn {}, ks {}, cohesion {}, tanPhi {};                              ///< of the joint; residual values
	alignas(64) Lane uplift {};
	bool raised = false; ///< whether any uplift is not 0

	// ---- from step to step
	char touched[size]; ///< whether it did, as the pair has it: 1, 0, or -1 where that is to be looked up
	alignas(64) Lane slip[2] {}, area {};
};

/// The pairs of a run of contacts.
struct EdgesInWork {
	std::vector<EdgeColumns> batches;       ///< in the order of contacts and pairs
	std::vector<RestColumns> close;         ///< those that rest, but not for long
	bool                     anew  = true;  ///< whether the columns are to be filled whatever they hold
	bool                     apart = false; ///< whether some do not touch
	int                      steps = 0;     ///< since those were asked whether they can rest
	Real                     until = 0;     ///< no pair that is in neither comes to touch before Odometer::most() is this [m]

	/// To be filled anew, from so many pairs at most.
	void startAnew(size_t pairs)
	{
		makeRoom(batches, pairs), makeRoom(close, pairs);
		anew = true;
	}

private:
	template <class Columns> static void makeRoom(std::vector<Columns>& all, size_t pairs)
	{
		const size_t wanted = (pairs + Columns::size - 1) / Columns::size;
		if (wanted > all.capacity()) all.clear(), all.reserve(wanted);
	}
};

} // namespace blocks
