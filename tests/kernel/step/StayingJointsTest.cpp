// yade-blocks, GPL-2.0-or-later
#include <ContactScenes.hpp>
#include <blocks/kernel/step/Release.hpp>

using namespace contacts;

namespace {

constexpr Real width = 0.4; // of the upper block [m]

JointParams rubbing()
{
	JointParams p = elasticJoint(1e9, 4e8);
	p.cohesion = p.tension = 100; // it held little when it broke: a hundredth of that is nothing
	p.tanPhiResidual       = 0.5;
	return p;
}

/// A block on the middle one of five edges of a longer one; their joint is broken and pressed by 1 kPa. Masses are scaled unless they are to be the true ones.
BlockAssembly upperOnLower(const JointParams& joint, bool scaled = true, Joint status = Joint::brokenInShear)
{
	BlockAssembly a = scene(1e9);
	addGrid(a, { 0, 0 }, 5 * width, 0.5, 5, 1), addGrid(a, { 2 * width, 0.5 }, width, 0.5, 1, 1);
	bondAll(a, joint);
	for (int n = 0; n < a.nodeCount(); ++n)
		a.state.inertia[n] = (scaled ? 2 : 1) * a.mesh.mass[n];
	a.state.status[0] = a.state.status[1] = status;
	moveBlock(a, 1, { 0, -1e-6 });
	updateKinematics(a, allJoints(a)); // it knows what it bears before anybody releases it
	advanceStresses(a, allJoints(a), Brittle {});
	return a;
}

/// Moves the upper block in a step of one second.
void moveUpper(BlockAssembly& a, const Vec2& by, const JointParams& joint)
{
	moveBlock(a, 1, by);
	setVelocity(a, 1, by);
	computeAllForces(a, joint, 1);
}

/// What the lower block does to the upper one [N].
Vec2 forceOnUpper(const BlockAssembly& a)
{
	Vec2 sum = Vec2::Zero();
	for (int n = a.mesh.firstNode[1]; n < a.nodeCount(); ++n)
		sum += a.forces.nodal[n];
	return sum;
}

/// Steps until the joint is released.
int stepsAsJoint(BlockAssembly& a, const Vec2& by, const JointParams& joint)
{
	int steps = 0;
	while (!a.state.released[0] && steps < 100)
		moveUpper(a, by, joint), ++steps;
	return steps;
}

} // namespace

TEST(StayingJoints, UntilTheirEdgesHaveMovedOn)
{
	// 2 % of 0.4 m are 8 mm, passed in the ninth step: the tenth releases it.
	for (const Vec2& by : { Vec2(0.95e-3, 0), Vec2(-0.95e-3, 0), Vec2(0, 0.95e-3) }) {
		BlockAssembly a = upperOnLower(rubbing());
		computeAllForces(a, rubbing(), 1);
		EXPECT_FALSE(a.state.released[0]);
		EXPECT_EQ(stepsAsJoint(a, by, rubbing()), 10) << by.transpose();
		EXPECT_TRUE(a.contacts.waiting.empty());
	}
}

TEST(StayingJoints, NotWhereMassesAreTrueOrNothingWasBonded)
{
	for (bool scaled : { true, false })
		for (Joint status : { Joint::brokenInShear, Joint::brokenInTension, Joint::unbonded }) {
			BlockAssembly a = upperOnLower(rubbing(), scaled, status);
			computeAllForces(a, rubbing(), 1);
			EXPECT_EQ(bool(a.state.released[0]), !scaled || status == Joint::unbonded);
			if (a.state.released[0]) continue;
			a.state.inertia = a.mesh.mass; // a run that goes on with the true masses
			askAllWhether(a);
			computeAllForces(a, rubbing(), 1);
			EXPECT_TRUE(a.state.released[0]);
		}
}

TEST(StayingJoints, DoWhatTheFreeContactWouldDo)
{
	// The block slides by a quarter of its width, over the end of the edge that it lies on: its weight goes from one edge to the next, and nothing is lost
	// when the joint is released on the way.
	BlockAssembly stays = upperOnLower(rubbing()), free = upperOnLower(rubbing(), false);
	for (auto* a : { &stays, &free })
		computeAllForces(*a, rubbing(), 1);
	ASSERT_TRUE(free.state.released[0] && !stays.state.released[0]);
	const Real weight = 1e9 * 1e-6 * width;
	for (int i = 0; i < 100; ++i) {
		for (auto* a : { &stays, &free })
			moveUpper(*a, { 1e-3, 0 }, rubbing());
		EXPECT_NEAR(forceOnUpper(stays).y(), weight, 2e-3 * weight) << i; // free contacts blend their ends
		EXPECT_NEAR(forceOnUpper(free).y(), weight, 2e-3 * weight) << i;
		EXPECT_NEAR(forceOnUpper(stays).x(), -0.5 * weight, 2e-3 * weight) << i;
	}
	EXPECT_TRUE(stays.state.released[0]);
	EXPECT_LT((forceOnUpper(stays) - forceOnUpper(free)).norm(), 1e-6 * weight);
}

TEST(StayingJoints, ThoseThatWaitAreNotToldOfInEveryStep)
{
	// It dilates, so it is asked in every step until it has slid by its limit slip; its batch is not.
	JointParams joint = rubbing();
	joint.tanDilation = 0.1, joint.dilationLimitSlip = 20e-3;
	BlockAssembly a = upperOnLower(joint);
	for (int i = 0; i < 12; ++i)
		moveUpper(a, { 1e-3, 0 }, joint);
	EXPECT_EQ(a.contacts.waiting, std::vector<int> { 0 });
	EXPECT_FALSE(a.forces.broke[0]);
	EXPECT_EQ(stepsAsJoint(a, { 1e-3, 0 }, joint), 12); // the springs hold 2.5 mm of its slip, under a pressure of 2 MPa
}

TEST(StayingJoints, ALawThatDoesNotSayWhoMovesOn)
{
	BlockAssembly      a = upperOnLower(rubbing());
	std::vector<Joint> known;
	computeAllForces(a, rubbing(), 1);
	noteBroken(a, known);
	a.forces.broke[0] = false;
	for (Real slip : { 7.9e-3, 8.1e-3 }) {
		a.state.slip[1] = slip;
		noteBroken(a, known);
		EXPECT_EQ(bool(a.forces.broke[0]), slip > staysFor * width);
	}
}

TEST(StayingJoints, StressesInSituMoveNobody)
{
	// Of stiff blocks with a soft joint that has been closed by more than 2 % of its length, in thought.
	JointParams joint = rubbing();
	joint.kn = joint.ks    = 1e5;
	BlockAssembly a        = upperOnLower(joint);
	a.joints.inSituOpening = { { -9e-3, -9e-3 } }, a.joints.inSituSlip = { { 0, 0 } };
	a.state.opening = { -9e-3, -9e-3 };
	EXPECT_FALSE(hasMovedOn(a, 0, { -9e-3, -9e-3 }, { 0, 0 }));
	EXPECT_TRUE(hasMovedOn(a, 0, { 0, 0 }, { 0, 0 }));
}
