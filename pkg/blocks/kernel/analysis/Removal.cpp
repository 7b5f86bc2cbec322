// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/analysis/Energy.hpp>
#include <blocks/kernel/analysis/Removal.hpp>

namespace blocks {
namespace {

	void requireRemovable(const BlockAssembly& a, const std::vector<int>& blocks)
	{
		require(!blocks.empty(), "a removal needs one block at least; count", 0);
		for (int b : blocks) {
			require(b >= 0 && b < a.blockCount(), "a removal needs the indices of blocks", b);
			require(!a.isRemoved(b), "a block can be removed once only; block", b);
			require(!a.isRigid(b), "rigid blocks cannot be removed; block", b);
		}
		const long gone = std::count(a.mesh.removed.begin(), a.mesh.removed.end(), true) + long(blocks.size());
		require(gone < a.blockCount(), "one block must be left; removed", Real(gone));
		const auto leaves = [&](int node) { return std::binary_search(blocks.begin(), blocks.end(), a.blockOfNode(node)); };
		for (const MotionGroup& g : a.state.groups)
			for (int dof : g.dofs)
				require(!leaves(dof / 2),
				        "motion group \"" + g.name + "\" must be released before its blocks are removed; grid point",
				        dof / 2);
		for (const Dashpot& d : a.supports.dashpots)
			require(!leaves(d.node),
			        "viscous boundary \"" + a.supports.viscous[d.boundary].name + "\" must be released before its blocks are removed; grid point",
			        d.node);
	}

	void clearNode(BlockAssembly& a, int n)
	{
		for (auto* all : { &a.state.displacement, &a.state.velocity, &a.forces.nodal })
			(*all)[n].setZero();
		for (auto* all : { &a.supports.load, &a.forces.rate, &a.state.search.detectedAt, &a.state.search.lookedAt, &a.contacts.odometer.seenAt })
			if (!all->empty()) (*all)[n].setZero();
		a.mesh.mass[n] = a.state.inertia[n] = 0;
	}

	Real held(const BlockAssembly& a) { return zoneEnergy(a) + jointEnergy(a) + gridPointsKineticEnergy(a); }

} // namespace

void removeBlocks(BlockAssembly& a, std::vector<int> blocks)
{
	std::sort(blocks.begin(), blocks.end());
	blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
	requireRemovable(a, blocks);

	const Real energy = held(a), load = loadWork(a);
	a.mesh.removed.resize(a.blockCount(), false);
	for (int b : blocks) {
		a.mesh.removed[b] = true;
		for (int n = a.mesh.firstNode[b]; n < a.mesh.firstNode[b + 1]; ++n)
			clearNode(a, n);
		for (int z = a.mesh.firstZone[b]; z < a.mesh.firstZone[b + 1] && !a.mesh.inSitu.empty(); ++z)
			a.mesh.inSitu.xx[z] = a.mesh.inSitu.yy[z] = a.mesh.inSitu.xy[z] = 0;
	}
	const auto leaves = [&](const std::array<int, 2>& two) { return a.isRemoved(two[0]) || a.isRemoved(two[1]); };
	for (int i = 0; i < a.joints.count(); ++i) {
		if (a.state.released[i] || !leaves(a.joints.segments[i].block)) continue;
		a.releaseJoint(i);
		a.forces.broke[i / Joints::batch] = true; // those whom it held together may meet now
		for (int p : { 2 * i, 2 * i + 1 })
			a.state.sigma[p] = a.state.tau[p] = 0;
	}
	auto& waiting = a.contacts.waiting;
	waiting.erase(std::remove_if(waiting.begin(), waiting.end(), [&](int joint) { return a.state.released[joint] != 0; }), waiting.end());
	for (FreeContact& c : a.state.contacts)
		if (c.block[0] >= 0 && leaves(c.block)) {
			a.state.lostFriction += c.friction;
			c = {};
		}
	a.updateMobility();
	if (a.contacts.started || !a.state.contacts.empty()) {
		sortContacts(a);
		placeForces(a);
		++a.contacts.version;
	}
	if (!a.forces.before.status.empty()) a.forces.before.take(a.state); // nothing is dissipated by leaving
	a.state.accounts.released.work += load - loadWork(a);
	a.state.further.removed += energy - held(a);
}

} // namespace blocks
