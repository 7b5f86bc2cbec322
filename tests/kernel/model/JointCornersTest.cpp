// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/analysis/Removal.hpp>
#include <blocks/kernel/model/Fingerprint.hpp>

using namespace specimens;

/// Blocks that joints hold together at a corner have no contact there; they get one as soon as these joints break.

namespace {

/// Four squares of 1 m that meet at (1, 1): 0 and 1 below, 2 and 3 above; general contact.
BlockAssembly fourSquares(JointParams joint)
{
	joint.tanPhiResidual = 0.5;
	BlockAssembly a;
	a.addMaterial(stone());
	for (int j : { 0, 1 })
		for (int i : { 0, 1 })
			addGrid(a, { Real(i), Real(j) }, 1, 1, 1, 1);
	bondAll(a, joint);
	a.joints.ofMaterials = { a.joints.kind[0] };
	setGeneralContact(a, true);
	return a;
}

/// The joint of two blocks.
int between(const BlockAssembly& a, int block1, int block2)
{
	for (int i = 0; i < a.joints.count(); ++i)
		if (a.joints.segments[i].block == std::array<int, 2> { block1, block2 }) return i;
	return -1;
}

/// As if a joint had broken in the last step.
void breakJoint(BlockAssembly& a, int joint)
{
	for (int p : { 2 * joint, 2 * joint + 1 })
		a.state.status[p] = Joint::brokenInTension;
	a.state.opening[2 * joint] = a.state.opening[2 * joint + 1] = 1e-9;
	a.forces.broke[joint / Joints::batch]                       = true;
}

void moveBlock(BlockAssembly& a, int block, const Vec2& by)
{
	for (int n = a.mesh.firstNode[block]; n < a.mesh.firstNode[block + 1]; ++n)
		a.state.displacement[n] += by;
}

/// Of normal springs [J].
Real energyBetween(const BlockAssembly& a, int block1, int block2)
{
	const FreeContact& c   = a.state.contacts[contactOf(a, block1, block2)];
	Real               sum = 0;
	for (int pair : c.active)
		sum += c.joint.kn * a.thickness * c.edges[pair].potential;
	return sum;
}

void touch(BlockAssembly& a)
{
	prepareContacts(a);
	advanceContacts(a, 0);
}

const JointParams weak = [] {
	JointParams p = elasticJoint(1e9, 5e8);
	p.tension = p.cohesion = 1e6;
	return p;
}();

} // namespace

TEST(JointCorners, JointsEndWhereBlocksMeet)
{
	const BlockAssembly a       = voronoi(1.7, 0.9, 6, 4, stone(), elasticJoint(1, 1), 0.4);
	const JointCorners  corners = cornersOf(a);
	const int           count   = int(corners.first.size()) - 1;
	std::vector<Vec2>   place(count);
	for (int c = 0; c < count; ++c) {
		ASSERT_LT(corners.first[c], corners.first[c + 1]);
		for (int i = corners.first[c]; i < corners.first[c + 1]; ++i) {
			const int   joint = corners.joints[i], end = corners.ofJoint[joint][0] == c ? 0 : 1;
			const auto& g  = a.joints.segments[joint];
			const Vec2  at = a.position(g.node[0]) + g.s1[end] * a.between(g.node[0], g.node[1]);
			ASSERT_EQ(corners.ofJoint[joint][end], c);
			if (i == corners.first[c]) place[c] = at;
			EXPECT_LT((at - place[c]).norm(), 4 * eps);
		}
		for (int other = 0; other < c; ++other)
			EXPECT_GT((place[other] - place[c]).norm(), 1e-4);
	}
	for (int n = 0; n < a.nodeCount(); ++n)
		if (corners.ofNode[n] >= 0) {
			EXPECT_LT((a.position(n) - place[corners.ofNode[n]]).norm(), 4 * eps);
		}
}

TEST(JointCorners, WhereAllIsWholeNothingIsAsked)
{
	// However hard it is pressed.
	BlockAssembly a = fourSquares(weak);
	for (Real strain : { 0., -1e-4, -1e-3 }) {
		for (int n = 0; n < a.nodeCount(); ++n)
			a.state.displacement[n] = strain * a.mesh.reference[n];
		for (int block : { 1, 2, 3 }) // joints close, too
			moveBlock(a, block, strain * Vec2(block % 2, block / 2));
		touch(a);
		EXPECT_TRUE(a.state.contacts.empty()) << strain;
	}
}

TEST(JointCorners, HeldByOneWayIsHeld)
{
	// 0 and 3 meet at the corner only. Of the two ways round it, by 1 and by 2, one is enough.
	BlockAssembly a = fourSquares(weak);
	touch(a);
	breakJoint(a, between(a, 0, 1));
	touch(a);
	EXPECT_EQ(contactOf(a, 0, 3), -1);
	EXPECT_EQ(contactOf(a, 1, 2), -1);
	EXPECT_GE(contactOf(a, 0, 1), 0); // the joint's own edges
	breakJoint(a, between(a, 2, 3));
	touch(a); // {0, 2} and {1, 3} are two halves now
	ASSERT_GE(contactOf(a, 0, 3), 0);
	ASSERT_GE(contactOf(a, 1, 2), 0);
	moveBlock(a, 3, { -1e-3, -1e-3 });
	touch(a);
	const Vec2 force = contactForce(a, 0);
	EXPECT_LT(force.x() + force.y(), 0); // 3 pushes 0 away
}

TEST(JointCorners, WhatOverlapsWhenAJointBreaksBringsNoEnergy)
{
	// 3 has come into 0 by what joints yield before the last of them breaks. The new contact holds nothing; it does when they come closer.
	for (Real overlap : { 1e-5, 1e-3, 1e-2 }) {
		BlockAssembly a = fourSquares(weak);
		touch(a);
		moveBlock(a, 3, { -overlap, -overlap });
		touch(a);
		EXPECT_TRUE(a.state.contacts.empty());
		breakJoint(a, between(a, 0, 1));
		breakJoint(a, between(a, 2, 3));
		breakJoint(a, between(a, 1, 3));
		for (int k = 0; k < 2; ++k) {
			touch(a);
			ASSERT_GE(contactOf(a, 0, 3), 0);
			EXPECT_EQ(energyBetween(a, 0, 3), 0) << overlap;
		}
		moveBlock(a, 3, { -1e-3, -1e-3 });
		touch(a);
		EXPECT_GT(energyBetween(a, 0, 3), 0);
	}
}

TEST(JointCorners, APutBackStateKnowsWhoIsHeld)
{
	// Put back before corners knew of the last break, and behind it: the same contacts as without.
	BlockAssembly a = fourSquares(weak);
	touch(a);
	breakJoint(a, between(a, 0, 1));
	breakJoint(a, between(a, 2, 3));
	const State before = a.state;
	touch(a);
	const auto hash = fingerprint(a.state);
	EXPECT_GE(contactOf(a, 0, 3), 0);
	BlockAssembly b = fourSquares(weak);
	touch(b);
	b.restore(before);
	touch(b);
	EXPECT_EQ(fingerprint(b.state), hash);
	b.restore(a.state);
	touch(b);
	touch(a);
	EXPECT_EQ(fingerprint(b.state), fingerprint(a.state));
}

TEST(JointCorners, RemovedBlocksHoldNobody)
{
	BlockAssembly a = fourSquares(weak);
	touch(a);
	removeBlocks(a, { 1 });
	touch(a);
	EXPECT_EQ(contactOf(a, 0, 3), -1); // by 2
	removeBlocks(a, { 2 });
	touch(a);
	ASSERT_GE(contactOf(a, 0, 3), 0);
	moveBlock(a, 3, { -1e-3, -1e-3 });
	touch(a);
	EXPECT_LT(contactForce(a, 0).x(), 0);
}
