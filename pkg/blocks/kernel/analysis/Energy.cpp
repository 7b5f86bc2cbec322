// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/analysis/Energy.hpp>
#include <blocks/kernel/step/Contacts.hpp>
#include <blocks/kernel/step/Joints.hpp>
#include <blocks/kernel/step/ZoneForces.hpp>

namespace blocks {

Real zoneEnergy(const BlockAssembly& a)
{
	Real total = 0;
	for (int block = 0; block < a.blockCount(); ++block) {
		const Moduli moduli = moduliOf(a, block);
		Real         sum    = 0;
		for (int z = a.mesh.firstZone[block]; z < a.mesh.firstZone[block + 1]; ++z)
			sum += a.mesh.zoneVolume[z] * zoneEnergyDensity(moduli, strainOf(a, z));
		total += sum;
	}
	return total;
}

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

Real unbalancedRatio(const BlockAssembly& a, Real floor)
{
	Real unbalanced = 0, contact = 0;
	for (int n = 0; n < a.nodeCount(); ++n)
		for (int axis : { 0, 1 })
			if (a.supports.mobility[n][axis] > 0) unbalanced += std::abs(a.forces.nodal[n][axis]);
	for (const RigidBlock& r : a.state.rigid)
		unbalanced += r.unbalanced.head<2>().lpNorm<1>();
	for (int i = 0; i < a.joints.count(); ++i) {
		if (a.state.released[i]) continue;
		const JointFrame f = frameOf(a, i);
		for (int p : { 2 * i, 2 * i + 1 }) {
			const Real sigma = a.state.sigma[p], tau = a.state.tau[p];
			contact += a.joints.segments[i].area * (std::abs(sigma * f.nx - tau * f.ny) + std::abs(sigma * f.ny + tau * f.nx));
		}
	}
	for (int i : a.contacts.order)
		for (int e : a.state.contacts[i].active) {
			const FourPoints& force = a.state.contacts[i].edges[e].force;
			contact += (force[0] + force[1]).lpNorm<1>();
		}
	const Real scale = 2 * std::max(contact, floor);
	return scale > 0 ? unbalanced / scale : 0;
}

} // namespace blocks
