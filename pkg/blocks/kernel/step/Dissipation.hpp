// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/step/JointBatch.hpp>

/// What joints dissipate in a step, by the trapezoidal rule: the work that their contact points took in less what their springs hold more.
/// Intact points dissipate nothing and are not asked. Exists only where somebody keeps accounts.
namespace blocks {

/// Contact points of a batch as they were at the last step.
struct BatchBefore {
	static constexpr int size = 2 * JointBatch::size;

	Real  opening[size], slip[size], sigma[size], tau[size];
	Joint status[size];

	void take(const State&, int firstJoint, int count);
};

/// Of joints first, first + 1, ..., whose new stresses are in the batch and whose new states are in the assembly [J].
Dissipated dissipatedIn(const BlockAssembly&, int first, int count, const BatchBefore&, const JointBatch&);

/// Adds what the batches dissipated to the accounts, in their order.
void bookDissipation(BlockAssembly&);

} // namespace blocks
