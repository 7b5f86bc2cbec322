// yade-blocks, GPL-2.0-or-later
#include <Rings.hpp>
#include <blocks/kernel/geometry/Boxes.hpp>
#include <gtest/gtest.h>
#include <random>
#include <set>

using namespace rings;

TEST(Boxes, MeetingIsWhatEachPairSays)
{
	// Every pair asked by itself. The last box is where nothing is: it has no finite corners.
	std::mt19937                         random(5);
	std::uniform_real_distribution<Real> u(0, 1);
	const auto                           some = [&](int n) {
                std::vector<Box> boxes;
                for (int i = 0; i < n; ++i) {
                        const Vec2 low(u(random), u(random));
                        boxes.emplace_back(low, low + 0.2 * Vec2(u(random), u(random)));
                }
                boxes.emplace_back(Vec2(std::nan(""), 0), Vec2(1, 1));
                return boxes;
	};
	const std::vector<Box>       ones = some(60), others = some(45);
	std::set<std::array<int, 2>> expected, expectedWithin, found, within;
	for (int i = 0; i < 60; ++i)
		for (int j = 0; j < 60; ++j) {
			if (j < 45 && ones[i].intersects(others[j])) expected.insert({ i, j });
			if (i < j && ones[i].intersects(ones[j])) expectedWithin.insert({ i, j });
		}
	forEachMeeting(ones, others, [&](int i, int j) { EXPECT_TRUE(found.insert({ i, j }).second); });
	forEachMeeting(ones, [&](int i, int j) { EXPECT_TRUE(within.insert({ std::min(i, j), std::max(i, j) }).second); });
	EXPECT_EQ(found, expected);
	EXPECT_EQ(within, expectedWithin);
	EXPECT_GT(expected.size(), 20u);
}

TEST(Boxes, WithAMargin)
{
	const Box box(Vec2(0, 0), Vec2(1, 1)), beside(Vec2(1.25, 0), Vec2(2, 1)), above(Vec2(0, 1.5), Vec2(1, 2));
	EXPECT_FALSE(meet(box, beside, 0));
	EXPECT_TRUE(meet(box, beside, 0.25));
	EXPECT_FALSE(meet(box, above, 0.25));
	EXPECT_TRUE(grown(box, 0.25).isApprox(Box(Vec2(-0.25, -0.25), Vec2(1.25, 1.25))));
	EXPECT_TRUE(boxOf(Vec2(3, 1), Vec2(2, 4)).isApprox(Box(Vec2(2, 1), Vec2(3, 4))));
}
