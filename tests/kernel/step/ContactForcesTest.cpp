// yade-blocks, GPL-2.0-or-later
#include <ContactScenes.hpp>

using namespace contacts;

namespace {

/// Largest change of the force on block 1 from step to step when it is moved along `path` in `count` steps, frictionless; by the largest force.
Real roughness(const BlockAssembly& start, const std::function<Vec2(Real)>& path, int count, Real turn = 0)
{
	BlockAssembly a      = start;
	Vec2          before = Vec2::Zero();
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

TEST(ContactForces, AreasAddUp)
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

TEST(ContactForces, ConformingJointGivesThePointLaw)
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

TEST(ContactForces, RaisedEdgesHaveThePotentialsForces)
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

TEST(ContactForces, MomentaAreKept)
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

TEST(ContactForces, ForcesHaveNoJumps)
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

TEST(ContactForces, SpinningTogetherMakesNoSlip)
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

TEST(ContactForces, StiffnessIsBounded)
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
