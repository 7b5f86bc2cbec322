// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/step/Step.hpp>
#include <blocks/kernel/step/StiffnessDamping.hpp>
#include <blocks/kernel/step/ZoneForces.hpp>
#include <cassert>

namespace blocks {
namespace {

	/// Blocks [first, last), few enough that their forces stay in the nearest cache.
	void sumBlocks(BlockAssembly& a, int first, int last, Real* energy)
	{
		Vec2*     force = a.forces.nodal.data();
		const int node = a.mesh.firstNode[first], nodeEnd = a.mesh.firstNode[last];
		if (a.supports.load.empty())
			std::fill(force + node, force + nodeEnd, Vec2::Zero());
		else
			std::copy(a.supports.load.begin() + node, a.supports.load.begin() + nodeEnd, force + node);

		const auto* nodes = a.joints.sideNode.data();
		const auto* sides = a.forces.side.data();
		for (int i = a.joints.firstSide[first], end = a.joints.firstSide[last]; i < end; ++i) {
			force[nodes[i][0]] += sides[i][0];
			force[nodes[i][1]] += sides[i][1];
		}
		if (!a.contacts.order.empty())
			for (int block = first; block < last; ++block)
				gatherContactForces(a, block, force);
		for (int run = first, next; run < last; run = next) {
			const int material = a.mesh.blockMaterial[run];
			for (next = run + 1; next < last && a.mesh.blockMaterial[next] == material; ++next) { }
			addZoneForces(a, run, next, force, energy);
		}
	}

	/// Blocks [first, last) in pieces of about a batch of zones.
	void sumRange(BlockAssembly& a, int first, int last, Real* energy)
	{
		const auto& zone = a.mesh.firstZone;
		for (int next; first < last; first = next) {
			next = first + 1;
			while (next < last && zone[next + 1] - zone[first] <= zoneBatch)
				++next;
			sumBlocks(a, first, next, energy);
		}
	}

	/// Where a part of the blocks begins, of so many that take about equal time: a zone takes two and a half times that of a joint's side.
	int firstOf(const BlockAssembly& a, int part, int parts)
	{
		const auto costBefore = [&](int block) { return 5l * a.mesh.firstZone[block] + 2l * a.joints.firstSide[block]; };
		const long target     = costBefore(a.blockCount()) * part / parts;
		int        low = 0, high = a.blockCount();
		while (low < high) {
			const int middle = (low + high) / 2;
			if (costBefore(middle) < target)
				low = middle + 1;
			else
				high = middle;
		}
		return low;
	}

} // namespace

void sumForces(BlockAssembly& a, bool account, int threads)
{
	assert(threads >= 1);
	if (account) a.forces.zoneEnergy.assign(a.blockCount(), 0);
	Real* const energy = account ? a.forces.zoneEnergy.data() : nullptr;
	if (threads == 1)
		sumRange(a, 0, a.blockCount(), energy);
	else {
#pragma omp parallel for schedule(static) num_threads(threads)
		for (int part = 0; part < threads; ++part)
			sumRange(a, firstOf(a, part, threads), firstOf(a, part + 1, threads), energy);
	}
	if (a.supports.stiffnessDamping > 0) addStiffnessDamping(a, threads);
}

} // namespace blocks
