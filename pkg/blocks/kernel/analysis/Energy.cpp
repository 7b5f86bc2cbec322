// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/analysis/Energy.hpp>

namespace blocks {
namespace {
	template <Strain kind> Real energyOfZone(const BlockAssembly& a, const Moduli& m, int z)
	{
		const auto& node = a.zoneNodes[z];
		const Vec2  p = a.position[node[1]] - a.position[node[0]], q = a.position[node[2]] - a.position[node[0]];
		return a.zoneVolume[z] * zoneEnergyDensity(m, zoneStrain<kind>(a.zoneGradient[z], p.x(), p.y(), q.x(), q.y()));
	}

	template <class Visit> void forEachPoint(const BlockAssembly& a, const Visit& visit)
	{
		for (size_t pair = 0; pair < a.pairs.size(); ++pair)
			for (int i = 2 * a.pairs[pair].first; i < 2 * a.pairs[pair].last; ++i)
				visit(a.joints[pair], a.points[i], a.segments[i / 2], i);
	}
} // namespace

Real zoneEnergy(const BlockAssembly& a)
{
	Real sum = 0;
	for (int block = 0; block < a.blockCount(); ++block) {
		const Material& material = a.materials[a.blockMaterial[block]];
		const Moduli    moduli   = planeModuli(material.young, material.poisson, a.plane);
		for (int z = a.firstZone[block]; z < a.firstZone[block + 1]; ++z)
			sum += a.strain == Strain::large ? energyOfZone<Strain::large>(a, moduli, z) : energyOfZone<Strain::small>(a, moduli, z);
	}
	return sum;
}

Real jointEnergy(const BlockAssembly& a)
{
	Real sum = 0;
	forEachPoint(a, [&](const JointParams& joint, const ContactPoint& p, const Segment& g, int) { sum += g.area * storedEnergy(joint, p.sigma, p.tau); });
	return sum + (a.contacts.order.empty() ? 0 : contactEnergy(a));
}

Real gridPointsKineticEnergy(const BlockAssembly& a)
{
	Real sum = 0;
	for (int n = 0; n < a.nodeCount(); ++n)
		sum += a.inertia[n] * a.velocity[n].squaredNorm() / 2;
	return sum;
}

Real kineticEnergy(const BlockAssembly& a)
{
	Real sum = gridPointsKineticEnergy(a);
	for (const RigidBlock& r : a.rigid)
		sum += (r.inertia * r.velocity.head<2>().squaredNorm() + r.rotaryInertia * r.velocity[2] * r.velocity[2]) / 2;
	return sum;
}

Real loadWork(const BlockAssembly& a)
{
	Real sum = 0;
	for (size_t n = 0; n < a.load.size(); ++n)
		sum += a.load[n].dot(a.position[n] - a.reference[n]);
	for (const RigidBlock& r : a.rigid)
		sum += r.load.dot(r.centre - r.origin);
	return sum;
}

Real groupWork(const BlockAssembly& a)
{
	Real sum = a.released.work;
	for (const MotionGroup& g : a.groups)
		sum += g.work;
	return sum;
}

Real rigidWork(const BlockAssembly& a)
{
	Real sum = 0;
	for (const RigidBlock& r : a.rigid)
		sum += r.work;
	return sum;
}

void JointDissipation::start(const BlockAssembly& a)
{
	before.clear();
	for (const ContactPoint& p : a.points)
		before.push_back({ p.opening, p.slip, p.sigma, p.tau, p.joint.status });
}

void JointDissipation::book(const BlockAssembly& a)
{
	forEachPoint(a, [&](const JointParams& joint, const ContactPoint& p, const Segment& g, int i) {
		Before&    b      = before[i];
		const Real work   = (b.sigma + p.sigma) / 2 * (p.opening - b.opening) + (b.tau + p.tau) / 2 * (p.slip - b.slip);
		const Real stored = storedEnergy(joint, p.sigma, p.tau) - storedEnergy(joint, b.sigma, b.tau);
		(b.status == p.joint.status ? friction : fracture) += g.area * (work - stored);
		b = { p.opening, p.slip, p.sigma, p.tau, p.joint.status };
	});
}

Real unbalancedRatio(const BlockAssembly& a, Real floor)
{
	Real unbalanced = 0, contact = 0;
	for (int n = 0; n < a.nodeCount(); ++n)
		for (int axis : { 0, 1 })
			if (a.mobility[n][axis] > 0) unbalanced += std::abs(a.force[n][axis]);
	for (const RigidBlock& r : a.rigid)
		unbalanced += r.unbalanced.head<2>().lpNorm<1>();
	for (size_t i = 0; i < a.points.size(); ++i) {
		const ContactPoint& p = a.points[i];
		const SegmentFrame& f = a.frames[i / 2];
		contact += a.segments[i / 2].area * (std::abs(p.sigma * f.nx - p.tau * f.ny) + std::abs(p.sigma * f.ny + p.tau * f.nx));
	}
	for (int i : a.contacts.order)
		for (int e : a.contacts.all[i].active) {
			const FourPoints& force = a.contacts.all[i].edges[e].force;
			contact += (force[0] + force[1]).lpNorm<1>();
		}
	const Real scale = 2 * std::max(contact, floor);
	return scale > 0 ? unbalanced / scale : 0;
}

} // namespace blocks
