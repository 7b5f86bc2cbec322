// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/analysis/Follow.hpp>

using namespace specimens;

namespace {

constexpr Real infinite = std::numeric_limits<Real>::infinity();

JointParams brittle(Real tension, Real cohesion, Real tanPhi, Real tanPhiResidual, Real psi = 0)
{
	JointParams p;
	p.kn = 400e9, p.ks = 200e9;
	p.tension = tension, p.cohesion = cohesion, p.tanPhi = tanPhi, p.tanPhiResidual = tanPhiResidual, p.tanDilation = psi;
	return p;
}

Growth growing(const BlockAssembly& a, int group, Real way = 1)
{
	Growth g;
	g.group.assign(a.state.groups.size(), 0);
	g.rigid.assign(a.state.rigid.size(), Vec3::Zero());
	g.group[group] = way;
	return g;
}

std::vector<int> allDofs(const BlockAssembly& a, int block, int axis)
{
	std::vector<int> list;
	for (int n = a.mesh.firstNode[block]; n < a.mesh.firstNode[block + 1]; ++n)
		list.push_back(2 * n + axis);
	return list;
}

std::vector<int> both(std::vector<int> x, const std::vector<int>& y)
{
	x.insert(x.end(), y.begin(), y.end());
	return x;
}

/// A wall of Voronoi cells, `order` says in which order its blocks are added; held below, its top moves by (vx, vy) or is pressed down.
BlockAssembly wall(int nx, int ny, const JointParams& joint, Real vx, Real vy, Real pressure, unsigned seed, const std::function<int(int, int)>& order = {})
{
	const Real          w = 0.1 * nx, h = 0.1 * ny;
	TessellationOptions options;
	options.seeds       = jitteredSeeds(w, h, nx, ny, 0.7, seed);
	options.size        = 0.1;
	options.lloyd       = 0;
	const Cells   cells = tessellate(rectangle(w, h), options);
	BlockAssembly a;
	a.thickness = 0.5;
	a.addMaterial(stone());
	const int count = int(cells.cells.size());
	for (int i = 0; i < count; ++i)
		addFan(a, ringOf(cells, order ? order(i, count) : i));
	bondAll(a, joint);
	auto low  = [](const Vec2& x) { return x.y() < 1e-9; };
	auto high = [&](const Vec2& x) { return x.y() > h - 1e-9; };
	a.addGroup(driven("low", both(dofs(a, 0, low), dofs(a, 1, low)), 0));
	if (vx != 0) a.addGroup(driven("x", dofs(a, 0, high), vx));
	if (pressure > 0)
		a.addGroup(pushed("press", dofs(a, 1, high), -pressure * w * a.thickness));
	else
		a.addGroup(driven("y", dofs(a, 1, high), vy));
	return a;
}

} // namespace

TEST(EventPath, SnapBackByHand)
{
	// Three blocks on each other that move as wholes and only move up and down. The lower joint (2 points, area A each) has the strength T, the upper one
	// holds. Up to v = T/kn both points carry T and lambda is T/kn + T/kn. One breaks; the other keeps to its strength while the force falls
	// from 2 A T to A T, for which the upper joint shortens by T/(2 kn): that is the snap-back. Then the other breaks, at constant lambda.
	const Real    T = 0.3e6, kn = 400e9;
	BlockAssembly a = column(3, 0.4, 0.3, 1, 1, stone(), brittle(T, 1e9, 0, 0));
	a.setJoints(a.joints.pairs[1].first, a.joints.pairs[1].last, brittle(1e9, 1e9, 0, 0));
	ASSERT_EQ(a.joints.pairs[1].block, (std::array<int, 2> { 1, 2 }));
	ASSERT_EQ(a.pointCount(), 4);
	a.addGroup(driven("low", both(allDofs(a, 0, 0), allDofs(a, 0, 1)), 0));
	a.addGroup(driven("sides", both(allDofs(a, 1, 0), allDofs(a, 2, 0)), 0));
	a.addGroup(pushed("middle", allDofs(a, 1, 1), 0));
	a.addGroup(driven("top", allDofs(a, 2, 1), 1));
	const LinearModel m = linearise(a, growing(a, 3));
	ASSERT_EQ(m.unknowns, 1);
	const Real area = 0.2, first = 2 * T / kn, second = 1.5 * T / kn, near = 1e-12;

	EventPath         path(m);
	std::vector<Real> lambda, force;
	for (int i = 0; i < 4; ++i) {
		ASSERT_TRUE(path.advance(10 * first)) << path.ended();
		lambda.push_back(path.now().lambda), force.push_back(path.now().force);
	}
	const Real lambdas[] = { first, second, second, second }, forces[] = { 2 * area * T, area * T, area * T, 0 };
	for (int i = 0; i < 4; ++i) {
		EXPECT_NEAR(lambda[i], lambdas[i], near * first) << i;
		EXPECT_NEAR(force[i], forces[i], near * area * T) << i;
	}
	EXPECT_EQ(path.cracks()[0].point, 0); // of two alike the first
	EXPECT_EQ(path.cracks()[1].point, 1);
	// work: up the elastic line, then down the snap-back; nothing is stored in the end
	const Real work = area * T * first - (2 * area * T + area * T) / 2 * (first - second);
	EXPECT_NEAR(path.energy().work, work, near * work);
	EXPECT_NEAR(path.energy().excess, work, near * work);
	EXPECT_NEAR(path.energy().joints, 0, near * work);

	EventPath drop(m, Release::cascade); // what a machine sees that holds its displacement: both at once
	ASSERT_TRUE(drop.advance(10 * first) && drop.advance(10 * first));
	EXPECT_NEAR(drop.now().lambda, first, near * first);
	EXPECT_NEAR(drop.now().force, 0, near * area * T);
	EXPECT_EQ(drop.cracks().size(), 2u);
}

TEST(EventPath, FrictionByHandThereAndBack)
{
	// Two blocks that move as wholes, the upper one pressed down and driven sideways, without turning. Both points break at tau = c + p tan phi, slide at
	// p tan phi_res, and on the way back stick until the shear stress has turned round: 2 p tan phi_res / ks.
	const Real    p = 0.5e6, c = 1e6, kn = 400e9, ks = 200e9, area = 0.2, strength = c + 0.7 * p, residual = 0.6 * p;
	BlockAssembly a = column(2, 0.4, 0.3, 1, 1, stone(), brittle(1e9, c, 0.7, 0.6));
	a.addGroup(driven("low", both(allDofs(a, 0, 0), allDofs(a, 0, 1)), 0));
	a.addGroup(pushed("press", allDofs(a, 1, 1), -p * 2 * area));
	a.addGroup(driven("shear", allDofs(a, 1, 0), 1e-3));
	FollowUntil until;
	until.drop         = 0;
	until.displacement = 1.5 * strength / ks;
	auto       there   = follow(a, Driver { 2, -1 }, until);
	const Real near    = 1e-9; // hundreds of roundings
	ASSERT_EQ(there.ended, "displacement");
	ASSERT_EQ(there.path.size(), 6u); // settled, 2 x (at its strength, given away), end
	EXPECT_NEAR(there.path[1].displacement, strength / ks, near * strength / ks);
	EXPECT_NEAR(there.path[1].force, 2 * area * strength, near * area * strength);
	EXPECT_NEAR(there.path[2].force, area * (strength + residual), near * area * strength);
	EXPECT_NEAR(there.reached.force, 2 * area * residual, near * area * strength);
	EXPECT_NEAR(a.state.groups[2].force, 2 * area * residual, 1e-6 * area * strength); // large displacement: slip by height is 1e-5
	EXPECT_NEAR(a.state.groups[2].travelled, until.displacement, 1e-12 * until.displacement);
	// dissipated or carried away: half of pressing all at once, p^2/2kn; the springs' shear energy above the residual's; friction from there on
	const Real slid = until.displacement - residual / ks,
		   lost = 2 * area * (p * p / kn / 2 + (strength * strength - residual * residual) / ks / 2 + residual * (until.displacement - strength / ks));
	EXPECT_NEAR(there.energy.friction + there.energy.excess, lost, near * lost);
	EXPECT_NEAR(there.energy.friction, 2 * area * residual * (until.displacement - strength / ks), near * lost);

	a.state.groups[2].target = -1e-3; // back
	until.displacement       = 3 * residual / ks;
	auto back                = follow(a, Driver { 2, -1 }, until);
	ASSERT_EQ(back.ended, "displacement");
	EXPECT_NEAR(back.path.front().force, -2 * area * residual, 1e-5 * area * strength);
	EXPECT_NEAR(back.reached.force, 2 * area * residual, 1e-5 * area * strength);
	EXPECT_NEAR(back.energy.friction, 2 * area * residual * residual / ks, 1e-4 * area * residual * residual / ks); // slides the last third of the way
	for (Real slipPlastic : a.state.slipPlastic)
		EXPECT_NEAR(std::abs(slipPlastic), slid - residual / ks, 1e-5 * slid); // went back by the last third of the way
}

TEST(EventPath, PathDoesNotDependOnTheOrderOfBlocks)
{
	for (bool shear : { false, true }) {
		const JointParams joint = brittle(0.6e6, 1.5e6, 0.9, 0.7, 0.07);
		auto              build = [&](const std::function<int(int, int)>& order) {
                        return shear ? wall(4, 3, joint, 1e-3, 0, 0.4e6, 7, order) : wall(4, 3, joint, 0, 1e-3, 0, 7, order);
		};
		BlockAssembly a = build({}), b = build([](int i, int n) { return (7 * i + 3) % n; });
		ASSERT_NE(a.blockCount() % 7, 0);
		const int         group = 1;
		const LinearModel m = linearise(a, growing(a, group)), n = linearise(b, growing(b, group));
		EventPath         one(m), other(n);
		for (int i = 0; i < 40; ++i) {
			const bool on = one.advance(), also = other.advance();
			ASSERT_EQ(on, also) << i;
			if (!on) break;
			ASSERT_NEAR(one.now().lambda, other.now().lambda, 1e-9 * one.now().lambda) << i; // rounding by the softness of a cracked wall
			ASSERT_NEAR(one.now().force, other.now().force, 1e-8 * std::abs(one.now().force) + 1e-4) << i;
			ASSERT_EQ(one.now().broken, other.now().broken) << i;
		}
		EXPECT_GT(one.cracks().size(), 5u);
	}
}

TEST(EventPath, KeepsEquilibriumLimitsAndEnergy)
{
	for (unsigned seed : { 1u, 2u, 3u, 4u, 5u, 6u }) {
		const JointParams joint = brittle(0.6e6, 1.5e6, 0.9, 0.7, seed % 2 ? 0.07 : 0);
		BlockAssembly     a     = seed < 4 ? wall(6, 4, joint, 1e-3, 0, 0.6e6, seed) : wall(6, 4, joint, 0, 1e-3, 0, seed);
		addGravity(a, { 0, -9.81 });
		const LinearModel m = linearise(a, growing(a, 1));
		for (Release release : { Release::path, Release::cascade }) {
			EventPath path(m, release);
			Real      most = 0;
			for (int i = 0; i < 200 && path.advance(); ++i) {
				most = std::max(most, std::abs(path.energy().work));
				ASSERT_LT(std::abs(path.energy().error()), 1e-9 * most) << seed << " " << i; // sums of hundreds of pieces
			}
			EXPECT_GT(path.cracks().size(), 5u);
			EXPECT_LT(path.residual(), EventPath::wrong / 10); // 1e-13 but in one, before it is put right with the next direction
			EXPECT_LT(path.inadmissible(), 1e-9);
			EXPECT_GT(path.leastFriction(), -1e-9); // tan phi_res exceeds psi, so friction never gives
			EXPECT_GT(path.leastExcess(), -1e-9);
		}
	}
}

TEST(EventPath, RefusesWhatNothingHolds)
{
	BlockAssembly a = column(3, 0.4, 0.3, 1, 1, stone(), brittle(1e6, 1e6, 0, 0));
	addGrid(a, { 2, 0 }, 1, 1, 1, 1); // a block apart
	bondAll(a, brittle(1e6, 1e6, 0, 0));
	auto low = [](const Vec2& x) { return x.y() < 1e-9 && x.x() < 1; };
	a.addGroup(driven("low", both(dofs(a, 0, low), dofs(a, 1, low)), 0));
	a.addGroup(driven("top", dofs(a, 1, [](const Vec2& x) { return x.y() > 0.9 - 1e-9 && x.x() < 1; }), 1e-3));
	const LinearModel m = linearise(a, growing(a, 1));
	try {
		EventPath path(m);
		ADD_FAILURE() << "not refused";
	} catch (const std::runtime_error& e) {
		EXPECT_STREQ(e.what(), "blocks can move without resistance; hold them: block 3");
	}
}

TEST(EventPath, RefusesAMechanism)
{
	// Two blocks glued on each other, held in one grid point and pushed in another: they turn about the pin as one.
	BlockAssembly a  = column(2, 0.4, 0.3, 1, 1, stone(), brittle(1e6, 1e6, 0, 0));
	auto          at = [](Real x, Real y) { return [=](const Vec2& p) { return (p - Vec2(x, y)).norm() < 1e-9; }; };
	a.addGroup(driven("pin", both(dofs(a, 0, at(0, 0)), dofs(a, 1, at(0, 0))), 0));
	a.addGroup(pushed("push", dofs(a, 1, at(0.4, 0.6)), 1e3));
	const LinearModel m = linearise(a, growing(a, 1));
	try {
		EventPath path(m);
		ADD_FAILURE() << "not refused";
	} catch (const std::runtime_error& e) {
		EXPECT_STREQ(e.what(), "blocks can move without resistance; hold them: block 0, 1");
	}
}

TEST(EventPath, RefusesSofteningJoints)
{
	BlockAssembly a   = wall(2, 2, brittle(0.6e6, 1.5e6, 0.9, 0.7), 0, 1e-3, 0, 7);
	a.state.status[1] = Joint::softening;
	try {
		linearise(a, growing(a, 1));
		ADD_FAILURE() << "not refused";
	} catch (const std::runtime_error& e) {
		EXPECT_NE(std::string(e.what()).find("softens"), std::string::npos) << e.what();
	}
}

TEST(EventPath, ABlockThatComesLooseIsReported)
{
	// A block between two others, glued weakly on both sides, free sideways: once both joints are open nothing holds it.
	BlockAssembly a = column(3, 0.4, 0.3, 1, 1, stone(), brittle(0.5e6, 1e9, 0, 0));
	a.addGroup(driven("low", both(allDofs(a, 0, 0), allDofs(a, 0, 1)), 0));
	a.addGroup(driven("top", both(allDofs(a, 2, 1), {}), 1e-3));
	a.addGroup(driven("sides", allDofs(a, 2, 0), 0));
	const LinearModel m = linearise(a, growing(a, 1));
	EventPath         path(m, Release::cascade);
	Real              force = 1;
	while (path.now().lambda < 1e-3 && path.advance(1e-3))
		force = path.now().force;
	EXPECT_NEAR(force, 0, 1e-3);         // of 2e5 N
	EXPECT_EQ(path.cracks().size(), 2u); // one joint is enough to unload the other
	EXPECT_TRUE(path.looseBlocks().empty());

	BlockAssembly b = column(3, 0.4, 0.3, 1, 1, stone(), brittle(0.5e6, 1e9, 0, 0));
	b.addGroup(driven("low", both(allDofs(b, 0, 0), allDofs(b, 0, 1)), 0));
	b.addGroup(driven("top", both(allDofs(b, 2, 1), {}), 1e-3)); // free sideways
	const LinearModel n = linearise(b, growing(b, 1));
	EventPath         loose(n);
	while (loose.cracks().size() < 2 && loose.advance(1e-3)) { }
	loose.advance(1e-3);
	ASSERT_FALSE(loose.looseBlocks().empty());
	EXPECT_EQ(loose.looseBlocks().back(), 2);
	EXPECT_LT(loose.anchorForce(), 1e-3); // of 2e5 N
}

namespace {

/// Two blocks that move as wholes, a joint between them; the upper one goes sideways or up, or down, and nothing turns.
BlockAssembly pair(const JointParams& joint, Real vx, Real vy)
{
	BlockAssembly a = column(2, 0.4, 0.3, 1, 1, stone(), joint);
	a.addGroup(driven("low", both(allDofs(a, 0, 0), allDofs(a, 0, 1)), 0));
	a.addGroup(driven("x", allDofs(a, 1, 0), vx));
	a.addGroup(driven("y", allDofs(a, 1, 1), vy));
	return a;
}

/// Why following such a pair ends, whatever it had come to.
std::string endOf(const JointParams& joint, Real vx, Real vy, FollowUntil until = {})
{
	BlockAssembly a = pair(joint, vx, vy);
	return follow(a, Driver { vx != 0 ? 1 : 2, -1 }, until).ended;
}

} // namespace

TEST(EventPath, EndsWithASentence)
{
	// Edges are 0.4 m long: a tenth is 40 mm.
	FollowUntil far;
	far.drop                = 0;
	const JointParams joint = brittle(0.6e6, 1.5e6, 0.9, 0.7), whole = brittle(1e15, 1e15, 0, 0);
	const std::string beyond = " by more than 10 % of an edge";
	EXPECT_EQ(endOf(joint, 0, 1, far), "nothing more happens, however far the loading goes"); // the joint is open, and stays so
	EXPECT_EQ(endOf(whole, 1, 0, far), "blocks 0 and 1 at contact point 0 have slid" + beyond + ", though bonded");
	far.displacement = 0.041;
	EXPECT_EQ(endOf(joint, 0, 1, far), "blocks 0 and 1 at contact point 0 have parted" + beyond);
	EXPECT_EQ(endOf(joint, 1, 0, far), "blocks 0 and 1 at contact point 0 have slid" + beyond);
	EXPECT_EQ(endOf(whole, 0, -1, far), "blocks 0 and 1 at contact point 0 overlap" + beyond + ", though bonded");
	far.displacement = 1e-6;
	EXPECT_EQ(endOf(joint, 0, 1, far), "displacement");
	FollowUntil until;
	EXPECT_EQ(endOf(joint, 0, 1, until), "drop");
	until.cracks = 1;
	EXPECT_EQ(endOf(joint, 0, 1, until), "cracks");
}

TEST(EventPath, EndsRatherThanGoOnWithAWrongNumber)
{
	const JointParams joint = brittle(0.6e6, 1.5e6, 0.9, 0.7);
	BlockAssembly     a     = wall(4, 3, joint, 0, 1e-3, 0, 7);
	LinearModel       m     = linearise(a, growing(a, 1));
	{
		EventPath path(m);
		ASSERT_TRUE(path.advance());
		PathState beyond = path.state(); // everything whole at twice the load of the first crack
		beyond.u *= 2;
		beyond.lambda *= 2;
		path.restore(beyond);
		EXPECT_FALSE(path.advance());
		EXPECT_NE(path.ended().find("is beyond its limits by "), std::string::npos) << path.ended();
	}
	EventPath path(m);
	m.zones *= 1.5; // the factors are no longer those of the model: each correction leaves half
	EXPECT_FALSE(path.advance());
	EXPECT_NE(path.ended().find("equilibrium is lost: "), std::string::npos) << path.ended();
}

TEST(EventPath, GroupsHaveGoneWhereTheirBlocksAre)
{
	// A pushed group goes on by what large displacement adds, once handed over.
	BlockAssembly     a     = wall(4, 3, brittle(0.6e6, 1.5e6, 0.9, 0.7), 1e-3, 0, 5e6, 7);
	const MotionGroup press = a.state.groups[2];
	ASSERT_EQ(press.name, "press");
	FollowUntil until;
	until.displacement = 1e-4;
	until.drop         = 0;
	follow(a, Driver { 1, -1 }, until);
	const int dof = press.dofs.front();
	EXPECT_LT(a.state.displacement[dof / 2][dof % 2], 0);
	EXPECT_EQ(a.state.groups[2].travelled, a.state.displacement[dof / 2][dof % 2]);
}
