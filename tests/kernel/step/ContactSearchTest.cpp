// yade-blocks, GPL-2.0-or-later
#include <ContactScenes.hpp>

using namespace contacts;

TEST(ContactSearch, NothingHappensWithoutThem)
{
	BlockAssembly a = twoBlocks(elasticJoint(1e9, 5e8));
	computeForces(a);
	EXPECT_TRUE(!a.contacts.started && a.state.contacts.empty() && a.contacts.rounding.empty() && a.state.search.detectedAt.empty());
	EXPECT_EQ(contactOf(a, 0, 1), -1);
}

TEST(ContactSearch, OnlyNearBlocksGetAContact)
{
	BlockAssembly a = scene();
	addFan(a, box(0, 0, 1, 1)), addFan(a, box(1.01, 0.3, 1, 1)), addFan(a, box(2.6, 0, 1, 1));
	a.contacts.wanted = true;
	prepareContacts(a);
	ASSERT_EQ(a.contacts.order.size(), 1u);
	const int c = contactOf(a, 1, 0);
	ASSERT_GE(c, 0);
	EXPECT_EQ(contactOf(a, 0, 1), c);
	EXPECT_EQ(contactOf(a, 0, 2), -1);
	const auto  facing = std::array<int, 2> { 1, 7 }; // right edge of block 0, left edge of block 1
	const auto& edges  = a.state.contacts[c].edges;
	EXPECT_TRUE(std::any_of(edges.begin(), edges.end(), [&](const EdgePair& e) { return e.edge == facing; }));
	expectRefusal([&] { setContactJoint(a, c, {}); }, { "kn must be positive" });
	EXPECT_EQ(a.state.contacts[c].joint.kn, 0); // nobody has said what the two materials are to each other
	for (int i = 0; i < 10; ++i)
		prepareContacts(a);
	EXPECT_EQ(a.contacts.looks, 1); // nothing has moved
}

TEST(ContactSearch, MaterialsDecideOnProperties)
{
	// Three materials, all pairs but one of them known, either way round.
	BlockAssembly a = scene();
	a.addMaterial(stone()), a.addMaterial(stone());
	const Ring square = box(0, 0, 1, 1);
	for (int i = 0; i < 3; ++i)
		a.addBlock(shifted(square, { 1.001 * i, 0 }), { { 0, 1, 2, 3 } }, {}, 2 - i);
	for (Real kn : { 3., 4. })
		a.joints.kinds.push_back(frictional(kn, 1, 0.1));
	a.joints.ofMaterials = { 1, 2, 0, 2, 1, 1, 0, 1, 0 };
	a.contacts.wanted    = true;
	prepareContacts(a);
	ASSERT_EQ(a.contacts.order.size(), 2u);
	EXPECT_EQ(a.state.contacts[contactOf(a, 0, 1)].joint.kn, 3); // materials 2 and 1
	EXPECT_EQ(a.state.contacts[contactOf(a, 1, 2)].joint.kn, 4); // 1 and 0
	a.bond({});                                                  // the kinds are new, so that those between materials are to be said again
	EXPECT_EQ(a.joints.kindOfMaterials(2, 1), 0);
}

TEST(ContactSearch, ABlockThatIsAddedLaterIsSeen)
{
	BlockAssembly a = scene();
	addFan(a, box(0, 0, 1, 1));
	const JointParams joint = frictional(1e6, 5e5, 0);
	computeAllForces(a, joint, 0);
	EXPECT_TRUE(a.contacts.order.empty());
	addFan(a, box(1 - 1e-4, 0.3, 1, 1));
	computeAllForces(a, joint, 0);
	ASSERT_EQ(a.contacts.order.size(), 1u);
	EXPECT_NEAR(contactForce(a, 1).x(), 1e6 * 1e-4 * 0.7, 0.01 * 70); // kn d times the overlap
}

TEST(ContactSearch, PairsAreFoundInTimeAndForgottenWhenFar)
{
	// A box comes down from out of reach at 2 m/s: its contact is there before it touches, and gone when it is lifted again.
	BlockAssembly a = scene();
	addRigid(a, box(-2, -1, 4, 1));
	addFan(a, box(-0.5, 0.5, 1, 1));
	Simulation run(a, frictional(1e6, 1e6, 0.5));
	EXPECT_TRUE(a.contacts.order.empty());
	setVelocity(a, 1, { 0.3, -2 });
	Real lowest = 1, before = 1;
	run.steps(20000, [&](Real) {
		Real low = 1;
		for (int n = a.mesh.firstNode[1]; n < a.mesh.firstNode[2]; ++n)
			low = std::min(low, a.position(n).y());
		if (before < -1e-6) {
			ASSERT_GT(contactForce(a, 1).y(), 0);
		}
		before = low;
		lowest = std::min(lowest, low);
	});
	EXPECT_LT(lowest, -0.01);
	EXPECT_GT(meanVelocity(a, 1).y(), 0);
	EXPECT_TRUE(a.contacts.order.empty());
	EXPECT_TRUE(std::all_of(a.state.contacts.begin(), a.state.contacts.end(), [](const FreeContact& c) { return c.edges.empty(); }));
}

TEST(ContactSearch, VelocitiesTellHowFarThingsHaveGone)
{
	// Where nobody else moves grid points, their velocities bound how far they have gone, and positions are compared only now and then. The
	// same contacts are found in the same steps.
	BlockAssembly watched = heap(12), trusted = watched;
	trusted.contacts.strangers = false;
	const JointParams joint    = frictional(2e6, 1e6, 25 * degree);
	Simulation        s(watched, joint, 0.4), t(trusted, joint, 0.4);
	for (int i = 0; i < 3000; ++i) {
		s.steps(1), t.steps(1);
		ASSERT_EQ(watched.contacts.looks, trusted.contacts.looks) << i;
		Real farthest = 0, fastest = 0; // along an axis
		for (int n = 0; n < trusted.nodeCount(); ++n)
			fastest = std::max(fastest, trusted.state.velocity[n].lpNorm<Eigen::Infinity>());
		for (int b : trusted.contacts.blocksInContact)
			for (int n = trusted.mesh.firstNode[b]; n < trusted.mesh.firstNode[b + 1]; ++n)
				farthest = std::max(farthest, (trusted.state.displacement[n] - trusted.contacts.odometer.seenAt[n]).lpNorm<Eigen::Infinity>());
		ASSERT_EQ(trusted.contacts.odometer.fastest, fastest) << i;
		ASSERT_GE(trusted.contacts.odometer.unseen, farthest * (1 - 1e-9)) << i;
	}
	EXPECT_GT(watched.contacts.looks, 10);
	expectSameBits(watched, trusted);
	EXPECT_EQ(contactFriction(watched), contactFriction(trusted));
}
