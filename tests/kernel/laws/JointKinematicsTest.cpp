// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>

using namespace specimens;

namespace {

/// As if all joints had been bonded across a gap.
void bondedAcross(BlockAssembly& a, Real opening, Real slip)
{
	for (int k : { 0, 1 }) {
		std::fill(a.joints.columns.bondOpening[k].begin(), a.joints.columns.bondOpening[k].end(), opening);
		std::fill(a.joints.columns.bondSlip[k].begin(), a.joints.columns.bondSlip[k].end(), slip);
		std::fill(a.joints.columns.matched.begin(), a.joints.columns.matched.end(), false);
	}
}

Real springEnergy(BlockAssembly& a)
{
	updateKinematics(a, allJoints(a));
	Real sum = 0;
	for (const Pair& pair : a.joints.pairs)
		for (int i = 2 * pair.first; i < 2 * pair.last; ++i) {
			const JointParams& j = a.joints.ofPoint(i);
			sum += a.joints.segments[i / 2].area * (j.kn * a.state.opening[i] * a.state.opening[i] + j.ks * a.state.slip[i] * a.state.slip[i]) / 2;
		}
	return sum;
}

} // namespace

TEST(JointKinematics, OpeningAndSlipInPlainNumbers)
{
	// Lower block's top edge y = 0.5 faces up: n = (0, 1), and t, n turned by +90 degrees, = (-1, 0). The upper block moves by
	// (0.02, 0.03): opening 0.03, slip -0.02 at both points. Positions of order 1, a handful of roundings.
	BlockAssembly a = column(2, 0.8, 0.5, 1, 1, stone(), elasticJoint(100, 40), 2);
	rotateAbout(a, { 0, 0 }, 0, { 0.02, 0.03 }, a.mesh.firstNode[1]);
	computeForces(a);
	for (int i = 0; i < a.pointCount(); ++i) {
		EXPECT_NEAR(a.state.opening[i], 0.03, 10 * eps);
		EXPECT_NEAR(a.state.slip[i], -0.02, 10 * eps);
		EXPECT_NEAR(a.state.sigma[i], 3, 1000 * eps);
		EXPECT_NEAR(a.state.tau[i], -0.8, 400 * eps);
	}
	// On the lower block: A (sigma n + tau t) = 1.6 (3 (0,1) - 0.8 (-1,0)) = (1.28, 4.8), pulled after the upper one.
	const auto f   = jointForces(a);
	Vec2       sum = Vec2::Zero();
	for (int n = 0; n < a.mesh.firstNode[1]; ++n)
		sum += f[n];
	EXPECT_NEAR(sum.x(), 1.28, 1600 * eps);
	EXPECT_NEAR(sum.y(), 4.8, 1600 * eps);
	// The two forces, (0.02, 0.03) apart, turn the pair by -(0.02 x 4.8 - 0.03 x 1.28) = -0.0576; the couples on the two edges
	// make up for it, half each: right node +0.0288/0.8, left node as much less.
	EXPECT_NEAR(f[3].y() - f[2].y(), 0.0576 / 0.8, 4000 * eps);
}

TEST(JointKinematics, ForcesAreTheGradientOfTheSprings)
{
	// Large openings, slips and rotations, three blocks, joints of unequal meshes. Central differences with d = 1e-6: truncation
	// d^2/6 U''' ~ 1e-12/6 x (k/L ~ 1e3) = 2e-10, rounding eps U/d = 2e-16 x 20/1e-6 = 4e-9. Allowed is three times their sum.
	BlockAssembly a = emptyAssembly(0.9);
	addGrid(a, { 0, 0 }, 1, 0.5, 2, 1);
	addGrid(a, { 0.3, 0.5 }, 1.3, 0.4, 3, 1);
	addGrid(a, { 1, -0.1 }, 1, 0.6, 1, 2);
	bondAll(a, elasticJoint(70, 30));
	bondedAcross(a, 0.03, -0.05);
	disturb(a, 0.12);
	rotateAbout(a, { 1, 1 }, 0.8, { 0.05, -0.1 }, a.mesh.firstNode[1], a.mesh.firstNode[2]);
	rotateAbout(a, { 1, 1 }, 0.6, { 0, 0 });
	const auto f = jointForces(a);
	const Real d = 1e-6;
	for (int n = 0; n < a.nodeCount(); ++n)
		for (int axis : { 0, 1 }) {
			const Real at                 = a.state.displacement[n][axis];
			a.state.displacement[n][axis] = at + d;
			const Real ahead              = springEnergy(a);
			a.state.displacement[n][axis] = at - d;
			const Real behind             = springEnergy(a);
			a.state.displacement[n][axis] = at;
			EXPECT_NEAR(f[n][axis], -(ahead - behind) / (2 * d), 1.3e-8) << "node " << n << " axis " << axis;
		}
}

TEST(JointKinematics, ForceAndMomentVanishHoweverFarApart)
{
	// Any stresses, openings of twice the block's size, any rotation: rounding only. 40 nodes' forces of order k A d < 200,
	// arms below 5, some 20 roundings each: 40 x 200 x 5 x 20 eps = 2e-10; relative to the largest force (100) well below 1e-10.
	for (Real angle : { 0.1, 1.0, 2.5, 3.0 }) {
		SCOPED_TRACE(angle);
		BlockAssembly a = emptyAssembly(0.9);
		addGrid(a, { 0, 0 }, 1, 0.5, 2, 1);
		addGrid(a, { 0.3, 0.5 }, 1.3, 0.4, 3, 1);
		bondAll(a, elasticJoint(70, 30));
		bondedAcross(a, 0.03, -0.05);
		disturb(a, 0.1);
		rotateAbout(a, { 0.5, 0.5 }, angle, { 1.1, 2.0 }, a.mesh.firstNode[1]);
		const auto f      = jointForces(a);
		Vec2       force  = Vec2::Zero();
		Real       moment = 0, largest = 0;
		for (int n = 0; n < a.nodeCount(); ++n) {
			force += f[n];
			moment += cross(a.position(n), f[n]);
			largest = std::max(largest, f[n].norm());
		}
		EXPECT_GT(largest, 1);
		EXPECT_LT(force.norm(), 1e-10);
		EXPECT_LT(std::abs(moment), 1e-10 * largest);
	}
}

TEST(JointKinematics, RigidMotionOpensNothing)
{
	// The pair moves far away and turns by any angle. Positions of order 10: 10 roundings of 10 eps.
	for (Real angle : { 0.01, 1.3, 3.0, -2.0, 40 * M_PI + 0.7 }) {
		SCOPED_TRACE(angle);
		BlockAssembly a = twoBlocks(elasticJoint(1, 1));
		rotateAbout(a, { 0.3, -2 }, angle, { 5, -3 });
		updateKinematics(a, { 0, 1 });
		for (int i = 0; i < a.pointCount(); ++i) {
			EXPECT_NEAR(a.state.opening[i], 0, 100 * eps);
			EXPECT_NEAR(a.state.slip[i], 0, 100 * eps);
		}
	}
}

TEST(JointKinematics, BondedAcrossAGapTheGapIsNoOpening)
{
	// A tolerance of 1e-3 bonds blocks that are 4e-4 apart and askew; unstressed, whatever the pair's rigid motion.
	BlockAssembly a = emptyAssembly(1);
	addFan(a, { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 0.9 } });
	addFan(a, { { 1.0004, 0.1 }, { 2, 0 }, { 2, 1 }, { 1.0002, 0.8 } });
	a.bond(detectSegments(a, 1e-3));
	ASSERT_EQ(a.joints.segments.size(), 1u);
	EXPECT_NEAR(a.joints.columns.bondOpening[0][0], 4e-4, 1e-4 * 0.5); // they are not parallel: the normal bisects
	rotateAbout(a, { 0.3, -2 }, 1.9, { 5, -3 });
	updateKinematics(a, { 0, 1 });
	for (int i = 0; i < a.pointCount(); ++i) {
		EXPECT_NEAR(a.state.opening[i], 0, 100 * eps);
		EXPECT_NEAR(a.state.slip[i], 0, 100 * eps);
	}
}

TEST(JointKinematics, FrameBisectsTheEdges)
{
	// Block 1 turns by 0.4 about the joint's middle: the frame turns by 0.2. At the ends the edges are 2 (L/2) sin(0.2) apart
	// along the bisecting normal: opening +-L sin(0.2); slip 0.
	BlockAssembly a = column(2, 0.8, 0.5, 1, 1, stone(), elasticJoint(1, 1));
	rotateAbout(a, { 0.4, 0.5 }, 0.4, { 0, 0 }, a.mesh.firstNode[1]);
	updateKinematics(a, { 0, 1 });
	EXPECT_NEAR(frameOf(a, 0).nx, -std::sin(0.2), 10 * eps);
	EXPECT_NEAR(frameOf(a, 0).ny, std::cos(0.2), 10 * eps);
	for (int k : { 0, 1 }) {
		const Real arm = (host(a, a.joints.segments[0], 0, k).x() - 0.4);
		EXPECT_NEAR(a.state.opening[k], 2 * arm * std::sin(0.2), 10 * eps);
		EXPECT_NEAR(a.state.slip[k], 0, 10 * eps);
	}
}
