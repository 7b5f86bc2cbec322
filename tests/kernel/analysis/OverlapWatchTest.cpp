// yade-blocks, GPL-2.0-or-later
#include <analysis/PressedBlocks.hpp>

using namespace pressed;

TEST(OverlapWatch, SeesJointsThatActThoughTheirEdgesDoNotMeet)
{
	// Two squares of 0.4 m on each other with a broken joint, which presses. The upper one is pushed along, or turned about the middle of the joint.
	JointParams joint = elasticJoint(1e9, 5e8);
	joint.cohesion = joint.tension = 0;
	auto look =
		[&](Real along, Real turn, Joint status = Joint::brokenInShear, Real stress = -1, bool released = false, bool contact = false, int whole = -1) {
			BlockAssembly a;
			a.addMaterial(stone());
			addGrid(a, { 0, 0 }, 0.4, 0.4, 1, 1);
			addGrid(a, { 0, 0.4 }, 0.4, 0.4, 1, 1);
			bondAll(a, joint);
			const Vec2 middle(0.2, 0.4);
			for (int n = a.mesh.firstNode[1]; n < a.mesh.firstNode[2]; ++n) {
				const Vec2 arm = a.mesh.reference[n] - middle;
				a.place(n, middle + Vec2(along, 0) + std::cos(turn) * arm + std::sin(turn) * Vec2(-arm.y(), arm.x()));
			}
			for (int p : { 0, 1 })
				a.state.status[p] = status, a.state.sigma[p] = stress, a.state.slip[p] = along;
			if (whole >= 0) a.state.status[whole] = Joint::intact;
			a.state.released[0] = released, a.contacts.wanted = contact;
			EXPECT_EQ(StabilityWatch::lookAtEnd(a).stable, firstStrayed(a) < 0);
			return firstStrayed(a) == 0;
		};
	EXPECT_FALSE(look(0.79, 0)); // edges of 0.4 m each still meet at their ends, if they had been bonded end to end
	EXPECT_TRUE(look(0.81, 0) && look(-0.81, 0));
	EXPECT_FALSE(look(0, 1.5) || look(0, -1.5));
	EXPECT_TRUE(look(0, 1.6) && look(0, -1.6));
	EXPECT_FALSE(look(0.81, 0, Joint::softening, -1, false, true)); // other edges act, too
	EXPECT_TRUE(look(0, 1.6, Joint::softening, -1, false, true));
	for (int whole : { 0, 1 })
		EXPECT_TRUE(look(0, 1.6, Joint::brokenInShear, -1, false, true, whole)); // turned about the end that holds
	for (Real along : { 0., 0.81 }) {                                                // what is open, whole or a free contact does not act there
		EXPECT_FALSE(look(along, 1.6, Joint::brokenInShear, 0));
		EXPECT_FALSE(look(along, 1.6, Joint::intact));
		EXPECT_FALSE(look(along, 1.6, Joint::brokenInShear, -1, true));
	}
}

TEST(OverlapWatch, ComparesJointsWithTheLowerZone)
{
	BlockAssembly a = twoMeshes();
	OverlapWatch  watch;
	watch.look(a);
	EXPECT_EQ(watch.joint.share(), 0);

	a.state.opening[2] = -0.012, a.state.opening[3] = 0.5; // an open end does not count
	watch.look(a);
	EXPECT_EQ(watch.joint.block, (std::array<int, 2> { 0, 1 }));
	EXPECT_NEAR(watch.joint.height, 0.08, 100 * eps);
	EXPECT_NEAR(watch.joint.share(), 0.15, 1000 * eps);
	EXPECT_NEAR(watch.mean, 0.15, 1000 * eps); // of what is closed
	BlockAssembly b    = a;
	b.state.opening[0] = b.state.opening[1] = -0.004;
	watch.look(b);
	EXPECT_NEAR(
		watch.mean,
		(0.15 * b.joints.segments[1].area + 0.05 * b.joints.segments[0].area) / (b.joints.segments[0].area + b.joints.segments[1].area),
		1000 * eps);
	watch.look(a);
	EXPECT_EQ(&watch.thickest(), &watch.joint);

	a.releaseJoint(1); // its points carry nothing, what they say is not looked at
	watch.look(a);
	EXPECT_EQ(watch.joint.share(), 0);
}

TEST(OverlapWatch, EveryJointHasZonesBehind)
{
	for (BlockAssembly a : { voronoi(1, 0.6, 4, 2, stone(), elasticJoint(1, 1), 0.5),
	                         column(2, 0.4, 0.004, 2, 1, stone(), elasticJoint(1, 1)),
	                         twoBlocks(elasticJoint(1, 1)) })
		for (size_t i = 0; i < a.state.status.size(); ++i) {
			BlockAssembly b    = a;
			b.state.opening[i] = -1;
			OverlapWatch watch;
			watch.look(b);
			EXPECT_GT(watch.joint.height, 0);
			EXPECT_LT(watch.joint.height, 1); // no block is higher
			EXPECT_EQ(watch.joint.block, b.joints.segments[i / 2].block);
		}
}

TEST(OverlapWatch, FollowsAFreeContactThroughTheBlock)
{
	// Squares of 1 m; zones 0.5 m high; the innermost point is the grid point in the middle.
	Pressed      p;
	OverlapWatch watch;
	for (Real depth = 0; depth < 1.6; depth += 0.05) {
		p.put(depth);
		watch.look(p.a);
		if (depth < 0.24) { // the depth at which the contact is lost, area by outline
			EXPECT_NEAR(watch.contact.share(), depth / 0.5, 1e-9);
			EXPECT_EQ(&watch.thickest(), depth > 0 ? &watch.contact : &watch.thickest());
		}
		const bool inside = depth > 0.5 + 1e-9 && depth < 1.5 - 1e-9;
		if (std::abs(depth - 0.5) > 0.01 && std::abs(depth - 1.5) > 0.01) {
			EXPECT_EQ(watch.through[0] >= 0, inside) << depth;
		}
	}
}

TEST(OverlapWatch, ABlockInAHoleOrANotchIsNotWithinTheOther)
{
	// A frame of 3 m with a hole of 1 m and a square in the hole: the frame's centroid lies within the square, its innermost point does not.
	BlockAssembly a;
	a.addMaterial(stone());
	const Ring        outer { { 0, 0 }, { 3, 0 }, { 3, 3 }, { 0, 3 } }, inner { { 1, 1 }, { 1, 2 }, { 2, 2 }, { 2, 1 } };
	std::vector<Vec2> points(outer);
	points.insert(points.end(), inner.begin(), inner.end());
	const std::vector<std::array<int, 3>> zones { { 0, 1, 7 }, { 0, 7, 4 }, { 1, 2, 6 }, { 1, 6, 7 }, { 2, 3, 5 }, { 2, 5, 6 }, { 3, 0, 4 }, { 3, 4, 5 } };
	a.addBlock(points, { { 0, 1, 2, 3 }, { 4, 5, 6, 7 } }, zones, 0);
	addGrid(a, { 1, 1 }, 1, 1, 2, 2);
	a.contacts.wanted = true;
	prepareContacts(a);
	setContactJoint(a, 0, elasticJoint(1e9, 5e8));
	advanceContacts(a, 1e-9);
	OverlapWatch watch;
	watch.look(a);
	EXPECT_EQ(watch.through[0], -1);
	for (int n = a.mesh.firstNode[1]; n < a.mesh.firstNode[2]; ++n) // now into the frame
		a.state.displacement[n] += Vec2(-0.6, 0);
	watch.look(a);
	EXPECT_EQ(watch.through, (std::array<int, 2> { 1, 0 }));
}
