// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/step/JointBatch.hpp>
#include <blocks/kernel/step/StiffnessDamping.hpp>
#include <blocks/kernel/step/ZoneForces.hpp>

namespace blocks {
namespace {

	template <Strain kind> void addZones(BlockAssembly& a, int block)
	{
		const Real   beta = a.supports.stiffnessDamping;
		const Moduli m    = moduliOf(a, block);
		const Vec2*  v    = a.state.velocity.data();
		Vec2*        f    = a.forces.rate.data();
		for (int z = a.mesh.firstZone[block]; z < a.mesh.firstZone[block + 1]; ++z) {
			const auto&         node = a.mesh.zoneNodes[z];
			const Vec2          p = v[node[1]] - v[node[0]], q = v[node[2]] - v[node[0]];
			const ZoneGradients g    = a.mesh.zoneGradient[z];
			const ZoneStrain    e    = strainOf(a, z);
			const ZoneStrain    rate = zoneStrainRate<kind>(g, e, p.x(), p.y(), q.x(), q.y());
			const ZoneForces    by   = zoneForcesOfAnyAxes<kind>(g, beta * a.mesh.zoneVolume[z], zoneStress(m, rate), e);
			const Vec2          f1(by.f1x, by.f1y), f2(by.f2x, by.f2y);
			f[node[0]] -= f1 + f2, f[node[1]] += f1, f[node[2]] += f2;
		}
	}

	/// Rates of opening and slip are those of the frame that turns with both edges, so that forces are their exact counterpart.
	void addJoints(BlockAssembly& a)
	{
		const Real          beta = a.supports.stiffnessDamping;
		const JointColumns& c    = a.joints.columns;
		JointBatch          b;
		for (int first = 0; first < a.joints.count(); first += JointBatch::size) {
			const int count = std::min(JointBatch::size, a.joints.count() - first);
			gatherDisplacements(a, first, count, b);
			moveJoints(c, first, count, b);
			for (int i = 0; i < count; ++i) {
				const auto&        node     = a.joints.node[first + i];
				const JointParams& joint    = a.joints.of(first + i);
				const Vec2*        v        = a.state.velocity.data();
				const Vec2         turning1 = v[node[1]] - v[node[0]], turning2 = v[node[3]] - v[node[2]], apart = v[node[2]] - v[node[0]];
				const Real omega = -(b.r1x[i] * turning1.x() + b.r1y[i] * turning1.y() + b.r2x[i] * turning2.x() + b.r2y[i] * turning2.y()) / 2;
				const bool deforms = a.mesh.mass[node[0]] > 0 && a.mesh.mass[node[2]] > 0;
				for (int k : { 0, 1 }) {
					const bool acts = deforms && !a.state.released[first + i] && a.state.status[2 * (first + i) + k] == Joint::intact;
					const Vec2 d    = apart + c.s2[k][first + i] * turning2 - c.s1[k][first + i] * turning1;
					b.sigma[k][i]   = acts ? beta * joint.kn * (d.x() * b.nx[i] + d.y() * b.ny[i] + omega * b.dt[k][i]) : 0;
					b.tau[k][i]     = acts ? beta * joint.ks * (d.y() * b.nx[i] - d.x() * b.ny[i] - omega * b.dn[k][i]) : 0;
				}
			}
			loadEdges(c, first, count, b);
			for (int i = 0; i < count; ++i)
				for (int k = 0; k < 4; ++k)
					a.forces.rate[a.joints.node[first + i][k]] += Vec2(b.force.x[k][i], b.force.y[k][i]);
		}
	}

} // namespace

void setStiffnessDamping(BlockAssembly& a, Real beta)
{
	require(beta >= 0 && std::isfinite(beta), "damping proportional to stiffness must not be negative [s]", beta);
	a.supports.stiffnessDamping = beta;
	a.forces.rate.clear();
}

void addStiffnessDamping(BlockAssembly& a, [[maybe_unused]] int threads)
{
	a.forces.rate.assign(a.nodeCount(), Vec2::Zero());
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
	for (int block = 0; block < a.blockCount(); ++block)
		a.strain == Strain::large ? addZones<Strain::large>(a, block) : addZones<Strain::small>(a, block);
	addJoints(a);
	for (int n = 0; n < a.nodeCount(); ++n)
		a.forces.nodal[n] += a.forces.rate[n];
}

Real stiffnessDampingPower(const BlockAssembly& a)
{
	Real sum = 0;
	for (size_t n = 0; n < a.forces.rate.size(); ++n)
		sum += a.forces.rate[n].dot(a.state.velocity[n]);
	return sum;
}

} // namespace blocks
