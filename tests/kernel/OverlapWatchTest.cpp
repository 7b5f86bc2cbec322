// yade-blocks, GPL-2.0-or-later
#include "Specimens.hpp"
#include <blocks/kernel/StabilityWatch.hpp>

using namespace specimens;

namespace {

/// Two unequally meshed rectangles, 0.6 x 0.2 m below 0.6 x 0.4 m; zones behind the joint are 0.1 and 0.08 m high.
BlockAssembly twoMeshes()
{
	BlockAssembly a;
	a.addMaterial(stone());
	addGrid(a, { 0, 0 }, 0.6, 0.2, 3, 2);
	addGrid(a, { 0, 0.2 }, 0.6, 0.4, 2, 5);
	bondAll(a, elasticJoint(100e9, 40e9));
	return a;
}

/// A square of 1 m that was never bonded, `depth` deep in another one, with the contact's forces.
struct Pressed {
	BlockAssembly a;
	Pressed()
	{
		a.addMaterial(stone());
		addGrid(a, { 0, 0 }, 1, 1, 2, 2);
		addGrid(a, { 0.1, 1 }, 1, 1, 2, 2);
		requestContact(a, 0, 1);
		prepareContacts(a);
		JointParams joint = elasticJoint(1e9, 5e8);
		joint.cohesion = joint.tension = 0;
		setContactJoint(a, 0, joint);
	}
	void put(Real depth)
	{
		for (int n = a.firstNode[1]; n < a.firstNode[2]; ++n)
			a.position[n] = a.reference[n] - Vec2(0, depth);
		prepareContacts(a);
		advanceContacts(a, 1e-9);
		computeJointForces(a);
		gatherForces(a);
	}
};

} // namespace

TEST(OverlapWatch, GreatestForceOfAFreeContactIsWhereItSays)
{
	// Two long parallel edges: U = D^2 h(6 (D/limit)^2) T L kn / 2; depths in steps of 0.001 of the limit.
	EdgeShape shape {};
	shape.rounding = shape.farRounding = { 1e-3, 1e-3 };
	shape.depthLimit                   = 0.25;
	Real greatest = 0, where = 0;
	for (Real share = 0.01; share < 1; share += 1e-3) {
		const FourPoints x { Vec2(0, 0), Vec2(1, 0), Vec2(1, share * 0.25), Vec2(0, share * 0.25) }; // the first block is above y = 0
		EdgeGeometry     g;
		FourPoints       force;
		force.fill(Vec2::Zero());
		edgeGeometry(x, shape, g);
		ASSERT_TRUE(g.active);
		addNormalForces(x, shape, g, 1, force);
		const Real apart = force[0].y() + force[1].y();
		if (apart > greatest) greatest = apart, where = share;
	}
	EXPECT_GT(greatest, 0);
	EXPECT_NEAR(where, OverlapWatch::lostFrom, 0.005);
}

TEST(OverlapWatch, ComparesJointsWithTheLowerZoneAndTheSmallerBlock)
{
	BlockAssembly a = twoMeshes();
	OverlapWatch  watch;
	watch.look(a);
	EXPECT_EQ(watch.thickest.share(), 0);
	EXPECT_EQ(watch.deepest.block[0], -1);

	a.points[2].opening = -0.012, a.points[3].opening = 0.5; // an open end does not count
	watch.look(a);
	EXPECT_EQ(watch.thickest.block, (std::array<int, 2> { 0, 1 }));
	EXPECT_NEAR(watch.thickest.bound, 0.08, 100 * eps);
	EXPECT_NEAR(watch.thickest.share(), 0.15, 1000 * eps);
	// area by outline: 0.12/1.6 below, 0.24/2 above
	EXPECT_NEAR(watch.deepest.bound, OverlapWatch::lostFrom * 0.12 / 1.6, 100 * eps);
	EXPECT_NEAR(watch.deepest.depth, 0.012 / std::sqrt(2), 100 * eps);

	a.segments[1].area = 0; // released: its points carry nothing, what they say is not looked at
	watch.look(a);
	EXPECT_EQ(watch.thickest.share(), 0);
}

TEST(OverlapWatch, EveryJointHasZonesBehind)
{
	for (BlockAssembly a : { voronoi(1, 0.6, 4, 2, stone(), elasticJoint(1, 1), 0.5), column(2, 0.4, 0.004, 2, 1, stone(), elasticJoint(1, 1)), twoBlocks(elasticJoint(1, 1)) })
		for (size_t i = 0; i < a.points.size(); ++i) {
			BlockAssembly b     = a;
			b.points[i].opening = -1;
			OverlapWatch watch;
			watch.look(b);
			EXPECT_GT(watch.thickest.bound, 0);
			EXPECT_LT(watch.thickest.bound, 1); // no block is higher
			EXPECT_EQ(watch.thickest.block, b.segments[i / 2].block);
		}
}

TEST(OverlapWatch, FollowsAFreeContactThroughTheBlock)
{
	// Squares of 1 m, zones 0.5 m high, depth limit 1/4 m.
	Pressed      p;
	OverlapWatch watch;
	p.put(0.02);
	watch.look(p.a);
	EXPECT_NEAR(watch.thickest.share(), 0.04, 1e-9);
	EXPECT_NEAR(watch.deepest.share(), 0.02 / (OverlapWatch::lostFrom * 0.25), 1e-9);
	p.put(0.1);
	watch.look(p.a);
	EXPECT_LT(watch.deepest.share(), 1);
	p.put(0.11);
	watch.look(p.a);
	EXPECT_GT(watch.deepest.share(), 1);

	// on to where nothing is left of the contact, as between two looks
	Pressed q;
	for (Real depth = 0; depth < 0.4; depth += 0.01)
		q.put(depth);
	EXPECT_TRUE(q.a.contacts.all[0].active.empty());
	watch.look(q.a);
	EXPECT_GT(watch.deepest.share(), 1);
	EXPECT_EQ(watch.deepest.block, (std::array<int, 2> { 0, 1 }));

	// blocks that part have not gone through each other
	Pressed r;
	r.put(0.05);
	r.put(-0.05);
	watch.look(r.a);
	EXPECT_EQ(watch.deepest.share(), 0);
}

TEST(OverlapWatch, SeesAZoneThatHasTurnedInsideOut)
{
	BlockAssembly a = twoMeshes();
	OverlapWatch  watch;
	watch.look(a);
	EXPECT_EQ(watch.inverted, -1);
	rotateAbout(a, { 0.3, 0.2 }, 2, { 1, 0 }); // turning is none of that
	watch.look(a);
	EXPECT_EQ(watch.inverted, -1);
	std::swap(a.position[a.firstNode[1]], a.position[a.firstNode[1] + 1]);
	watch.look(a);
	EXPECT_EQ(watch.inverted, 1);
}

TEST(StabilityWatch, WarnsOnceOfThickJointsAndStopsLostOnes)
{
	BlockAssembly  a = twoMeshes();
	StabilityWatch watch;
	auto           pressed = [&](Real overlap, long step) {
                for (auto& p : a.points)
                        p.opening = -overlap;
                return watch.look(a, step, step * 1e-3, 1e-3);
	};
	EXPECT_EQ(pressed(0.007, 0).warning, "");
	const auto first = pressed(0.009, 100), second = pressed(0.01, 200), lost = pressed(0.031, 300);
	EXPECT_TRUE(first.stable && second.stable);
	EXPECT_NE(first.warning.find("blocks 0 and 1 overlap by 0.009 m"), std::string::npos) << first.warning;
	EXPECT_NE(first.warning.find("11 % of the 0.08 m"), std::string::npos) << first.warning;
	EXPECT_EQ(second.warning, "");
	EXPECT_FALSE(lost.stable);
	EXPECT_EQ(lost.block, 0);
	EXPECT_NE(lost.reason.find("blocks 0 and 1 overlap by 0.031"), std::string::npos) << lost.reason;
	EXPECT_EQ(watch.restore(a), 200);
}
