// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/step/Dissipation.hpp>

namespace blocks {

void BatchBefore::take(const State& s, int first, int count)
{
	const int from = 2 * first, n = 2 * count;
	std::copy_n(s.opening.data() + from, n, opening);
	std::copy_n(s.slip.data() + from, n, slip);
	std::copy_n(s.sigma.data() + from, n, sigma);
	std::copy_n(s.tau.data() + from, n, tau);
	std::copy_n(s.status.data() + from, n, status);
}

Dissipated dissipatedIn(const BlockAssembly& a, int first, int count, const BatchBefore& before, const JointBatch& b)
{
	Dissipated sum;
	for (int i = 0; i < count; ++i) {
		if (a.state.released[first + i]) continue;
		const JointParams& joint = a.joints.of(first + i);
		for (int k : { 0, 1 }) {
			const int   p      = 2 * i + k;
			const Joint status = a.state.status[2 * first + p];
			if (before.status[p] == Joint::intact && status == Joint::intact) continue;
			const Real sigma = b.sigma[k][i], tau = b.tau[k][i];
			const Real work = (before.sigma[p] + sigma) / 2 * (b.opening[k][i] - before.opening[p]) + (before.tau[p] + tau) / 2 * (b.slip[k][i] - before.slip[p]);
			const Real stored = storedEnergy(joint, sigma, tau) - storedEnergy(joint, before.sigma[p], before.tau[p]);
			(before.status[p] == status ? sum.friction : sum.fracture) += a.joints.columns.area[first + i] * (work - stored);
		}
	}
	return sum;
}

void bookDissipation(BlockAssembly& a)
{
	for (const Dissipated& d : a.forces.dissipated)
		a.state.accounts.friction += d.friction, a.state.accounts.fracture += d.fracture;
}

} // namespace blocks
