// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/step/ContactResults.hpp>

using namespace specimens;

/// The step as a whole: batches against one point after the other, fans against zones of any shape, far from the origin against near it.

// ---- joints in batches

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

// ---- zones

TEST(ZoneForces, FansAndZonesOfAnyShapeAgree)
{
	// Polygons of 3 to 100 corners (more than a batch of zones), once as fans that are known as such, once with zones that start at another
	// of their nodes. Two materials, so that runs end. The zones of the two differ by rounding: strains of 0.1 and forces of order
	// 50 x 0.1 x 0.7 at the inner point from up to 100 zones with 20 roundings each.
	for (const Strain strain : { Strain::large, Strain::small }) {
		BlockAssembly a, b;
		for (BlockAssembly* s : { &a, &b }) {
			s->strain    = strain;
			s->thickness = 0.7;
			s->addMaterial({ 20, 0.2, 1 });
			s->addMaterial({ 50, 0.3, 1 });
		}
		std::mt19937 random(5);
		for (int corners : { 3, 4, 5, 6, 30, 30, 7, 64, 65, 4, 100, 3, 5 }) {
			const int  material = random() % 3 == 0;
			Ring       ring;
			const Real shiftX = 3 * a.blockCount();
			for (int i = 0; i < corners; ++i)
				ring.push_back({ shiftX + std::cos(2 * M_PI * i / corners), 0.7 * std::sin(2 * M_PI * i / corners) });
			addFan(a, ring, material);
			Ring                            points = ring;
			std::vector<int>                outline;
			std::vector<std::array<int, 3>> zones;
			points.push_back(0.9 * mean(ring) + 0.1 * ring[0]);
			for (int i = 0; i < corners; ++i)
				outline.push_back(i), zones.push_back({ (i + 1) % corners, corners, i });
			b.addBlock(points, { outline }, zones, material);
			EXPECT_TRUE(a.mesh.isFan[a.blockCount() - 1]);
			EXPECT_FALSE(b.mesh.isFan[b.blockCount() - 1]);
		}
		std::uniform_real_distribution<Real> shift(-0.03, 0.03);
		for (Vec2& u : a.state.displacement) {
			const Real dx = shift(random), dy = shift(random);
			u = { dx, dy };
		}
		if (strain == Strain::large) rotateAbout(a, { 1, 1 }, 1.1, { 0, 0 });
		b.state.displacement = a.state.displacement;
		for (int threads : { 1, 2 }) {
			sumForces(a, true, threads), sumForces(b, true, threads);
			for (int n = 0; n < a.nodeCount(); ++n)
				EXPECT_LT((a.forces.nodal[n] - b.forces.nodal[n]).norm(), 1000 * eps * 35) << "node " << n;
			EXPECT_GT(largestForce(a), 0.1);
			Real sum = 0, other = 0;
			for (int block = 0; block < a.blockCount(); ++block) {
				EXPECT_NEAR(a.forces.zoneEnergy[block], b.forces.zoneEnergy[block], 1000 * eps * a.forces.zoneEnergy[block]);
				EXPECT_GT(a.forces.zoneEnergy[block], 0);
				sum += a.forces.zoneEnergy[block], other += b.forces.zoneEnergy[block];
			}
			EXPECT_NEAR(sum, zoneEnergy(a), 1000 * eps * sum);
			EXPECT_NEAR(other, zoneEnergy(b), 1000 * eps * sum);
			const auto booked = a.forces.nodal;
			sumForces(a, false, threads); // accounts change no bit of a force
			EXPECT_TRUE(a.forces.nodal == booked);
		}
	}
}

TEST(ZoneForces, ABlockThatOnlyLooksLikeAFanIsNone)
{
	// As many zones as corners and an inner grid point, but not from corner to corner.
	BlockAssembly a;
	a.addMaterial(stone());
	const Ring points { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 }, { 0.5, 0.5 } };
	a.addBlock(points, { { 0, 1, 2, 3 } }, { { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 }, { 3, 0, 4 } }, 0);
	a.addBlock(points, { { 0, 1, 2, 3 } }, { { 1, 2, 4 }, { 0, 1, 4 }, { 2, 3, 4 }, { 3, 0, 4 } }, 0); // in another order
	a.addBlock(points, { { 0, 1, 2, 3 } }, { { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 }, { 0, 4, 3 } }, 0); // the last one turned
	const Ring shuffled { { 0, 0 }, { 1, 1 }, { 1, 0 }, { 0, 1 }, { 0.5, 0.5 } };                      // grid points not in the order of the outline
	a.addBlock(shuffled, { { 0, 2, 1, 3 } }, { { 2, 1, 4 }, { 0, 2, 4 }, { 1, 3, 4 }, { 3, 0, 4 } }, 0);
	EXPECT_TRUE(a.mesh.isFan[0]);
	EXPECT_FALSE(a.mesh.isFan[1]);
	EXPECT_FALSE(a.mesh.isFan[2]);
	EXPECT_FALSE(a.mesh.isFan[3]);
	BlockAssembly rigid;
	rigid.addMaterial(stone());
	rigid.addBlock({ { 0, 0 }, { 1, 0 }, { 0, 1 } }, { { 0, 1, 2 } }, {}, 0);
	EXPECT_FALSE(rigid.mesh.isFan[0]);
	computeForces(rigid);
	EXPECT_EQ(largestForce(rigid), 0);
}

// ---- far from the origin

namespace {

/// To 2^-20 m: so it is exact up to 2^32 m from the origin.
Vec2 dyadic(const Vec2& x) { return (x * 1048576).array().round() / 1048576; }

/// A wall of Voronoi cells, 1 x 0.6 m, and a block beside it that touches nothing but what it hits, all of it shifted.
BlockAssembly wall(const Vec2& shift)
{
	JointParams joint = elasticJoint(1e12, 4e11);
	joint.tension = joint.cohesion = 100; // some give way on the way
	joint.tanPhi = joint.tanPhiResidual = 0.5;
	TessellationOptions options;
	options.seeds         = jitteredSeeds(1, 0.6, 5, 3, 0.6, 7);
	options.size          = 0.2;
	options.mergeFraction = 0.1;
	const Cells   cells   = tessellate(rectangle(1, 0.6), options);
	BlockAssembly a;
	a.thickness = 0.5;
	a.addMaterial(stone());
	auto add = [&](Ring ring) {
		std::vector<int>                outline;
		std::vector<std::array<int, 3>> zones;
		const int                       corners = int(ring.size());
		ring.push_back(mean(ring));
		for (Vec2& x : ring)
			x = dyadic(x) + shift;
		for (int i = 0; i < corners; ++i)
			outline.push_back(i), zones.push_back({ i, (i + 1) % corners, corners });
		a.addBlock(ring, { outline }, zones, 0);
	};
	for (size_t i = 0; i < cells.cells.size(); ++i)
		add(ringOf(cells, i));
	add({ { 1.0078125, 0.25 }, { 1.25, 0.2265625 }, { 1.25, 0.5 }, { 1.03125, 0.5 } });
	bondAll(a, joint);
	a.contacts.wanted    = true;
	a.joints.ofMaterials = { int(a.joints.kinds.size()) };
	a.joints.kinds.push_back(elasticJoint(1e11, 4e10));
	a.joints.kinds.back().tanPhiResidual = 0.5;
	return a;
}

} // namespace

TEST(FarFromTheOrigin, EveryBitIsTheSame)
{
	// Reference positions that both places hold exactly. 5000 km away positions are 1e-9 m apart, three times what the head moves in a step
	// (4e-10 m): only displacements can tell. Strains, joints that break, a block that hits and rubs: nothing knows where it is.
	const Vec2    far(5e6, -3e6);
	BlockAssembly here = wall({ 0, 0 }), there = wall(far);
	const Real    dt = 1e-6;
	ASSERT_LT(2 * dt, stableTimeStep(here, nodalStiffness(here), here.state.inertia));
	EXPECT_EQ(here.joints.columns.bondOpening[0], there.joints.columns.bondOpening[0]);
	for (BlockAssembly* a : { &here, &there }) {
		const Vec2 shift = a == &here ? Vec2(0, 0) : far;
		a->addGroup(driven("foot", dofs(*a, 1, [&](const Vec2& x) { return x.y() == shift.y(); }), 0));
		a->addGroup(driven("head", dofs(*a, 1, [&](const Vec2& x) { return x.y() == shift.y() + dyadic({ 0, 0.6 }).y(); }), 4e-4));
		ASSERT_GT(a->state.groups[1].dofs.size(), 3u);
		const int last = a->blockCount() - 1;
		for (int n = a->mesh.firstNode[last]; n < a->mesh.firstNode[last + 1]; ++n)
			a->state.velocity[n] = { -12, 1 };
	}
	Damping damping;
	damping.alpha    = 0.2;
	bool touched     = false;
	auto elongations = [&](const BlockAssembly& a) { return a.state.groups[1].travelled; };
	for (int i = 0; i < 1000; ++i) {
		for (BlockAssembly* a : { &here, &there }) {
			blocks::computeForces(*a, Brittle {}, dt, true);
			move(*a, damping, dt, i * dt, true);
		}
		touched |= contactEnergy(there) > 0;
		ASSERT_TRUE(here.state.displacement == there.state.displacement) << "step " << i;
	}
	EXPECT_NEAR(elongations(there), 4e-7, 1e-15);
	const int head = there.state.groups[1].dofs[0] / 2;
	EXPECT_EQ(there.state.displacement[head].y(), there.state.groups[1].travelled);
	EXPECT_LT(std::abs((there.position(head) - there.mesh.reference[head]).y() / 4e-7 - 1), 0.01); // to the 1e-9 m that positions tell
	EXPECT_TRUE(here.forces.nodal == there.forces.nodal);
	EXPECT_EQ(here.state.status, there.state.status);
	EXPECT_EQ(here.state.accounts.friction, there.state.accounts.friction);
	EXPECT_EQ(contactFriction(here), contactFriction(there));
	EXPECT_EQ(zoneEnergy(here), zoneEnergy(there));
	EXPECT_TRUE(touched);
	EXPECT_GT(std::count(there.state.released.begin(), there.state.released.end(), true), 0);
	EXPECT_LT(std::count(there.state.released.begin(), there.state.released.end(), true), there.joints.count());
}

// ---- contact in time

namespace {

/// Depth of two convex blocks in each other: the least over the edges' normals, negative if they are apart [m].
Real depthOf(const BlockAssembly& a)
{
	Real least = std::numeric_limits<Real>::infinity();
	for (int block : { 0, 1 })
		for (int e = a.mesh.firstEdge[block]; e < a.mesh.firstEdge[block + 1]; ++e) {
			const Vec2 p = a.position(a.mesh.edgeNodes[e][0]), along = a.between(a.mesh.edgeNodes[e][0], a.mesh.edgeNodes[e][1]).normalized();
			Real       deepest = -std::numeric_limits<Real>::infinity();
			for (int n = a.mesh.firstNode[1 - block]; n < a.mesh.firstNode[2 - block]; ++n)
				deepest = std::max(deepest, cross(along, a.position(n) - p));
			least = std::min(least, deepest);
		}
	return least;
}

} // namespace

TEST(ContactInTime, NoSpeedAndNoOffsetMakesItLate)
{
	// A square goes at another one, straight, aside, corner first, turning; its size by the other's is 1 or 1/20. The step that takes it in by
	// more than rounding must find it in contact: nobody is deeper than one step's motion without a force.
	std::mt19937                         random(2);
	std::uniform_real_distribution<Real> u(0, 1);
	int                                  hits = 0;
	for (const Real size : { 1., 0.05 })
		for (const Real share : { 1e-4, 1e-3, 0.007, 0.016, 0.033, 0.1, 0.2 }) // of the smaller edge, a step
			for (int pose = 0; pose < 40; ++pose) {
				SCOPED_TRACE("size " + shown(size) + ", " + shown(share) + " of an edge a step, pose " + std::to_string(pose));
				BlockAssembly a;
				a.addMaterial(stone());
				auto square = [&](Vec2 centre, Real side, Real turn) {
					Ring ring;
					for (int i = 0; i < 4; ++i)
						ring.push_back(
							centre
							+ side / std::sqrt(2)
								* Vec2(std::cos(turn + (i + 0.5) * M_PI / 2), std::sin(turn + (i + 0.5) * M_PI / 2)));
					std::vector<int> outline { 0, 1, 2, 3 };
					a.addBlock(ring, { outline }, {}, 0);
				};
				square({ 0, 0 }, 1, 0);
				const Real step  = share * size,
					   turn  = pose % 4 == 0 ? 0
					 : pose % 4 == 1         ? M_PI / 4
								 : 2 * M_PI * u(random),
					   spin  = pose % 8 == 7 ? 0.3 * share : 0;
				const Real gap   = (0.001 + 0.3 * u(random)) * size + (pose % 5 == 0 ? 20 * step : 0),
					   aside = 0.9 * (u(random) - 0.5) * (1 + size);
				square({ -0.5 - size * std::sqrt(0.5) - gap, aside }, size, turn);
				const Vec2 v         = step * Vec2(std::cos(0.3 * (pose % 3 - 1)), std::sin(0.3 * (pose % 3 - 1)));
				a.contacts.wanted    = true;
				a.joints.ofMaterials = { 1 };
				a.joints.kinds.push_back(elasticJoint(1e6, 5e5));
				const int most    = int(3 * (gap + size) / step) + 10;
				bool      touched = false;
				for (int i = 0; i < most && !touched; ++i) {
					blocks::computeForces(a, Brittle {}, 1e-3);
					const Real depth = depthOf(a);
					ASSERT_LT(depth, (1 + spin / std::max(share, 1e-9)) * step + 1e-12);
					touched = contactEnergy(a) > 0;
					ASSERT_EQ(touched, depth > 0) << "depth " << depth;
					const Vec2 centre = a.centroid(1);
					rotateAbout(a, centre, spin, v, a.mesh.firstNode[1]);
				}
				hits += touched;
				if (share <= 1e-3) { // it is not looked for in every step: half of mayMove lies between two looks, at least
					EXPECT_LT(a.contacts.looks, 3 + 2 * most * step / (FreeContacts::mayMove * size));
				}
			}
	EXPECT_GT(hits, 2 * 7 * 30);
}
