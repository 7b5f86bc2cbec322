// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/analysis/GroupForce.hpp>

using namespace specimens;

namespace {

/// A block with forces and masses of no symmetry, and a group of some of its degrees of freedom.
struct Handle {
	BlockAssembly a;
	MotionGroup   g;

	explicit Handle(std::vector<int> dofs)
	{
		a.addMaterial(stone());
		addFan(a, { { 0.1, 0.2 }, { 1.7, 0.5 }, { 2.1, 1.9 }, { 1.0, 2.3 }, { -0.3, 1.1 } });
		for (int n = 0; n < a.nodeCount(); ++n) {
			a.forces.nodal[n] = Vec2(3 + 7 * n, -11 + 2 * n * n);
			a.state.inertia[n] *= 1 + 0.3 * n;
		}
		g.dofs = std::move(dofs);
		a.addGroup(g);
	}
	Real inertia(int dof) const { return a.state.inertia[dof / 2]; }
	Real nodal(int dof) const { return a.forces.nodal[dof / 2][dof % 2]; }

	/// As the step does: what the group puts on the blocks when all of it accelerates by `acceleration`.
	void accelerate(Real acceleration)
	{
		g.force = 0;
		for (int dof : g.dofs)
			g.force += inertia(dof) * acceleration - nodal(dof);
	}
};

} // namespace

TEST(GroupForce, IsMassTimesAccelerationLessWhatElseActs)
{
	// Newton's law along either axis by itself, for a group along both.
	Handle h({ 0, 1, 4, 5, 9 });
	h.accelerate(0.7);
	Vec2 expected = Vec2::Zero();
	for (int dof : h.g.dofs)
		expected[dof % 2] += h.inertia(dof) * 0.7 - h.nodal(dof);
	const Vec2 force = groupForce(h.a, h.g);
	EXPECT_LT((force - expected).norm(), 1e-13 * expected.norm());
	EXPECT_NEAR(force.sum(), h.g.force, 1e-13 * std::abs(h.g.force));
}

TEST(GroupForce, OfOneAxisIsAllOfIt)
{
	Handle h({ 1, 5, 9 });
	h.accelerate(-0.3);
	EXPECT_EQ(groupForce(h.a, h.g).x(), 0);
	EXPECT_NEAR(groupForce(h.a, h.g).y(), h.g.force, 1e-14 * std::abs(h.g.force));
}

TEST(GroupForce, MomentIsThatOfTheForcesOnItsGridPoints)
{
	// Arm by arm, about a point and about another: they differ by the force times the distance.
	Handle h({ 0, 1, 4, 5, 9 });
	h.accelerate(0.7);
	const Vec2 about(0.4, -0.9), other(-2, 1.5);
	Real       expected = 0;
	for (int dof : h.g.dofs) {
		const Vec2 arm   = h.a.position(dof / 2) - about;
		const Real force = h.inertia(dof) * 0.7 - h.nodal(dof);
		expected += dof % 2 ? arm.x() * force : -arm.y() * force;
	}
	EXPECT_NEAR(groupMoment(h.a, h.g, about), expected, 1e-13 * std::abs(expected));
	EXPECT_NEAR(groupMoment(h.a, h.g, other) - groupMoment(h.a, h.g, about), cross(about - other, groupForce(h.a, h.g)), 1e-12 * std::abs(expected));
}
