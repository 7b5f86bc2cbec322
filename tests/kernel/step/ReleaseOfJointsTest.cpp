// yade-blocks, GPL-2.0-or-later
#include <ContactScenes.hpp>

using namespace contacts;

namespace {

void moveSecond(BlockAssembly& a, const Vec2& u)
{
	for (int n = a.mesh.firstNode[1]; n < a.nodeCount(); ++n)
		a.state.displacement[n] += u, a.state.velocity[n] = u;
}

/// Slips of 4e-7 m, with the joint's law alone.
void slideSecond(BlockAssembly& a, int steps)
{
	for (int i = 0; i < steps; ++i) {
		moveSecond(a, 4e-7 * along);
		updateKinematics(a, { 0, 1 });
		advanceStresses(a, jointsOf(a, 0), Brittle {});
	}
}

/// Nodal forces of the joint as it is, everything stopped.
std::vector<Vec2> forcesAtRest(BlockAssembly& a)
{
	for (Vec2& v : a.state.velocity)
		v.setZero();
	sumForces(a);
	return a.forces.nodal;
}

} // namespace

TEST(ReleaseOfJoints, BrokenSegmentsAreReleasedWithoutAJump)
{
	// Pressed and sheared until the joint slides; the step in which its segments become free pairs must not change the forces.
	JointParams joint = elasticJoint(1e9, 4e8);
	joint.tension = 1e5, joint.cohesion = 2e3, joint.tanPhi = joint.tanPhiResidual = 0.5;
	joint.cohesionResidual = 500;
	BlockAssembly a        = twoBlocks(joint);
	auto          move     = [&](const Vec2& u) { moveSecond(a, u); };
	move(-1e-6 * normal);
	computeAllForces(a, joint, 1, 1);
	EXPECT_TRUE(a.contacts.order.empty());
	EXPECT_FALSE(a.state.released[0]);
	slideSecond(a, 20);
	EXPECT_EQ(a.state.status[0], Joint::brokenInShear);
	EXPECT_NEAR(a.state.tau[0], 500 + 0.5 * 1000, 1);
	const auto before = forcesAtRest(a);
	const Real energy = jointEnergy(a), scale = largestForce(a);
	computeAllForces(a, joint, 1, 1);
	ASSERT_EQ(a.contacts.order.size(), 1u);
	EXPECT_TRUE(a.state.released[0]);
	EXPECT_EQ(a.state.tau[0], 0); // what it carried is the free pair's
	for (int n = 0; n < a.nodeCount(); ++n)
		EXPECT_LT((a.forces.nodal[n] - before[n]).norm(), 1e-5 * scale);
	EXPECT_NEAR(jointEnergy(a), energy, 1e-5 * energy);
	EXPECT_EQ(a.joints.effective[0], releasedKind) << "nothing of it is summed";
	// it goes on sliding at its residual strength
	for (int i = 0; i < 5; ++i)
		move(4e-7 * along), computeAllForces(a, joint, 1, 1);
	const Vec2 f = contactForce(a, 0);
	EXPECT_NEAR(f.dot(along) / (0.7 * Vec2(0.3, 0.8).norm()), 500 + 0.5 * 1000, 1);
}

TEST(ReleaseOfJoints, JointsThatHoldAtOneEndStayJoints)
{
	// Pressed, and broken at one of its ends: as a free contact it would lose what holds at the other one.
	JointParams joint = elasticJoint(1e9, 4e8);
	joint.tension = joint.cohesion = 1e5;
	BlockAssembly a                = twoBlocks(joint);
	moveSecond(a, -1e-6 * normal);
	computeAllForces(a, joint, 1, 1);
	a.state.status[1] = Joint::brokenInShear, a.forces.broke[0] = true;
	computeAllForces(a, joint, 1, 1);
	EXPECT_FALSE(a.state.released[0]);
	EXPECT_TRUE(a.contacts.order.empty());
	EXPECT_EQ(a.state.status[0], Joint::intact);
	EXPECT_NEAR(a.state.sigma[0], -1e9 * 1e-6, 1e-6); // kn times the opening, to rounding
	a.state.status[0] = Joint::brokenInShear, a.forces.broke[0] = true;
	computeAllForces(a, joint, 1, 1);
	EXPECT_TRUE(a.state.released[0]);
}

TEST(ReleaseOfJoints, DilatedJointsAreReleasedWithoutAJump)
{
	// As above, with a joint that dilates for 2e-6 m: it stays a joint while it does, and what it was raised by stays for good.
	JointParams joint = elasticJoint(1e9, 4e8);
	joint.tension = 1e5, joint.cohesion = 100, joint.tanPhi = joint.tanPhiResidual = 0.5;
	joint.tanDilation = 0.2, joint.dilationLimitSlip = 2e-6;
	BlockAssembly a    = twoBlocks(joint);
	auto          move = [&](const Vec2& u) { moveSecond(a, u); };
	move(-1e-6 * normal);
	for (int i = 0; i < 5; ++i)
		move(4e-7 * along), computeAllForces(a, joint, 1, 1);
	EXPECT_NE(a.state.status[0], Joint::intact);
	EXPECT_FALSE(a.state.released[0]); // it still dilates
	slideSecond(a, 20);
	const Real atBreaking = 1.6e-6 - 500 / 4e8,
		   pressed    = 1e-6 + 0.2 * (2e-6 - atBreaking); // it breaks in the fourth step, beyond 600 Pa; that slip lifts nothing
	EXPECT_NEAR(a.state.sigma[0], -1e9 * pressed, 1);
	const auto before = forcesAtRest(a);
	const Real energy = jointEnergy(a), scale = largestForce(a);
	computeAllForces(a, joint, 1, 1);
	EXPECT_TRUE(a.state.released[0]);
	for (int n = 0; n < a.nodeCount(); ++n)
		EXPECT_LT((a.forces.nodal[n] - before[n]).norm(), 3e-5 * scale); // it has slid by 1e-5 of its length
	EXPECT_NEAR(jointEnergy(a), energy, 3e-5 * energy);
	// apart by less than the asperities are high they still touch; farther they do not
	move((pressed - 0.2e-6) * normal), computeAllForces(a, joint, 0, 1);
	EXPECT_GT(largestForce(a), 0.1 * scale);
	move(0.4e-6 * normal), computeAllForces(a, joint, 0, 1);
	EXPECT_EQ(contactEnergy(a), 0);
	// without a limit slip it dilates for a quarter of its length, 0.85 m
	joint.dilationLimitSlip = std::numeric_limits<Real>::max();
	for (Real slip : { 0.21, 0.22 }) {
		BlockAssembly b = twoBlocks(joint);
		computeAllForces(b, joint, 0);
		b.state.status[0] = b.state.status[1] = Joint::brokenInShear;
		b.state.sigma[0] = b.state.sigma[1] = -1;
		b.state.slipPlastic[0] = b.state.slipPlastic[1] = slip;
		b.forces.broke[0]                               = true;
		prepareContacts(b);
		EXPECT_EQ(bool(b.state.released[0]), slip > std::hypot(0.3, 0.8) / 4);
		EXPECT_EQ(b.contacts.waiting.empty(), bool(b.state.released[0]));
		EXPECT_FALSE(b.forces.broke[0]);
	}
}

TEST(ReleaseOfJoints, TornApartAndPushedTogetherAgain)
{
	// Two blocks with a strong joint between them are pulled apart and, with a shift, pushed together again: they meet with
	// what is left, kn and the residual friction, on the area that is left.
	JointParams joint = elasticJoint(1e9, 5e8);
	joint.tension = 1e5, joint.cohesion = 2e5, joint.tanPhi = 0.8, joint.tanPhiResidual = 0.3;
	BlockAssembly a = scene(2e9);
	addGrid(a, { 0, 0 }, 1, 0.5, 2, 1), addGrid(a, { 0, 0.5 }, 1, 0.5, 3, 1);
	bondAll(a, joint);
	auto all = [&](int block, bool y) { return dofs(a, y, [&, block](const Vec2& p) { return block == 0 ? p.y() < 1e-9 : p.y() > 1 - 1e-9; }); };
	a.addGroup(driven("bottom", all(0, true), 0)), a.addGroup(driven("bottom x", all(0, false), 0));
	const int  vertical = a.addGroup(driven("top", all(1, true), 0.05)), sideways = a.addGroup(driven("top x", all(1, false), 0));
	Simulation run(a, joint, 0.4, 0.5);
	run.steps(long(0.2 / run.dt)); // 10 mm open
	for (Joint status : a.state.status)
		EXPECT_EQ(status, Joint::brokenInTension);
	EXPECT_EQ(contactForce(a, 1).norm(), 0);
	a.state.groups[vertical].target = 0, a.state.groups[sideways].target = 1;
	run.steps(long(0.3 / run.dt)); // 0.3 m to the right
	a.state.groups[sideways].target = 0, a.state.groups[vertical].target = -0.05;
	Real touched = 0;
	while (contactForce(a, 1).y() < 5e4 && run.step * run.dt < 1) {
		run.steps(10);
		if (touched == 0 && contactForce(a, 1).y() > 0) touched = a.state.groups[vertical].travelled;
	}
	EXPECT_NEAR(touched, 0, 20 * run.dt * 0.05 + 2e-4); // the plates' own strain
	Real area = 0;
	for (int i : a.contacts.order)
		for (const EdgePair& e : a.state.contacts[i].edges)
			area += e.touching ? 2 * e.area : 0;
	EXPECT_NEAR(area, 0.7, 0.002);
	a.state.groups[vertical].target = 0, a.state.groups[sideways].target = 0.02;
	run.steps(long(0.1 / run.dt));
	const Vec2 f = contactForce(a, 1);
	EXPECT_NEAR(-f.x() / f.y(), 0.3, 0.003);
}

TEST(ReleaseOfJoints, ReleasedAndIntactSegmentsShareAnInterface)
{
	// A joint of three segments, the middle one broken: it alone becomes a free pair, neither forces nor areas change.
	JointParams joint    = elasticJoint(1e9, 5e8);
	joint.tanPhiResidual = 0.5;
	BlockAssembly a      = scene(1e9);
	addGrid(a, { 0, 0 }, 1.2, 0.5, 3, 1), addGrid(a, { 0, 0.5 }, 1.2, 0.5, 3, 1);
	bondAll(a, joint);
	ASSERT_EQ(a.joints.segments.size(), 3u);
	for (int n = a.mesh.firstNode[1]; n < a.nodeCount(); ++n)
		a.state.displacement[n].y() -= 1e-7;
	computeAllForces(a, joint, 0);
	EXPECT_TRUE(a.contacts.order.empty());
	const auto before = a.forces.nodal;
	for (int i : { 2, 3 })
		a.state.status[i] = Joint::brokenInShear;
	a.forces.broke[0] = true;
	computeAllForces(a, joint, 0);
	ASSERT_EQ(a.contacts.order.size(), 1u);
	for (int s : { 0, 1, 2 })
		EXPECT_EQ(bool(a.state.released[s]), s == 1);
	int active = 0;
	for (const EdgePair& e : a.state.contacts[0].edges)
		active += e.touching;
	EXPECT_GE(active, 1);
	const Real scale = largestForce(a);
	for (int n = 0; n < a.nodeCount(); ++n)
		EXPECT_LT((a.forces.nodal[n] - before[n]).norm(), 1e-5 * scale);
}

TEST(ReleaseOfJoints, PartingSetsFreeWhatTheSpringsHeld)
{
	// Two rigid boxes, sheared by s at depth d with residual cohesion, in which nothing slides: 2 x A ks s^2/2 with 2 A = 0.8 x 0.5. Then
	// they are parted in one step: all that the shear springs held counts as friction, and nothing is held any more.
	BlockAssembly a = scene(1e8, 0.5);
	addRigid(a, box(-1, -1, 3, 1)), addRigid(a, box(0, -1e-4, 0.8, 1));
	JointParams joint      = frictional(1e8, 4e7, 0);
	joint.cohesionResidual = joint.cohesion = 1e6;
	computeAllForces(a, joint, 1);
	const Real s = 1e-5;
	for (int n = a.mesh.firstNode[1]; n < a.mesh.firstNode[2]; ++n)
		a.state.displacement[n].x() += s, a.state.velocity[n].x() = s;
	computeAllForces(a, joint, 1);
	const Real shear = 0.8 * 0.5 * 4e7 * s * s / 2, normal = 0.8 * 0.5 * 1e8 * 1e-8 / 2;
	EXPECT_NEAR(contactEnergy(a), shear + normal, 1e-9 * (shear + normal));
	EXPECT_NEAR(contactForce(a, 1).x(), -0.8 * 0.5 * 4e7 * s, 1e-6);
	EXPECT_NEAR(contactFriction(a), 0, 1e-9 * shear);
	moveBlock(a, 1, { 0, 1e-3 });
	computeAllForces(a, joint, 1);
	EXPECT_EQ(contactEnergy(a), 0);
	EXPECT_EQ(contactForce(a, 1).norm(), 0);
	EXPECT_NEAR(contactFriction(a), shear, 1e-9 * shear);
}
