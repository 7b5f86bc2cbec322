// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/analysis/StabilityWatch.hpp>
#include <blocks/kernel/step/ContactResults.hpp>
#include <blocks/kernel/step/TimeStep.hpp>

using namespace specimens;

namespace {

constexpr Real degree = M_PI / 180;

/// A joint that was never bonded.
JointParams frictional(Real kn, Real ks, Real phi)
{
	JointParams p;
	p.kn     = kn;
	p.ks     = ks;
	p.tanPhi = p.tanPhiResidual = std::tan(phi);
	return p;
}

BlockAssembly scene(Real young = 1e8, Real thickness = 1, Real density = 2000)
{
	BlockAssembly a;
	a.thickness = thickness;
	a.addMaterial({ young, 0.2, density });
	return a;
}

/// A polygon without zones; nobody moves it unless the test does.
int addRigid(BlockAssembly& a, const Ring& ring)
{
	std::vector<int> outline(ring.size());
	for (size_t i = 0; i < ring.size(); ++i)
		outline[i] = int(i);
	return a.addBlock(ring, { outline }, {}, 0);
}

Ring box(Real x, Real y, Real w, Real h) { return { { x, y }, { x + w, y }, { x + w, y + h }, { x, y + h } }; }

/// General contact in a scene of one material.
void wantContacts(BlockAssembly& a, const JointParams& joint)
{
	a.contacts.wanted    = true;
	a.joints.ofMaterials = { int(a.joints.kinds.size()) };
	a.joints.kinds.push_back(joint);
}

/// Everything between positions and forces, in a scene with free contacts.
void computeAllForces(BlockAssembly& a, const JointParams& joint, Real dt, int threads = 1)
{
	if (!a.contacts.wanted) wantContacts(a, joint);
	blocks::computeForces(a, Brittle {}, dt, false, threads);
}

/// A run without damping unless told; `each(step)` sees the state of the forces.
struct Simulation {
	BlockAssembly& a;
	JointParams    joint;
	Real           dt;
	Damping        damping;
	StepWork       work;
	int            threads = 1;
	long           step    = 0;

	Simulation(BlockAssembly& assembly, const JointParams& p, Real safety = 0.3, Real alpha = -1)
		: a(assembly)
		, joint(p)
	{
		damping.kind  = alpha < 0 ? Damping::Kind::none : Damping::Kind::local;
		damping.alpha = std::max(alpha, Real(0));
		computeAllForces(a, joint, 0); // makes the contacts, on which the time step depends
		dt = safety * boundedStep();
	}
	/// Another assembly, in the same state as the first.
	Simulation(BlockAssembly& assembly, const Simulation& o)
		: a(assembly)
		, joint(o.joint)
		, dt(o.dt)
		, damping(o.damping)
		, step(o.step)
	{
	}
	/// As if every pair of blocks touched.
	Real boundedStep()
	{
		BlockAssembly b = a;
		for (int i = 0; i < b.blockCount(); ++i)
			for (int j = i + 1; j < b.blockCount(); ++j)
				if (contactOf(b, i, j) < 0) {
					FreeContact c;
					c.block = { i, j };
					c.joint = joint;
					b.state.contacts.all().push_back(c);
					b.contacts.order.push_back(int(b.state.contacts.size()) - 1);
				}
		return stableTimeStep(b, nodalStiffness(b), b.mesh.mass);
	}
	template <class Each> void steps(long count, const Each& each)
	{
		for (long i = 0; i < count; ++i, ++step) {
			computeAllForces(a, joint, dt, threads);
			const BlockAssembly* before = &a;
			const Real           stored = zoneEnergy(*before) + jointEnergy(*before), loads = loadWork(*before);
			for (int n = 0; n < a.nodeCount(); ++n) // blocks without mass that a test moves
				if (a.mesh.mass[n] == 0) a.state.velocity[n] = rigidVelocity(n);
			work = integrate(a, damping, dt, step * dt, true, threads);
			each(stored + work.kinetic - loads);
		}
	}
	void steps(long count)
	{
		steps(count, [](Real) {});
	}
	std::function<Vec2(int)> rigidVelocity = [](int) { return Vec2(0, 0); };
};

void moveBlock(BlockAssembly& a, int block, const Vec2& shift, Real angle = 0)
{
	const Vec2 centre = a.centroid(block);
	rotateAbout(a, centre, angle, shift, a.mesh.firstNode[block], a.mesh.firstNode[block + 1]);
}

void setVelocity(BlockAssembly& a, int block, const Vec2& v, Real spin = 0)
{
	const Vec2 centre = a.centroid(block);
	for (int n = a.mesh.firstNode[block]; n < a.mesh.firstNode[block + 1]; ++n)
		a.state.velocity[n] = v + spin * Vec2(-(a.position(n) - centre).y(), (a.position(n) - centre).x());
}

Vec2 meanVelocity(const BlockAssembly& a, int block)
{
	Vec2 p = Vec2::Zero();
	Real m = 0;
	for (int n = a.mesh.firstNode[block]; n < a.mesh.firstNode[block + 1]; ++n)
		p += a.mesh.mass[n] * a.state.velocity[n], m += a.mesh.mass[n];
	return p / m;
}

/// A convex polygon with corners on a circle, some of them close to each other.
Ring randomPolygon(std::mt19937& random, Real radius, int corners, Real squeeze = 1)
{
	std::uniform_real_distribution<Real> u(0, 1);
	std::vector<Real>                    angles;
	for (int i = 0; i < corners; ++i)
		angles.push_back(2 * M_PI * (i + 0.8 * u(random)) / corners);
	const Real turn = 2 * M_PI * u(random);
	Ring       ring;
	for (Real w : angles) {
		const Vec2 p(radius * std::cos(w), squeeze * radius * std::sin(w));
		ring.push_back({ p.x() * std::cos(turn) - p.y() * std::sin(turn), p.x() * std::sin(turn) + p.y() * std::cos(turn) });
	}
	return ring;
}

Ring shifted(Ring ring, const Vec2& by)
{
	for (Vec2& p : ring)
		p += by;
	return ring;
}

} // namespace

// ---- detection

TEST(FreeContacts, NothingHappensWithoutThem)
{
	BlockAssembly a = twoBlocks(elasticJoint(1e9, 5e8));
	computeForces(a);
	EXPECT_TRUE(!a.contacts.started && a.state.contacts.empty() && a.contacts.rounding.empty() && a.state.search.detectedAt.empty());
	EXPECT_EQ(contactOf(a, 0, 1), -1);
}

TEST(FreeContacts, OnlyNearBlocksGetAContact)
{
	BlockAssembly a = scene();
	addFan(a, box(0, 0, 1, 1)), addFan(a, box(1.01, 0.3, 1, 1)), addFan(a, box(2.6, 0, 1, 1));
	a.contacts.wanted = true;
	prepareContacts(a);
	ASSERT_EQ(a.contacts.order.size(), 1u);
	const int c = contactOf(a, 1, 0);
	ASSERT_GE(c, 0);
	EXPECT_EQ(contactOf(a, 0, 1), c);
	EXPECT_EQ(contactOf(a, 0, 2), -1);
	const auto  facing = std::array<int, 2> { 1, 7 }; // right edge of block 0, left edge of block 1
	const auto& edges  = a.state.contacts[c].edges;
	EXPECT_TRUE(std::any_of(edges.begin(), edges.end(), [&](const EdgePair& e) { return e.edge == facing; }));
	expectRefusal([&] { setContactJoint(a, c, {}); }, { "kn must be positive" });
	EXPECT_EQ(a.state.contacts[c].joint.kn, 0); // nobody has said what the two materials are to each other
	for (int i = 0; i < 10; ++i)
		prepareContacts(a);
	EXPECT_EQ(a.contacts.looks, 1); // nothing has moved
}

TEST(FreeContacts, MaterialsDecideOnProperties)
{
	// Three materials, all pairs but one of them known, either way round.
	BlockAssembly a = scene();
	a.addMaterial(stone()), a.addMaterial(stone());
	const Ring square = box(0, 0, 1, 1);
	for (int i = 0; i < 3; ++i)
		a.addBlock(shifted(square, { 1.001 * i, 0 }), { { 0, 1, 2, 3 } }, {}, 2 - i);
	for (Real kn : { 3., 4. })
		a.joints.kinds.push_back(frictional(kn, 1, 0.1));
	a.joints.ofMaterials = { 1, 2, 0, 2, 1, 1, 0, 1, 0 };
	a.contacts.wanted    = true;
	prepareContacts(a);
	ASSERT_EQ(a.contacts.order.size(), 2u);
	EXPECT_EQ(a.state.contacts[contactOf(a, 0, 1)].joint.kn, 3); // materials 2 and 1
	EXPECT_EQ(a.state.contacts[contactOf(a, 1, 2)].joint.kn, 4); // 1 and 0
	a.bond({});                                                  // the kinds are new, so that those between materials are to be said again
	EXPECT_EQ(a.joints.kindOfMaterials(2, 1), 0);
}

TEST(FreeContacts, ABlockThatIsAddedLaterIsSeen)
{
	BlockAssembly a = scene();
	addFan(a, box(0, 0, 1, 1));
	const JointParams joint = frictional(1e6, 5e5, 0);
	computeAllForces(a, joint, 0);
	EXPECT_TRUE(a.contacts.order.empty());
	addFan(a, box(1 - 1e-4, 0.3, 1, 1));
	computeAllForces(a, joint, 0);
	ASSERT_EQ(a.contacts.order.size(), 1u);
	EXPECT_NEAR(contactForce(a, 1).x(), 1e6 * 1e-4 * 0.7, 0.01 * 70); // kn d times the overlap
}

TEST(FreeContacts, AreasAddUp)
{
	// A box on a floor of five blocks of unequal widths, and the box's own bottom in three edges: the areas are those of the
	// bottom, 2 x T. What is lost at the sharp corners of the floor's blocks is of the order of the depth.
	BlockAssembly a = scene(1e8, 0.7);
	Real          x = 0;
	for (Real w : { 0.5, 1.0, 0.3, 0.8, 1.4 }) {
		addRigid(a, box(x, -1, w, 1));
		x += w;
	}
	const Real d = 1e-4;
	addFan(a, { { 0.7, -d }, { 1.1, -d }, { 1.9, -d }, { 2.7, -d }, { 2.7, 1 }, { 0.7, 1 } });
	computeAllForces(a, frictional(1e6, 5e5, 0), 0);
	Real area = 0;
	for (int i : a.contacts.order)
		for (const EdgePair& e : a.state.contacts[i].edges)
			if (e.touching) area += 2 * e.area;
	EXPECT_NEAR(area, 2 * 0.7, 10 * d);
	EXPECT_NEAR(contactForce(a, 5).y(), 1e6 * d * 2 * 0.7, 1e6 * d * 10 * d);
	EXPECT_NEAR(contactForce(a, 5).x(), 0, 1e6 * d * 10 * d);
}

TEST(FreeContacts, PairsAreFoundInTimeAndForgottenWhenFar)
{
	// A box comes down from out of reach at 2 m/s: its contact is there before it touches, and gone when it is lifted again.
	BlockAssembly a = scene();
	addRigid(a, box(-2, -1, 4, 1));
	addFan(a, box(-0.5, 0.5, 1, 1));
	Simulation run(a, frictional(1e6, 1e6, 0.5));
	EXPECT_TRUE(a.contacts.order.empty());
	setVelocity(a, 1, { 0.3, -2 });
	Real lowest = 1, before = 1;
	run.steps(20000, [&](Real) {
		Real low = 1;
		for (int n = a.mesh.firstNode[1]; n < a.mesh.firstNode[2]; ++n)
			low = std::min(low, a.position(n).y());
		if (before < -1e-6) {
			ASSERT_GT(contactForce(a, 1).y(), 0);
		}
		before = low;
		lowest = std::min(lowest, low);
	});
	EXPECT_LT(lowest, -0.01);
	EXPECT_GT(meanVelocity(a, 1).y(), 0);
	EXPECT_TRUE(a.contacts.order.empty());
	EXPECT_TRUE(std::all_of(a.state.contacts.begin(), a.state.contacts.end(), [](const FreeContact& c) { return c.edges.empty(); }));
}

// ---- forces against the point law

TEST(FreeContacts, ConformingJointGivesThePointLaw)
{
	// Two blocks pressed together and sheared, once as a joint of point contacts without strength, once as free contact.
	// Compressed by un/L ~ 1e-6 and tilted as little: what differs is of the order of these.
	auto pushed = [](BlockAssembly& a) {
		for (int n = a.mesh.firstNode[1]; n < a.nodeCount(); ++n) {
			const Vec2 along(0.3, 0.8), normal(0.8, -0.3); // of the common edge, n out of the first block
			a.state.displacement[n] += -1e-6 * normal / normal.norm() + 3e-7 * along / along.norm();
		}
		rotateAbout(a, { 1, 0 }, 2e-7, { 0, 0 }, a.mesh.firstNode[1]);
	};
	const JointParams joint  = frictional(1e9, 4e8, 30 * degree);
	BlockAssembly     bonded = twoBlocks(joint), free = bonded;
	bonded.setJoints(0, bonded.joints.count(), joint, Joint::unbonded);
	free.bond({});
	// the motion as a velocity, so that the free contact sees the slip too
	BlockAssembly at = bonded;
	pushed(at);
	free.contacts.wanted = true;
	prepareContacts(free);
	setContactJoint(free, 0, joint);
	for (int n = 0; n < free.nodeCount(); ++n)
		free.state.velocity[n] = at.state.displacement[n];
	pushed(bonded), pushed(free);
	const auto zero = [](BlockAssembly& a) { std::fill(a.forces.nodal.begin(), a.forces.nodal.end(), Vec2::Zero()); };
	updateKinematics(bonded, { 0, 1 });
	advanceStresses(bonded, { 0, 1 }, Brittle {});
	zero(bonded), zero(free);
	for (int c = 0; c < 4; ++c)
		bonded.forces.nodal[bonded.joints.segments[0].node[c]] += forcesOfJoint(bonded, 0)[c];
	advanceContacts(free, 1);
	gatherContactForces(free, 0, free.forces.nodal.data());
	gatherContactForces(free, 1, free.forces.nodal.data());
	const Real scale = largestForce(bonded);
	EXPECT_GT(scale, 100);
	for (int n = 0; n < free.nodeCount(); ++n)
		EXPECT_LT((bonded.forces.nodal[n] - free.forces.nodal[n]).norm(), 1e-5 * scale) << n;
}

namespace {

// Along the joint of twoBlocks and out of the first one.
const Vec2 along = Vec2(0.3, 0.8).normalized(), normal(along.y(), -along.x());

void moveSecond(BlockAssembly& a, const Vec2& u)
{
	for (int n = a.mesh.firstNode[1]; n < a.nodeCount(); ++n)
		a.state.displacement[n] += u, a.state.velocity[n] = u;
}

/// Slips of 4e-7 m, with the joint's law alone.
void slideSecond(BlockAssembly& a, int steps)
{
	for (int i = 0; i < steps; ++i) {
		moveSecond(a, 4e-7 * along);
		updateKinematics(a, { 0, 1 });
		advanceStresses(a, jointsOf(a, 0), Brittle {});
	}
}

/// Nodal forces of the joint as it is, everything stopped.
std::vector<Vec2> forcesAtRest(BlockAssembly& a)
{
	for (Vec2& v : a.state.velocity)
		v.setZero();
	sumForces(a);
	return a.forces.nodal;
}

} // namespace

TEST(FreeContacts, BrokenSegmentsAreReleasedWithoutAJump)
{
	// Pressed and sheared until the joint slides; the step in which its segments become free pairs must not change the forces.
	JointParams joint = elasticJoint(1e9, 4e8);
	joint.tension = 1e5, joint.cohesion = 2e3, joint.tanPhi = joint.tanPhiResidual = 0.5;
	joint.cohesionResidual = 500;
	BlockAssembly a        = twoBlocks(joint);
	auto          move     = [&](const Vec2& u) { moveSecond(a, u); };
	move(-1e-6 * normal);
	computeAllForces(a, joint, 1, 1);
	EXPECT_TRUE(a.contacts.order.empty());
	EXPECT_FALSE(a.state.released[0]);
	slideSecond(a, 20);
	EXPECT_EQ(a.state.status[0], Joint::brokenInShear);
	EXPECT_NEAR(a.state.tau[0], 500 + 0.5 * 1000, 1);
	const auto before = forcesAtRest(a);
	const Real energy = jointEnergy(a), scale = largestForce(a);
	computeAllForces(a, joint, 1, 1);
	ASSERT_EQ(a.contacts.order.size(), 1u);
	EXPECT_TRUE(a.state.released[0]);
	EXPECT_EQ(a.state.tau[0], 0); // what it carried is the free pair's
	for (int n = 0; n < a.nodeCount(); ++n)
		EXPECT_LT((a.forces.nodal[n] - before[n]).norm(), 1e-5 * scale);
	EXPECT_NEAR(jointEnergy(a), energy, 1e-5 * energy);
	EXPECT_EQ(a.joints.effective[0], releasedKind) << "nothing of it is summed";
	// it goes on sliding at its residual strength
	for (int i = 0; i < 5; ++i)
		move(4e-7 * along), computeAllForces(a, joint, 1, 1);
	const Vec2 f = contactForce(a, 0);
	EXPECT_NEAR(f.dot(along) / (0.7 * Vec2(0.3, 0.8).norm()), 500 + 0.5 * 1000, 1);
}

TEST(FreeContacts, JointsThatHoldAtOneEndStayJoints)
{
	// Pressed, and broken at one of its ends: as a free contact it would lose what holds at the other one.
	JointParams joint = elasticJoint(1e9, 4e8);
	joint.tension = joint.cohesion = 1e5;
	BlockAssembly a                = twoBlocks(joint);
	moveSecond(a, -1e-6 * normal);
	computeAllForces(a, joint, 1, 1);
	a.state.status[1] = Joint::brokenInShear, a.forces.broke[0] = true;
	computeAllForces(a, joint, 1, 1);
	EXPECT_FALSE(a.state.released[0]);
	EXPECT_TRUE(a.contacts.order.empty());
	EXPECT_EQ(a.state.status[0], Joint::intact);
	EXPECT_NEAR(a.state.sigma[0], -1e9 * 1e-6, 1e-6); // kn times the opening, to rounding
	a.state.status[0] = Joint::brokenInShear, a.forces.broke[0] = true;
	computeAllForces(a, joint, 1, 1);
	EXPECT_TRUE(a.state.released[0]);
}

TEST(FreeContacts, DilatedJointsAreReleasedWithoutAJump)
{
	// As above, with a joint that dilates for 2e-6 m: it stays a joint while it does, and what it was raised by stays for good.
	JointParams joint = elasticJoint(1e9, 4e8);
	joint.tension = 1e5, joint.cohesion = 100, joint.tanPhi = joint.tanPhiResidual = 0.5;
	joint.tanDilation = 0.2, joint.dilationLimitSlip = 2e-6;
	BlockAssembly a    = twoBlocks(joint);
	auto          move = [&](const Vec2& u) { moveSecond(a, u); };
	move(-1e-6 * normal);
	for (int i = 0; i < 5; ++i)
		move(4e-7 * along), computeAllForces(a, joint, 1, 1);
	EXPECT_NE(a.state.status[0], Joint::intact);
	EXPECT_FALSE(a.state.released[0]); // it still dilates
	slideSecond(a, 20);
	const Real atBreaking = 1.6e-6 - 500 / 4e8,
		   pressed    = 1e-6 + 0.2 * (2e-6 - atBreaking); // it breaks in the fourth step, beyond 600 Pa; that slip lifts nothing
	EXPECT_NEAR(a.state.sigma[0], -1e9 * pressed, 1);
	const auto before = forcesAtRest(a);
	const Real energy = jointEnergy(a), scale = largestForce(a);
	computeAllForces(a, joint, 1, 1);
	EXPECT_TRUE(a.state.released[0]);
	for (int n = 0; n < a.nodeCount(); ++n)
		EXPECT_LT((a.forces.nodal[n] - before[n]).norm(), 3e-5 * scale); // it has slid by 1e-5 of its length
	EXPECT_NEAR(jointEnergy(a), energy, 3e-5 * energy);
	// apart by less than the asperities are high they still touch; farther they do not
	move((pressed - 0.2e-6) * normal), computeAllForces(a, joint, 0, 1);
	EXPECT_GT(largestForce(a), 0.1 * scale);
	move(0.4e-6 * normal), computeAllForces(a, joint, 0, 1);
	EXPECT_EQ(contactEnergy(a), 0);
	// without a limit slip it dilates for a quarter of its length, 0.85 m
	joint.dilationLimitSlip = std::numeric_limits<Real>::max();
	for (Real slip : { 0.21, 0.22 }) {
		BlockAssembly b = twoBlocks(joint);
		computeAllForces(b, joint, 0);
		b.state.status[0] = b.state.status[1] = Joint::brokenInShear;
		b.state.sigma[0] = b.state.sigma[1] = -1;
		b.state.slipPlastic[0] = b.state.slipPlastic[1] = slip;
		b.forces.broke[0]                               = true;
		prepareContacts(b);
		EXPECT_EQ(bool(b.state.released[0]), slip > std::hypot(0.3, 0.8) / 4);
		EXPECT_EQ(b.contacts.waiting.empty(), bool(b.state.released[0]));
		EXPECT_FALSE(b.forces.broke[0]);
	}
}

TEST(FreeContacts, RaisedEdgesHaveThePotentialsForces)
{
	// Asperities far higher than any, so that their lever counts: normal forces against differences of the energy, and what friction
	// takes from the blocks against what its springs hold.
	JointParams joint = frictional(1e9, 4e8, 0);
	joint.cohesion = joint.tension = 0;
	BlockAssembly a                = twoBlocks(joint);
	a.setJoints(0, a.joints.count(), joint, Joint::brokenInShear);
	a.contacts.wanted = true;
	prepareContacts(a);
	ASSERT_EQ(a.contacts.order.size(), 1u);
	setContactJoint(a, 0, joint);
	FreeContact& contact = a.state.contacts[0];
	for (EdgePair& e : contact.edges)
		e.uplift = e.area > 0 ? 0.05 : 0;
	std::mt19937                         random(5);
	std::uniform_real_distribution<Real> shift(-0.01, 0.01);
	for (Vec2& x : a.state.displacement)
		x += Vec2(shift(random), shift(random));

	auto energy = [](BlockAssembly b) {
		rebuildContacts(b);
		advanceContact(b, 0, 0);
		return contactEnergy(b);
	};
	auto forces = [](BlockAssembly& b, Real dt) {
		rebuildContacts(b);
		advanceContact(b, 0, dt);
		std::vector<Vec2> f(b.nodeCount(), Vec2::Zero());
		gatherContactForces(b, 0, f.data()), gatherContactForces(b, 1, f.data());
		return f;
	};
	for (EdgePair& e : contact.edges)
		e.slip = { 0, 0 };
	BlockAssembly smooth = a;
	const auto    normal = forces(smooth, 0);
	Real          scale = 0, moment = 0;
	Vec2          sum = Vec2::Zero();
	for (int n = 0; n < a.nodeCount(); ++n)
		scale = std::max(scale, normal[n].norm()), sum += normal[n], moment += cross(a.position(n), normal[n]);
	EXPECT_GT(scale, 1e5);
	EXPECT_LT(sum.norm() + std::abs(moment), 1e-12 * scale);
	const Real h = 1e-7;
	for (int n = 0; n < a.nodeCount(); ++n)
		for (int axis : { 0, 1 }) {
			BlockAssembly more = a, less = a;
			more.state.displacement[n][axis] += h, less.state.displacement[n][axis] -= h;
			EXPECT_NEAR(normal[n][axis], (energy(less) - energy(more)) / (2 * h), 1e-6 * scale) << n;
		}

	BlockAssembly rough                          = a;
	rough.state.contacts[0].joint.tanPhiResidual = 1e9;
	for (Vec2& v : rough.state.velocity)
		v = Vec2(shift(random), shift(random));
	const Real dt    = 1e-3;
	const auto all   = forces(rough, dt);
	Real       taken = 0, held = 0;
	for (int n = 0; n < a.nodeCount(); ++n)
		taken += dt * (all[n] - normal[n]).dot(rough.state.velocity[n]);
	for (const EdgePair& e : rough.state.contacts[0].edges)
		held += joint.ks * e.area * (e.slip[0] * e.slip[0] + e.slip[1] * e.slip[1]);
	EXPECT_GT(held, 0);
	EXPECT_NEAR(taken, -held, 1e-10 * held);
}

// ---- energy

TEST(FreeContacts, CornerHitsKeepTheEnergy)
{
	// Polygons thrown at each other, without friction, both deformable or one of them rigid: energy after the hit against
	// energy before. Second-order scheme, C1 potential: < 1e-3 at 0.3 of the stable step, and 4 x less at a quarter (in fact 16 x).
	Real worst[2] = { 0, 0 }, sum[2] = { 0, 0 };
	int  hits = 0;
	for (int pose = 0; pose < 200; ++pose)
		for (int fine : { 0, 1 }) {
			std::mt19937                         random(pose);
			std::uniform_real_distribution<Real> u(-1, 1);
			BlockAssembly                        a      = scene(3e7);
			const Ring                           target = randomPolygon(random, 0.8, 3 + pose % 5),
				   shot                             = shifted(randomPolygon(random, 0.5, 3 + pose % 4), { 1.31, 0.5 * u(random) });
			if (pose % 2)
				addFan(a, target);
			else
				addRigid(a, target);
			addFan(a, shot);
			Simulation run(a, frictional(1e6, 1e6, 0), fine ? 0.075 : 0.3);
			const Vec2 v(-0.4, 0.15 * u(random));
			setVelocity(a, 1, v, u(random));
			Real       start = 0, last = 0, deepest = 0;
			const long steps = long(2 / run.dt);
			run.steps(steps, [&](Real energy) {
				if (run.step == 1) start = energy;
				last    = energy;
				deepest = std::max(deepest, contactForce(a, 1).norm());
			});
			const Real error = std::abs(last - start) / start;
			worst[fine]      = std::max(worst[fine], error);
			sum[fine] += error;
			hits += deepest > 0;
		}
	std::printf("corner hits: %d of 400, worst %.2e, fine %.2e, mean %.2e, fine %.2e\n", hits, worst[0], worst[1], sum[0] / 200, sum[1] / 200);
	EXPECT_GT(hits, 200);
	EXPECT_LT(worst[0], 1e-3);
	EXPECT_LT(worst[1], worst[0] / 4);
	EXPECT_LT(sum[1], sum[0] / 4);
}

TEST(FreeContacts, ABoxThatFallsBouncesBack)
{
	// Free fall from h, then an elastic impact: within 1 % of the energy back (zones keep some of it as vibration, which counts).
	BlockAssembly a = scene(2e8);
	addRigid(a, box(-2, -1, 4, 1));
	addGrid(a, { -0.5, 0.1 }, 1, 0.6, 3, 2);
	const Vec2 g(0, -9.81);
	addGravity(a, g);
	const Vec2 start = a.centroid(1);
	Simulation run(a, frictional(5e7, 5e7, 0));
	Real       first = 0, worst = 0, touched = 0, top = 0;
	long       contact = 0;
	run.steps(long(0.4 / run.dt), [&](Real energy) {
		if (run.step == 1) first = energy;
		worst = std::max(worst, std::abs(energy - first));
		if (!contact && contactForce(a, 1).y() > 0) contact = run.step, touched = run.step * run.dt;
		if (contact) top = std::max(top, a.centroid(1).y() + (energy - energy));
	});
	const Real fallen = 2000 * 0.6 * 9.81 * 0.1; // N x m: the energy of the fall
	EXPECT_NEAR(touched, std::sqrt(2 * 0.1 / 9.81), 2 * run.dt + 1e-4);
	EXPECT_LT(worst, 0.01 * fallen);
	std::printf("bounce: energy error %.1e of the fall, height regained %.3f\n", worst / fallen, 1 - (start.y() - top) / 0.1);
}

TEST(FreeContacts, MomentaAreKept)
{
	// Three blocks without loads, spinning and rubbing: momentum and angular momentum to 1e-10 of their turnover.
	std::mt19937  random(3);
	BlockAssembly a = scene(5e7);
	addFan(a, randomPolygon(random, 0.6, 5)), addFan(a, shifted(randomPolygon(random, 0.6, 6), { 1.15, 0.2 })),
		addFan(a, shifted(randomPolygon(random, 0.6, 4), { 0.5, 1.1 }));
	Simulation run(a, frictional(1e6, 5e5, 30 * degree));
	setVelocity(a, 0, { 0.4, 0.3 }, 1), setVelocity(a, 1, { -0.6, 0.1 }, 2), setVelocity(a, 2, { 0, -0.7 }, -1);
	auto momenta = [&](Vec2& p, Real& L, Real& scale) { // positions half a step back, at the time of the velocities; x cross v is the same
		p.setZero(), L = scale = 0;
		for (int n = 0; n < a.nodeCount(); ++n) {
			p += a.mesh.mass[n] * a.state.velocity[n];
			L += a.mesh.mass[n] * cross(a.position(n), a.state.velocity[n]);
			scale += a.mesh.mass[n] * a.state.velocity[n].norm();
		}
	};
	Vec2 p0, p1;
	Real L0, L1, scale, least = 0;
	momenta(p0, L0, scale);
	run.steps(4000, [&](Real) { least = std::max(least, contactForce(a, 0).norm()); });
	momenta(p1, L1, scale);
	EXPECT_GT(least, 100);
	EXPECT_GT(contactFriction(a), 1);
	EXPECT_LT((p1 - p0).norm(), 1e-10 * scale);
	EXPECT_LT(std::abs(L1 - L0), 1e-10 * scale);
}

// ---- sliding

namespace {

/// Largest change of the force on block 1 from step to step when it is moved along `path` in `count` steps, frictionless; by the largest force.
Real roughness(const BlockAssembly& start, const std::function<Vec2(Real)>& path, int count, Real turn = 0)
{
	BlockAssembly a = start;
	Vec2          before;
	Real          jump = 0, largest = 0;
	for (int i = 0; i <= count; ++i) {
		const Real s = Real(i) / count;
		for (int n = a.mesh.firstNode[1]; n < a.mesh.firstNode[2]; ++n)
			a.state.displacement[n] = start.state.displacement[n];
		moveBlock(a, 1, path(s), turn * s);
		computeAllForces(a, frictional(1e6, 1e6, 0), 0);
		const Vec2 f = contactForce(a, 1);
		if (i) jump = std::max(jump, (f - before).norm());
		largest = std::max(largest, f.norm());
		before  = f;
	}
	return jump / largest;
}

} // namespace

TEST(FreeContacts, ForcesHaveNoJumps)
{
	// Swept over a corner, an uneven floor of one block, and a floor of several blocks with steps: the largest change of force from
	// one step to the next halves with the step. A jump would stay.
	struct Sweep {
		const char*               what;
		Ring                      floor;
		std::function<Vec2(Real)> path;
		Real                      turn;
	};
	const Ring               uneven { { -3, -1 },     { 3, -1 },      { 3, 0 },        { 2.1, 0.03 },  { 1.4, -0.02 },
                            { 0.6, 0.015 }, { 0.55, 0.01 }, { -0.3, -0.01 }, { -1.2, 0.02 }, { -3, 0 } };
	const Ring               notch { { -3, -1 }, { 3, -1 }, { 3, 0 }, { 0.8, 0 }, { 0.4, -0.4 }, { 0, 0 }, { -3, 0 } };
	const std::vector<Sweep> sweeps {
		{ "off the corner", box(-3, -1, 3, 1), [](Real s) { return Vec2(-0.3 + 1.5 * s, -0.01); }, 0 },
		{ "off the corner, turning", box(-3, -1, 3, 1), [](Real s) { return Vec2(-0.3 + 1.2 * s, 0.05 - 0.04 * s); }, 0.3 },
		{ "uneven", uneven, [](Real s) { return Vec2(-1.5 + 3 * s, -0.01); }, 0 },
		{ "uneven, tilted", uneven, [](Real s) { return Vec2(-1.5 + 3 * s, 0.045 + 0.03 * s); }, 0.35 },
		{ "over a notch", notch, [](Real s) { return Vec2(-1 + 2 * s, -0.008); }, 0 },
		{ "corner down, over a notch", notch, [](Real s) { return Vec2(-1 + 2 * s, 0.088); }, 0.01 },
		{ "onto the corner from above", box(-3, -1, 3, 1), [](Real s) { return Vec2(0.28, 0.02 - 0.05 * s); }, 0.2 },
	};
	for (const Sweep& sweep : sweeps) {
		SCOPED_TRACE(sweep.what);
		BlockAssembly a = scene();
		addRigid(a, sweep.floor);
		addRigid(a, box(-0.3, 0, 0.6, 0.8));
		if (std::string(sweep.what).find("corner down") == 0) moveBlock(a, 1, { 0, 0 }, 45 * degree);
		Real rough[4];
		for (int i = 0; i < 4; ++i)
			rough[i] = roughness(a, sweep.path, 4000 << i, sweep.turn);
		std::printf("%-28s %.4f %.4f %.4f %.4f\n", sweep.what, rough[0], rough[1], rough[2], rough[3]);
		EXPECT_LT(rough[2], 0.6 * rough[1]);
		EXPECT_LT(rough[3], 0.6 * rough[2]);
	}
}

TEST(FreeContacts, FlatFloorFriction)
{
	// A box pulled over a floor at constant velocity and depth d: T = mu N, on its side or on one corner. Where one floor block
	// ends and the next begins, a stretch of order d has other forces: at most 2 d / L of the side's, and those of a corner, which
	// leaves one block's edge and must first get hold of the next one's, only in the mean.
	struct Case {
		Real tilt;
		bool joints;
		Real worst, mean;
	};
	for (const Case& c : { Case { 0, true, 1e-3, 1e-3 }, Case { 20 * degree, false, 1e-3, 1e-3 }, Case { 20 * degree, true, 10, 1e-3 } }) {
		BlockAssembly a = scene();
		if (c.joints)
			addRigid(a, box(-3, -1, 2.5, 1)), addRigid(a, box(-0.5, -1, 1.2, 1)), addRigid(a, box(0.7, -1, 3, 1));
		else
			addRigid(a, box(-3, -1, 6.7, 1));
		const int mover = addRigid(a, box(-2, 0, 0.6, 0.8));
		moveBlock(a, mover, { 0, 0 }, c.tilt);
		Real low = 1;
		for (int n = a.mesh.firstNode[mover]; n < a.mesh.firstNode[mover + 1]; ++n)
			low = std::min(low, a.position(n).y());
		const Real d = 5e-5, dt = 1e-3;
		moveBlock(a, mover, { 0, -low - d });
		const JointParams joint = frictional(1e6, 5e5, 35 * degree);
		Real              worst = 0;
		Vec2              sum   = Vec2::Zero();
		for (int n = a.mesh.firstNode[mover]; n < a.mesh.firstNode[mover + 1]; ++n)
			a.state.velocity[n] = { 0.02, 0 };
		for (int i = 0; i < 175000; ++i) {
			computeAllForces(a, joint, dt);
			for (int n = a.mesh.firstNode[mover]; n < a.mesh.firstNode[mover + 1]; ++n)
				a.state.displacement[n] += dt * a.state.velocity[n];
			if (i < 50) continue; // until friction is built up: mu kn d/ks = 7e-5 m
			const Vec2 f = contactForce(a, mover);
			worst        = std::max(worst, std::abs(-f.x() / (joint.tanPhi * f.y()) - 1));
			sum += f;
		}
		const Real mean = std::abs(-sum.x() / (joint.tanPhi * sum.y()) - 1);
		std::printf(
			"friction on a flat floor, tilt %.2f, %s: T/(mu N) off by %.1e at most, %.1e in the mean\n",
			c.tilt,
			c.joints ? "three blocks" : "one block",
			worst,
			mean);
		EXPECT_LT(worst, c.worst);
		EXPECT_LT(mean, c.mean);
	}
}

TEST(FreeContacts, InclineHoldsAndLetsGo)
{
	// A box on a slope one degree below its friction angle stays; one degree above it slides with g (sin - mu cos). Both start from
	// rest on the lower slope. Staying: nothing but rounding and the last of the damped motion, < 1e-4 of what friction's springs
	// give (4e-5 m). Sliding: the mean acceleration between two times; the box's bouncing on kn, which the sudden turn of gravity
	// starts, adds a fraction of (period/duration) x (relative change of the normal force), 1e-3.
	const Real g = 9.81, phi = 30 * degree;
	for (bool many : { false, true }) {
		BlockAssembly a = scene(2e8);
		if (many)
			for (Real x = -4; x < 3; x += 0.9)
				addRigid(a, box(x, -1, 0.9, 1));
		else
			addRigid(a, box(-4, -1, 8, 1));
		const int  mover = addGrid(a, { 0.05, 0 }, 1, 0.4, 3, 1);
		Simulation run(a, frictional(1e8, 1e8, phi), 0.4, 0.3);
		auto       tilt = [&](Real slope) {
                        std::fill(a.supports.load.begin(), a.supports.load.end(), Vec2::Zero());
                        addGravity(a, { -g * std::sin(slope), -g * std::cos(slope) });
		};
		tilt(0);
		run.steps(10000);
		tilt(phi - degree);
		run.steps(20000);
		const Vec2 start = a.centroid(mover);
		run.damping.kind = Damping::Kind::none;
		run.steps(10000);
		const Real crept = (a.centroid(mover) - start).norm();
		tilt(phi + degree);
		run.steps(long(0.1 / run.dt));
		const Real v = meanVelocity(a, mover).x();
		const long n = long(0.8 / run.dt);
		run.steps(n);
		const Real acceleration = (v - meanVelocity(a, mover).x()) / (n * run.dt);
		const Real expected     = g * (std::sin(phi + degree) - std::tan(phi) * std::cos(phi + degree));
		std::printf("incline, %s: crept %.1e m; acceleration %.5f, expected %.5f\n", many ? "many blocks" : "one block", crept, acceleration, expected);
		EXPECT_LT(crept, 4e-9);
		EXPECT_NEAR(acceleration, expected, 0.01 * expected);
	}
}

TEST(FreeContacts, BoxTopplesOverItsCorner)
{
	// A tall box (1 : 3), rough, on a floor that is tilted (gravity is): below atan(1/3) = 18.43 degrees it stands, above it topples.
	for (Real above : { -1.0, 1.0 }) {
		BlockAssembly a = scene(2e8);
		addRigid(a, box(-3, -1, 6, 1));
		addGrid(a, { 0, 0 }, 0.4, 1.2, 2, 4);
		const Real slope = std::atan(1. / 3) + above * degree, g = 9.81;
		Simulation run(a, frictional(2e8, 2e8, 60 * degree), 0.4, 0.5);
		addGravity(a, { 0, -g });
		run.steps(4000);
		std::fill(a.supports.load.begin(), a.supports.load.end(), Vec2::Zero());
		for (int i = 1; i <= 20; ++i) { // tilt it gradually
			std::fill(a.supports.load.begin(), a.supports.load.end(), Vec2::Zero());
			addGravity(a, { -g * std::sin(slope * i / 20), -g * std::cos(slope * i / 20) });
			run.steps(500);
		}
		run.damping.kind = Damping::Kind::none;
		const Vec2 start = a.centroid(1);
		run.steps(long(1.2 / run.dt));
		const Real moved = (a.centroid(1) - start).norm();
		std::printf("toppling %+.0f degree: centre moved by %.2e\n", above, moved);
		if (above < 0)
			EXPECT_LT(moved, 0.005);
		else
			EXPECT_GT(moved, 0.05);
	}
}

TEST(FreeContacts, SlidesAcrossUnevenBlocksAtConstantForce)
{
	// A plate is pulled over many blocks whose tops rise and fall by 2 mm in 0.3 m, with mu = 0.4. In the mean T = mu N up to the
	// slopes' squares; and no step changes the force by more than what the motion of one step can.
	std::mt19937                         random(5);
	std::uniform_real_distribution<Real> u(-0.002, 0.002);
	BlockAssembly                        a      = scene(5e8);
	Real                                 y      = 0;
	int                                  floors = 0;
	for (Real x = 0; x < 4; x += 0.3, ++floors) {
		const Real next = u(random);
		addRigid(a, { { x, -0.5 }, { x + 0.3, -0.5 }, { x + 0.3, next }, { x, y } });
		y = next;
	}
	addGrid(a, { 0.3, 0.003 }, 1, 0.3, 6, 2);
	addGravity(a, { 0, -9.81 });
	Simulation run(a, frictional(2e7, 1e7, std::atan(0.4)), 0.4, 0.2);
	run.steps(4000);
	std::vector<int> right;
	for (int n = a.mesh.firstNode[floors]; n < a.mesh.firstNode[floors + 1]; ++n)
		if (a.mesh.reference[n].x() > 1.29 && a.mesh.reference[n].y() < 0.2) right.push_back(2 * n);
	a.addGroup(driven("pull", right, 0.3, 0.2));
	Vec2 sum  = Vec2::Zero();
	long from = run.step + long(0.5 / run.dt), count = 0;
	run.steps(long(6.5 / run.dt), [&](Real) {
		if (run.step < from) return;
		sum += contactForce(a, floors);
		++count;
	});
	const Real weight = 2000 * 0.3 * 9.81;
	sum /= Real(count);
	std::printf("uneven floor: N/W = %.4f, T/N = %.4f\n", sum.y() / weight, -sum.x() / sum.y());
	EXPECT_NEAR(sum.y() / weight, 1, 0.02);
	EXPECT_NEAR(-sum.x() / sum.y(), 0.4, 0.02);
}

TEST(FreeContacts, TornApartAndPushedTogetherAgain)
{
	// Two blocks with a strong joint between them are pulled apart and, with a shift, pushed together again: they meet with
	// what is left, kn and the residual friction, on the area that is left.
	JointParams joint = elasticJoint(1e9, 5e8);
	joint.tension = 1e5, joint.cohesion = 2e5, joint.tanPhi = 0.8, joint.tanPhiResidual = 0.3;
	BlockAssembly a = scene(2e9);
	addGrid(a, { 0, 0 }, 1, 0.5, 2, 1), addGrid(a, { 0, 0.5 }, 1, 0.5, 3, 1);
	bondAll(a, joint);
	auto all = [&](int block, bool y) { return dofs(a, y, [&, block](const Vec2& p) { return block == 0 ? p.y() < 1e-9 : p.y() > 1 - 1e-9; }); };
	a.addGroup(driven("bottom", all(0, true), 0)), a.addGroup(driven("bottom x", all(0, false), 0));
	const int  vertical = a.addGroup(driven("top", all(1, true), 0.05)), sideways = a.addGroup(driven("top x", all(1, false), 0));
	Simulation run(a, joint, 0.4, 0.5);
	run.steps(long(0.2 / run.dt)); // 10 mm open
	for (Joint status : a.state.status)
		EXPECT_EQ(status, Joint::brokenInTension);
	EXPECT_EQ(contactForce(a, 1).norm(), 0);
	a.state.groups[vertical].target = 0, a.state.groups[sideways].target = 1;
	run.steps(long(0.3 / run.dt)); // 0.3 m to the right
	a.state.groups[sideways].target = 0, a.state.groups[vertical].target = -0.05;
	Real touched = 0;
	while (contactForce(a, 1).y() < 5e4 && run.step * run.dt < 1) {
		run.steps(10);
		if (touched == 0 && contactForce(a, 1).y() > 0) touched = a.state.groups[vertical].travelled;
	}
	EXPECT_NEAR(touched, 0, 20 * run.dt * 0.05 + 2e-4); // the plates' own strain
	Real area = 0;
	for (int i : a.contacts.order)
		for (const EdgePair& e : a.state.contacts[i].edges)
			area += e.touching ? 2 * e.area : 0;
	EXPECT_NEAR(area, 0.7, 0.002);
	a.state.groups[vertical].target = 0, a.state.groups[sideways].target = 0.02;
	run.steps(long(0.1 / run.dt));
	const Vec2 f = contactForce(a, 1);
	EXPECT_NEAR(-f.x() / f.y(), 0.3, 0.003);
}

TEST(FreeContacts, ReleasedAndIntactSegmentsShareAnInterface)
{
	// A joint of three segments, the middle one broken: it alone becomes a free pair, neither forces nor areas change.
	JointParams joint    = elasticJoint(1e9, 5e8);
	joint.tanPhiResidual = 0.5;
	BlockAssembly a      = scene(1e9);
	addGrid(a, { 0, 0 }, 1.2, 0.5, 3, 1), addGrid(a, { 0, 0.5 }, 1.2, 0.5, 3, 1);
	bondAll(a, joint);
	ASSERT_EQ(a.joints.segments.size(), 3u);
	for (int n = a.mesh.firstNode[1]; n < a.nodeCount(); ++n)
		a.state.displacement[n].y() -= 1e-7;
	computeAllForces(a, joint, 0);
	EXPECT_TRUE(a.contacts.order.empty());
	const auto before = a.forces.nodal;
	for (int i : { 2, 3 })
		a.state.status[i] = Joint::brokenInShear;
	a.forces.broke[0] = true;
	computeAllForces(a, joint, 0);
	ASSERT_EQ(a.contacts.order.size(), 1u);
	for (int s : { 0, 1, 2 })
		EXPECT_EQ(bool(a.state.released[s]), s == 1);
	int active = 0;
	for (const EdgePair& e : a.state.contacts[0].edges)
		active += e.touching;
	EXPECT_GE(active, 1);
	const Real scale = largestForce(a);
	for (int n = 0; n < a.nodeCount(); ++n)
		EXPECT_LT((a.forces.nodal[n] - before[n]).norm(), 1e-5 * scale);
}

TEST(FreeContacts, DryStackRests)
{
	// Five blocks on a floor under their weight, damped to rest, then 1e6 steps without damping: nothing creeps.
	BlockAssembly a = scene(1e9);
	addRigid(a, box(-1, -0.5, 3, 0.5));
	for (int i = 0; i < 5; ++i)
		addGrid(a, { 0.03 * (i % 2), 0.2 * i }, 0.5, 0.2, 1, 1);
	addGravity(a, { 0, -9.81 });
	Simulation run(a, frictional(1e9, 5e8, 30 * degree), 0.4, 0.7);
	run.steps(30000);
	const auto start = a.state.displacement;
	run.damping.kind = Damping::Kind::none;
	run.steps(1000000);
	Real moved = 0;
	for (int n = 0; n < a.nodeCount(); ++n)
		moved = std::max(moved, (a.state.displacement[n] - start[n]).norm());
	const Real settled = 2000 * 9.81 / 1e9; // weight of the stack / kn: 2e-5 m
	std::printf("stack: moved %.1e m in 1e6 steps, contacts are compressed by %.1e m\n", moved, settled);
	EXPECT_LT(moved, 1e-3 * settled);
}

// ---- bookkeeping

namespace {

/// Blocks that fall into a trough.
BlockAssembly heap(int count)
{
	std::mt19937  random(9);
	BlockAssembly a = scene(1e8, 1);
	addRigid(a, { { -2, -0.5 }, { 2, -0.5 }, { 2, 0.4 }, { 1, 0 }, { -1, 0 }, { -2, 0.4 } });
	for (int i = 0; i < count; ++i)
		addFan(a, shifted(randomPolygon(random, 0.2, 3 + i % 5), { -0.8 + 0.41 * (i % 5), 0.35 + 0.42 * (i / 5) }));
	addGravity(a, { 0, -9.81 });
	for (int i = 1; i <= count; ++i)
		setVelocity(a, i, { 0.3 * (i % 3 - 1), -0.5 }, i % 4 - 1.5);
	return a;
}

void expectSameBits(const BlockAssembly& a, const BlockAssembly& b)
{
	for (int n = 0; n < a.nodeCount(); ++n) {
		ASSERT_EQ(a.state.displacement[n], b.state.displacement[n]) << n;
		ASSERT_EQ(a.forces.nodal[n], b.forces.nodal[n]) << n;
	}
}

} // namespace

TEST(FreeContacts, SameBitsWhateverThreadsAndOrder)
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

TEST(FreeContacts, RestingChangesNothing)
{
	// Looking at every pair and every vertex in every step gives the same bits, and is far more work.
	BlockAssembly     resting = heap(12), restless = resting;
	const JointParams joint = frictional(2e6, 1e6, 25 * degree);
	Simulation        s(resting, joint, 0.4), t(restless, joint, 0.4);
	long              pairs = 0, asleep = 0;
	for (int i = 0; i < 3000; ++i) {
		s.steps(1, [&](Real) {
			for (int c : resting.contacts.order)
				for (const Rest& rest : std::as_const(resting.state.contacts)[c].rests)
					++pairs,
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
}

TEST(FreeContacts, ColumnsHoldWhatTheStateSays)
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
			integrate(kept, s.damping, s.dt, 0, true);
		} else
			s.steps(1);
		copied.state.contacts.all(); // as if somebody had written there
		t.steps(1);
	}
	expectSameBits(kept, copied);
	EXPECT_GT(contactFriction(kept), 0);
	EXPECT_EQ(contactFriction(kept), contactFriction(copied));
}

TEST(FreeContacts, ColumnsFollowWhatHappensToPairs)
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

TEST(FreeContacts, ColumnsDoNotOutliveAStateThatIsPutBack)
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

TEST(FreeContacts, NobodyChangesAContactUnseen)
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

TEST(FreeContacts, ColumnsHaveRoomForAllPairs)
{
	// Pairs begin and end their rest all the time, and as long as nobody changes contacts nothing is allocated for them: columns stay where they are.
	BlockAssembly                   a = heap(12);
	Simulation                      s(a, frictional(2e6, 1e6, 25 * degree), 0.4);
	std::vector<const EdgeColumns*> at;
	std::vector<size_t>             used;
	long                            edition = 0;
	int                             grown   = 0;
	for (int i = 0; i < 3000; ++i) {
		s.steps(1);
		const bool same = std::exchange(edition, a.contacts.columnsOf) == a.contacts.columnsOf;
		for (size_t run = 0; same && run < at.size(); ++run) {
			ASSERT_EQ(a.contacts.inWork[run].batches.data(), at[run]) << i;
			grown += a.contacts.inWork[run].batches.size() > used[run];
		}
		at.clear(), used.clear();
		for (const EdgesInWork& work : a.contacts.inWork)
			at.push_back(work.batches.data()), used.push_back(work.batches.size());
	}
	EXPECT_GT(grown, 0);
}

TEST(FreeContacts, VelocitiesTellHowFarThingsHaveGone)
{
	// Where nobody else moves grid points, their velocities bound how far they have gone, and positions are compared only now and then. The
	// same contacts are found in the same steps.
	BlockAssembly watched = heap(12), trusted = watched;
	trusted.contacts.strangers = false;
	const JointParams joint    = frictional(2e6, 1e6, 25 * degree);
	Simulation        s(watched, joint, 0.4), t(trusted, joint, 0.4);
	for (int i = 0; i < 3000; ++i) {
		s.steps(1), t.steps(1);
		ASSERT_EQ(watched.contacts.looks, trusted.contacts.looks) << i;
		Real farthest = 0, fastest = 0; // along an axis
		for (int n = 0; n < trusted.nodeCount(); ++n)
			fastest = std::max(fastest, trusted.state.velocity[n].lpNorm<Eigen::Infinity>());
		for (int b : trusted.contacts.blocksInContact)
			for (int n = trusted.mesh.firstNode[b]; n < trusted.mesh.firstNode[b + 1]; ++n)
				farthest = std::max(farthest, (trusted.state.displacement[n] - trusted.contacts.odometer.seenAt[n]).lpNorm<Eigen::Infinity>());
		ASSERT_EQ(trusted.contacts.odometer.fastest, fastest) << i;
		ASSERT_GE(trusted.contacts.odometer.unseen, farthest * (1 - 1e-9)) << i;
	}
	EXPECT_GT(watched.contacts.looks, 10);
	expectSameBits(watched, trusted);
	EXPECT_EQ(contactFriction(watched), contactFriction(trusted));
}

TEST(FreeContacts, ContinuesFromWhatIsSaved)
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

// ---- whatever may come

namespace {

struct Stress {
	int  poses = 0, touched = 0;
	Real gain      = 0; ///< worst, of what there was
	Real lost      = 0; ///< worst imbalance of energy and friction, of what there was
	long edgePairs = 0, active = 0;
};

/// Two random polygons each time: slivers, tiny edges, reentrant corners, shared vertices and edges, started in touch or overlapping.
Stress stress(int count, int steps, unsigned seed)
{
	Stress                               result;
	std::mt19937                         random(seed);
	std::uniform_real_distribution<Real> u(-1, 1);
	for (int pose = 0; pose < count; ++pose) {
		auto polygon = [&] {
			const int kind = int(random() % 5);
			Ring      ring = randomPolygon(random, 0.5, 3 + int(random() % 6), kind == 0 ? 0.04 : 1);
			if (kind == 1) { // a corner cut by a tiny edge
				const size_t i = random() % ring.size(), n = ring.size();
				const Vec2   p = ring[i], next = ring[(i + 1) % n], last = ring[(i + n - 1) % n];
				ring[i] = p + 1e-3 * (next - p);
				ring.insert(ring.begin() + long(i), p + 1e-3 * (last - p));
			}
			if (kind == 2) { // a grid point in the middle of an edge
				const size_t i = random() % ring.size();
				ring.insert(ring.begin() + long(i) + 1, Vec2((ring[i] + ring[(i + 1) % ring.size()]) / 2));
			}
			if (kind == 3) { // a corner that bends inward a little
				const size_t i = random() % ring.size();
				const Vec2   p = ring[i], q = ring[(i + 1) % ring.size()], e = q - p;
				ring.insert(ring.begin() + long(i) + 1, Vec2((p + q) / 2 + 0.05 * Vec2(-e.y(), e.x())));
			}
			return ring;
		};
		auto usable = [](const Ring& ring) { // addFan's zones must not overlap
			const Vec2 inner = 0.9 * mean(ring) + 0.1 * ring[0];
			for (size_t i = 0; i < ring.size(); ++i)
				if (cross(ring[i] - inner, ring[(i + 1) % ring.size()] - inner) <= 0) return false;
			return true;
		};
		Ring first = polygon(), second = polygon();
		while (!usable(first))
			first = polygon();
		while (!usable(second))
			second = polygon();
		const Vec2 apart(std::cos(6 * u(random)), std::sin(6 * u(random)));
		switch (random() % 4) {
		case 0:
			second = shifted(second, 0.9 * apart);
			break;
		case 1:
			second = shifted(second, first[0] * 1.0 - second[second.size() / 2]);
			break; // vertex upon vertex
		case 2: {      // its mirror image across an edge
			const Vec2 p = first[0], e = (first[1] - first[0]).normalized();
			second.clear();
			for (auto it = first.rbegin(); it != first.rend(); ++it) {
				const Vec2 d = *it - p;
				second.push_back(p + 2 * d.dot(e) * e - d);
			}
			if (!usable(second)) second = shifted(box(0, 0, 0.3, 0.4), first[0]); // another inner point
			break;
		}
		default:
			second = shifted(second, 1.05 * apart);
		}
		BlockAssembly a = scene(5e7);
		if (random() % 3)
			addFan(a, first);
		else
			addRigid(a, first);
		addFan(a, second);
		Simulation run(a, frictional(1e6, 5e5, (pose % 3) * 15 * degree), 0.5);
		for (int b : { 0, 1 })
			if (a.mesh.firstZone[b] < a.mesh.firstZone[b + 1])
				setVelocity(a, b, 0.5 * Vec2(u(random), u(random)) + (b ? -0.3 : 0.3) * apart, u(random));
		Real start = 0, most = 0, imbalance = 0;
		bool touched = false;
		run.steps(steps, [&](Real energy) {
			if (run.step == 0) start = energy;
			most      = std::max(most, energy);
			imbalance = std::max(imbalance, std::abs(energy + contactFriction(a) - start));
			for (int c : a.contacts.order)
				for (const EdgePair& e : a.state.contacts[c].edges)
					touched |= e.touching, ++result.edgePairs, result.active += e.touching;
		});
		EXPECT_EQ(a.firstBadNode(), -1) << "pose " << pose;
		const Real gain = most / start - 1;
		if (gain > 0.01) std::printf("pose %d gains %.3f\n", pose, gain);
		result.gain = std::max(result.gain, gain);
		result.lost = std::max(result.lost, imbalance / start);
		result.touched += touched;
		++result.poses;
	}
	return result;
}

} // namespace

TEST(FreeContacts, RandomPolygonsGainNoEnergy)
{
	const int    count = std::getenv("BLOCKS_STRESS") ? std::atoi(std::getenv("BLOCKS_STRESS")) : 2100; // half of them touch
	const Stress s     = stress(count, 1000, 21);
	std::printf(
		"stress: %d poses, %d touched, worst gain of energy %.1e, worst imbalance %.1e; %.1f edge pairs, %.1f active\n",
		s.poses,
		s.touched,
		s.gain,
		s.lost,
		Real(s.edgePairs) / s.poses / 1000,
		Real(s.active) / s.poses / 1000);
	EXPECT_GT(s.touched, count / 3);
	EXPECT_LT(s.gain, 0.01);
	EXPECT_LT(s.lost, 0.01);
}

TEST(FreeContacts, SpinningTogetherMakesNoSlip)
{
	// Two rigid blocks, 1e-3 into each other, turn by ten turns as one, in coarse steps: slip of 1e4 steps' rounding only. Without
	// the frame's own turning it would reach the friction limit, 5.8e-4, after a tenth of a turn.
	BlockAssembly a = scene();
	addRigid(a, box(0, -1, 2, 1)), addRigid(a, box(0.4, -1e-3, 1, 1));
	const JointParams joint = frictional(1e9, 1e9, 30 * degree);
	Real              most  = 0;
	for (int i = 0; i < 10000; ++i) {
		const auto before = a.state.displacement;
		rotateAbout(a, { 0.7, 0.3 }, 2 * M_PI / 1000, { 0, 0 });
		for (int n = 0; n < a.nodeCount(); ++n)
			a.state.velocity[n] = a.state.displacement[n] - before[n];
		computeAllForces(a, joint, 1);
		for (const EdgePair& e : a.state.contacts[0].edges)
			if (e.area > 1e-9) // edges at right angles face each other by rounding, with an area of rounding squared
				most = std::max({ most, std::abs(e.slip[0]), std::abs(e.slip[1]) });
	}
	EXPECT_EQ(a.contacts.order.size(), 1u);
	EXPECT_LT(most, 1e4 * 10 * eps);
}

TEST(FreeContacts, StiffnessIsBounded)
{
	// Heaps in any state: the largest eigenvalue of M^-1 K, from finite differences of the forces with friction sticking, must not exceed
	// what nodalStiffness promises: omega dt <= 2 at the stable step. Rigid floor, soft zones so that contacts dominate. Depths stay
	// below a tenth of a block: deeper contacts, which fade out, are up to twice as stiff as promised.
	// In closed form first: two edges of each corner, k T (La + Lb), k the larger of kn and ks.
	BlockAssembly two = scene(1e8, 0.7);
	addRigid(two, box(0, 0, 1, 0.5)), addRigid(two, box(0.2, 0.5, 2, 0.3));
	two.contacts.wanted = true;
	prepareContacts(two);
	setContactJoint(two, 0, frictional(2e6, 3e6, 0.1));
	const auto share = contactStiffness(two);
	for (int n = 0; n < 8; ++n)
		EXPECT_NEAR(share[n], 3e6 * 0.7 * (n < 4 ? 1.5 : 2.3), 1e-3);

	Real worst = 0;
	for (unsigned seed = 0; seed < 20; ++seed) {
		std::mt19937  random(seed);
		BlockAssembly a = scene(3e5);
		addRigid(a, { { -2, -0.5 }, { 2, -0.5 }, { 2, 0.4 }, { 1, 0 }, { -1, 0 }, { -2, 0.4 } });
		for (int i = 0; i < 5; ++i)
			addFan(a, shifted(randomPolygon(random, 0.22, 3 + int(seed + i) % 4), { -0.8 + 0.45 * (i % 4), 0.25 + 0.45 * (i / 4) }));
		addGravity(a, { 0, -9.81 });
		const JointParams joint = frictional(5e6, 5e6, 40 * degree);
		Simulation        run(a, joint, 0.4, 0.3);
		run.steps(4000);
		const auto       stiffness = nodalStiffness(a);
		const Real       stable = stableTimeStep(a, stiffness, a.mesh.mass), d = 1e-9;
		std::vector<int> free;
		for (int n = 0; n < a.nodeCount(); ++n)
			if (a.mesh.mass[n] > 0) free.push_back(2 * n), free.push_back(2 * n + 1);
		const int       size = int(free.size());
		Eigen::MatrixXd k(size, size);
		auto            column = [&](int dof, Real by) {
                        BlockAssembly b = a; // moved by `by` in one step of length 1, with friction that follows
                        for (Vec2& v : b.state.velocity)
                                v.setZero();
                        b.state.displacement[dof / 2][dof % 2] += by;
                        b.state.velocity[dof / 2][dof % 2] = by;
                        JointParams rough                  = joint;
                        rough.tanPhiResidual               = 1e3;
                        for (int c : b.contacts.order)
                                b.state.contacts[c].joint = rough;
                        advanceContacts(b, 1);
                        sumForces(b);
                        return b.forces.nodal;
		};
		for (int j = 0; j < size; ++j) {
			const auto ahead = column(free[j], d), behind = column(free[j], -d);
			for (int i = 0; i < size; ++i)
				k(i, j) = (behind[free[i] / 2][free[i] % 2] - ahead[free[i] / 2][free[i] % 2]) / (2 * d)
					/ std::sqrt(a.mesh.mass[free[i] / 2] * a.mesh.mass[free[j] / 2]);
		}
		const Real largest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>((k + k.transpose()) / 2, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
		worst              = std::max(worst, std::sqrt(largest) * stable / 2);
	}
	std::printf("omega dt / 2 at the stable step: %.3f at most\n", worst);
	EXPECT_LT(worst, 1);
	EXPECT_GT(worst, 0.3); // a bound that is far too large wastes time
}

TEST(FreeContacts, TriplePointsStayQuiet)
{
	// Bonded cells, squeezed. Cells that share only a corner or have
	// intact joints must not disturb each other: forces as without contacts, to the depth by size.
	JointParams joint    = elasticJoint(1e9, 5e8);
	joint.tanPhiResidual = 0.5;
	BlockAssembly a      = voronoi(1, 1, 4, 4, { 1e9, 0.2, 2000 }, joint, 1);
	for (int n = 0; n < a.nodeCount(); ++n)
		a.state.displacement[n].y() = -1e-5 * a.mesh.reference[n].y();
	BlockAssembly b = a;
	computeForces(a);
	computeAllForces(b, joint, 0);
	EXPECT_FALSE(b.contacts.order.empty());
	const Real scale = largestForce(a);
	for (int n = 0; n < a.nodeCount(); ++n)
		EXPECT_LT((a.forces.nodal[n] - b.forces.nodal[n]).norm(), 1e-4 * scale) << n;
}

TEST(FreeContacts, NonConvexBlocksInterlock)
{
	// A block in the notch of another one: pushed to either side it is stopped by the notch's walls, with the area of the wall.
	BlockAssembly a = scene();
	addRigid(a, { { 0, 0 }, { 3, 0 }, { 3, 1 }, { 2, 1 }, { 2, 0.4 }, { 1.5, 0.4 }, { 1, 0.4 }, { 1, 1 }, { 0, 1 } });
	addRigid(a, box(1, 0.4, 1, 1));
	wantContacts(a, frictional(1e6, 1e6, 0));
	prepareContacts(a);
	const Real sharp[] = { 1, 1, 1, 1, 0, 0, 0, 1, 1 }; // right angles are, inward corners and points of straight edges are not
	for (int n = 0; n < 9; ++n)
		EXPECT_NEAR(a.contacts.sharpness[n], sharp[n], 10 * eps) << n;
	const Real d = 1e-4;
	for (const Vec2& push : { Vec2(d, 0), Vec2(-d, 0), Vec2(0, -d) }) {
		BlockAssembly b = a;
		moveBlock(b, 1, push);
		computeAllForces(b, frictional(1e6, 1e6, 0), 0);
		const Vec2 expected = -push * 1e6 * (push.x() != 0 ? 0.6 : 1); // kn d x the wall's height, or the notch's floor
		// the other wall is parted by d; corners share within a few d; 100 d/L
		EXPECT_LT((contactForce(b, 1) - expected).norm(), 0.01 * expected.norm()) << push.transpose();
	}
}

TEST(FreeContacts, PartingSetsFreeWhatTheSpringsHeld)
{
	// Two rigid boxes, sheared by s at depth d with residual cohesion, in which nothing slides: 2 x A ks s^2/2 with 2 A = 0.8 x 0.5. Then
	// they are parted in one step: all that the shear springs held counts as friction, and nothing is held any more.
	BlockAssembly a = scene(1e8, 0.5);
	addRigid(a, box(-1, -1, 3, 1)), addRigid(a, box(0, -1e-4, 0.8, 1));
	JointParams joint      = frictional(1e8, 4e7, 0);
	joint.cohesionResidual = joint.cohesion = 1e6;
	computeAllForces(a, joint, 1);
	const Real s = 1e-5;
	for (int n = a.mesh.firstNode[1]; n < a.mesh.firstNode[2]; ++n)
		a.state.displacement[n].x() += s, a.state.velocity[n].x() = s;
	computeAllForces(a, joint, 1);
	const Real shear = 0.8 * 0.5 * 4e7 * s * s / 2, normal = 0.8 * 0.5 * 1e8 * 1e-8 / 2;
	EXPECT_NEAR(contactEnergy(a), shear + normal, 1e-9 * (shear + normal));
	EXPECT_NEAR(contactForce(a, 1).x(), -0.8 * 0.5 * 4e7 * s, 1e-6);
	EXPECT_NEAR(contactFriction(a), 0, 1e-9 * shear);
	moveBlock(a, 1, { 0, 1e-3 });
	computeAllForces(a, joint, 1);
	EXPECT_EQ(contactEnergy(a), 0);
	EXPECT_EQ(contactForce(a, 1).norm(), 0);
	EXPECT_NEAR(contactFriction(a), shear, 1e-9 * shear);
}
