// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/analysis/Energy.hpp>
#include <blocks/kernel/analysis/StabilityWatch.hpp>
#include <blocks/kernel/model/JointEdges.hpp>
#include <blocks/kernel/step/ViscousBoundaries.hpp>
#include <blocks/kernel/step/ZoneForces.hpp>
#include <cstring>

namespace blocks {
namespace {

	/// The block with the most kinetic energy in one grid point, or in a rigid block's share for one of its own.
	int fastestBlock(const BlockAssembly& a)
	{
		int  fastest = 0;
		Real most    = -1;
		for (int n = 0; n < a.nodeCount(); ++n)
			if (a.state.inertia[n] * a.state.velocity[n].squaredNorm() > most)
				most = a.state.inertia[n] * a.state.velocity[n].squaredNorm(), fastest = a.blockOfNode(n);
		for (const RigidBlock& r : a.state.rigid) {
			const Real energy = (r.inertia * r.velocity.head<2>().squaredNorm() + r.rotaryInertia * r.velocity[2] * r.velocity[2])
				/ (a.mesh.firstNode[r.block + 1] - a.mesh.firstNode[r.block]);
			if (energy > most) most = energy, fastest = r.block;
		}
		return fastest;
	}

	const char* const notANumber = "the motion of a grid point is not a number";
	const char* const insideOut  = "a zone has turned inside out";

	/// Whether columns are the same, bit by bit.
	template <class T> bool same(const std::vector<T>& a, const std::vector<T>& b)
	{
		return a.size() == b.size() && (a.empty() || std::memcmp(static_cast<const void*>(a.data()), b.data(), a.size() * sizeof(T)) == 0);
	}

	/// "12 %"
	std::string percent(Real share) { return std::to_string(std::lround(100 * share)) + " %"; }

	/// "blocks 3 and 7 overlap by 1e-05 m, 12 % of the height of the zones behind (8e-05 m)"
	std::string described(const Overlap& o)
	{
		return "blocks " + std::to_string(o.block[0]) + " and " + std::to_string(o.block[1]) + " overlap by " + shown(o.depth, 3) + " m, "
			+ percent(o.share()) + " of the height of the zones behind (" + shown(o.height, 3) + " m)";
	}

	StabilityWatch::Verdict strayed(const BlockAssembly& a)
	{
		const int joint = firstStrayed(a);
		if (joint < 0) return {};
		const auto& node = a.joints.segments[joint].node;
		return { false,
			 a.blockOfNode(node[0]),
			 "it acts on block " + std::to_string(a.blockOfNode(node[2])) + " by joint " + std::to_string(joint) + ", whose edges have "
			         + (edgesTurned(a, joint) ? "turned against each other by more than a right angle" : "slid past each other")
			         + "; general contact follows blocks that come apart, once their joint has broken",
			 {} };
	}

	/// What half a step of the present forces adds to the kinetic energy, dt v.f / 2.
	Real kineticChange(const BlockAssembly& a, Real time, Real dt)
	{
		Real power = viscousPower(a, time);
		for (int n = 0; n < a.nodeCount(); ++n)
			for (int axis : { 0, 1 })
				if (a.supports.mobility[n][axis] > 0) power += a.state.velocity[n][axis] * a.forces.nodal[n][axis];
		for (const MotionGroup& g : a.state.groups) {
			if (g.drive == MotionGroup::Drive::velocity) continue;
			power += g.velocity * g.target * g.ramp(time);
			for (int dof : g.dofs)
				power += g.velocity * a.forces.nodal[dof / 2][dof % 2];
		}
		for (const RigidBlock& r : a.state.rigid)
			for (int i = 0; i < 3; ++i)
				if (r.free[i]) power += r.velocity[i] * r.force[i];
		return power * dt / 2;
	}

	/// Work of groups on the blocks, up to the time of the present forces: what groups have booked ends at the forces before these. A group that is
	/// driven holds against the blocks, as long as its velocity stays; where it changes now, neither that nor its kinetic energy has come yet.
	Real workOfGroups(const BlockAssembly& a, Real time, Real dt)
	{
		Real sum = groupWork(a);
		for (const MotionGroup& g : a.state.groups) {
			Real applied = 0;
			if (g.drive == MotionGroup::Drive::force)
				applied = g.target * g.ramp(time);
			else
				for (int dof : g.dofs)
					applied -= a.forces.nodal[dof / 2][dof % 2];
			sum += g.pendingWork + applied * g.velocity * dt / 2;
		}
		return sum;
	}
} // namespace

StabilityWatch::Verdict StabilityWatch::look(const BlockAssembly& a, long step, Real time, Real dt)
{
	const ZoneLook zones   = lookAtZones(a);
	const Real     kinetic = kineticEnergy(a);
	if (!zones.sound || !std::isfinite(zones.energy + kinetic)) { // who is asked one by one
		const Verdict verdict = lookAtEnd(a);
		if (!verdict.stable) return verdict;
	}
	overlaps.look(a);
	const char* const cure    = "; joints must be stiffer or loads smaller";
	const std::string entered = overlaps.entries == 0 ? "" : "has gone into block " + std::to_string(overlaps.through[1]) + " by more than half";
	if (overlaps.entries > lostShare * a.blockCount()) return { false, overlaps.through[0], "it " + entered + cure };
	if (overlaps.mean > OverlapWatch::thin) {
		return { false,
			 overlaps.joint.block[0],
			 "joints overlap by " + percent(overlaps.mean) + " of the height of the zones behind in the mean, most of all "
			         + described(overlaps.joint) + cure };
	}

	if (const Verdict verdict = strayed(a); !verdict.stable) return verdict;

	Real turnover = a.state.accounts.released.turnover + a.state.further.incoming;
	for (const MotionGroup& g : a.state.groups)
		turnover += g.workTurnover;
	for (const RigidBlock& r : a.state.rigid)
		turnover += r.workTurnover;
	const Real work = loadWork(a), put = workOfGroups(a, time, dt) + rigidWork(a) + a.state.further.incoming + work;
	const Real swinging = zones.energy + jointEnergy(a) + kinetic, energy = swinging + kineticChange(a, time, dt);
	if (!begun) {
		roundingEnergy = 0;
		for (int block = 0; block < a.blockCount(); ++block)
			for (int z = a.mesh.firstZone[block]; z < a.mesh.firstZone[block + 1]; ++z)
				roundingEnergy += a.mesh.materials[a.mesh.blockMaterial[block]].young * a.mesh.zoneVolume[z] * roundingStrain * roundingStrain;
		baseline = energy - put;
		begun    = true;
		compared = step;
	}
	if (loadsChanged(a))
		baseline = energy - put - lastExcess, earlier = lastScale; // no work since the last look is known to be theirs
	else
		baseline += energyOfNewMasses(a);
	if (!same(inertia, a.state.inertia)) inertia = a.state.inertia;
	const Real excess  = energy - put - baseline;
	const Real scale   = std::max(earlier, std::abs(baseline) + turnover + std::abs(work) + roundingEnergy);
	lastScale          = scale;
	const bool compare = step - compared >= leastInterval;
	const bool grows   = compare && excess > tolerance * scale && lastExcess > tolerance * scale && excess > growth * lastExcess;
	if (grows || swinging > swing * (std::max(energy, Real(0)) + scale)) {
		return { false, fastestBlock(a), "energy grew without work, to " + shown(swinging) + " J where " + shown(energy - excess) + " J were put in" };
	}
	if (excess <= tolerance * scale) {
		goodAt   = step;
		when     = time;
		lastGood = a.state;
	}
	if (compare) lastExcess = excess, compared = step;
	Verdict good;
	if (!excessTold && compare && excess > tolerance * scale) {
		excessTold   = true;
		good.warning = shown(excess, 3) + " J of energy came from nowhere, beside " + shown(scale, 3)
			+ " J that were put in or were there: blocks that overlapped when they first touched, or a script that wrote velocities or positions";
	}
	if (!warned && overlaps.thickest().share() > OverlapWatch::told) {
		warned = true;
		good.warning += (good.warning.empty() ? "" : "; ") + described(overlaps.thickest())
			+ "; up to 10 % joints may count as thin, and if their mean is more the run is stopped" + cure;
	}
	if (!lossTold && overlaps.entries > 0) {
		lossTold = true;
		good.warning += (good.warning.empty() ? "" : "; ")
			+ ("block " + std::to_string(overlaps.through[0]) + " " + entered + ": fragments get lost there" + cure);
	}
	return good;
}

/// Whether loads are others than at the last look; notes them.
bool StabilityWatch::loadsChanged(const BlockAssembly& a)
{
	std::vector<Vec2> rigid;
	for (const RigidBlock& r : a.state.rigid)
		rigid.push_back(r.load);
	const bool others  = !same(a.supports.load, loads);
	const bool changed = goodAt >= 0 && (others || rigid != rigidLoads);
	if (others) loads = a.supports.load;
	rigidLoads = std::move(rigid);
	return changed;
}

/// Kinetic energy that scaled masses have brought by growing since the last look, at the present velocities: nobody put it in.
Real StabilityWatch::energyOfNewMasses(const BlockAssembly& a) const
{
	Real sum = 0;
	if (inertia.size() == a.state.inertia.size() && !same(inertia, a.state.inertia))
		for (int n = 0; n < a.nodeCount(); ++n)
			sum += (a.state.inertia[n] - inertia[n]) / 2 * a.state.velocity[n].squaredNorm();
	return sum;
}

StabilityWatch::Verdict StabilityWatch::lookAtEnd(const BlockAssembly& a)
{
	const int bad = a.firstBadNode();
	if (bad >= 0) return { false, a.blockOfNode(bad), notANumber, {} };
	const int inverted = firstInverted(a);
	if (inverted >= 0) return { false, inverted, insideOut, {} };
	return strayed(a);
}

long StabilityWatch::restore(BlockAssembly& a) const
{
	if (goodAt >= 0) a.restore(lastGood);
	return goodAt;
}

} // namespace blocks
