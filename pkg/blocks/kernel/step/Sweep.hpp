// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/step/Joints.hpp>
#include <blocks/kernel/step/StiffnessDamping.hpp>

/// From joints, contacts and zones to the force of every grid point, in one sweep over the blocks: a joint is computed when its first block comes, and its
/// forces go straight to the grid points. Every grid point gets load + joints, in their order, + contacts + zones, on any number of threads.
namespace blocks::step {

/// How the blocks are shared out among so many threads.
Parts& partsFor(BlockAssembly&, int threads);

/// Whether joints of a batch, which belongs to a part, also hold blocks of later parts.
inline bool crosses(const BlockAssembly& a, int batch, const Part& part) { return a.joints.blocksOfBatch[batch].last >= part.lastBlock; }

/// Loads, and what crossing batches of earlier parts do to blocks of this one.
void beginForces(BlockAssembly&, const Part&);
/// The forces of a batch of joints, on all their blocks.
void addJointForces(BlockAssembly&, int batch, const JointForces&);
/// The forces of a batch of joints on blocks of a part alone.
void addJointForces(BlockAssembly&, int batch, const JointForces&, const Part&);
/// The end of the piece of blocks that begins with `first`: so few that what belongs to them stays in the nearest cache.
int pieceEnd(const BlockAssembly&, int first, int last);
/// Contacts and zones of blocks [first, last).
void addContactsAndZones(BlockAssembly&, int first, int last, Real* energy);

/// work(batch, b) leaves the forces of a batch of joints in b.
template <class Work> void sweepPart(BlockAssembly& a, const Part& part, const Work& work, JointBatch& b, Real* energy)
{
	beginForces(a, part);
	int batch = part.firstBatch, crossing = part.firstCrossing;
	for (int first = part.firstBlock, next; first < part.lastBlock; first = next) {
		next = pieceEnd(a, first, part.lastBlock);
		for (; batch < part.lastBatch && a.joints.blocksOfBatch[batch].first < next; ++batch) {
			if (crosses(a, batch, part))
				addJointForces(a, batch, a.forces.parts.forces[crossing++], part);
			else {
				work(batch, b);
				addJointForces(a, batch, b.force);
			}
		}
		addContactsAndZones(a, first, next, energy);
	}
}

template <class Work> void sweep(BlockAssembly& a, const Work& work, bool account, int threads)
{
	if (account) a.forces.zoneEnergy.assign(a.blockCount(), 0);
	Real* const energy   = account ? a.forces.zoneEnergy.data() : nullptr;
	Parts&      parts    = partsFor(a, threads);
	const int   crossing = int(parts.crossing.size());
#pragma omp parallel num_threads(threads) if (threads > 1)
	{
		JointBatch b;
		if (crossing > 0) {
#pragma omp for schedule(static)
			for (int i = 0; i < crossing; ++i) {
				work(parts.crossing[i], b);
				parts.forces[i] = b.force;
			}
		}
#pragma omp for schedule(static)
		for (int part = 0; part < threads; ++part)
			sweepPart(a, parts.all[part], work, b, energy);
	}
	if (a.supports.stiffnessDamping > 0) addStiffnessDamping(a, threads);
}

} // namespace blocks::step
