// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/step/Contacts.hpp>
#include <blocks/kernel/step/Sweep.hpp>
#include <blocks/kernel/step/ZoneForces.hpp>

namespace blocks::step {
namespace {

	/// The first batch that begins with this block or a later one.
	int batchOf(const BlockAssembly& a, int block)
	{
		const auto& all = a.joints.blocksOfBatch;
		return int(std::lower_bound(all.begin(), all.end(), block, [](const BlockRange& b, int wanted) { return b.first < wanted; }) - all.begin());
	}

	/// Where a part of the blocks begins, of so many that take about equal time: a joint takes seven thirds of that of a zone.
	int firstOf(const BlockAssembly& a, int part, int parts)
	{
		if (part == parts) return a.blockCount(); // the last blocks may have neither
		const auto costBefore = [&](int block) { return 3l * a.mesh.firstZone[block] + 7l * Joints::batch * batchOf(a, block); };
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

Part partOf(const BlockAssembly& a, int part, int parts)
{
	const int first = firstOf(a, part, parts), last = firstOf(a, part + 1, parts);
	return { first, last, batchOf(a, first), batchOf(a, last) };
}

void beginForces(BlockAssembly& a, const Part& part)
{
	const int node = a.mesh.firstNode[part.firstBlock], end = a.mesh.firstNode[part.lastBlock];
	Vec2*     force = a.forces.nodal.data();
	if (a.supports.load.empty())
		std::fill(force + node, force + end, Vec2::Zero());
	else
		std::copy(a.supports.load.begin() + node, a.supports.load.begin() + end, force + node);
}

void addJointForces(BlockAssembly& a, int batch, const JointForces& by)
{
	Vec2* const force = a.forces.nodal.data();
	const int   first = batch * Joints::batch, count = jointsIn(a, batch), kind = a.joints.kindOfBatch[batch];
	for (int i = 0; i < count; ++i) {
		if (kind < 0 && a.joints.effective[first + i] == releasedKind) continue;
		const auto& node = a.joints.node[first + i];
		for (int k = 0; k < 4; ++k)
			force[node[k]] += Vec2(by.x[k][i], by.y[k][i]);
	}
}

void addJointForces(BlockAssembly& a, int batch, const JointForces& by, const Part& part)
{
	Vec2* const force = a.forces.nodal.data();
	const int   first = batch * Joints::batch, count = jointsIn(a, batch);
	for (int i = 0; i < count; ++i) {
		if (a.joints.effective[first + i] == releasedKind) continue;
		const Segment& g = a.joints.segments[first + i];
		for (int side : { 0, 1 }) {
			if (g.block[side] < part.firstBlock || g.block[side] >= part.lastBlock) continue;
			for (int k : { 2 * side, 2 * side + 1 })
				force[g.node[k]] += Vec2(by.x[k][i], by.y[k][i]);
		}
	}
}

void addForcesFromBefore(BlockAssembly& a, int part, int parts)
{
	const Part own = partOf(a, part, parts);
	for (int before = 0; before < part; ++before) {
		const Part other    = partOf(a, before, parts);
		int        crossing = 0;
		for (int batch = other.firstBatch; batch < other.lastBatch; ++batch)
			if (crosses(a, batch, other)) addJointForces(a, batch, a.forces.crossing[before][crossing++], own);
	}
}

int pieceEnd(const BlockAssembly& a, int first, int last)
{
	const auto& zone = a.mesh.firstZone;
	int         next = first + 1;
	while (next < last && zone[next + 1] - zone[first] <= zoneBatch)
		++next;
	return next;
}

void addContactsAndZones(BlockAssembly& a, int first, int last, Real* energy)
{
	Vec2* const force = a.forces.nodal.data();
	if (!a.contacts.order.empty())
		for (int block = first; block < last; ++block)
			gatherContactForces(a, block, force);
	for (int run = first, next; run < last; run = next) {
		const int material = a.mesh.blockMaterial[run];
		for (next = run + 1; next < last && a.mesh.blockMaterial[next] == material; ++next) { }
		addZoneForces(a, run, next, force, energy);
	}
}

} // namespace blocks::step
