// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/step/TimeStep.hpp>

namespace blocks {
namespace {

	/// Largest singular value of [a b; c d].
	Real spectralNorm(Real a, Real b, Real c, Real d)
	{
		const Real square = a * a + b * b + c * c + d * d, det = a * d - b * c;
		return std::sqrt((square + std::sqrt(std::max(Real(0), square * square - 4 * det * det))) / 2);
	}

	/// Largest absolute principal value of the stress that a zone has in situ [Pa].
	Real inSituStress(const BlockAssembly& a, int zone, const Moduli& m)
	{
		const StrainColumns& e = a.mesh.inSitu;
		if (e.empty()) return 0;
		const ZoneStress t = zoneStress(m, { e.xx[zone], e.yy[zone], e.xy[zone], 1, 0 });
		return std::abs(t.sxx + t.syy) / 2 + std::hypot((t.sxx - t.syy) / 2, t.sxy);
	}

	void addZone(const BlockAssembly& a, int zone, const Moduli& m, std::vector<Real>& stiffness)
	{
		const Real          geometric = 2 * inSituStress(a, zone, m); // see nodalStiffness
		const ZoneGradients s         = a.mesh.zoneGradient[zone];
		const Vec2          g[3]      = { { -s.g1x - s.g2x, -s.g1y - s.g2y }, { s.g1x, s.g1y }, { s.g2x, s.g2y } };
		for (int i = 0; i < 3; ++i)
			for (int j = 0; j < 3; ++j) { // K_ij = V (lambda g_i g_j^T + mu (g_j g_i^T + g_i.g_j 1))
				const Real dot = m.mu * g[i].dot(g[j]), mixed = m.lambda + m.mu;
				const Real elastic = spectralNorm(
					mixed * g[i].x() * g[j].x() + dot,
					m.lambda * g[i].x() * g[j].y() + m.mu * g[j].x() * g[i].y(),
					m.lambda * g[i].y() * g[j].x() + m.mu * g[j].y() * g[i].x(),
					mixed * g[i].y() * g[j].y() + dot);
				const Real turning = geometric > 0 ? geometric * g[i].norm() * g[j].norm() : 0;
				stiffness[a.mesh.zoneNodes[zone][i]] += a.mesh.zoneVolume[zone] * (elastic + turning);
			}
	}

} // namespace

std::vector<Real> nodalStiffness(const BlockAssembly& a) { return nodalStiffness(a, zoneStiffness(a)); }

std::vector<Real> zoneStiffness(const BlockAssembly& a)
{
	std::vector<Real> stiffness(a.nodeCount(), 0);
	for (int block = 0; block < a.blockCount(); ++block) {
		const Material& material = a.mesh.materials[a.mesh.blockMaterial[block]];
		const Moduli    moduli   = planeModuli(material.young, material.poisson, a.plane);
		for (int z = a.mesh.firstZone[block]; z < a.mesh.firstZone[block + 1]; ++z)
			addZone(a, z, moduli, stiffness);
	}
	return stiffness;
}

std::vector<Real> nodalStiffness(const BlockAssembly& a, std::vector<Real> stiffness)
{
	for (int i = 0; i < a.joints.count(); ++i) {
		if (a.state.released[i]) continue;
		const JointParams& joint = a.joints.of(i);
		const Real         k     = std::max(joint.kn, joint.ks) + joint.kn * joint.tanDilation;
		const Segment&     g     = a.joints.segments[i];
		for (int p = 0; p < 2; ++p) { // K_ij = A k w_i w_j, and the weights of both sides add up to 2
			const Real weight[4] = { 1 - g.s1[p], g.s1[p], 1 - g.s2[p], g.s2[p] };
			for (int c = 0; c < 4; ++c)
				stiffness[g.node[c]] += 2 * k * g.area * weight[c];
		}
	}
	if (!a.contacts.order.empty()) { // a grid point may have an intact joint on one edge and a free contact on the other
		const std::vector<Real> contacts = contactStiffness(a);
		for (int n = 0; n < a.nodeCount(); ++n)
			stiffness[n] += contacts[n];
	}
	return stiffness;
}

std::vector<Real> contactStiffness(const BlockAssembly& a)
{
	// Overlaps do not overlap: the areas on one edge add up to its own, however many blocks there are. So its two vertices
	// get at most as much as from point contacts with all of T L on either vertex: 2 k (T L / 2) from each edge.
	std::vector<Real> stiffest(a.blockCount(), 0);
	auto              include = [&](int block, const JointParams& joint) { stiffest[block] = std::max({ stiffest[block], joint.kn, joint.ks }); };
	for (int i : a.contacts.order)
		for (int block : a.state.contacts[i].block)
			include(block, a.state.contacts[i].joint);
	for (size_t pair = 0; pair < a.joints.pairs.size(); ++pair)
		for (int block : a.joints.pairs[pair].block)
			if (stiffest[block] > 0) include(block, a.joints.of(a.joints.pairs[pair].first));

	std::vector<Real> stiffness(a.nodeCount(), 0);
	for (int b = 0; b < a.blockCount(); ++b)
		for (int e = a.mesh.firstEdge[b]; e < a.mesh.firstEdge[b + 1]; ++e) {
			const auto& node  = a.mesh.edgeNodes[e];
			const Real  share = stiffest[b] * a.thickness * (a.mesh.reference[node[1]] - a.mesh.reference[node[0]]).norm();
			stiffness[node[0]] += share;
			stiffness[node[1]] += share;
		}
	return stiffness;
}

std::vector<Real> touchStiffness(const BlockAssembly& a, const std::vector<Real>& stiffness)
{
	std::vector<Real>       sum      = stiffness;
	const std::vector<Real> contacts = contactStiffness(a);
	for (int n = 0; n < a.nodeCount(); ++n)
		sum[n] += 3 * contacts[n];
	return sum;
}

Real stableTimeStep(const BlockAssembly& a, const std::vector<Real>& stiffness, const std::vector<Real>& inertia)
{
	std::vector<char> driven(2 * a.nodeCount(), false); // a platen under a force moves freely, as one
	for (const MotionGroup& g : a.state.groups)
		if (g.drive == MotionGroup::Drive::velocity)
			for (int dof : g.dofs)
				driven[dof] = true;
	Real least = std::numeric_limits<Real>::infinity();
	for (int n = 0; n < a.nodeCount(); ++n)
		if (stiffness[n] > 0 && inertia[n] > 0 && !(driven[2 * n] && driven[2 * n + 1])) least = std::min(least, inertia[n] / stiffness[n]);
	const Real limit = 2 * std::sqrt(least), beta = a.supports.stiffnessDamping;
	return beta > 0 && std::isfinite(limit) ? limit * limit / (std::hypot(beta, limit) + beta) : limit;
}

void scaleInertia(BlockAssembly& a, const std::vector<Real>& stiffness, Real dt, Real safety)
{
	require(dt > 0 && std::isfinite(dt), "the time step must be positive [s]", dt);
	require(safety > 0, "safety must be positive", safety);
	for (int n = 0; n < a.nodeCount(); ++n)
		a.state.inertia[n] = a.mesh.mass[n] > 0 ? stiffness[n] * dt * dt / (4 * safety * safety) : 0;
	a.updateMobility();
}

} // namespace blocks
