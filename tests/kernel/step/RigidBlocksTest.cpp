// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/analysis/StabilityWatch.hpp>
#include <blocks/kernel/step/RigidBlocks.hpp>

using namespace specimens;

namespace {

int addRigid(BlockAssembly& a, const Ring& ring, int material = 0)
{
	std::vector<int> outline(ring.size());
	for (size_t i = 0; i < ring.size(); ++i)
		outline[i] = int(i);
	return a.addBlock(ring, { outline }, {}, material);
}

/// A lopsided rigid block bonded to deformable ones on two of its sides, whose meshes do not fit its edges, and to a rigid one.
BlockAssembly mixed(const JointParams& joint, Real thickness = 0.3)
{
	BlockAssembly a;
	a.thickness = thickness;
	a.addMaterial(stone());
	addGrid(a, { 0, 0 }, 1, 0.4, 3, 1);
	addRigid(a, { { 0.2, 0.4 }, { 1.2, 0.4 }, { 1.2, 0.7 }, { 0.5, 0.9 } });
	addGrid(a, { 1.2, 0.3 }, 0.5, 0.3, 1, 2);
	addRigid(a, { { 1.2, 0.6 }, { 1.6, 0.6 }, { 1.5, 1.1 }, { 1.2, 0.8 } });
	bondAll(a, joint);
	return a;
}

/// What somebody outside does in a step: leapfrog of every rigid block under its forces and `extra`; blocked motions keep their velocity.
StepWork moveRigid(BlockAssembly& a, Real dt, const Vec3& extra = Vec3::Zero(), Real damping = 0)
{
	gatherRigidForces(a);
	StepWork work;
	for (RigidBlock& r : a.state.rigid) {
		RigidMotion now { r.centre, r.halfTurn, r.velocity, r.force + extra };
		for (int i = 0; i < 3; ++i)
			if (r.free[i]) { // local damping
				const Real dv = dt * now.force[i] / (i < 2 ? r.inertia : r.rotaryInertia);
				now.velocity[i] += dv - damping * std::copysign(dv, now.velocity[i] + dv / 2);
			}
		now.centre += dt * now.velocity.head<2>();
		const Real half = std::atan2(r.halfTurn.y(), r.halfTurn.x()) + dt * now.velocity[2] / 2;
		now.halfTurn    = { std::cos(half), std::sin(half) };
		work += followRigidMotion(a, r, now, dt);
	}
	return work;
}

/// Rigid motions as columns: the positions of all grid points against (free nodes' degrees of freedom, then three for every rigid block).
Eigen::MatrixXd coordinates(const BlockAssembly& a, Eigen::VectorXd& mass)
{
	std::vector<int> nodes;
	for (int n = 0; n < a.nodeCount(); ++n)
		if (a.mesh.mass[n] > 0) nodes.push_back(n);
	const int       count = 2 * int(nodes.size()) + 3 * int(a.state.rigid.size());
	Eigen::MatrixXd g     = Eigen::MatrixXd::Zero(2 * a.nodeCount(), count);
	mass.resize(count);
	int column = 0;
	for (int n : nodes)
		for (int axis : { 0, 1 })
			g(2 * n + axis, column) = 1, mass[column++] = a.state.inertia[n];
	for (const RigidBlock& r : a.state.rigid) {
		for (int n = a.mesh.firstNode[r.block]; n < a.mesh.firstNode[r.block + 1]; ++n) {
			const Vec2 arm   = a.position(n) - r.centre;
			g(2 * n, column) = g(2 * n + 1, column + 1) = 1;
			g(2 * n, column + 2) = -arm.y(), g(2 * n + 1, column + 2) = arm.x();
		}
		mass[column] = mass[column + 1] = r.inertia, mass[column + 2] = r.rotaryInertia;
		column += 3;
	}
	return g;
}

/// 2/omega of the fastest mode, rigid blocks moving as such.
Real trueLimit(const BlockAssembly& a)
{
	Eigen::VectorXd                                           mass;
	const Eigen::MatrixXd                                     g = coordinates(a, mass), k = g.transpose() * stiffnessMatrix(a, 1e-7) * g;
	Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(k, mass.asDiagonal().toDenseMatrix());
	return 2 / std::sqrt(solver.eigenvalues().maxCoeff());
}

Real boundOf(const BlockAssembly& a, Masses masses)
{
	const auto k = nodalStiffness(a);
	return std::min(stableTimeStep(a, k, masses == Masses::actual ? a.mesh.mass : a.state.inertia), rigidTimeStep(a, k, masses));
}

} // namespace

TEST(RigidBlocks, MassCentroidMoment)
{
	// A triangle of legs b, h: area b h/2, centroid (b, h)/3 from the right angle, polar moment A (b^2 + h^2)/18. Far from the origin, turned.
	BlockAssembly a;
	a.thickness = 0.4;
	a.addMaterial(stone());
	const Real b = 0.6, h = 0.5, c = std::cos(0.3), s = std::sin(0.3);
	const Vec2 corner(30, -20);
	auto       at = [&](Real x, Real y) { return Vec2(corner + Vec2(c * x - s * y, s * x + c * y)); };
	addRigid(a, { at(0, 0), at(b, 0), at(0, h) });
	const RigidBlock& r    = a.state.rigid.at(0);
	const Real        mass = b * h / 2 * 0.4 * 2000;
	EXPECT_NEAR(r.mass, mass, 1e-12 * mass); // coordinates of 30 known to 4e-15
	EXPECT_NEAR((r.origin - at(b / 3, h / 3)).norm(), 0, 1e-13);
	EXPECT_NEAR(r.moment, mass * (b * b + h * h) / 18, 1e-12 * mass);
	EXPECT_EQ(r.inertia, r.mass);
	EXPECT_EQ(r.rotaryInertia, r.moment);
	EXPECT_EQ(r.centre, r.origin);
	// a square with a square hole beside its middle
	const int ring = a.addBlock(
		{ { 0, 0 }, { 2, 0 }, { 2, 2 }, { 0, 2 }, { 0.5, 0.5 }, { 0.5, 1 }, { 1, 1 }, { 1, 0.5 } }, { { 0, 1, 2, 3 }, { 4, 5, 6, 7 } }, {}, 0);
	EXPECT_NEAR((a.centroid(ring) - Vec2(1, 1) * (4 - 0.25 * 0.75) / 3.75).norm(), 0, 8 * eps);
	EXPECT_NEAR(a.state.rigid[1].mass, 3.75 * 0.4 * 2000, 1e-12 * 3000);
	expectRefusal(
		[&] {
			a.addBlock({ { 0, 0 }, { 1, 0 }, { 0, 1 }, { 5, 5 }, { 5, 9 }, { 9, 9 } }, { { 0, 1, 2 }, { 3, 4, 5 } }, {}, 0);
		},
		{ "holes", "got -" });
	EXPECT_EQ(a.state.rigid.size(), 2u);
	expectRefusal([&] { a.addGroup(driven("top", { 2 }, 0)); }, { "\"top\"", "rigid block", "got 1" });
}

TEST(RigidBlocks, ForcesAndMomentsBalance)
{
	// Joints and zones hold no momentum: what rigid blocks feel is the opposite of what all others feel, about any point. Loads add to it.
	BlockAssembly                        a = mixed(elasticJoint(100e9, 40e9));
	std::mt19937                         random(3);
	std::uniform_real_distribution<Real> shift(-1e-4, 1e-4);
	for (int n = 0; n < a.nodeCount(); ++n)
		if (a.mesh.mass[n] > 0) a.state.displacement[n] += Vec2(shift(random), shift(random));
	for (RigidBlock& r : a.state.rigid) {
		const Real  half = 1e-4 * (1 + r.block);
		RigidMotion now { r.centre + Vec2(2e-4, -1e-4 * r.block), { std::cos(half), std::sin(half) }, Vec3::Zero(), Vec3::Zero() };
		followRigidMotion(a, r, now, 1);
		for (int n = a.mesh.firstNode[r.block]; n < a.mesh.firstNode[r.block + 1]; ++n)
			a.state.displacement[n] += a.state.velocity[n];
	}
	computeForces(a);
	gatherRigidForces(a);
	Vec3 nodes = Vec3::Zero(), rigid = Vec3::Zero();
	for (int n = 0; n < a.nodeCount(); ++n)
		if (a.mesh.mass[n] > 0) nodes += Vec3(a.forces.nodal[n].x(), a.forces.nodal[n].y(), cross(a.position(n), a.forces.nodal[n]));
	for (const RigidBlock& r : a.state.rigid)
		rigid += r.force + Vec3(0, 0, cross(r.centre, r.force.head<2>()));
	const Real scale = largestForce(a);
	EXPECT_GT(a.state.rigid[0].force.head<2>().norm(), 1e-3 * scale);
	EXPECT_GT(std::abs(a.state.rigid[0].force[2]), 1e-3 * scale);
	EXPECT_LT((nodes + rigid).norm(), 1e-11 * scale); // 100 terms of 1e-16
	const Vec3 without = a.state.rigid[1].force;
	addGravity(a, { 0.5, -9.81 });
	addTraction(a, a.mesh.firstEdge[3] + 1, { 1e5, 2e5 }); // from (1.6, 0.6) to (1.5, 1.1)
	computeForces(a);
	gatherRigidForces(a);
	const Real length = Vec2(0.1, 0.5).norm() * 0.3, mass = a.state.rigid[1].mass;
	const Vec2 arm = (a.position(a.mesh.firstNode[3] + 1) + a.position(a.mesh.firstNode[3] + 2)) / 2 - a.state.rigid[1].centre;
	const Vec3 expected(1e5 * length + 0.5 * mass, 2e5 * length - 9.81 * mass, cross(arm, Vec2(1e5, 2e5)) * length);
	EXPECT_LT((a.state.rigid[1].force - without - expected).norm(), 1e-11 * scale);
}

TEST(RigidBlocks, GridPointsGoWhereTheBodyGoes)
{
	BlockAssembly a = mixed(elasticJoint(1e9, 1e9));
	RigidBlock&   r = a.state.rigid[0];
	Damping       none;
	none.kind                             = Damping::Kind::none;
	const Real half                       = 1.2;
	a.state.velocity[a.mesh.firstNode[1]] = { 7, 7 }; // of no account
	followRigidMotion(a, r, { r.origin + Vec2(3, -2), { std::cos(half), std::sin(half) }, { 1, 2, 3 }, Vec3::Zero() }, 0.1);
	integrate(a, none, 0.1, 0);
	Eigen::Matrix<Real, 2, 2> turn;
	turn << std::cos(2 * half), -std::sin(2 * half), std::sin(2 * half), std::cos(2 * half);
	for (int n = a.mesh.firstNode[1]; n < a.mesh.firstNode[2]; ++n)
		EXPECT_LT((a.position(n) - (r.origin + Vec2(3, -2) + turn * (a.mesh.reference[n] - r.origin))).norm(), 16 * eps);
	EXPECT_LT((a.centroid(1) - r.centre).norm(), 16 * eps);
}

TEST(RigidBlocks, BoundIsBelowTheTrueLimitAndNotFarBelow)
{
	// Not above: derived in RigidBlocks.hpp. Not far below: half for the nodes' own bound (TimeStepTest), and the quadratic form
	// counts a joint twice (2 k A w against k A between two that both may move): another sqrt(2); scaled masses take another
	// sqrt(2) at most for |s|.
	for (const Real ratio : { 1e-2, 1., 1e2 }) {
		SCOPED_TRACE(ratio);
		BlockAssembly a     = mixed(elasticJoint(ratio * 100e9, 0.4 * ratio * 100e9));
		Real          bound = boundOf(a, Masses::actual), limit = trueLimit(a);
		EXPECT_LE(bound, limit * (1 + 1e-6));
		EXPECT_GE(bound, limit / 2 / std::sqrt(2));
		const auto k = nodalStiffness(a);
		scaleInertia(a, k, 0.25, 0.8);
		scaleRigidInertia(a, k, 0.25, 0.8);
		EXPECT_NE(a.state.rigid[0].inertia, a.state.rigid[0].mass);
		bound = boundOf(a, Masses::resisting), limit = trueLimit(a);
		EXPECT_GE(bound, 0.25 / 0.8 * (1 - 1e-12)); // every node and block at the same fraction, or below
		EXPECT_LE(0.25 / 0.8, limit * (1 + 1e-6));
		EXPECT_GE(0.25 / 0.8, limit / 4);
		restoreRigidInertia(a);
		EXPECT_EQ(a.state.rigid[0].inertia, a.state.rigid[0].mass);
		EXPECT_EQ(a.state.rigid[1].rotaryInertia, a.state.rigid[1].moment);
	}
}

TEST(RigidBlocks, BoundInClosedForm)
{
	// Stiffness at two of the corners only: k = 3 + 1 at arms (-1, -0.5) and (1, -0.5): s = (-2, -2), J = 4 x 1.25 = 5.
	BlockAssembly a;
	a.addMaterial({ 1, 0, 0.5 }); // 2 x 1: mass 1, moment 5/12
	addRigid(a, { { 0, 0 }, { 2, 0 }, { 2, 1 }, { 0, 1 } });
	const std::vector<Real> k { 3, 1, 0, 0 };
	RigidBlock&             r     = a.state.rigid[0];
	const RigidStiffness    bound = rigidStiffness(a, k, r);
	EXPECT_NEAR(bound.translation, 4, 4 * eps);
	EXPECT_NEAR(bound.coupling, std::sqrt(8), 8 * eps);
	EXPECT_NEAR(bound.rotation, 5, 8 * eps);
	// lambda of [4, sqrt 8; sqrt 8, 5] against (1, 5/12): mean 8, difference 4 - 12
	const Real squared = 8 + std::sqrt(16 + 8 * 12 / 5.);
	EXPECT_NEAR(rigidTimeStep(a, k, Masses::actual), 2 / std::sqrt(squared), 16 * eps);
	r.free = { true, false, false };
	EXPECT_NEAR(rigidTimeStep(a, k, Masses::actual), 2 / std::sqrt(4), 16 * eps);
	r.free = { false, false, true };
	EXPECT_NEAR(rigidTimeStep(a, k, Masses::actual), 2 / std::sqrt(12), 16 * eps);
	r.free = { false, false, false };
	EXPECT_EQ(rigidTimeStep(a, k, Masses::actual), std::numeric_limits<Real>::infinity());
	scaleRigidInertia(a, k, 0.2, 0.5); // c = 0.04; l = sqrt(5/4)
	EXPECT_NEAR(r.inertia, 0.04 * (4 + std::sqrt(8 / 1.25)), 4 * eps);
	EXPECT_NEAR(r.rotaryInertia, 0.04 * (5 + std::sqrt(8 * 1.25)), 4 * eps);
	scaleRigidInertia(a, { 0, 0, 0, 0 }, 0.2, 0.5); // nothing near
	EXPECT_EQ(r.inertia, r.mass);
	EXPECT_EQ(r.rotaryInertia, r.moment);
	expectRefusal([&] { scaleRigidInertia(a, k, 0, 0.5); }, { "time step", "got 0" });
}

TEST(RigidBlocks, StableAtTheBoundForManySteps)
{
	// Scaled masses at safety 0.95 without damping: a small motion stays small, 1/sqrt(1 - 0.95^2) = 3.2 times its start for every mode.
	BlockAssembly a = mixed(elasticJoint(100e9, 40e9));
	const auto    k = nodalStiffness(a);
	scaleInertia(a, k, 1e-3, 0.95);
	scaleRigidInertia(a, k, 1e-3, 0.95);
	std::mt19937                         random(5);
	std::uniform_real_distribution<Real> kick(-1e-9, 1e-9);
	for (int n = 0; n < a.nodeCount(); ++n)
		if (a.mesh.mass[n] > 0) a.state.velocity[n] = { kick(random), kick(random) };
	for (RigidBlock& r : a.state.rigid)
		r.velocity = { kick(random), kick(random), kick(random) };
	const Real start = kineticEnergy(a);
	Damping    none;
	none.kind = Damping::Kind::none;
	for (int i = 0; i < 5000; ++i) {
		computeForces(a);
		moveRigid(a, 1e-3);
		integrate(a, none, 1e-3, i * 1e-3);
	}
	EXPECT_LT(kineticEnergy(a), 11 * start);
	EXPECT_GT(kineticEnergy(a), start / 100);
}

TEST(RigidBlocks, MomentaAreKeptAndEnergyBalances)
{
	// Two rigid and two deformable blocks glued together, spinning freely under a push that ends: leapfrog keeps momentum and angular
	// momentum to rounding, and booked work, damping and what is stored and moving sum to zero.
	for (const Real damping : { 0., 0.4 }) {
		BlockAssembly a = mixed(elasticJoint(1e9, 4e8));
		Damping       none;
		none.kind     = Damping::Kind::none;
		const Real dt = 0.3 * boundOf(a, Masses::actual), speed = 1e-3;
		addGravity(a, { 0, -3 });
		Real balance = 0, largest = 0, damped = 0, pending = 0;
		Vec3 momentum = Vec3::Zero(), start = Vec3::Zero();
		for (RigidBlock& r : a.state.rigid)
			r.velocity = { speed, 0, 20 * speed };
		for (int i = 0; i < 3000; ++i) {
			computeForces(a);
			const Real stored = storedEnergy(a), loads = loadWork(a);
			StepWork   work = moveRigid(a, dt, i < 100 ? Vec3(30, 20, -10) : Vec3::Zero(), damping);
			work += integrate(a, none, dt, i * dt, true);
			damped += pending + work.dampingBefore;
			pending        = work.dampingAfter;
			const Real sum = stored + work.kinetic + damped - loads - rigidWork(a);
			if (i == 0 || i == 100) balance = sum; // gravity ends at step 99, in the middle of its step
			largest = std::max(largest, stored);
			ASSERT_NEAR(sum, balance, 1e-3 * largest + 1e-12) << i; // linear but for turns of some 1e-3
			momentum = Vec3::Zero();
			for (int n = 0; n < a.nodeCount(); ++n) {
				const Vec2 p = a.mesh.mass[n] * a.state.velocity[n];
				momentum += Vec3(p.x(), p.y(), cross(a.position(n), p));
			}
			for (const RigidBlock& r : a.state.rigid) {
				const Vec2 p = r.mass * r.velocity.head<2>();
				momentum += Vec3(p.x(), p.y(), cross(r.centre, p) + r.moment * r.velocity[2]);
			}
			if (i == 99) {
				a.supports.load.clear(); // then nothing acts from outside
				for (RigidBlock& r : a.state.rigid)
					r.load.setZero();
				start = momentum;
			}
			if (i > 99 && damping == 0) {
				ASSERT_LT((momentum - start).norm(), 1e-11 * start.norm()) << i;
			}
		}
		EXPECT_GT(start.norm(), 0.01);
		EXPECT_EQ(damped > 1e-3 * largest, damping > 0);
		EXPECT_EQ(std::abs(damped) < 1e-10 * largest, damping == 0);
	}
}

TEST(RigidBlocks, WorkOfOneStepByHand)
{
	// A free block of mass 2, moment 3 (made so): force of neighbours (5, 0, 1), total (9, 0, 4); x-velocity 1 -> 1.3 in 0.1 s, so
	// m a = 6 and damping takes 3; spin 2 -> 2.1: I a = 3, damping 1. Along y it is driven from 4 to 3: m a = -20.
	BlockAssembly a;
	a.addMaterial(stone());
	addRigid(a, { { 0, 0 }, { 2, 0 }, { 2, 1 }, { 0, 1 } });
	RigidBlock& r = a.state.rigid[0];
	r.inertia = 2, r.rotaryInertia = 3, r.force = { 5, 6, 1 }, r.velocity = { 1, 4, 2 }, r.free = { true, false, true };
	r.work = 100, r.pendingWork = 10;
	const StepWork work = followRigidMotion(a, r, { r.centre, r.halfTurn, { 1.3, 3, 2.1 }, { 9, 99, 4 } }, 0.1);
	const Real     half = 0.05;
	EXPECT_NEAR(r.work, 110 + half * (4 * 1 + (-20 - 6) * 4 + 3 * 2), 1e-13);
	EXPECT_NEAR(r.pendingWork, half * (4 * 1.3 - 26 * 3 + 3 * 2.1), 1e-14);
	EXPECT_NEAR(work.dampingBefore, half * (3 * 1 + 1 * 2), 1e-14);
	EXPECT_NEAR(work.dampingAfter, half * (3 * 1.3 + 1 * 2.1), 1e-14);
	EXPECT_NEAR(work.kinetic, (2 * 1.3 + 2 * 12 + 3 * 4.2) / 2, 1e-14);
	EXPECT_EQ(r.unbalanced, Vec3(9, 0, 4));
	EXPECT_EQ(r.velocity, Vec3(1.3, 3, 2.1));
	EXPECT_NEAR(kineticEnergy(a), (2 * (1.69 + 9) + 3 * 4.41) / 2, 1e-13);

	// masses that grow keep the momentum along free directions and the speed along driven ones; the difference is work from outside
	r.work = r.workTurnover = 0;
	Vec3 velocity           = r.velocity;
	changeInertia(r, { 0.5, 0.5, 6 }, velocity);
	EXPECT_NEAR((velocity - Vec3(1.3 / 4, 3, 2.1)).norm(), 0, 4 * eps); // the moment has fallen
	EXPECT_NEAR(r.work, (2 * 1.69 / 16 - 0.5 * 1.69 + 1.5 * 9 - 3 * 4.41) / 2, 1e-14);
	EXPECT_NEAR(r.workTurnover, std::abs(r.work), 1e-14);
}

TEST(RigidBlocks, AreHeldInTheLastGoodState)
{
	BlockAssembly  a = mixed(elasticJoint(100e9, 40e9));
	StabilityWatch watch;
	computeForces(a);
	a.state.rigid[1].velocity = { 1, 2, 3 };
	EXPECT_TRUE(watch.look(a, 7, 0.7, 0.1).stable);
	const RigidBlock good = a.state.rigid[1];
	moveRigid(a, 0.1);
	a.state.rigid[1].velocity *= std::nan("");
	a.state.velocity[a.mesh.firstNode[3]].x() = std::nan("");
	const auto verdict                        = watch.look(a, 8, 0.8, 0.1);
	EXPECT_FALSE(verdict.stable);
	EXPECT_EQ(verdict.block, 3);
	EXPECT_EQ(watch.restore(a), 7);
	EXPECT_EQ(a.state.rigid[1].centre, good.centre);
	EXPECT_EQ(a.state.rigid[1].halfTurn, good.halfTurn);
	EXPECT_EQ(a.state.rigid[1].velocity, good.velocity);
}

TEST(RigidBlocks, CountAmongTheUnbalanced)
{
	BlockAssembly a = mixed(elasticJoint(100e9, 40e9));
	computeForces(a);
	EXPECT_EQ(unbalancedRatio(a, 1000), 0);
	moveRigid(a, 1e-9, { 30, -20, 5 }); // both rigid blocks
	EXPECT_NEAR(unbalancedRatio(a, 1000), 100 / 2000., 1e-6);
	a.state.rigid[1].free = { true, false, true };
	moveRigid(a, 1e-9, { 30, -20, 5 });
	EXPECT_NEAR(unbalancedRatio(a, 1000), 80 / 2000., 1e-6);
}
