// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <numeric>
#include <set>

using namespace specimens;

namespace {

Real totalArea(const std::vector<Segment>& segments)
{
	Real sum = 0;
	for (const Segment& g : segments)
		sum += 2 * g.area;
	return sum;
}

void expectHostsMeet(const BlockAssembly& a, const std::vector<Segment>& segments, Real tolerance)
{
	for (const Segment& g : segments)
		for (int k : { 0, 1 })
			EXPECT_LT((host(a, g, 0, k) - host(a, g, 1, k)).norm(), tolerance);
}

} // namespace

TEST(JointDetection, ConformingEdge)
{
	BlockAssembly a = twoBlocks(elasticJoint(1, 1), 0.7);
	ASSERT_EQ(a.joints.segments.size(), 1u);
	const Segment& g = a.joints.segments[0];
	EXPECT_EQ(g.block, (std::array<int, 2> { 0, 1 }));
	EXPECT_EQ(g.node, (std::array<int, 4> { 1, 2, 9, 5 })); // (1,0) -> (1.3,0.8), and the same the other way on block 1
	EXPECT_EQ(g.s1, (std::array<Real, 2> { 0, 1 }));
	EXPECT_EQ(g.s2, (std::array<Real, 2> { 1, 0 }));
	EXPECT_NEAR(2 * g.area, 0.7 * std::hypot(0.3, 0.8), 8 * eps); // some 8 roundings of a number below 1
	ASSERT_EQ(a.joints.pairs.size(), 1u);
	EXPECT_EQ(a.joints.pairs[0].first, 0);
	EXPECT_EQ(a.joints.pairs[0].last, 1);
	EXPECT_EQ(a.joints.blocksOfBatch[0].first, 0);
	EXPECT_EQ(a.joints.blocksOfBatch[0].last, 1);
}

TEST(JointDetection, AreasAddUpOnUnequalMeshes)
{
	// 3 edges against 7 along a skew line of length 2.5 from (0, 0) in the direction (3, 4)/5: 9 overlaps, 18 points, L t in all.
	BlockAssembly a = emptyAssembly(0.35);
	const Vec2    along(0.6, 0.8), across(0.8, -0.6);
	auto          side = [&](int n, Real sign) {
                Ring ring;
                for (int i = 0; i <= n; ++i)
                        ring.push_back(2.5 * (sign > 0 ? n - i : i) / n * along); // block 0 lies left of the line
                ring.push_back(ring.back() + sign * 0.9 * across);
                ring.push_back(ring.front() + sign * 0.9 * across);
                return ring;
	};
	addFan(a, side(3, -1));
	addFan(a, side(7, +1));
	const auto found = detectSegments(a);
	EXPECT_EQ(found.size(), 9u);
	EXPECT_NEAR(totalArea(found), 2.5 * 0.35, 9 * 8 * eps); // 9 terms, 8 roundings each of numbers below 1
	expectHostsMeet(a, found, 20 * eps * 2.5);
}

TEST(JointDetection, PartlyOverlappingEdges)
{
	// A brick on two others in running bond, and one beside it: surfaces 0.7 + 0.6 below, 0.5 at the side.
	BlockAssembly a = emptyAssembly(2);
	addGrid(a, { 0, 0 }, 1, 0.5, 2, 1);
	addGrid(a, { 1, 0 }, 1, 0.5, 3, 2);
	addGrid(a, { 0.3, 0.5 }, 1.3, 0.4, 3, 1);
	auto bond = [&](int i, int j) {
		Real sum = 0;
		for (const Segment& g : detectSegments(a))
			if (g.block == std::array<int, 2> { i, j }) sum += 2 * g.area;
		return sum;
	};
	// sums of at most 4 pieces with 8 roundings of numbers of order 2
	EXPECT_NEAR(bond(0, 1), 0.5 * 2, 64 * eps);
	EXPECT_NEAR(bond(0, 2), 0.7 * 2, 64 * eps);
	EXPECT_NEAR(bond(1, 2), 0.6 * 2, 64 * eps);
	expectHostsMeet(a, detectSegments(a), 20 * eps * 2);
}

TEST(JointDetection, SurfaceOfATessellation)
{
	// Every edge of every cell is either the outline's or a joint: joints = (sum of perimeters - outline) / 2.
	BlockAssembly a          = voronoi(1.7, 0.9, 6, 4, stone(), elasticJoint(1, 1), 0.4);
	Real          perimeters = 0;
	for (const auto& e : a.mesh.edgeNodes)
		perimeters += (a.position(e[1]) - a.position(e[0])).norm();
	const auto found = detectSegments(a);
	// some 60 joints of length below 0.4, each with 8 roundings, and as many in the sum of perimeters
	EXPECT_NEAR(totalArea(found), (perimeters - 2 * (1.7 + 0.9)) / 2 * 0.4, 1000 * eps);
	for (size_t i = 0; i + 1 < found.size(); ++i)
		EXPECT_LE(found[i].block, found[i + 1].block) << "segments must come sorted by pair";
}

TEST(JointDetection, WhatDoesNotTouchIsNoJoint)
{
	BlockAssembly a = emptyAssembly(1);
	addGrid(a, { 0, 0 }, 1, 1, 1, 1);
	addGrid(a, { 1, 1 }, 1, 1, 1, 1);        // corner to corner
	addGrid(a, { 0, 1.0001 }, 0.9, 1, 1, 1); // a gap of 1e-4 of the shorter edge, wider than the default 1e-6
	EXPECT_TRUE(detectSegments(a).empty());
	const auto wide = detectSegments(a, 1e-3); // but not than this
	ASSERT_EQ(wide.size(), 1u);
	EXPECT_EQ(wide[0].block, (std::array<int, 2> { 0, 2 }));
	EXPECT_NEAR(2 * wide[0].area, 0.9, 8 * eps);
}

TEST(JointDetection, OrderOfBlocksOnlyChangesTheSides)
{
	BlockAssembly a = emptyAssembly(1), b = emptyAssembly(1);
	const Ring    left { { 0, 0 }, { 1, 0 }, { 1.2, 0.7 }, { 0, 1 } }, right { { 1, 0 }, { 2, 0.1 }, { 1.2, 0.7 } };
	addFan(a, left), addFan(a, right);
	addFan(b, right), addFan(b, left);
	bondAll(a, elasticJoint(5, 3));
	bondAll(b, elasticJoint(5, 3));
	ASSERT_EQ(b.joints.segments.size(), 1u);
	EXPECT_EQ(b.joints.segments[0].area, a.joints.segments[0].area);
	// The same displacements, node by node: the same opening and slip at the same place. Terms of order 1, some 20 roundings.
	disturb(a, 0.1);
	for (int n = 0; n < 5; ++n)
		b.place(4 + n, a.position(n));
	for (int n = 0; n < 4; ++n)
		b.place(n, a.position(5 + n));
	computeForces(a);
	computeForces(b);
	for (int k : { 0, 1 }) { // points run along the first block's edge, so the other way round here
		EXPECT_NEAR(b.state.opening[1 - k], a.state.opening[k], 20 * eps);
		EXPECT_NEAR(b.state.slip[1 - k], a.state.slip[k], 20 * eps);
	}
	const auto fa = jointForces(a), fb = jointForces(b);
	for (int n = 0; n < 5; ++n)
		EXPECT_LT((fa[n] - fb[4 + n]).norm(), 100 * eps); // stiffness 5, openings 0.2, area 0.36
}

TEST(JointDetection, Refusals)
{
	BlockAssembly a = twoBlocks(elasticJoint(1, 1));
	expectRefusal([&] { detectSegments(a, 0); }, { "detectSegments: tolerance", "(0, 0.1)", "got 0" });
	expectRefusal([&] { detectSegments(a, 0.25); }, { "detectSegments: tolerance", "(0, 0.1)", "got 0.25" });
	expectRefusal([&] { detectSegments(a, std::nan("")); }, { "detectSegments: tolerance", "nan" });
}

TEST(JointDetection, RefusesBlocksThatPenetrate)
{
	BlockAssembly a = emptyAssembly(1);
	addGrid(a, { 0, 0 }, 1, 1, 1, 1);
	addGrid(a, { 0.9, 0.2 }, 1, 0.5, 1, 1);
	expectRefusal([&] { detectSegments(a); }, { "blocks 0 and 1 overlap", "must not overlap" });

	BlockAssembly same = emptyAssembly(1); // no edges cross, but they run the same way
	addGrid(same, { 0, 0 }, 1, 1, 2, 1);
	addGrid(same, { 0, 0 }, 1, 1, 1, 1);
	expectRefusal([&] { detectSegments(same); }, { "blocks 0 and 1 overlap" });
}

TEST(JointDetection, ThinBlocksAreNotTheirNeighbours)
{
	// A millionth as thick as long: the tolerance for touching must not reach through it. Two joints, 1 m long each.
	BlockAssembly a;
	a.addMaterial(stone());
	addGrid(a, { 0, -1 }, 1, 1, 2, 2);
	addGrid(a, { 0, 0 }, 1, 1e-6, 3, 1);
	addGrid(a, { 0, 1e-6 }, 1, 1, 2, 2);
	const auto found = detectSegments(a);
	for (const Segment& g : found)
		EXPECT_EQ(g.block[1], g.block[0] + 1);
	EXPECT_NEAR(totalArea(found), 2 * a.thickness, 1e-6);
}

TEST(JointDetection, RefusesABlockWithinAnother)
{
	const auto within = [](const Ring& outer, const Ring& inner, bool innerFirst) {
		BlockAssembly a;
		a.addMaterial(stone());
		for (const Ring& ring : innerFirst ? std::vector<Ring> { inner, outer } : std::vector<Ring> { outer, inner }) {
			std::vector<int> nodes(ring.size());
			std::iota(nodes.begin(), nodes.end(), 0);
			a.addBlock(ring, { nodes }, {}, 0);
		}
		detectSegments(a);
	};
	const Ring square { { 0, 0 }, { 3, 0 }, { 3, 3 }, { 0, 3 } }, small { { 1, 1 }, { 2, 1 }, { 1.4, 2 } };
	const Ring diamond { { 1.5, 0 }, { 3, 1.5 }, { 1.5, 3 }, { 0, 1.5 } }; // its corners touch the square's sides, none of its edges cross them
	const Ring hook { { 0, 0 }, { 3, 0 }, { 3, 3 }, { 2.5, 3 }, { 2.5, 0.5 }, { 0.5, 0.5 }, { 0.5, 3 }, { 0, 3 } };
	for (bool innerFirst : { false, true }) {
		expectRefusal([&] { within(square, small, innerFirst); }, { "blocks 0 and 1 overlap" });
		expectRefusal([&] { within(square, diamond, innerFirst); }, { "blocks 0 and 1 overlap" });
		EXPECT_NO_THROW(within(hook, small, innerFirst)); // in its box, not in it
	}
}

TEST(UnjoinedBlocks, AreThoseThatDetectionFindsBesideTheJoined)
{
	// Two tessellations, each bonded by itself, half a percent of an edge apart, and a loose stone in contact with both and with nothing else.
	BlockAssembly a = voronoi(1.7, 0.9, 6, 4, stone(), elasticJoint(1, 1), 0.4);
	addGrid(a, { 1.7 + 5e-4, 0.1 }, 0.5, 0.6, 3, 4);
	addGrid(a, { 0.2, 0.9 }, 1.8, 0.3, 7, 2);
	std::set<std::array<int, 2>> expected;
	for (const Segment& g : detectSegments(a, 0.01))
		expected.insert(g.block);
	for (const Pair& pair : a.joints.pairs)
		expected.erase(pair.block);
	ASSERT_GT(expected.size(), 8u);
	std::set<std::array<int, 2>> found;
	for (const Unjoined& u : unjoinedBlocks(a)) {
		found.insert(u.block);
		EXPECT_NEAR(u.gap, u.block[1] == a.blockCount() - 2 ? 5e-4 : 0, 1e-9);
	}
	EXPECT_TRUE(found == expected);
	bondAll(a, elasticJoint(1, 1));
	for (const Unjoined& u : unjoinedBlocks(a)) // bonded with the narrow tolerance: those across the gap are left
		EXPECT_EQ(u.block[1], a.blockCount() - 2);
}

TEST(UnjoinedBlocks, EdgesJoinedInPartAreAsked)
{
	// The top of 0 is joined with 2 over one half, the bottom of 3 with 1 over one half; the other halves are 5 mm apart.
	BlockAssembly a;
	a.addMaterial(stone());
	addGrid(a, { 0, 0 }, 2, 1, 1, 1);
	addGrid(a, { 2, 0 }, 1, 1.005, 1, 1);
	addGrid(a, { 0, 1 }, 1, 1, 1, 1);
	addGrid(a, { 1, 1.005 }, 2, 0.995, 1, 1);
	bondAll(a, elasticJoint(1, 1));
	const auto found = unjoinedBlocks(a);
	ASSERT_EQ(found.size(), 1u);
	EXPECT_EQ(found[0].block, (std::array<int, 2> { 0, 3 }));
	EXPECT_NEAR(found[0].gap, 5e-3, 1e-12);
}

TEST(UnjoinedBlocks, WhatComesAfterTheBondMustNotOverlap)
{
	const BlockAssembly bonded = voronoi(1.7, 0.9, 3, 2, stone(), elasticJoint(1, 1), 0.4);
	EXPECT_TRUE(unjoinedBlocks(bonded).empty());
	BlockAssembly across = bonded, within = bonded;
	addGrid(across, { 0.4, 0.3 }, 0.7, 0.2, 1, 1);
	expectRefusal([&] { unjoinedBlocks(across); }, { "overlap" });
	const Vec2 middle = within.centroid(0);
	addGrid(within, { middle.x(), middle.y() }, 1e-3, 1e-3, 1, 1);
	expectRefusal([&] { unjoinedBlocks(within); }, { "overlap" });
}
