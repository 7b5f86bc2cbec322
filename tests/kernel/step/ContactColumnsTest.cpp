// yade-blocks, GPL-2.0-or-later
#include <ContactScenes.hpp>
#include <blocks/kernel/step/CloseRests.hpp>
#include <blocks/kernel/step/Rests.hpp>
#include <random>

using namespace contacts;

TEST(ContactColumns, SameBitsWhateverThreadsAndOrder)
{
	BlockAssembly     one = heap(12), two = one, three = one, shuffled = one;
	const JointParams joint = frictional(2e6, 1e6, 25 * degree);
	auto              run   = [&](BlockAssembly& a, int threads) {
                Simulation s(a, joint, 0.4);
                s.threads = threads;
                s.steps(1000);
	};
	run(one, 1), run(two, 2), run(three, 3);
	EXPECT_GT(contactFriction(one), 0);
	expectSameBits(one, two);
	expectSameBits(one, three);
	// contacts in the opposite order, with dead slots in between, and neighbours looked for far too often
	Simulation s(shuffled, joint, 0.4);
	auto&      contacts = shuffled.state.contacts.all();
	std::reverse(contacts.begin(), contacts.end());
	contacts.insert(contacts.begin(), 3, FreeContact());
	rebuildContacts(shuffled);
	s.steps(1000, [&](Real) {
		if (s.step % 7 == 0) shuffled.state.search.mayGo = 0;
		if (s.step % 100 == 0) shuffled.contacts.started = false; // everything is looked for
	});
	EXPECT_GE(shuffled.contacts.looks, 1000 / 7);
	EXPECT_LT(one.contacts.looks, 100);
	expectSameBits(one, shuffled);
}

TEST(ContactColumns, RestingChangesNothing)
{
	// Looking at every pair and every vertex in every step gives the same bits, and is far more work.
	BlockAssembly     resting = heap(12), restless = resting;
	const JointParams joint = frictional(2e6, 1e6, 25 * degree);
	Simulation        s(resting, joint, 0.4), t(restless, joint, 0.4);
	long              pairs = 0, asleep = 0, close = 0;
	for (int i = 0; i < 3000; ++i) {
		s.steps(1, [&](Real) {
			for (int c : resting.contacts.order)
				for (const Rest& rest : std::as_const(resting.state.contacts)[c].rests)
					++pairs, close += rest.until == restsClose,
						asleep += rest.until != inWork
						&& rest.until > resting.contacts.odometer.path[resting.state.contacts[c].block[0]]
								+ resting.contacts.odometer.path[resting.state.contacts[c].block[1]];
		});
		for (FreeContact& c : restless.state.contacts) {
			std::fill(c.rests.begin(), c.rests.end(), Rest());
		}
		for (Sleep& contact : restless.contacts.sleep)
			contact.until = 0;
		t.steps(1);
		ASSERT_EQ(resting.contacts.order.size(), restless.contacts.order.size()) << i;
	}
	expectSameBits(resting, restless);
	EXPECT_GT(contactFriction(resting), 0);
	EXPECT_EQ(contactFriction(resting), contactFriction(restless));
	std::printf("edge pairs asleep in a heap that falls: %.0f %%\n", 100. * asleep / pairs);
	EXPECT_GT(asleep, pairs / 2);
	EXPECT_GT(close, 0);
}

TEST(ContactColumns, WhatRestsCloseIsMetAlone)
{
	// A box comes down on another one by a micrometre a step. It rests close; then contacts are worked on one by one, as YADE's InteractionLoop does.
	const Real        down  = 1e-6;
	const JointParams joint = frictional(2e6, 1e6, 25 * degree);
	BlockAssembly     a     = scene();
	addRigid(a, box(-1, -1, 2, 1));
	const int upper      = addRigid(a, box(-0.5, 10.5 * down, 1, 1));
	a.contacts.strangers = true;
	computeAllForces(a, joint, 0);
	ASSERT_EQ(a.contacts.order.size(), 1u);
	setVelocity(a, upper, { 0, -1 });
	const auto close = [&] {
		const auto& rests = std::as_const(a.state.contacts)[0].rests;
		return std::count_if(rests.begin(), rests.end(), [](const Rest& r) { return r.until == restsClose; });
	};
	for (int step = 0; step < 5; ++step) {
		moveBlock(a, upper, { 0, -down });
		computeAllForces(a, joint, down);
	}
	EXPECT_GT(close(), 0);
	for (int step = 5; step < 12; ++step) {
		moveBlock(a, upper, { 0, -down });
		prepareContacts(a, down);
		advanceContact(a, 0, down);
		EXPECT_EQ(!std::as_const(a.state.contacts)[0].active.empty(), step >= 10) << step;
	}
}

TEST(ContactColumns, ThoseThatRestCloseAreAskedAsOneAloneIs)
{
	// Corners in the middle of nowhere, which have gone a little less or a little more than the pair is free to: one of A at a time, and the farther one of
	// B.
	BlockAssembly a = scene();
	for (int i = 0; i < RestColumns::size; ++i)
		addRigid(a, box(3. * i, 0, 1, 1));
	std::mt19937                         random(7);
	std::uniform_real_distribution<Real> some(-1, 1);
	for (int count : { 1, 2, 5, RestColumns::size })
		for (int round = 0; round < 200; ++round) {
			RestColumns   columns;
			std::uint32_t expected = 0;
			columns.count          = count;
			for (int lane = 0; lane < count; ++lane) {
				Rest rest;
				for (int n = 0; n < 4; ++n) {
					rest.node[n]                       = 4 * lane + n;
					a.state.displacement[4 * lane + n] = { some(random), some(random) };
				}
				rest.from = movesOf(a, rest.node);
				Real went[3];
				for (int k : { 0, 1, 2 }) {
					const Vec2 more = Vec2(some(random), some(random)) * (round % 4 == k ? 1 : 0.1);
					a.state.displacement[rest.node[k + 1]] += more;
					went[k] = more.norm();
				}
				const Real all   = went[0] + std::max(went[1], went[2]);
				const bool stirs = some(random) > 0;
				rest.free        = all * (stirs ? 1 - 1e-9 : 1 + 1e-9);
				EXPECT_EQ(leftOf(a, rest) > 0, !stirs);
				columns.set(lane, 0, 0, rest);
				expected |= std::uint32_t(stirs) << lane;
			}
			EXPECT_EQ(stirring(a, columns), expected);
		}
}

TEST(ContactColumns, ColumnsHoldWhatTheStateSays)
{
	// What a step copied from the state for later ones is as good as what it would copy now: edges part and meet, contacts come and go, somebody changes
	// their joints, and for a while contacts are worked on one by one.
	BlockAssembly     kept = heap(12), copied = kept;
	const JointParams joint = frictional(2e6, 1e6, 25 * degree), other = frictional(3e6, 2e6, 10 * degree);
	Simulation        s(kept, joint, 0.4), t(copied, joint, 0.4);
	for (int i = 0; i < 3000; ++i) {
		if (i == 1500)
			for (BlockAssembly* a : { &kept, &copied })
				for (int c : a->contacts.order)
					setContactJoint(*a, c, other);
		if (i > 2000 && i < 2200) {
			prepareContacts(kept, s.dt);
			for (int c : kept.contacts.order)
				advanceContact(kept, c, s.dt);
			sumForces(kept);
			move(kept, s.damping, s.dt, 0, true);
		} else
			s.steps(1);
		copied.state.contacts.all(); // as if somebody had written there
		t.steps(1);
	}
	expectSameBits(kept, copied);
	EXPECT_GT(contactFriction(kept), 0);
	EXPECT_EQ(contactFriction(kept), contactFriction(copied));
}

TEST(ContactColumns, ColumnsFollowWhatHappensToPairs)
{
	// A box on another, pressed in by depth d: sigma = -kn d, and tau = ks times what it slid, by v dt in each step, as long as that is below friction.
	// Nobody asks who rests in between, so that columns are not filled anew for that reason.
	const Real        d = 1e-3, v = 0.1, dt = 1e-3;
	const JointParams joint = frictional(2e6, 1e6, 25 * degree), stiffer = frictional(6e6, 1e6, 25 * degree);
	BlockAssembly     a = scene();
	addRigid(a, box(-1, -1, 2, 1));
	const int upper = addRigid(a, box(-0.5, -d, 1, 1));
	computeAllForces(a, joint, 0);
	ASSERT_EQ(a.contacts.order.size(), 1u);
	const FreeContact& c = a.state.contacts[0];
	ASSERT_EQ(c.active.size(), 1u);
	const EdgePair& e         = c.edges[c.active[0]];
	const auto      expectTau = [&](Real slip) {
                for (int k : { 0, 1 })
                        EXPECT_NEAR(std::abs(e.tau[k]), joint.ks * slip, 1e-9 * joint.ks * v * dt);
	};
	setVelocity(a, upper, { v, 0 });
	advanceContacts(a, dt);
	expectTau(v * dt);
	advanceContact(a, 0, dt);
	expectTau(2 * v * dt);
	advanceContacts(a, 0);
	expectTau(2 * v * dt);
	EXPECT_NEAR(e.sigma[0], -joint.kn * d, 1e-9 * joint.kn * d);
	setContactJoint(a, 0, stiffer);
	advanceContacts(a, 0);
	EXPECT_NEAR(e.sigma[0], -stiffer.kn * d, 1e-9 * stiffer.kn * d);
	moveBlock(a, upper, { 0, 2 * d });
	advanceContacts(a, dt);
	EXPECT_FALSE(e.touching);
	EXPECT_EQ(contactForce(a, upper), Vec2(0, 0));
	moveBlock(a, upper, { 0, -2 * d });
	advanceContacts(a, 0);
	EXPECT_TRUE(e.touching);
	expectTau(0); // it has forgotten what it slid
}

TEST(ContactColumns, ColumnsDoNotOutliveAStateThatIsPutBack)
{
	// An earlier state is put back while other contacts are in work, by every way there is: it goes on as it did the first time. Whoever shows contacts
	// hears of it.
	BlockAssembly     a     = heap(12);
	const JointParams joint = frictional(2e6, 1e6, 25 * degree);
	Simulation        s(a, joint, 0.4);
	s.steps(500);
	const State earlier = a.state;
	const long  from    = s.step;
	s.steps(1000);
	const BlockAssembly first = a;
	for (int way : { 0, 1, 2 }) {
		s.step               = from;
		const long seenSoFar = a.contacts.version;
		if (way == 0) a.restore(earlier);
		if (way == 1) a.state = earlier, rebuildContacts(a); // as after loading
		if (way == 2) {
			BlockAssembly other = a; // a copy has columns, too, and they are of a list that is not its own
			other.restore(earlier);
			a = std::move(other);
		}
		EXPECT_GT(a.contacts.version, seenSoFar) << way;
		s.steps(1000);
		expectSameBits(a, first);
		EXPECT_EQ(contactFriction(a), contactFriction(first)) << way;
	}
}

TEST(ContactColumns, NobodyChangesAContactUnseen)
{
	BlockAssembly a = heap(3);
	Simulation    s(a, frictional(2e6, 1e6, 25 * degree), 0.4);
	s.steps(10);
	long       edition = a.state.contacts.edition();
	const auto changed = [&] { return std::exchange(edition, a.state.contacts.edition()) != a.state.contacts.edition(); };
	s.steps(1);
	EXPECT_FALSE(changed()); // unless neighbours were looked for
	EXPECT_EQ(a.contacts.columnsOf, edition);
	contactEnergy(a), contactFriction(a), contactStiffness(a);
	EXPECT_FALSE(changed());
	a.state.contacts[0];
	EXPECT_TRUE(changed());
	for ([[maybe_unused]] FreeContact& c : a.state.contacts) { }
	EXPECT_TRUE(changed());
	setContactJoint(a, 0, frictional(3e6, 1e6, 25 * degree));
	EXPECT_TRUE(changed());
	advanceContact(a, 0, 0);
	EXPECT_TRUE(changed());
	State other = a.state;
	EXPECT_FALSE(changed());
	EXPECT_NE(other.contacts.edition(), edition);
	a.state = other;
	EXPECT_TRUE(changed());
	EXPECT_NE(other.contacts.edition(), edition);
	a.state = std::move(other);
	EXPECT_TRUE(changed());
}

TEST(ContactColumns, ColumnsHaveRoomForAllPairs)
{
	// Pairs begin and end their rest all the time, and as long as nobody changes contacts nothing is allocated for them: columns stay where they are.
	BlockAssembly                   a = heap(12);
	Simulation                      s(a, frictional(2e6, 1e6, 25 * degree), 0.4);
	std::vector<const EdgeColumns*> at;
	std::vector<const RestColumns*> closeAt;
	std::vector<size_t>             used;
	long                            edition = 0;
	int                             grown   = 0;
	for (int i = 0; i < 3000; ++i) {
		s.steps(1);
		const bool same = std::exchange(edition, a.contacts.columnsOf) == a.contacts.columnsOf;
		for (size_t run = 0; same && run < at.size(); ++run) {
			ASSERT_EQ(a.contacts.inWork[run].batches.data(), at[run]) << i;
			ASSERT_EQ(a.contacts.inWork[run].close.data(), closeAt[run]) << i;
			grown += a.contacts.inWork[run].batches.size() > used[run];
		}
		long rest = 0, columns = 0; // nobody is in them twice, or while he is in work
		for (int c : a.contacts.order)
			for (const Rest& r : std::as_const(a.state.contacts)[c].rests)
				rest += r.until == restsClose;
		for (const EdgesInWork& work : a.contacts.inWork)
			for (const RestColumns& c : work.close)
				columns += c.count;
		if (same) {
			ASSERT_EQ(rest, columns) << i;
		}
		at.clear(), closeAt.clear(), used.clear();
		for (const EdgesInWork& work : a.contacts.inWork)
			at.push_back(work.batches.data()), closeAt.push_back(work.close.data()), used.push_back(work.batches.size());
	}
	EXPECT_GT(grown, 0);
}

TEST(ContactColumns, ContinuesFromWhatIsSaved)
{
	// What AssemblyArchive keeps is enough: the rest is computed again, and the run goes on with the same bits.
	BlockAssembly     a     = heap(8);
	const JointParams joint = frictional(2e6, 1e6, 25 * degree);
	Simulation        run(a, joint, 0.4);
	run.steps(2500);
	BlockAssembly b = a;
	for (FreeContact& c : b.state.contacts)
		for (EdgePair& e : c.edges) {
			EdgePair kept {};
			kept.edge = e.edge, kept.slip = e.slip, kept.sigma = e.sigma, kept.tau = e.tau, kept.area = e.area, kept.uplift = e.uplift;
			e = kept;
		}
	b.contacts = {}; // all of it follows from the state
	b.rebuild();
	Simulation again(b, run);
	run.steps(1000), again.steps(1000);
	expectSameBits(a, b);
	EXPECT_EQ(contactFriction(a), contactFriction(b));
}
