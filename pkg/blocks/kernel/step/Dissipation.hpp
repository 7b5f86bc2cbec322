// yade-blocks, GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <blocks/kernel/step/JointBatch.hpp>

/// What joints dissipate in a step, by the trapezoidal rule: the work that their contact points took in less what their springs hold more.
/// Intact points dissipate nothing and are not asked. Exists only where somebody keeps accounts.
namespace blocks {

/// Contact points of a batch as they were at the last step.
struct BatchBefore {
	static constexpr int size = 2 * JointBatch::size;

	Real  opening[size], slip[size], sigma[size], tau[size];
	Joint status[size];

	// ---- only where some joint softens
	Real slipPlastic[size], softening[size], softenedOpening[size], slipLargest[size], crushing[size];

	/// From columns of a state or a history.
	template <class Columns> void take(const Columns& c, int firstJoint, int count)
	{
		const int from = 2 * firstJoint, n = 2 * count;
		std::copy_n(c.opening.data() + from, n, opening);
		std::copy_n(c.slip.data() + from, n, slip);
		std::copy_n(c.sigma.data() + from, n, sigma);
		std::copy_n(c.tau.data() + from, n, tau);
		std::copy_n(c.status.data() + from, n, status);
		if (c.softened.empty()) return;
		std::copy_n(c.slipPlastic.data() + from, n, slipPlastic);
		std::copy_n(c.softened.k.data() + from, n, softening);
		std::copy_n(c.softened.opening.data() + from, n, softenedOpening);
		std::copy_n(c.softened.slipLargest.data() + from, n, slipLargest);
		std::copy_n(c.softened.crushing.data() + from, n, crushing);
	}
};

/// Of joints first, first + 1, ..., whose new stresses are in the batch and whose new states are in the assembly [J].
Dissipated dissipatedIn(const BlockAssembly&, int first, int count, const BatchBefore&, const JointBatch&);

/// What the springs of joints first, first + 1, ... hold, with the stresses in the batch [J].
Real heldIn(const BlockAssembly&, int first, int count, const JointBatch&);

/// Adds what the batches dissipated to the accounts, in their order.
void bookDissipation(BlockAssembly&);

/// Adds what all joints dissipated where stresses came otherwise: from what they were to what they are.
void bookDissipation(BlockAssembly&, const JointHistory& before);

} // namespace blocks
