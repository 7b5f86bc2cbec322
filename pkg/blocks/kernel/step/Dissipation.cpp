// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/step/Dissipation.hpp>

namespace blocks {

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
			const Real work = (before.sigma[p] + sigma) / 2 * (b.opening[k][i] - before.opening[p])
				+ (before.tau[p] + tau) / 2 * (b.slip[k][i] - before.slip[p]);
			const Real stored = storedEnergy(joint, sigma, tau) - storedEnergy(joint, before.sigma[p], before.tau[p]);
			(before.status[p] == status ? sum.friction : sum.fracture) += a.joints.columns.area[first + i] * (work - stored);
		}
	}
	return sum;
}

Real heldIn(const BlockAssembly& a, int first, int count, const JointBatch& b)
{
	Real sum = 0;
	for (int i = 0; i < count; ++i) {
		if (a.state.released[first + i] || a.joints.kind[first + i] == 0) continue;
		const JointParams& joint = a.joints.of(first + i);
		for (int k : { 0, 1 })
			sum += a.joints.columns.area[first + i] * storedEnergy(joint, b.sigma[k][i], b.tau[k][i]);
	}
	return sum;
}

void bookDissipation(BlockAssembly& a)
{
	for (const Dissipated& d : a.forces.dissipated)
		a.state.accounts.friction += d.friction, a.state.accounts.fracture += d.fracture;
}

void bookDissipation(BlockAssembly& a, const JointHistory& history)
{
	const State& s = a.state;
	a.forces.dissipated.assign(a.forces.broke.size(), {});
	a.forces.jointEnergy.clear(); // nobody has kept it
	JointBatch  b;
	BatchBefore before;
	for (size_t batch = 0; batch < a.forces.dissipated.size(); ++batch) {
		const int first = int(batch) * Joints::batch, count = std::min(Joints::batch, a.joints.count() - first);
		for (int i = 0; i < count; ++i)
			for (int k : { 0, 1 }) {
				const int p     = 2 * (first + i) + k;
				b.opening[k][i] = s.opening[p], b.slip[k][i] = s.slip[p], b.sigma[k][i] = s.sigma[p], b.tau[k][i] = s.tau[p];
			}
		before.take(history, first, count);
		a.forces.dissipated[batch] = dissipatedIn(a, first, count, before, b);
	}
	bookDissipation(a);
}

} // namespace blocks
