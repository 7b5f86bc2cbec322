// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/step/InSitu.hpp>
#include <blocks/kernel/step/Joints.hpp>
#include <blocks/kernel/step/Loads.hpp>
#include <blocks/kernel/step/ZoneForces.hpp>

namespace blocks {
namespace {

	/// Traction on a surface with this outward normal [Pa].
	Vec2 traction(const ZoneStress& s, const Vec2& n) { return { s.sxx * n.x() + s.sxy * n.y(), s.sxy * n.x() + s.syy * n.y() }; }

	/// Normal and shear stress of a joint's two points.
	struct PointStress {
		Real sigma, tau;
	};
	std::array<PointStress, 2> stressesOf(const BlockAssembly& a, int joint, const InSituStress& field)
	{
		const JointFrame f = frameOf(a, joint);
		const Real       y[2] { contactPosition(a, 2 * joint).y(), contactPosition(a, 2 * joint + 1).y() };
		const Vec2       n(f.nx, f.ny), t(-f.ny, f.nx);
		const auto       at = [&](Real height) {
                        const Vec2 pull = traction(field(height), n);
                        return PointStress { pull.dot(n), pull.dot(t) };
		};
		return { at((2 * y[0] + y[1]) / 3), at((y[0] + 2 * y[1]) / 3) };
	}

	void requireUntouched(const BlockAssembly& a)
	{
		for (const Vec2& u : a.state.displacement)
			require(u.isZero(0), "stresses in situ must be set before anything moves; displacement [m]", u.norm());
		for (int i = 0; i < a.joints.count(); ++i) {
			require(a.joints.kind[i] > 0, "stresses in situ need joints that have their properties, from bond() with JointMats; joint", i);
			for (int p : { 2 * i, 2 * i + 1 })
				require(a.state.status[p] == Joint::intact || a.state.status[p] == Joint::unbonded,
				        "stresses in situ need joints that are whole or were never bonded; joint",
				        i);
		}
	}

	void requireStrength(const BlockAssembly& a, int joint, const PointStress& s, Joint status)
	{
		const JointParams& p       = a.joints.of(joint);
		const bool         bonded  = status == Joint::intact;
		const Real         tension = bonded ? p.tension : p.tensionResidual;
		const Real         shear   = bonded ? p.cohesion - s.sigma * p.tanPhi : p.cohesionResidual - s.sigma * p.tanPhiResidual;
		if (s.sigma <= tension && std::abs(s.tau) <= std::max(shear, Real(0))) return;
		const auto& block = a.joints.segments[joint].block;
		throw std::invalid_argument(
			"the joint between blocks " + std::to_string(block[0]) + " and " + std::to_string(block[1])
			+ " must be able to carry the stress in situ, normal and shear, got " + shown(s.sigma, 6) + " and " + shown(s.tau, 6) + " Pa (tension "
			+ shown(tension, 6) + ", shear strength " + shown(shear, 6) + " Pa)");
	}

} // namespace

void setInSitu(BlockAssembly& a, const InSituStress& field)
{
	for (const ZoneStress& s : { field.at, field.gradient })
		for (Real part : { s.sxx, s.syy, s.sxy })
			require(std::isfinite(part), "stresses in situ must be finite [Pa], [Pa/m]", part);
	require(std::isfinite(field.level), "the level of stresses in situ must be finite [m]", field.level);
	requireUntouched(a);
	std::vector<std::array<PointStress, 2>> stresses;
	for (int i = 0; i < a.joints.count(); ++i) {
		stresses.push_back(stressesOf(a, i, field));
		for (int k : { 0, 1 })
			requireStrength(a, i, stresses.back()[k], a.state.status[2 * i + k]);
	}

	// everything is as it should be: from here on nothing can fail half-way
	StrainColumns& start = a.mesh.inSitu;
	start.assign(a.zoneCount(), 0);
	for (int block = 0; block < a.blockCount(); ++block)
		for (int z = a.mesh.firstZone[block]; z < a.mesh.firstZone[block + 1]; ++z) {
			const auto&      node = a.mesh.zoneNodes[z];
			const Real       y    = a.mesh.reference[node[0]].y() + (a.between(node[0], node[1]).y() + a.between(node[0], node[2]).y()) / 3;
			const ZoneStrain e    = zoneStrainOf(moduliOf(a, block), field(y));
			start.xx[z] = e.exx, start.yy[z] = e.eyy, start.xy[z] = e.exy;
		}
	a.joints.inSituOpening.resize(a.joints.count());
	a.joints.inSituSlip.resize(a.joints.count());
	for (int i = 0; i < a.joints.count(); ++i)
		for (int k : { 0, 1 }) {
			const PointStress& s         = stresses[i][k];
			const JointParams& p         = a.joints.of(i);
			a.joints.inSituOpening[i][k] = s.sigma / p.kn;
			a.joints.inSituSlip[i][k]    = s.tau / p.ks;
			a.state.opening[2 * i + k]   = s.sigma / p.kn;
			a.state.slip[2 * i + k]      = s.tau / p.ks;
			a.state.sigma[2 * i + k]     = s.sigma;
			a.state.tau[2 * i + k]       = s.tau;
		}
	a.rebuildJoints();
	a.forces.before.status.clear(); // what was there before had other stresses
}

void addInSituTraction(BlockAssembly& a, int edge, const InSituStress& field)
{
	require(edge >= 0 && edge < int(a.mesh.edgeNodes.size()), "a traction needs the index of a boundary edge", edge);
	const auto node = a.mesh.edgeNodes[edge];
	const Vec2 x[2] { a.mesh.reference[node[0]], a.mesh.reference[node[1]] }, along = x[1] - x[0], n = Vec2(along.y(), -along.x()) / along.norm();
	const Vec2 pull[2] { traction(field(x[0].y()), n), traction(field(x[1].y()), n) };
	for (int k : { 0, 1 })
		addLoad(a, node[k], (2 * pull[k] + pull[1 - k]) * (along.norm() * a.thickness / 6));
}

} // namespace blocks
