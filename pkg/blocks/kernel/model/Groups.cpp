// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/model/BlockAssembly.hpp>

namespace blocks {

int BlockAssembly::addGroup(MotionGroup group)
{
	std::sort(group.dofs.begin(), group.dofs.end());
	require(!group.dofs.empty(), "motion group \"" + group.name + "\" must hold at least one degree of freedom; count", 0);
	require(std::isfinite(group.target), "motion group \"" + group.name + "\": target must be finite", group.target);
	require(group.rampTime >= 0 && std::isfinite(group.rampTime), "motion group \"" + group.name + "\": rampTime must not be negative [s]", group.rampTime);
	require(std::isfinite(group.startTime), "motion group \"" + group.name + "\": startTime must be finite [s]", group.startTime);
	for (size_t i = 0; i < group.dofs.size(); ++i) {
		const int dof = group.dofs[i];
		require(dof >= 0 && dof < 2 * nodeCount(), "motion group \"" + group.name + "\": no such degree of freedom", dof);
		require(i == 0 || group.dofs[i - 1] != dof, "motion group \"" + group.name + "\" names a degree of freedom twice", dof);
		require(mesh.mass[dof / 2] > 0,
		        "motion group \"" + group.name + "\" holds a grid point of a rigid block, which moves with its body; grid point",
		        dof / 2);
		for (const MotionGroup& other : state.groups)
			require(!std::binary_search(other.dofs.begin(), other.dofs.end(), dof),
			        "motion group \"" + group.name + "\" overlaps \"" + other.name + "\" at degree of freedom (2 node + axis)",
			        dof);
	}
	state.groups.push_back(std::move(group));
	try {
		requireDashpotsMove();
	} catch (...) {
		state.groups.pop_back();
		throw;
	}
	updateMobility();
	return int(state.groups.size()) - 1;
}

void BlockAssembly::releaseGroup(int group)
{
	const MotionGroup& g        = state.groups[group];
	ReleasedWork&      released = state.accounts.released;
	released.work += g.work + g.pendingWork; // the half step since the last time of forces is past, too
	released.turnover += g.workTurnover + std::abs(g.pendingWork);
	state.groups.erase(state.groups.begin() + group);
	updateMobility();
}

void BlockAssembly::requireDashpotsMove() const
{
	if (supports.dashpots.empty()) return;
	std::vector<int>  axes(nodeCount(), 0);
	std::vector<char> pushed(nodeCount(), false);
	for (const MotionGroup& g : state.groups)
		for (int dof : g.dofs) {
			++axes[dof / 2];
			if (g.drive == MotionGroup::Drive::force) pushed[dof / 2] = true;
		}
	for (const Dashpot& d : supports.dashpots) {
		const std::string what = "viscous boundary \"" + supports.viscous[d.boundary].name + "\": ";
		require(!pushed[d.node], what + "no group may push its grid points; grid point", d.node);
		require(axes[d.node] < 2, what + "its grid points must be free along one axis at least; grid point", d.node);
	}
}

void BlockAssembly::updateMobility()
{
	for (int n = 0; n < nodeCount(); ++n)
		supports.mobility[n] = Vec2::Constant(state.inertia[n] > 0 ? 1 / state.inertia[n] : 0);
	for (const MotionGroup& g : state.groups)
		for (int dof : g.dofs)
			supports.mobility[dof / 2][dof % 2] = 0;
}

} // namespace blocks
