// yade-blocks, GPL-2.0-or-later
#include "StabilityWatch.hpp"
#include "Energy.hpp"

namespace blocks {
namespace {

	/// The block with the most kinetic energy in one grid point, or in a rigid block's share for one of its own.
	int fastestBlock(const BlockAssembly& a)
	{
		int  fastest = 0;
		Real most    = -1;
		for (int n = 0; n < a.nodeCount(); ++n)
			if (a.inertia[n] * a.velocity[n].squaredNorm() > most) most = a.inertia[n] * a.velocity[n].squaredNorm(), fastest = a.blockOfNode(n);
		for (const RigidBlock& r : a.rigid) {
			const Real energy = (r.inertia * r.velocity.head<2>().squaredNorm() + r.rotaryInertia * r.velocity[2] * r.velocity[2]) / (a.firstNode[r.block + 1] - a.firstNode[r.block]);
			if (energy > most) most = energy, fastest = r.block;
		}
		return fastest;
	}

} // namespace

StabilityWatch::Verdict StabilityWatch::look(const BlockAssembly& a, long step, Real time)
{
	const int bad = a.firstBadNode();
	if (bad >= 0) return { false, a.blockOfNode(bad), "the motion of a grid point is not a number" };

	Real turnover = 0;
	for (const MotionGroup& g : a.groups)
		turnover += g.workTurnover;
	for (const RigidBlock& r : a.rigid)
		turnover += r.workTurnover;
	const Real loads = loadWork(a), energy = zoneEnergy(a) + jointEnergy(a) + kineticEnergy(a);
	if (!begun) {
		roundingEnergy = 0;
		for (int block = 0; block < a.blockCount(); ++block)
			for (int z = a.firstZone[block]; z < a.firstZone[block + 1]; ++z)
				roundingEnergy += a.materials[a.blockMaterial[block]].young * a.zoneVolume[z] * roundingStrain * roundingStrain;
		baseline = energy - groupWork(a) - rigidWork(a) - loads;
		begun    = true;
		compared = step;
	}
	const Real excess = energy - groupWork(a) - rigidWork(a) - loads - baseline;
	const Real scale  = std::abs(baseline) + turnover + std::abs(loads) + roundingEnergy;
	const bool compare = step - compared >= leastInterval;
	if (compare && excess > tolerance * scale && lastExcess > tolerance * scale && excess > growth * lastExcess) {
		return { false, fastestBlock(a), "energy grew without work, to " + shown(energy) + " J where " + shown(energy - excess) + " J were put in" };
	}
	if (excess <= tolerance * scale) {
		lastGood.step     = step;
		lastGood.time     = time;
		lastGood.position = a.position;
		lastGood.velocity = a.velocity;
		lastGood.points   = a.points;
		lastGood.groups   = a.groups;
		lastGood.rigid    = a.rigid;
		if (!a.contacts.order.empty()) lastGood.contacts = a.contacts, lastGood.segments = a.segments;
	}
	if (compare) lastExcess = excess, compared = step;
	return {};
}

long StabilityWatch::restore(BlockAssembly& a) const
{
	if (lastGood.step < 0) return -1;
	a.position = lastGood.position;
	a.velocity = lastGood.velocity;
	a.points   = lastGood.points;
	a.groups   = lastGood.groups;
	a.rigid    = lastGood.rigid;
	if (!lastGood.contacts.order.empty()) a.contacts = lastGood.contacts, a.segments = lastGood.segments;
	return lastGood.step;
}

} // namespace blocks
