// yade-blocks, GPL-2.0-or-later
#include "StabilityWatch.hpp"
#include "Energy.hpp"

namespace blocks {

StabilityWatch::Verdict StabilityWatch::look(const BlockAssembly& a, long step, Real time)
{
	const int bad = a.firstBadNode();
	if (bad >= 0) return { false, a.blockOfNode(bad), "the motion of a grid point is not a number" };

	Real turnover = 0;
	for (const MotionGroup& g : a.groups)
		turnover += g.workTurnover;
	const Real loads = loadWork(a), energy = zoneEnergy(a) + jointEnergy(a) + kineticEnergy(a);
	if (!begun) {
		roundingEnergy = 0;
		for (int block = 0; block < a.blockCount(); ++block)
			for (int z = a.firstZone[block]; z < a.firstZone[block + 1]; ++z)
				roundingEnergy += a.materials[a.blockMaterial[block]].young * a.zoneVolume[z] * roundingStrain * roundingStrain;
		baseline = energy - groupWork(a) - loads;
		begun    = true;
		compared = step;
	}
	const Real excess = energy - groupWork(a) - loads - baseline;
	const Real scale  = std::abs(baseline) + turnover + std::abs(loads) + roundingEnergy;
	const bool compare = step - compared >= leastInterval;
	if (compare && excess > tolerance * scale && lastExcess > tolerance * scale && excess > growth * lastExcess) {
		int fastest = 0;
		for (int n = 1; n < a.nodeCount(); ++n)
			if (a.inertia[n] * a.velocity[n].squaredNorm() > a.inertia[fastest] * a.velocity[fastest].squaredNorm()) fastest = n;
		return { false, a.blockOfNode(fastest), "energy grew without work, to " + shown(energy) + " J where " + shown(energy - excess) + " J were put in" };
	}
	if (excess <= tolerance * scale) {
		lastGood.step     = step;
		lastGood.time     = time;
		lastGood.position = a.position;
		lastGood.velocity = a.velocity;
		lastGood.points   = a.points;
		lastGood.groups   = a.groups;
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
	if (!lastGood.contacts.order.empty()) a.contacts = lastGood.contacts, a.segments = lastGood.segments;
	return lastGood.step;
}

} // namespace blocks
