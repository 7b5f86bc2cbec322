// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/Two.hpp>
#include <blocks/kernel/step/Contacts.hpp>
#include <blocks/kernel/step/Sweep.hpp>
#include <blocks/kernel/step/ZoneForces.hpp>
#include <numeric>

namespace blocks::step {
namespace {

	/// What blocks and the joints that begin with them cost, in thirds of a zone: a joint takes seven, and three where its forces are known already.
	/// That is from profiles of a couplet on one machine; the three is a guess. No result depends on it.
	std::vector<long> costsBefore(const BlockAssembly& a, const std::vector<int>& partEnd)
	{
		std::vector<long> cost(a.blockCount() + 1, 0);
		for (int block = 0; block < a.blockCount(); ++block)
			cost[block + 1] = 1 + 3 * (a.mesh.firstZone[block + 1] - a.mesh.firstZone[block]);
		for (int batch = 0; batch < int(a.joints.blocksOfBatch.size()); ++batch) {
			const BlockRange& blocks = a.joints.blocksOfBatch[batch];
			const int         end    = *std::upper_bound(partEnd.begin(), partEnd.end(), blocks.first);
			cost[blocks.first + 1] += jointsIn(a, batch) * (blocks.last >= end ? 3 : 7);
		}
		std::partial_sum(cost.begin(), cost.end(), cost.begin());
		return cost;
	}

	/// Where the parts end, so that they cost about the same. What crosses depends on where they end, so this is done several times.
	std::vector<int> endsOfParts(const BlockAssembly& a, int threads)
	{
		std::vector<int> end { a.blockCount() };
		for (int pass = 0; pass < (threads > 1 ? 5 : 0); ++pass) {
			const std::vector<long> cost = costsBefore(a, end);
			end.assign(threads, a.blockCount());
			for (int part = 1; part < threads; ++part)
				end[part - 1] = int(std::lower_bound(cost.begin(), cost.end(), cost.back() * part / threads) - cost.begin());
		}
		return end;
	}

	/// The first batch that begins with this block or a later one.
	int batchOf(const BlockAssembly& a, int block)
	{
		const auto& all = a.joints.blocksOfBatch;
		return int(std::lower_bound(all.begin(), all.end(), block, [](const BlockRange& b, int wanted) { return b.first < wanted; }) - all.begin());
	}

	Parts makeParts(const BlockAssembly& a, int threads)
	{
		Parts                  parts { threads, a.blockCount(), a.joints.count(), {}, {}, {} };
		const std::vector<int> end   = endsOfParts(a, threads);
		int                    block = 0;
		for (int last : end) {
			parts.all.push_back({ block, last, batchOf(a, block), batchOf(a, last), int(parts.crossing.size()), {} });
			for (int batch = parts.all.back().firstBatch; batch < parts.all.back().lastBatch; ++batch)
				if (crosses(a, batch, parts.all.back())) parts.crossing.push_back(batch);
			block = last;
		}
		parts.forces.resize(parts.crossing.size());
		for (int i = 0; i < int(parts.crossing.size()); ++i) {
			const int batch = parts.crossing[i];
			for (int lane = 0; lane < jointsIn(a, batch); ++lane)
				for (int side : { 0, 1 }) {
					const int on   = a.joints.segments[batch * Joints::batch + lane].block[side];
					Part&     part = parts.all[std::upper_bound(end.begin(), end.end(), on) - end.begin()];
					if (batch < part.firstBatch) part.incoming.push_back({ i, lane, side });
				}
		}
		return parts;
	}

	void addSide(BlockAssembly& a, int joint, int side, const JointForces& by, int lane)
	{
		const auto& node = a.joints.node[joint];
		for (int k : { 2 * side, 2 * side + 1 })
			a.forces.nodal[node[k]] += Vec2(by.x[k][lane], by.y[k][lane]);
	}

} // namespace

Parts& partsFor(BlockAssembly& a, int threads)
{
	Parts& p = a.forces.parts;
	if (p.threads != threads || p.blocks != a.blockCount() || p.joints != a.joints.count()) p = makeParts(a, threads);
	return p;
}

void beginForces(BlockAssembly& a, const Part& part)
{
	const int node = a.mesh.firstNode[part.firstBlock], end = a.mesh.firstNode[part.lastBlock];
	Vec2*     force = a.forces.nodal.data();
	if (a.supports.load.empty())
		std::fill_n(force[node].data(), 2 * (end - node), Real(0));
	else
		std::copy(a.supports.load.begin() + node, a.supports.load.begin() + end, force + node);
	for (const IncomingSide& in : part.incoming) {
		const int joint = a.forces.parts.crossing[in.crossing] * Joints::batch + in.lane;
		if (a.joints.effective[joint] != releasedKind) addSide(a, joint, in.side, a.forces.parts.forces[in.crossing], in.lane);
	}
}

void addJointForces(BlockAssembly& a, int batch, const JointForces& by)
{
	Vec2* const force = a.forces.nodal.data();
	const int   first = batch * Joints::batch, count = jointsIn(a, batch);
	const bool  all     = a.joints.kindOfBatch[batch] >= 0;
	auto        carries = [&](int i) { return all || a.joints.effective[first + i] != releasedKind; };
	auto        addBoth = [&](int i) { addSide(a, first + i, 0, by, i), addSide(a, first + i, 1, by, i); };
	for (int i = 0; i < count; i += 2) {
		const bool one = carries(i), other = i + 1 < count && carries(i + 1);
		if (one && other) {
			const auto &node = a.joints.node[first + i], &next = a.joints.node[first + i + 1];
			Two         x[4], y[4];
			for (int k = 0; k < 4; ++k)
				x[k] = loadTwo(by.x[k] + i), y[k] = loadTwo(by.y[k] + i);
			for (int k = 0; k < 4; ++k)
				addTo(force[node[k]].data(), firsts(x[k], y[k]));
			for (int k = 0; k < 4; ++k)
				addTo(force[next[k]].data(), seconds(x[k], y[k]));
		} else if (one)
			addBoth(i);
		else if (other)
			addBoth(i + 1);
	}
}

void addJointForces(BlockAssembly& a, int batch, const JointForces& by, const Part& part)
{
	const int first = batch * Joints::batch, count = jointsIn(a, batch);
	for (int i = 0; i < count; ++i)
		for (int side : { 0, 1 }) {
			const int block = a.joints.segments[first + i].block[side];
			if (block < part.lastBlock && a.joints.effective[first + i] != releasedKind) addSide(a, first + i, side, by, i);
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
