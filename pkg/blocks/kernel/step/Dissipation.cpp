// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/step/Dissipation.hpp>

namespace blocks {

namespace {
	/// What one point of a joint that softens dissipated by the area [J/m2].
	SofteningWork workOf(const BlockAssembly& a, int first, const BatchBefore& before, const JointBatch& b, int i, int k)
	{
		const int           p = 2 * i + k, point = 2 * first + p;
		const SofteningStep from { before.sigma[p],
			                   before.tau[p],
			                   { before.slipPlastic[p], 0, before.status[p] },
			                   { before.softening[p], before.softenedOpening[p], before.slipLargest[p], before.crushing[p] },
			                   false };
		const SofteningStep to { b.sigma[k][i], b.tau[k][i], a.state.joint(point), a.state.softened.of(point), false };
		return dissipated(
			a.joints.ofPoint(point),
			a.joints.softening[a.joints.kind[first + i]],
			from,
			before.opening[p],
			before.slip[p],
			to,
			b.opening[k][i],
			b.slip[k][i]);
	}
} // namespace

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
			if (a.joints.softens(first + i)) {
				const SofteningWork d    = workOf(a, first, before, b, i, k);
				const Real          area = a.joints.columns.area[first + i];
				sum.modeI += area * d.opening, sum.modeII += area * d.slip, sum.friction += area * d.friction, sum.cap += area * d.cap;
				continue;
			}
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
		const bool         soft  = a.joints.softens(first + i);
		for (int k : { 0, 1 }) {
			const Real sigma = b.sigma[k][i], tau = b.tau[k][i];
			const Real held = soft ? storedEnergy(joint, a.joints.softeningOf(first + i), a.state.softened.of(2 * (first + i) + k), sigma, tau)
					       : storedEnergy(joint, sigma, tau);
			sum += a.joints.columns.area[first + i] * held;
		}
	}
	return sum;
}

void bookDissipation(BlockAssembly& a)
{
	for (const Dissipated& d : a.forces.dissipated)
		a.state.accounts.friction += d.friction, a.state.accounts.fracture += d.fracture;
	if (a.state.softened.empty()) return;
	for (const Dissipated& d : a.forces.dissipated)
		a.state.softened.modeI += d.modeI, a.state.softened.modeII += d.modeII, a.state.softened.cap += d.cap;
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
