// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/analysis/Removal.hpp>
#include <blocks/kernel/model/Fingerprint.hpp>

/// How a joint law of one's own remembers more than JointState has: columns with names, on ranges of joints.

using namespace specimens;

namespace {

/// Elastic joints that count how far they have slid: wear = sum of |slip - slip of the step before| [m].
class Wear : public JointLawOnRange {
public:
	explicit Wear(std::vector<std::string> named = { "wear", "slipBefore" })
		: names(std::move(named))
	{
	}
	void advance(BlockAssembly& a, JointRange range) const override
	{
		std::vector<Real>&wear = a.state.lawColumns[names[0]], &before = a.state.lawColumns[names[1]];
		for (int i = 2 * range.first; i < 2 * range.last; ++i) {
			const JointParams& p = a.joints.ofPoint(i);
			wear[i] += std::abs(a.state.slip[i] - before[i]);
			before[i]        = a.state.slip[i];
			a.state.sigma[i] = p.kn * a.state.opening[i];
			a.state.tau[i]   = p.ks * a.state.slip[i];
		}
	}
	const std::vector<std::string>& columns() const override { return names; }
	std::string                     name() const override { return "Wear"; }

private:
	std::vector<std::string> names;
};

/// The same without any memory.
class Springs : public JointLawOnRange {
public:
	void advance(BlockAssembly& a, JointRange range) const override
	{
		for (int i = 2 * range.first; i < 2 * range.last; ++i) {
			a.state.sigma[i] = a.joints.ofPoint(i).kn * a.state.opening[i];
			a.state.tau[i]   = a.joints.ofPoint(i).ks * a.state.slip[i];
		}
	}
};

constexpr Real height = 0.5;

BlockAssembly pile(int bricks = 2) { return column(bricks, 0.8, height, 2, 1, stone(), elasticJoint(5e9, 2e9), 0.4); }

/// The upper brick moves to the side, as a whole.
void slide(BlockAssembly& a, Real way, const JointLawOnRange& law)
{
	for (int n = a.mesh.firstNode[1]; n < a.mesh.firstNode[2]; ++n)
		a.place(n, a.mesh.reference[n] + Vec2(way, 0));
	blocks::computeForces(a, law, 0);
}

/// Each grid point a little aside, as if of a run.
void shake(BlockAssembly& a, unsigned seed)
{
	std::mt19937                         random(seed);
	std::uniform_real_distribution<Real> shift(-1e-5, 1e-5);
	for (Vec2& u : a.state.displacement)
		u += Vec2(shift(random), shift(random));
}

} // namespace

// To and fro by 3, 5 and 4 um less than a mm of brick: |3| + |-5 - 3| + |4 + 5| = 20 um. Places of 0.8 m are known to eps/2, so a slip to eps, and a way
// from one to the next to 2 eps; three of these.
TEST(LawColumns, WearIsTheWaySlid)
{
	BlockAssembly a = pile();
	EXPECT_TRUE(a.state.lawColumns.empty()); // nothing is there as long as no law asks
	const Wear law;
	for (Real way : { 3e-6, -5e-6, 4e-6 })
		slide(a, way, law);
	ASSERT_EQ(a.state.lawColumns.names, (std::vector<std::string> { "wear", "slipBefore" }));
	ASSERT_EQ(int(a.state.lawColumns["wear"].size()), a.pointCount());
	for (int i = 0; i < a.pointCount(); ++i) {
		EXPECT_NEAR(a.state.lawColumns["wear"][i], 20e-6, 6 * eps);
		EXPECT_EQ(a.state.lawColumns["slipBefore"][i], a.state.slip[i]);
	}
	expectRefusal([&] { a.state.lawColumns["ware"]; }, { "'ware'", "'wear', 'slipBefore'" });
}

// A state that is put back has the columns that it had then, or none.
TEST(LawColumns, ArePutBackWithTheState)
{
	BlockAssembly a = pile();
	const Wear    law;
	const State   untouched = a.state;
	slide(a, 3e-6, law);
	const State early = a.state;
	slide(a, -5e-6, law);
	const auto late = fingerprint(a.state);
	slide(a, 4e-6, law);
	EXPECT_NE(fingerprint(a.state), late);
	a.restore(early);
	EXPECT_EQ(a.state.lawColumns["wear"], early.lawColumns.columns[0]);
	slide(a, -5e-6, law);
	EXPECT_EQ(fingerprint(a.state), late);
	a.restore(untouched);
	EXPECT_TRUE(a.state.lawColumns.empty());
	slide(a, 3e-6, law);
	EXPECT_EQ(fingerprint(a.state), fingerprint(early));
}

// Names and numbers, each bit of them; a law without columns leaves the fingerprint as it is.
TEST(LawColumns, AreInTheFingerprint)
{
	BlockAssembly with = pile(), without = pile();
	slide(with, 3e-6, Wear());
	slide(without, 3e-6, Springs());
	State state = with.state;
	EXPECT_NE(fingerprint(state), fingerprint(without.state));
	Real& last = state.lawColumns.columns[1].back();
	last       = std::nextafter(last, Real(1));
	EXPECT_NE(fingerprint(state), fingerprint(with.state));
	state = with.state;
	std::swap(state.lawColumns.names[0], state.lawColumns.names[1]);
	EXPECT_NE(fingerprint(state), fingerprint(with.state));
	state.lawColumns = {};
	EXPECT_EQ(fingerprint(state), fingerprint(without.state));
}

// 60 bricks, some 100 joints: several batches, one range a thread.
TEST(LawColumns, SameBitsOnAnyNumberOfThreads)
{
	std::uint64_t expected = 0;
	for (int threads : { 1, 2, 4 }) {
		BlockAssembly a = voronoi(1, 0.8, 10, 6, stone(), elasticJoint(5e9, 2e9), 0.4);
		ASSERT_GT(a.joints.count(), 4 * Joints::batch);
		for (unsigned step = 0; step < 5; ++step) {
			shake(a, step);
			blocks::computeForces(a, Wear(), 0, true, threads);
		}
		for (Real wear : a.state.lawColumns["wear"])
			EXPECT_GT(wear, 0);
		if (threads == 1) expected = fingerprint(a.state);
		EXPECT_EQ(fingerprint(a.state), expected) << threads;
	}
}

// Bonded anew there are other points, and no columns; blocks that are removed leave the others theirs, and their own place.
TEST(LawColumns, FollowTheContactPoints)
{
	BlockAssembly a = pile(3);
	slide(a, 3e-6, Wear());
	const std::vector<Real> before = a.state.lawColumns["wear"];
	removeBlocks(a, { 2 });
	EXPECT_EQ(a.state.lawColumns["wear"], before);
	slide(a, 1e-6, Wear());
	for (int i = a.joints.pairs[0].first; i < a.joints.pairs[0].last; ++i)
		EXPECT_NEAR(a.state.lawColumns["wear"][2 * i], 5e-6, 4 * eps);

	BlockAssembly b = pile();
	slide(b, 3e-6, Wear());
	const int points = b.pointCount();
	addGrid(b, { 0.8, 0 }, 0.6, height, 1, 1);
	bondAll(b, elasticJoint(5e9, 2e9));
	EXPECT_TRUE(b.state.lawColumns.empty());
	blocks::computeForces(b, Wear(), 0);
	EXPECT_GT(b.pointCount(), points);
	EXPECT_EQ(int(b.state.lawColumns["wear"].size()), b.pointCount());
}

TEST(LawColumns, OtherColumnsAreRefused)
{
	BlockAssembly a = pile();
	slide(a, 3e-6, Wear());
	const auto before = fingerprint(a.state);
	expectRefusal([&] { slide(a, 3e-6, Wear({ "damage_", "age" })); }, { "Wear", "in their order: 'wear', 'slipBefore'", "got 'damage_', 'age'" });
	expectRefusal([&] { slide(a, 3e-6, Wear({ "slipBefore", "wear" })); }, { "got 'slipBefore', 'wear'" });
	expectRefusal([&] { slide(a, 3e-6, Springs()); }, { "the joint law", "got none" });
	EXPECT_EQ(fingerprint(a.state), before);
	a.state.lawColumns = {};
	slide(a, 3e-6, Wear({ "damage_", "age" }));
	EXPECT_EQ(a.state.lawColumns.names[1], "age");
}

TEST(LawColumns, NamesThatCannotBe)
{
	for (const char* name : { "opening", "slip", "sigma", "tau", "slipPlastic", "uplift", "status", "damage", "area" })
		expectRefusal(
			[&] {
				requireColumnNames("Wear", { "wear", name });
			},
			{ "Wear", "must not be that of a column", std::string("got '") + name + "'" });
	for (const char* name : { "", "2nd", "a b", "<a>", "\xc3\xa4" })
		expectRefusal([&] { requireColumnNames("Wear", { name }); }, { "Wear", "letters, digits and _", std::string("got '") + name + "'" });
	expectRefusal([&] { requireColumnNames("Wear", { "a", "b", "a" }); }, { "Wear", "no two columns", "'a', 'b', 'a'" });
	requireColumnNames("Wear", { "wear", "slip_before", "A2" });
	BlockAssembly a = pile();
	expectRefusal([&] { slide(a, 0, Wear({ "wear", "slip" })); }, { "Wear", "'slip'" });
	EXPECT_TRUE(a.state.lawColumns.empty());
}
