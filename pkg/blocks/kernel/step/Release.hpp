// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// What becomes of joints that have broken, and of the corners that they held.
namespace blocks {

/// Takes note of a joint that is to be released, or lets go of the corners at its ends.
void askWhether(BlockAssembly&, int joint);

/// Takes note of the batches of joints in which a point has another status than the `known` one, and of all where nothing is known; `known` becomes the
/// present one. For laws that do not say what they break.
void noteBroken(BlockAssembly&, std::vector<Joint>& known);

/// Joints of which a point broke in the last step wait for their release.
void collectBroken(BlockAssembly&);

/// Joints have ceased to be whole: the blocks that they held together at their ends may meet there. Where they overlap already, by what joints yielded,
/// they are lowered until they only touch: what was there before is no contact.
void loosen(BlockAssembly&, Real dt);

/// Turns joints that wait no longer into free contacts. With `account`, what they held and their successors do not hold is booked.
void releaseBroken(BlockAssembly&, Real dt, bool account);

} // namespace blocks
