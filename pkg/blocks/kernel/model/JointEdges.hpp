// yade-blocks, GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <blocks/kernel/laws/EdgeContact.hpp>
#include <blocks/kernel/model/BlockAssembly.hpp>

/// How far the two edges of a joint have come from where they were bonded.
namespace blocks {

/// A broken joint stays one until its edges have moved by this share of their common length. Up to there a free contact says nearly the same, for it blends its
/// ends over up to as much.
constexpr Real staysFor = roundingFraction;

/// Whether the contact points of a joint that is not released have moved on, by these openings and slips.
inline bool hasMovedOn(const BlockAssembly& a, int joint, std::array<Real, 2> opening, std::array<Real, 2> slip)
{
	Real farthest = 0;
	for (int k : { 0, 1 }) {
		if (!a.joints.inSituOpening.empty()) // opened and slid without displacement
			opening[k] -= a.joints.inSituOpening[joint][k], slip[k] -= a.joints.inSituSlip[joint][k];
		farthest = std::max({ farthest, std::abs(opening[k]), std::abs(slip[k]) });
	}
	return farthest * a.thickness > staysFor * 2 * a.joints.columns.area[joint];
}

/// Whether the edges of a joint, which ran against each other when it was bonded, have turned by more than a right angle.
bool edgesTurned(const BlockAssembly&, int joint);

/// Whether the edges of a joint have turned so, or have slid past each other. The law of a joint means nothing then.
bool edgesPassed(const BlockAssembly&, int joint);

} // namespace blocks
