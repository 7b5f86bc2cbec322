// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/model/JointChoice.hpp>

using namespace specimens;

namespace {

/// Three by two blocks of unequal size. Materials, from below and from the left: 0 1 0, then 1 1 2.
BlockAssembly six()
{
	BlockAssembly a;
	for (Real density : { 2000, 1500, 1000 })
		a.addMaterial({ 20e9, 0.2, density });
	const Real x[] = { 0, 1, 1.5, 2.5 }, y[] = { 0, 0.4, 1 };
	const int  of[2][3] = { { 0, 1, 0 }, { 1, 1, 2 } };
	for (int j : { 0, 1 })
		for (int i : { 0, 1, 2 })
			addGrid(a, { x[i], y[j] }, x[i + 1] - x[i], y[j + 1] - y[j], 1, 1, of[j][i]);
	bondAll(a, elasticJoint(1e9, 1e9));
	return a;
}

std::vector<std::array<int, 2>> blocksOf(const BlockAssembly& a, const std::vector<int>& joints)
{
	std::vector<std::array<int, 2>> out;
	for (int i : joints)
		out.push_back(a.joints.segments[i].block);
	return out;
}

std::vector<int> all(const BlockAssembly& a)
{
	std::vector<int> out;
	for (int i = 0; i < a.joints.count(); ++i)
		out.push_back(i);
	return out;
}

} // namespace

TEST(JointChoice, BetweenTwoMaterialsInEitherOrder)
{
	const BlockAssembly a       = six();
	const auto          between = [&](int m1, int m2) {
                std::vector<int> out;
                for (int i : all(a))
                        if (isBetween(a, i, m1, m2)) out.push_back(i);
                return blocksOf(a, out);
	};
	using Blocks = std::vector<std::array<int, 2>>;
	EXPECT_EQ(between(0, 1), (Blocks { { 0, 1 }, { 0, 3 }, { 1, 2 } }));
	EXPECT_EQ(between(1, 0), between(0, 1));
	EXPECT_EQ(between(1, 1), (Blocks { { 1, 4 }, { 3, 4 } }));
	EXPECT_EQ(between(2, 1), (Blocks { { 4, 5 } }));
	EXPECT_EQ(between(0, 2), (Blocks { { 2, 5 } }));
	EXPECT_EQ(between(0, 0), Blocks());
}

// The middles: (1, 0.2), (0.5, 0.4), (1.5, 0.2), (1.25, 0.4), (2, 0.4), (1, 0.7), (1.5, 0.7), of the pairs of blocks in their order.
TEST(JointChoice, WithinARegionOrOnItsOutline)
{
	BlockAssembly           a = six();
	const std::vector<Vec2> middles { { 1, 0.2 }, { 0.5, 0.4 }, { 1.5, 0.2 }, { 1.25, 0.4 }, { 2, 0.4 }, { 1, 0.7 }, { 1.5, 0.7 } };
	ASSERT_EQ(a.joints.count(), int(middles.size()));
	for (int i : all(a))
		EXPECT_NEAR((builtAt(a, i) - middles[i]).norm(), 0, 4 * eps); // a few roundings of numbers up to 2.5
	const auto within = [&](const Ring& ring) { return jointsWithin(a, { ring, {} }, all(a)); };
	EXPECT_EQ(within({ { 0, 0 }, { 1.1, 0 }, { 1.1, 0.5 }, { 0, 0.5 } }), (std::vector<int> { 0, 1 }));
	EXPECT_EQ(within({ { 1, 0.4 }, { 2.5, 0.4 }, { 2.5, 1 }, { 1, 1 } }), (std::vector<int> { 3, 4, 5, 6 })); // along two sides of it
	EXPECT_EQ(within({ { 0, 0 }, { 2.5, 0 }, { 0, 0.8 } }), (std::vector<int> { 0, 1, 2, 3 }));               // at x = 1.25 up to 0.4, at 1.5 up to 0.32
	EXPECT_EQ(within({ { 5, 0 }, { 6, 0 }, { 6, 1 } }), (std::vector<int> {}));
	EXPECT_EQ(jointsWithin(a, { { { 0, 0 }, { 2.5, 0 }, { 2.5, 1 }, { 0, 1 } }, {} }, { 4, 2 }), (std::vector<int> { 4, 2 })); // only these
	for (Vec2& u : a.state.displacement)
		u = { 3, 0 }; // where they have gone does not matter
	EXPECT_EQ(within({ { 0, 0 }, { 1.1, 0 }, { 1.1, 0.5 }, { 0, 0.5 } }), (std::vector<int> { 0, 1 }));
}
