// yade-blocks, GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <blocks/kernel/model/JointEdges.hpp>

/// What becomes of joints that have broken, and of the corners that they held.
namespace blocks {

/// How many of a joint's contact points are not bonded any more.
inline int brokenEnds(const BlockAssembly& a, int joint)
{
	auto isBroken = [](Joint status) { return status != Joint::intact && status != Joint::softening; };
	return isBroken(a.state.status[2 * joint]) + isBroken(a.state.status[2 * joint + 1]);
}

/// Whether a joint is asked in every step whether it is to be released.
inline bool isWaiting(const BlockAssembly& a, int joint) { return std::binary_search(a.contacts.waiting.begin(), a.contacts.waiting.end(), joint); }

/// A free contact has no cap.
inline bool hasCap(const BlockAssembly& a, int joint) { return a.joints.anyCap && a.joints.softeningOf(joint).cap.strength > 0; }

/// Whether these openings and slips are news for a joint: it is to be asked, and nobody does yet.
inline bool goesFree(const BlockAssembly& a, int joint, std::array<Real, 2> opening, std::array<Real, 2> slip)
{
	return brokenEnds(a, joint) == 2 && hasMovedOn(a, joint, opening, slip) && !isWaiting(a, joint) && !hasCap(a, joint);
}

/// Takes note of a joint that is to be released, or lets go of the corners at its ends.
void askWhether(BlockAssembly&, int joint);

/// Takes note of all joints: the next step asks which are to be released.
inline void askAllWhether(BlockAssembly& a) { std::fill(a.forces.broke.begin(), a.forces.broke.end(), char(true)); }

/// Takes note of the batches of joints in which a point has another status than the `known` one or a broken joint has moved on, and of all where nothing is
/// known; `known` becomes the present one. For laws that do not say what they break.
void noteBroken(BlockAssembly&, std::vector<Joint>& known);

/// Joints of which a point broke in the last step wait for their release.
void collectBroken(BlockAssembly&);

/// Joints have ceased to be whole: the blocks that they held together at their ends may meet there. Where they overlap already, by what joints yielded,
/// they are lowered until they only touch: what was there before is no contact.
void loosen(BlockAssembly&, Real dt);

/// Turns joints that wait no longer into free contacts. With `account`, what they held and their successors do not hold is booked.
void releaseBroken(BlockAssembly&, Real dt, bool account);

} // namespace blocks
