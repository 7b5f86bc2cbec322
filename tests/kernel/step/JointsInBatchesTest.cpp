// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>

using namespace specimens;

namespace {

JointParams kindOfJoint(int i)
{
	JointParams p = elasticJoint(1e9 * (1 + i), 4e8 * (2 + i));
	p.tension = 1e5 * (1 + i), p.cohesion = 2e5, p.tanPhi = 0.3 + 0.2 * i;
	p.cohesionResidual = 5e4 * i, p.tanPhiResidual = 0.2 + 0.1 * i, p.tensionResidual = i == 2 ? 3e4 : 0;
	p.tanDilation = 0.1 * i, p.dilationLimitSlip = i == 1 ? 1e-4 : std::numeric_limits<Real>::max();
	return p;
}

/// What a random state is made of.
struct Mixture {
	const char* what;
	Real        amount; ///< of displacements [m]
	int         kinds;
	Real        broken, released, without; ///< shares of joints
};

BlockAssembly randomState(const Mixture& m, unsigned seed)
{
	BlockAssembly                        a = voronoi(1, 1, 8, 8, stone(), kindOfJoint(0), 0.4);
	std::mt19937                         random(seed);
	std::uniform_real_distribution<Real> u(-1, 1), share(0, 1);
	for (Vec2& d : a.state.displacement) {
		const Real dx = u(random), dy = u(random);
		d = m.amount * Vec2(dx, dy);
	}
	if (m.without > 0) a.bond(detectSegments(a, 1e-2)); // no properties to begin with
	for (int i = 0; i < a.joints.count(); ++i) {
		if (share(random) < m.without) continue;
		const int kind = i < Joints::batch ? 1 : int(random() % m.kinds); // a batch of one kind, then any
		a.setJoints(i, i + 1, kindOfJoint(kind));
		for (int p : { 2 * i, 2 * i + 1 }) {
			if (share(random) >= m.broken) continue;
			a.state.status[p]      = Joint(1 + random() % 3);
			a.state.slipPlastic[p] = m.amount * u(random);
			a.state.uplift[p]      = uplift(kindOfJoint(kind), a.state.slipPlastic[p]);
		}
		if (share(random) < m.released) a.releaseJoint(i);
	}
	updateKinematics(a, allJoints(a)); // the step before
	std::fill(a.state.sigma.begin(), a.state.sigma.end(), 1e4);
	std::fill(a.state.tau.begin(), a.state.tau.end(), -2e4);
	for (Vec2& d : a.state.displacement) {
		const Real dx = u(random), dy = u(random);
		d += m.amount / 10 * Vec2(dx, dy);
	}
	return a;
}

/// Joints as the paper has them, one joint and one contact point after the other, then the zones block by block. Expressions in the order of
/// JointBatch.cpp.
void advanceOneByOne(BlockAssembly& a)
{
	State& s = a.state;
	auto&  f = a.forces.nodal;
	std::fill(f.begin(), f.end(), Vec2::Zero());
	for (int i = 0; i < a.joints.count(); ++i) {
		const Segment& g = a.joints.segments[i];
		const auto&    X = a.mesh.reference;
		const auto&    u = s.displacement;
		const Vec2 e1 = X[g.node[1]] - X[g.node[0]] + (u[g.node[1]] - u[g.node[0]]), e2 = X[g.node[3]] - X[g.node[2]] + (u[g.node[3]] - u[g.node[2]]);
		const Vec2 d          = X[g.node[2]] - X[g.node[0]] + (u[g.node[2]] - u[g.node[0]]);
		const JointFrame in   = jointFrame(e1.x(), e1.y(), e2.x(), e2.y());
		const Real       area = s.released[i] ? 0 : g.area;
		Vec2             on[4];
		std::fill(on, on + 4, Vec2::Zero());
		Real moment = 0;
		for (int k : { 0, 1 }) {
			const int  p  = 2 * i + k;
			const Real gx = d.x() + g.s2[k] * e2.x() - g.s1[k] * e1.x(), gy = d.y() + g.s2[k] * e2.y() - g.s1[k] * e1.y();
			const Real dn = gx * in.nx + gy * in.ny, dt = gy * in.nx - gx * in.ny;
			s.opening[p] = dn - a.joints.columns.bondOpening[k][i];
			s.slip[p]    = dt - a.joints.columns.bondSlip[k][i];
			JointStep now { 0, 0, s.joint(p) };
			if (!s.released[i]) now = advance(a.joints.of(i), now.state, s.opening[p], s.slip[p]);
			if (now.state.status != s.status[p]) a.forces.broke[i / Joints::batch] = true;
			s.setJoint(p, now.state);
			s.sigma[p] = now.sigma, s.tau[p] = now.tau;
			const Real n = area * now.sigma, t = area * now.tau;
			const Vec2 force(n * in.nx - t * in.ny, n * in.ny + t * in.nx);
			on[0] += (1 - g.s1[k]) * force, on[1] += g.s1[k] * force, on[2] -= (1 - g.s2[k]) * force, on[3] -= g.s2[k] * force;
			moment += n * dt - t * dn;
		}
		const Real half = moment / 2;
		const Vec2 r1(in.r1x, in.r1y), r2(in.r2x, in.r2y);
		on[0] -= half * r1, on[1] += half * r1, on[2] -= half * r2, on[3] += half * r2;
		if (s.released[i]) continue;
		for (int k = 0; k < 4; ++k)
			f[g.node[k]] += on[k];
	}
	for (int block = 0; block < a.blockCount(); ++block)
		addZoneForces(a, block, block + 1, f.data());
}

void expectSameJoints(const BlockAssembly& a, const BlockAssembly& b)
{
	EXPECT_EQ(a.state.opening, b.state.opening);
	EXPECT_EQ(a.state.slip, b.state.slip);
	EXPECT_EQ(a.state.sigma, b.state.sigma);
	EXPECT_EQ(a.state.tau, b.state.tau);
	EXPECT_EQ(a.state.status, b.state.status);
	EXPECT_EQ(a.state.slipPlastic, b.state.slipPlastic);
	EXPECT_EQ(a.state.uplift, b.state.uplift);
	EXPECT_EQ(a.forces.broke, b.forces.broke);
	EXPECT_TRUE(a.forces.nodal == b.forces.nodal);
}

const std::vector<Mixture> mixtures {
	{ "all intact, one kind", 1e-6, 1, 0, 0, 0 },
	{ "all intact, several kinds", 1e-6, 3, 0, 0, 0 },
	{ "some break, one kind", 8e-5, 1, 0, 0, 0 },
	{ "some break, several kinds", 8e-5, 3, 0, 0, 0 },
	{ "few broken", 1e-6, 3, 0.02, 0, 0 },
	{ "half broken, unbonded", 1e-4, 3, 0.5, 0, 0 },
	{ "all broken", 1e-4, 3, 1, 0, 0 },
	{ "released among the intact", 1e-6, 3, 0, 0.1, 0 },
	{ "everything at once", 1e-4, 3, 0.3, 0.2, 0.1 },
	{ "without properties", 1e-6, 3, 0, 0, 0.2 },
};

} // namespace

TEST(JointsInBatches, SameBitsAsPointByPoint)
{
	// Each mixture from ten states; what it promises must occur. No operation is fused, so that the width changes nothing.
	int broke = 0, slid = 0;
	for (const Mixture& m : mixtures)
		for (unsigned seed = 0; seed < 10; ++seed) {
			SCOPED_TRACE(std::string(m.what) + ", seed " + std::to_string(seed));
			const BlockAssembly start = randomState(m, seed);
			ASSERT_GT(start.joints.count(), 4 * Joints::batch);
			ASSERT_NE(start.joints.count() % Joints::batch, 0); // the last batch is not full
			BlockAssembly expected = start;
			advanceOneByOne(expected);
			for (int threads : { 1, 2, 3, 7 })
				for (bool account : { false, true }) {
					BlockAssembly a = start;
					sweepForces(a, Brittle {}, account, threads);
					expectSameJoints(a, expected);
				}
			BlockAssembly byRange = start; // as a loop by pairs does it
			updateKinematics(byRange, allJoints(byRange));
			for (int pair = 0; pair < int(byRange.joints.pairs.size()); ++pair)
				advanceStresses(byRange, jointsOf(byRange, pair), Brittle {});
			sumForces(byRange);
			expectSameJoints(byRange, expected);
			for (int p = 0; p < start.pointCount(); ++p) {
				broke += start.state.status[p] == Joint::intact && expected.state.status[p] != Joint::intact;
				slid += start.state.slipPlastic[p] != expected.state.slipPlastic[p];
			}
			if (m.amount < 2e-6 && m.broken == 0) {
				EXPECT_TRUE(start.state.status == expected.state.status);
			}
		}
	EXPECT_GT(broke, 500);
	EXPECT_GT(slid, 500);
}

TEST(JointsInBatches, WhereEdgesMatchTheFirstOneSaysAll)
{
	// Batches of matching edges read fewer columns. The same bits as by way of all columns.
	for (unsigned seed = 0; seed < 10; ++seed) {
		BlockAssembly a = randomState({ "everything at once", 1e-4, 3, 0.3, 0.2, 0.1 }, seed), b = a;
		auto&         matched = b.joints.columns.matched;
		ASSERT_GT(std::count(matched.begin(), matched.end(), true), 2);
		std::fill(matched.begin(), matched.end(), false);
		sweepForces(a, Brittle {});
		sweepForces(b, Brittle {});
		expectSameJoints(a, b);
	}
}

TEST(JointsInBatches, EdgesMatchWhereTheyDoInAllJointsOfABatch)
{
	// One joint of the second batch is different, in one of the ways there are.
	const BlockAssembly                                    whole = voronoi(1.7, 0.9, 6, 4, stone(), elasticJoint(1, 1), 0.4);
	const int                                              joint = Joints::batch + 5;
	const auto                                             node  = whole.joints.segments[joint].node;
	const std::vector<std::function<void(BlockAssembly&)>> ways {
		[&](BlockAssembly& a) { a.joints.segments[joint].s1[0] = 0.25; },
		[&](BlockAssembly& a) { a.joints.segments[joint].s1[1] = 0.75; },
		[&](BlockAssembly& a) { a.joints.segments[joint].s2[0] = 0.75; },
		[&](BlockAssembly& a) { a.joints.segments[joint].s2[1] = 0.25; },
		[&](BlockAssembly& a) { a.joints.segments[joint].s1[0] = 0.25, a.joints.segments[joint].s2[0] = 0.75; }, // at the same place, no gap
		[&](BlockAssembly& a) { a.joints.segments[joint].s1[1] = 0.75, a.joints.segments[joint].s2[1] = 0.25; },
		[&](BlockAssembly& a) { a.mesh.reference[node[0]].x() += 1e-9; },
		[&](BlockAssembly& a) { a.mesh.reference[node[3]].y() += 1e-9; },
		[&](BlockAssembly& a) {
			a.joints.inSituOpening.assign(a.joints.count(), { 0, 0 });
			a.joints.inSituSlip.assign(a.joints.count(), { 0, 0 });
			a.joints.inSituSlip[joint][1] = 1e-9;
		},
	};
	ASSERT_GE(whole.joints.columns.matched.size(), 2u);
	for (char matched : whole.joints.columns.matched)
		EXPECT_TRUE(matched);
	for (const auto& way : ways) {
		BlockAssembly a = whole;
		way(a);
		a.rebuild();
		EXPECT_FALSE(a.joints.columns.matched[1]);
	}
}

TEST(JointsInBatches, ALawOfOnesOwnIsAskedAtEveryPoint)
{
	// The same law without the promise that intact points are plainly elastic: every batch asks it, and nothing changes.
	struct Slow {
		JointStep operator()(const JointParams& p, const JointState& s, Real un, Real us) const { return advance(p, s, un, us); }
	};
	for (const Mixture& m : mixtures) {
		SCOPED_TRACE(m.what);
		BlockAssembly fast = randomState(m, 3), slow = fast;
		sweepForces(fast, Brittle {});
		sweepForces(slow, Slow {});
		expectSameJoints(slow, fast);
	}
}

TEST(JointsInBatches, DissipationIsWorkLessWhatIsStored)
{
	// Point by point and in plain sums; some 350 terms, each of a few roundings of the energies turned over.
	for (const Mixture& m : mixtures) {
		SCOPED_TRACE(m.what);
		const BlockAssembly start = randomState(m, 5);
		BlockAssembly       a     = start;
		sweepForces(a, Brittle {}, true);
		const State &before = start.state, &after = a.state;
		Real         friction = 0, fracture = 0, turnover = 0;
		for (int p = 0; p < a.pointCount(); ++p) {
			if (after.released[p / 2] || (before.status[p] == Joint::intact && after.status[p] == Joint::intact)) continue;
			const JointParams& j    = a.joints.ofPoint(p);
			const Real         area = a.joints.segments[p / 2].area;
			const Real         work = (before.sigma[p] + after.sigma[p]) / 2 * (after.opening[p] - before.opening[p])
				+ (before.tau[p] + after.tau[p]) / 2 * (after.slip[p] - before.slip[p]);
			const Real held  = blocks::storedEnergy(j, before.sigma[p], before.tau[p]),
				   holds = blocks::storedEnergy(j, after.sigma[p], after.tau[p]);
			(before.status[p] == after.status[p] ? friction : fracture) += area * (work + held - holds);
			turnover += area * (std::abs(work) + held + holds);
		}
		EXPECT_NEAR(after.accounts.friction, friction, 400 * eps * turnover);
		EXPECT_NEAR(after.accounts.fracture, fracture, 400 * eps * turnover);
		EXPECT_EQ(turnover > 0, m.amount > 2e-6 || m.broken > 0);
	}
}
