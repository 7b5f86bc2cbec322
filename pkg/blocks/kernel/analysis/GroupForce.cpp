// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/analysis/GroupForce.hpp>

namespace blocks {

Vec2 groupForce(const BlockAssembly& a, const MotionGroup& g)
{
	Vec2 resistance = Vec2::Zero(), inertia = Vec2::Zero();
	for (int dof : g.dofs) {
		resistance[dof % 2] -= a.forces.nodal[dof / 2][dof % 2];
		inertia[dof % 2] += a.state.inertia[dof / 2];
	}
	return resistance + (g.force - resistance.sum()) * inertia / inertia.sum();
}

Real groupMoment(const BlockAssembly& a, const MotionGroup& g, const Vec2& about)
{
	Real resistance = 0, inertia = 0;
	for (int dof : g.dofs) {
		resistance -= a.forces.nodal[dof / 2][dof % 2];
		inertia += a.state.inertia[dof / 2];
	}
	Real sum = 0;
	for (int dof : g.dofs) { // all of them accelerate alike
		const Vec2 arm   = a.position(dof / 2) - about;
		const Real force = (g.force - resistance) * a.state.inertia[dof / 2] / inertia - a.forces.nodal[dof / 2][dof % 2];
		sum += dof % 2 ? arm[0] * force : -arm[1] * force;
	}
	return sum;
}

} // namespace blocks
