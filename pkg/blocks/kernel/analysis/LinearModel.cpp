// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/analysis/LinearModel.hpp>
#include <blocks/kernel/step/Step.hpp>
#include <blocks/kernel/step/ZoneForces.hpp>
#include <limits>

namespace blocks {
namespace {

	using Triplets = std::vector<Eigen::Triplet<Real>>;

	void requireJointsOnly(const BlockAssembly& a)
	{
		for (int i = 0; i < a.joints.count(); ++i) {
			const auto&       block = a.joints.segments[i].block;
			const std::string who   = "the joint between blocks " + std::to_string(block[0]) + " and " + std::to_string(block[1]);
			if (a.joints.kind[i] == 0) throw std::runtime_error(who + " has no properties yet; give them to bond(), or run one step first");
			for (int p : { 2 * i, 2 * i + 1 })
				if (a.state.status[p] == Joint::softening || a.joints.softeningOf(i).cap.strength > 0)
					throw std::runtime_error(who + " softens, or has a cap; events are known of brittle joints only");
		}
		for (const FreeContact& c : a.state.contacts)
			if (!c.active.empty())
				throw std::runtime_error(
					"blocks " + std::to_string(c.block[0]) + " and " + std::to_string(c.block[1])
					+ " touch without a bond, so the answer is not linear");
	}

	void numberUnknowns(const BlockAssembly& a, LinearModel& m)
	{
		std::vector<char> taken(2 * a.nodeCount(), false);
		auto              next = [&](int block) {
                        m.blockOfUnknown.push_back(block);
                        return m.unknowns++;
		};
		for (size_t i = 0; i < a.state.groups.size(); ++i) {
			const MotionGroup& g      = a.state.groups[i];
			const bool         pushed = g.drive == MotionGroup::Drive::force;
			const int          shared = pushed ? next(a.blockOfNode(g.dofs.front() / 2)) : LinearModel::driven;
			m.groupUnknown.push_back(shared);
			for (int dof : g.dofs) {
				taken[dof] = true;
				if (pushed)
					m.motion[dof].unknown[0] = shared, m.motion[dof].factor[0] = 1;
				else
					m.motion[dof].byLoad = m.growth.group[i];
			}
		}
		for (size_t i = 0; i < a.state.rigid.size(); ++i) {
			const RigidBlock& r = a.state.rigid[i];
			int               of[3];
			for (int k : { 0, 1, 2 })
				m.rigidUnknown.push_back(of[k] = r.free[k] ? next(r.block) : LinearModel::driven);
			for (int n = a.mesh.firstNode[r.block]; n < a.mesh.firstNode[r.block + 1]; ++n) {
				const Vec2 arm = a.position(n) - r.centre;
				for (int axis : { 0, 1 }) {
					LinearModel::Motion& d    = m.motion[2 * n + axis];
					const Real           turn = axis == 0 ? -arm.y() : arm.x();
					taken[2 * n + axis]       = true;
					d.unknown                 = { of[axis], of[2] };
					d.factor                  = { of[axis] < 0 ? 0. : 1., of[2] < 0 ? 0. : turn };
					if (of[axis] < 0) d.byLoad += m.growth.rigid[i][axis];
					if (of[2] < 0) d.byLoad += turn * m.growth.rigid[i][2];
				}
			}
		}
		for (int block = 0; block < a.blockCount(); ++block)
			for (int dof = 2 * a.mesh.firstNode[block]; dof < 2 * a.mesh.firstNode[block + 1]; ++dof)
				if (!taken[dof]) m.motion[dof].unknown[0] = next(block), m.motion[dof].factor[0] = 1;
	}

	/// Adds a force on a degree of freedom to the unknowns that move it.
	void addForce(const LinearModel& m, int dof, Real force, Vector& onUnknowns, Real& onDriven)
	{
		const LinearModel::Motion& d = m.motion[dof];
		for (int k : { 0, 1 })
			if (d.unknown[k] >= 0) onUnknowns[d.unknown[k]] += d.factor[k] * force;
		onDriven += d.byLoad * force;
	}

	void assembleZones(const BlockAssembly& a, LinearModel& m)
	{
		Triplets entries;
		entries.reserve(21 * a.zoneCount());
		for (int block = 0; block < a.blockCount(); ++block) {
			const Moduli moduli = moduliOf(a, block);
			for (int z = a.mesh.firstZone[block]; z < a.mesh.firstZone[block + 1]; ++z) {
				const ZoneGradients s    = a.mesh.zoneGradient[z];
				const Vec2          g[3] = { { -s.g1x - s.g2x, -s.g1y - s.g2y }, { s.g1x, s.g1y }, { s.g2x, s.g2y } };
				for (int i = 0; i < 6; ++i)
					for (int j = 0; j < 6; ++j) {
						const Vec2 &gi = g[i / 2], &gj = g[j / 2];
						const int   p = i % 2, q = j % 2;
						const Real  k = a.mesh.zoneVolume[z]
							* (moduli.lambda * gi[p] * gj[q] + moduli.mu * gj[p] * gi[q] + (p == q ? moduli.mu * gi.dot(gj) : 0));
						const LinearModel::Motion &row    = m.motion[2 * a.mesh.zoneNodes[z][i / 2] + p],
									  &column = m.motion[2 * a.mesh.zoneNodes[z][j / 2] + q];
						const int r = row.unknown[0], c = column.unknown[0];
						if (r >= 0 && c >= r) entries.emplace_back(r, c, k);
						if (r >= 0) m.zonesDriven[r] += k * column.byLoad;
						m.drivenDriven += row.byLoad * k * column.byLoad;
					}
			}
		}
		m.zones.resize(m.unknowns, m.unknowns);
		m.zones.setFromTriplets(entries.begin(), entries.end());
	}

	void readPoints(const BlockAssembly& a, LinearModel& m)
	{
		m.points.resize(a.pointCount());
		for (int joint = 0; joint < a.joints.count(); ++joint) {
			const Segment&   g = a.joints.segments[joint];
			const JointFrame f = frameOf(a, joint);
			for (int k : { 0, 1 }) {
				const int    i       = 2 * joint + k;
				LinearPoint& p       = m.points[i];
				p                    = {};
				p.joint              = a.joints.of(joint);
				p.state              = a.state.joint(i);
				p.area               = a.state.released[joint] ? 0 : g.area;
				p.opening            = a.state.opening[i];
				p.slip               = a.state.slip[i];
				p.block              = g.block;
				p.edge               = std::min(a.between(g.node[0], g.node[1]).norm(), a.between(g.node[2], g.node[3]).norm());
				const Real weight[4] = { g.s1[k] - 1, -g.s1[k], 1 - g.s2[k], g.s2[k] };
				const Real n[2] = { f.nx, f.ny }, t[2] = { -f.ny, f.nx };
				auto       feel = [&](int unknown, Real byN, Real byT) {
                                        int at = 0;
                                        while (at < p.count && p.unknown[at] != unknown)
                                                ++at;
                                        if (at == p.count) ++p.count, p.unknown[at] = unknown;
                                        p.n[at] += byN;
                                        p.t[at] += byT;
				};
				for (int corner = 0; corner < 4; ++corner)
					for (int axis : { 0, 1 }) {
						const LinearModel::Motion& d = m.motion[2 * g.node[corner] + axis];
						for (int j : { 0, 1 })
							if (d.unknown[j] >= 0)
								feel(d.unknown[j],
								     weight[corner] * n[axis] * d.factor[j],
								     weight[corner] * t[axis] * d.factor[j]);
						p.nDriven += weight[corner] * n[axis] * d.byLoad;
						p.tDriven += weight[corner] * t[axis] * d.byLoad;
					}
			}
		}
	}

} // namespace

LinearModel linearise(const BlockAssembly& assembly, const Growth& growth, int growing)
{
	requireJointsOnly(assembly);
	if (!assembly.mesh.inSitu.empty()) throw std::runtime_error("the linear model knows no stresses in situ");
	if (!assembly.mesh.removed.empty()) throw std::runtime_error("the linear model knows no removed blocks");
	LinearModel m;
	m.growth = growth;
	m.motion.resize(2 * assembly.nodeCount());
	numberUnknowns(assembly, m);
	m.zonesDriven = m.zoneForce = m.load = m.loadGrowth = Vector::Zero(m.unknowns);

	BlockAssembly a = assembly; // forces are computed in a copy
	updateKinematics(a, allJoints(a));
	readPoints(a, m);
	assembleZones(a, m);

	a.supports.load.clear();
	a.supports.stiffnessDamping = 0;
	a.state.sigma.assign(a.pointCount(), 0);
	a.state.tau.assign(a.pointCount(), 0);
	sumForces(a); // of the zones alone
	for (int dof = 0; dof < 2 * a.nodeCount(); ++dof)
		addForce(m, dof, -a.forces.nodal[dof / 2][dof % 2], m.zoneForce, m.zoneForceDriven);
	for (int dof = 0; dof < 2 * int(assembly.supports.load.size()); ++dof)
		addForce(m, dof, assembly.supports.load[dof / 2][dof % 2], m.load, m.loadDriven);
	for (size_t i = 0; i < a.state.groups.size(); ++i)
		if (m.groupUnknown[i] >= 0) {
			m.load[m.groupUnknown[i]] += int(i) == growing ? a.state.groups[i].force : a.state.groups[i].target;
			m.loadGrowth[m.groupUnknown[i]] += growth.group[i];
		}
	for (size_t i = 0; i < a.state.rigid.size(); ++i)
		for (int k : { 0, 1 }) {
			const int unknown = m.rigidUnknown[3 * i + k];
			if (unknown >= 0)
				m.load[unknown] += a.state.rigid[i].load[k];
			else
				m.loadDriven += growth.rigid[i][k] * a.state.rigid[i].load[k];
		}
	return m;
}

void displace(BlockAssembly& a, const LinearModel& m, const Vector& u, Real lambda)
{
	a.contacts.odometer.unseen = a.contacts.odometer.sinceLook = std::numeric_limits<Real>::infinity();
	for (int block = 0; block < a.blockCount(); ++block)
		if (a.mesh.firstZone[block] != a.mesh.firstZone[block + 1])
			for (int dof = 2 * a.mesh.firstNode[block]; dof < 2 * a.mesh.firstNode[block + 1]; ++dof) {
				const LinearModel::Motion& d = m.motion[dof];
				a.state.displacement[dof / 2][dof % 2] += d.byLoad * lambda + (d.unknown[0] >= 0 ? d.factor[0] * u[d.unknown[0]] : 0);
			}
	for (size_t i = 0; i < a.state.rigid.size(); ++i) {
		RigidBlock& r = a.state.rigid[i];
		Vec3        by;
		for (int k : { 0, 1, 2 })
			by[k] = m.rigidUnknown[3 * i + k] >= 0 ? u[m.rigidUnknown[3 * i + k]] : lambda * m.growth.rigid[i][k];
		r.centre += by.head<2>();
		const Real c = std::cos(by[2] / 2), s = std::sin(by[2] / 2);
		r.halfTurn        = { c * r.halfTurn.x() - s * r.halfTurn.y(), s * r.halfTurn.x() + c * r.halfTurn.y() };
		const Real cosine = r.halfTurn.x() * r.halfTurn.x() - r.halfTurn.y() * r.halfTurn.y(), sine = 2 * r.halfTurn.x() * r.halfTurn.y();
		for (int n = a.mesh.firstNode[r.block]; n < a.mesh.firstNode[r.block + 1]; ++n) {
			const Vec2 arm          = a.mesh.reference[n] - r.origin;
			a.state.displacement[n] = (r.centre - r.origin) - arm + Vec2(cosine * arm.x() - sine * arm.y(), sine * arm.x() + cosine * arm.y());
		}
	}
}

Vector unbalanced(const BlockAssembly& a, const LinearModel& m, const std::vector<Real>& groupForce)
{
	Vector sum  = Vector::Zero(m.unknowns);
	Real   none = 0;
	for (int dof = 0; dof < 2 * a.nodeCount(); ++dof)
		addForce(m, dof, a.forces.nodal[dof / 2][dof % 2], sum, none);
	for (size_t i = 0; i < a.state.groups.size(); ++i)
		if (m.groupUnknown[i] >= 0) sum[m.groupUnknown[i]] += groupForce[i];
	for (size_t i = 0; i < a.state.rigid.size(); ++i)
		for (int k : { 0, 1 })
			if (m.rigidUnknown[3 * i + k] >= 0) sum[m.rigidUnknown[3 * i + k]] += a.state.rigid[i].load[k];
	return sum;
}

} // namespace blocks
