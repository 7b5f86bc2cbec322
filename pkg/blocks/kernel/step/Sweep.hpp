// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/step/Joints.hpp>
#include <blocks/kernel/step/StiffnessDamping.hpp>

/// From joints, contacts and zones to the force of every grid point, in one sweep over the blocks: a joint is computed when its first block comes, and its
/// forces go straight to the grid points. Every grid point gets load + joints, in their order, + contacts + zones, on any number of threads.
namespace blocks::step {

/// The blocks of one thread, and the batches of joints that begin with one of them.
struct Part {
	int firstBlock, lastBlock;
	int firstBatch, lastBatch;
};
Part partOf(const BlockAssembly&, int part, int parts);

/// Whether joints of a batch, which belongs to a part, also hold blocks of later parts.
inline bool crosses(const BlockAssembly& a, int batch, const Part& part) { return a.joints.blocksOfBatch[batch].last >= part.lastBlock; }

/// Loads.
void beginForces(BlockAssembly&, const Part&);
/// The forces of a batch of joints, on all their blocks.
void addJointForces(BlockAssembly&, int batch, const JointForces&);
/// ... on blocks of a part alone.
void addJointForces(BlockAssembly&, int batch, const JointForces&, const Part&);
/// What batches of earlier parts do to blocks of this one.
void addForcesFromBefore(BlockAssembly&, int part, int parts);
/// The end of the piece of blocks that begins with `first`: so few that what belongs to them stays in the nearest cache.
int pieceEnd(const BlockAssembly&, int first, int last);
/// Contacts and zones of blocks [first, last).
void addContactsAndZones(BlockAssembly&, int first, int last, Real* energy);

/// work(batch, b) leaves the forces of a batch of joints in b.
template <class Work> void sweepPart(BlockAssembly& a, int part, int parts, const Work& work, JointBatch& b, Real* energy)
{
	const Part own = partOf(a, part, parts);
	beginForces(a, own);
	addForcesFromBefore(a, part, parts);
	int batch = own.firstBatch, crossing = 0;
	for (int first = own.firstBlock, next; first < own.lastBlock; first = next) {
		next = pieceEnd(a, first, own.lastBlock);
		for (; batch < own.lastBatch && a.joints.blocksOfBatch[batch].first < next; ++batch) {
			if (crosses(a, batch, own))
				addJointForces(a, batch, a.forces.crossing[part][crossing++], own);
			else {
				work(batch, b);
				addJointForces(a, batch, b.force);
			}
		}
		addContactsAndZones(a, first, next, energy);
	}
}

/// Joints that hold blocks of several parts come first.
template <class Work> void workOnCrossing(BlockAssembly& a, int part, int parts, const Work& work, JointBatch& b)
{
	const Part own    = partOf(a, part, parts);
	auto&      forces = a.forces.crossing[part];
	forces.clear();
	for (int batch = own.firstBatch; batch < own.lastBatch; ++batch) {
		if (!crosses(a, batch, own)) continue;
		work(batch, b);
		forces.push_back(b.force);
	}
}

template <class Work> void sweep(BlockAssembly& a, const Work& work, bool account, int threads)
{
	if (account) a.forces.zoneEnergy.assign(a.blockCount(), 0);
	Real* const energy = account ? a.forces.zoneEnergy.data() : nullptr;
	a.forces.crossing.resize(threads); // each grows once
#pragma omp parallel num_threads(threads) if (threads > 1)
	{
		JointBatch b;
#pragma omp for schedule(static)
		for (int part = 0; part < threads - 1; ++part)
			workOnCrossing(a, part, threads, work, b);
#pragma omp for schedule(static)
		for (int part = 0; part < threads; ++part)
			sweepPart(a, part, threads, work, b, energy);
	}
	if (a.supports.stiffnessDamping > 0) addStiffnessDamping(a, threads);
}

} // namespace blocks::step
