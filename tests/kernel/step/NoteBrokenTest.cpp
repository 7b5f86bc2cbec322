// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/model/Fingerprint.hpp>
#include <blocks/kernel/step/ContactSearch.hpp>
#include <blocks/kernel/step/Release.hpp>

using namespace specimens;

namespace {

/// Elastic up to the tensile strength, then nothing; written by somebody who knows the state alone.
void cutOff(BlockAssembly& a, JointRange range)
{
	State& s = a.state;
	for (int i = 2 * range.first; i < 2 * range.last; ++i) {
		const JointParams& p = a.joints.ofPoint(i);
		if (p.kn * s.opening[i] > p.tension) s.status[i] = Joint::brokenInTension;
		const bool whole = s.status[i] == Joint::intact;
		s.sigma[i]       = whole ? p.kn * s.opening[i] : 0;
		s.tau[i]         = whole ? p.ks * s.slip[i] : 0;
	}
}

class CutOff : public JointLawOnRange {
public:
	void advance(BlockAssembly& a, JointRange range) const override { cutOff(a, range); }
};

JointParams weak()
{
	JointParams p = elasticJoint(5e9, 2e9);
	p.tension     = 1e5;
	return p;
}

} // namespace

// A loop that comes pair by pair, as YADE's, has the bits of the one over ranges, and releases the joints that such a law breaks: the upper brick is lifted,
// comes down on the lower one aside of where it was, and is carried by a free contact.
TEST(Release, ALawThatDoesNotSayWhatItBreaks)
{
	constexpr Real     dt      = 1e-3;
	BlockAssembly      byRange = column(2, 0.8, 0.5, 2, 1, stone(), weak(), 0.4), byPair = byRange;
	std::vector<Joint> known;
	for (auto* a : { &byRange, &byPair })
		setGeneralContact(*a, true);
	for (const Vec2& way : { Vec2(0, 0), Vec2(0, 1e-3), Vec2(1e-3, 1e-3), Vec2(1e-3, 1e-6), Vec2(1e-3, -1e-5), Vec2(1e-3, -2e-5) }) {
		for (auto* a : { &byRange, &byPair })
			for (int n = a->mesh.firstNode[1]; n < a->mesh.firstNode[2]; ++n)
				a->place(n, a->mesh.reference[n] + way);
		blocks::computeForces(byRange, CutOff(), dt);
		prepareContacts(byPair, dt, false);
		advanceContacts(byPair, dt, 1);
		for (int pair = 0; pair < int(byPair.joints.pairs.size()); ++pair) {
			updateKinematics(byPair, jointsOf(byPair, pair));
			cutOff(byPair, jointsOf(byPair, pair));
		}
		noteBroken(byPair, known);
		sumForces(byPair);
		EXPECT_EQ(fingerprint(byPair.state), fingerprint(byRange.state)) << way.x() << ", " << way.y();
	}
	for (int i = 0; i < byPair.joints.count(); ++i)
		EXPECT_TRUE(byPair.state.released[i]);
	EXPECT_LT(contactForce(byPair, 0).y(), 0); // pressed by what lies on it
}

TEST(Release, OnlyBatchesThatHaveBrokenAreLookedAt)
{
	BlockAssembly a = voronoi(1, 0.8, 10, 6, stone(), weak(), 0.4);
	ASSERT_GT(a.forces.broke.size(), 3u);
	const std::vector<char> all(a.forces.broke.size(), true), none(a.forces.broke.size(), false);
	std::vector<Joint>      known;
	noteBroken(a, known);
	EXPECT_EQ(a.forces.broke, all); // nothing was known
	a.forces.broke = none;
	noteBroken(a, known);
	EXPECT_EQ(a.forces.broke, none);
	a.state.status[4 * Joints::batch + 1] = Joint::brokenInShear; // a point of the third batch
	noteBroken(a, known);
	std::vector<char> third = none;
	third[2]                = true;
	EXPECT_EQ(a.forces.broke, third);
	a.state.status.back() = Joint::brokenInTension; // the last batch has fewer joints than others
	noteBroken(a, known);
	third.back() = true;
	EXPECT_EQ(a.forces.broke, third);
	EXPECT_EQ(known, a.state.status);
}
