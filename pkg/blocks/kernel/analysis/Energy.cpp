// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/analysis/Energy.hpp>
#include <blocks/kernel/step/ContactResults.hpp>
#include <blocks/kernel/step/Joints.hpp>
#include <blocks/kernel/step/ZoneForces.hpp>
#include <limits>

namespace blocks {

Real zoneEnergy(const BlockAssembly& a) { return lookAtZones(a).energy; }

Real sumOf(const std::vector<Real>& parts)
{
	Real sum = 0;
	for (Real part : parts)
		sum += part;
	return sum;
}

Real jointEnergy(const BlockAssembly& a)
{
	Real sum = 0;
	for (int i = 0; i < a.joints.count(); ++i) {
		if (a.state.released[i] || a.joints.kind[i] == 0) continue;
		const JointParams& joint = a.joints.of(i);
		for (int p : { 2 * i, 2 * i + 1 }) {
			const Real sigma = a.state.sigma[p], tau = a.state.tau[p];
			const Real held = a.joints.softens(i) ? storedEnergy(joint, a.joints.softeningOf(i), a.state.softened.of(p), sigma, tau)
							      : storedEnergy(joint, sigma, tau);
			sum += a.joints.segments[i].area * held;
		}
	}
	return sum + (a.contacts.order.empty() ? 0 : contactEnergy(a));
}

Real bookedJointEnergy(const BlockAssembly& a)
{
	if (a.forces.jointEnergy.empty()) return jointEnergy(a); // a law of one's own does not keep them
	return sumOf(a.forces.jointEnergy) + (a.contacts.order.empty() ? 0 : contactEnergy(a));
}

Real gridPointsKineticEnergy(const BlockAssembly& a)
{
	Real sum = 0;
	for (int n = 0; n < a.nodeCount(); ++n)
		sum += a.state.inertia[n] * a.state.velocity[n].squaredNorm() / 2;
	return sum;
}

Real kineticEnergy(const BlockAssembly& a)
{
	Real sum = gridPointsKineticEnergy(a);
	for (const RigidBlock& r : a.state.rigid)
		sum += (r.inertia * r.velocity.head<2>().squaredNorm() + r.rotaryInertia * r.velocity[2] * r.velocity[2]) / 2;
	return sum;
}

Real loadWork(const BlockAssembly& a)
{
	Real sum = 0;
	for (size_t n = 0; n < a.supports.load.size(); ++n)
		sum += a.supports.load[n].dot(a.state.displacement[n]);
	for (const RigidBlock& r : a.state.rigid)
		sum += r.load.dot(r.centre - r.origin);
	return sum;
}

Real groupWork(const BlockAssembly& a)
{
	Real sum = a.state.accounts.released.work;
	for (const MotionGroup& g : a.state.groups)
		sum += g.work;
	return sum;
}

Real rigidWork(const BlockAssembly& a)
{
	Real sum = 0;
	for (const RigidBlock& r : a.state.rigid)
		sum += r.work;
	return sum;
}

namespace {

	/// Sums of |Fx| + |Fy| over free degrees of freedom and over contacts [N].
	struct ForceSums {
		Real unbalanced = 0, contact = 0;
	};

	ForceSums forceSums(const BlockAssembly& a)
	{
		ForceSums sum;
		for (int n = 0; n < a.nodeCount(); ++n)
			for (int axis : { 0, 1 })
				if (a.supports.mobility[n][axis] > 0) sum.unbalanced += std::abs(a.forces.nodal[n][axis]);
		for (const RigidBlock& r : a.state.rigid)
			sum.unbalanced += r.unbalanced.head<2>().lpNorm<1>();
		for (int i = 0; i < a.joints.count(); ++i) {
			if (a.state.released[i]) continue;
			const JointFrame f = frameOf(a, i);
			for (int p : { 2 * i, 2 * i + 1 }) {
				const Real sigma = a.state.sigma[p], tau = a.state.tau[p];
				sum.contact += a.joints.segments[i].area * (std::abs(sigma * f.nx - tau * f.ny) + std::abs(sigma * f.ny + tau * f.nx));
			}
		}
		for (int i : a.contacts.order)
			forEachTouching(a.contacts, a.state.contacts[i], i, [&](const EdgePair&, const SideForce& on) {
				sum.contact += (on.force[0] + on.force[1]).lpNorm<1>();
			});
		return sum;
	}

} // namespace

Real unbalancedRatio(const BlockAssembly& a, Real floor)
{
	const ForceSums sum   = forceSums(a);
	const Real      scale = 2 * std::max(sum.contact, floor);
	return scale > 0 ? sum.unbalanced / scale : 0;
}

Real unrest(const BlockAssembly& a, Real time, Real floor)
{
	constexpr Real  never      = std::numeric_limits<Real>::infinity();
	const ForceSums sum        = forceSums(a);
	Real            unbalanced = sum.unbalanced, loads = 0, groups = 0;
	for (const Vec2& load : a.supports.load)
		loads += load.lpNorm<1>();
	for (const RigidBlock& r : a.state.rigid)
		loads += r.load.lpNorm<1>();
	for (const MotionGroup& g : a.state.groups) {
		if (g.target != 0 && g.ramp(time) < 1) return never;
		groups += std::abs(g.force);
		if (g.drive == MotionGroup::Drive::velocity) continue;
		Real force = g.target * g.ramp(time);
		for (int dof : g.dofs)
			force += a.forces.nodal[dof / 2][dof % 2];
		unbalanced += std::abs(force);
	}
	const Real scale   = std::max({ 2 * sum.contact, loads, groups, 2 * floor });
	const Real kinetic = kineticEnergy(a), stored = zoneEnergy(a) + jointEnergy(a);
	return std::max(unbalanced > 0 ? unbalanced / scale : 0, kinetic > 0 ? kinetic / stored : 0);
}

} // namespace blocks
