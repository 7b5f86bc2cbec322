// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/analysis/Removal.hpp>
#include <blocks/kernel/step/ContactResults.hpp>
#include <blocks/kernel/step/InSitu.hpp>
#include <blocks/kernel/step/ViscousBoundaries.hpp>

using namespace specimens;

namespace {

BlockAssembly tower(int bricks)
{
	BlockAssembly a = column(bricks, 0.8, 0.5, 2, 1, stone(), elasticJoint(5e9, 2e9), 0.4);
	a.addGroup(driven("foot", dofs(a, 1, [](const Vec2& x) { return x.y() == 0; }), 0));
	addGravity(a, { 0.5, -9.81 });
	return a;
}

void run(BlockAssembly& a, Real dt, int steps, Real alpha = 0.3)
{
	Damping local;
	local.alpha = alpha;
	for (int i = 0; i < steps; ++i) {
		blocks::computeForces(a, Brittle {}, dt, true);
		move(a, local, dt, i * dt, true);
	}
}

/// Steps with accounts.
struct Balance {
	BlockAssembly& a;
	Real           booked = 0, pending = 0; ///< by damping [J]
	Real           swinging = 0;            ///< what was stored and kinetic in the last step [J]

	/// A step; what is there, was dissipated and taken out, less what groups and loads put in [J].
	Real step(const Damping& damping, Real dt, Real time)
	{
		blocks::computeForces(a, Brittle {}, dt, true);
		const Real     stored = specimens::storedEnergy(a), loads = loadWork(a);
		const StepWork w = move(a, damping, dt, time, true);
		booked += pending + w.dampingBefore;
		pending         = w.dampingAfter;
		swinging        = stored + w.kinetic;
		const auto& acc = a.state.accounts;
		return swinging + booked + acc.friction + contactFriction(a) + acc.fracture + a.state.further.removed - groupWork(a) - loads;
	}
};

} // namespace

TEST(Removal, TheRestIsAsIfTheyHadNeverBeenThere)
{
	BlockAssembly all = tower(3), two = tower(2);
	const Real    dt = 0.5 * stableTimeStep(all, nodalStiffness(all), all.state.inertia);
	run(all, dt, 40);
	for (int n = 0; n < two.nodeCount(); ++n)
		two.state.displacement[n] = all.state.displacement[n], two.state.velocity[n] = all.state.velocity[n];
	removeBlocks(all, { 2 });
	run(all, dt, 100);
	run(two, dt, 100);
	Real most = 0;
	for (int n = 0; n < two.nodeCount(); ++n) {
		most = std::max(most, two.state.displacement[n].norm());
		EXPECT_EQ(all.state.displacement[n], two.state.displacement[n]);
		EXPECT_EQ(all.state.velocity[n], two.state.velocity[n]);
	}
	EXPECT_GT(most, 1e-8);
	for (int n = two.nodeCount(); n < all.nodeCount(); ++n)
		EXPECT_TRUE(all.state.displacement[n].isZero(0) && all.state.velocity[n].isZero(0) && all.forces.nodal[n].isZero(0));
	EXPECT_EQ(stableTimeStep(all, nodalStiffness(all), all.state.inertia), stableTimeStep(two, nodalStiffness(two), two.state.inertia));
	addGravity(all, { 0, -1 });
	EXPECT_TRUE(all.supports.load.back().isZero(0));
}

TEST(Removal, AccountsSayWhatWasTakenOut)
{
	// In situ, at rest: the zones' and the joints' energy of the block. Then the balance goes on: small strain, so that it is exact but for turning frames.
	BlockAssembly a = voronoi(3, 2, 5, 4, stone(), elasticJoint(5e9, 2e9), 0.7);
	a.strain        = Strain::small;
	setInSitu(a, { { -2e6, -3e6, 0.7e6 }, {}, 0 });
	a.addGroup(driven("edge x", dofs(a, 0, [](const Vec2& x) { return x.x() < 1e-9 || x.x() > 3 - 1e-9 || x.y() < 1e-9 || x.y() > 2 - 1e-9; }), 0));
	a.addGroup(driven("edge y", dofs(a, 1, [](const Vec2& x) { return x.x() < 1e-9 || x.x() > 3 - 1e-9 || x.y() < 1e-9 || x.y() > 2 - 1e-9; }), 0));
	addGravity(a, { 0, -9.81 }); // out of balance a little
	int inner = -1;
	for (int b = 0; b < a.blockCount(); ++b)
		if ((a.centroid(b) - Vec2(1.5, 1)).norm() < 0.4) inner = b;
	ASSERT_GE(inner, 0);
	blocks::computeForces(a, Brittle {}, 0, true);
	Real held = 0;
	for (int z = a.mesh.firstZone[inner]; z < a.mesh.firstZone[inner + 1]; ++z)
		held += a.mesh.zoneVolume[z] * zoneEnergyDensity(planeModuli(20e9, 0.2, Plane::strain), elasticStrainOf(a, z));
	for (int i = 0; i < a.joints.count(); ++i)
		for (int p : { 2 * i, 2 * i + 1 })
			if (a.joints.segments[i].block[0] == inner || a.joints.segments[i].block[1] == inner)
				held += a.joints.segments[i].area * blocks::storedEnergy(a.joints.of(i), a.state.sigma[p], a.state.tau[p]);
	const Real before = specimens::storedEnergy(a);
	removeBlocks(a, { inner });
	EXPECT_NEAR(a.state.further.removed, held, 1e-10 * before);
	EXPECT_NEAR(specimens::storedEnergy(a) + a.state.further.removed, before, 1e-10 * before);

	const Real dt = 0.5 * stableTimeStep(a, nodalStiffness(a), a.state.inertia);
	Damping    local;
	Balance    balance { a };
	Real       worst = 0;
	for (int i = 0; i < 2000; ++i)
		worst = std::max(worst, std::abs(balance.step(local, dt, i * dt) - before));
	EXPECT_GT(balance.booked, 0.01 * held); // the hole came to rest
	EXPECT_LT(unbalancedRatio(a), 1e-6);
	EXPECT_LT(worst, 1e-5 * before);
}

/// Four dry bricks on a held foot, by general contact.
BlockAssembly dryPile()
{
	JointParams dry = elasticJoint(5e9, 2e9);
	dry.tension = dry.cohesion = 0;
	BlockAssembly a            = column(4, 0.8, 0.5, 1, 1, stone(), dry, 0.4);
	for (int i = 0; i < a.joints.count(); ++i)
		a.setJoints(i, i + 1, dry, Joint::unbonded);
	a.joints.ofMaterials = { a.addKind(neverBonded(dry)) };
	a.addGroup(driven("foot", dofs(a, 1, [](const Vec2& x) { return x.y() == 0; }), 0));
	addGravity(a, { 0, -9.81 });
	setGeneralContact(a, true);
	return a;
}

TEST(Removal, ContactsAreForgotten)
{
	// Four dry bricks; without the two in the middle, the upper falls freely through where they were, also the one that it never touched: v = g t, half a
	// step ahead, until it meets the lowest.
	BlockAssembly a  = dryPile();
	const Real    dt = 0.3 * stableTimeStep(a, nodalStiffness(a), a.state.inertia);
	run(a, dt, 50);
	EXPECT_FALSE(a.contacts.order.empty());
	removeBlocks(a, { 1, 2 });
	const int  node = a.mesh.firstNode[3];
	const Real mass = a.mesh.mass[node];
	EXPECT_GT(mass, 0);
	for (Vec2& v : a.state.velocity)
		v.setZero();
	Damping none;
	none.kind   = Damping::Kind::none;
	const int n = int(0.35 / dt); // falls 0.6 m
	for (int i = 0; i < n; ++i) {
		blocks::computeForces(a, Brittle {}, dt);
		move(a, none, dt, i * dt);
	}
	Vec2 momentum = Vec2::Zero();
	Real all      = 0;
	for (int k = a.mesh.firstNode[3]; k < a.mesh.firstNode[4]; ++k)
		momentum += a.mesh.mass[k] * a.state.velocity[k], all += a.mesh.mass[k];
	EXPECT_NEAR(momentum.y() / all, -9.81 * n * dt, 1e-9);
	EXPECT_LT(a.centroid(3).y(), 1.75 - 0.59);
}

TEST(Removal, RemovedJointsHaveNoStress)
{
	// Without general contact there is no list of contacts to look them up in.
	BlockAssembly a  = tower(3);
	const Real    dt = 0.5 * stableTimeStep(a, nodalStiffness(a), a.state.inertia);
	run(a, dt, 40);
	removeBlocks(a, { 2 });
	const auto stresses = pointStresses(a, 0, a.joints.count());
	ASSERT_GE(a.joints.count(), 2);
	for (int p = 0; p < a.pointCount(); ++p)
		EXPECT_EQ(stresses.sigma[p] == 0, a.isRemoved(a.joints.segments[p / 2].block[1]));
}

TEST(Removal, WhatIsLeftStandsOnItsContacts)
{
	// A dry pile of four on a held foot, the upper two taken out, then the third, when the pile has come to rest. Each time the contact that is left
	// carries the weight of what is above it, the balance of energy holds, and no contact names a block that is gone.
	BlockAssembly a  = dryPile();
	const Real    dt = 0.3 * stableTimeStep(a, nodalStiffness(a), a.state.inertia);
	Damping       local;
	local.alpha = 0.5;
	Balance    balance { a };
	Real       worst = 0, most = 0;
	const auto settle = [&] {
		for (int i = 0; i < 6000; ++i) {
			worst = std::max(worst, std::abs(balance.step(local, dt, i * dt)));
			most  = std::max(most, balance.swinging);
		}
		blocks::computeForces(a, Brittle {}, dt, true);
	};
	const auto weight = [&](int block) {
		Real sum = 0;
		for (int n = a.mesh.firstNode[block]; n < a.mesh.firstNode[block + 1]; ++n)
			sum += 9.81 * a.mesh.mass[n];
		return sum;
	};
	const auto between = [&](int lower, int upper) {
		Real sum = 0;
		for (int i : a.contacts.order)
			if (a.state.contacts[i].block == std::array<int, 2> { lower, upper })
				forEachTouching(a.contacts, std::as_const(a.state.contacts)[i], i, [&](const EdgePair&, const SideForce& on) {
					sum -= on.force[0].y() + on.force[1].y();
				});
		return sum;
	};
	const Real one = weight(1);
	settle();
	EXPECT_NEAR(between(0, 1), 3 * one, 1e-4 * one);
	EXPECT_NEAR(between(1, 2), 2 * one, 1e-4 * one);
	for (std::vector<int> gone : { std::vector<int> { 2, 3 }, { 1 } }) {
		removeBlocks(a, gone);
		settle();
		for (int i : a.contacts.order)
			for (int b : a.state.contacts[i].block)
				EXPECT_FALSE(a.isRemoved(b)) << b;
		if (gone.size() == 2) {
			EXPECT_NEAR(between(0, 1), one, 1e-4 * one);
		}
		EXPECT_LT(unbalancedRatio(a), 1e-4);
	}
	EXPECT_TRUE(a.contacts.order.empty());
	EXPECT_LT(worst, 1e-9 * most); // nothing slides, contacts are springs: rounding of 18,000 steps, 18,000^(1/2) to 18,000 x 2e-16, and some slack
}

TEST(Removal, WhatSlidesGoesOnSliding)
{
	// Three dry bricks on a held one under a pull aslant, beyond the angle of friction, slide; without damping they rattle, so that there is no closed
	// form. The uppermost is taken off meanwhile: what is left has the velocities it had, and goes on sliding. Momentum is what loads and held edges give,
	// to rounding; energy is in the accounts. Then the pull ends, and they come to rest on their friction.
	const Real  mu = 0.5, g = 9.81;
	JointParams dry = elasticJoint(5e9, 2e9);
	dry.tension = dry.cohesion = 0, dry.tanPhi = dry.tanPhiResidual = mu;
	BlockAssembly a = column(4, 1.6, 0.4, 1, 1, stone(), dry, 0.4);
	for (int i = 0; i < a.joints.count(); ++i)
		a.setJoints(i, i + 1, dry, Joint::unbonded);
	a.joints.ofMaterials = { a.addKind(neverBonded(dry)) };
	for (int axis : { 0, 1 })
		a.addGroup(driven("held " + std::to_string(axis), dofs(a, axis, [](const Vec2& x) { return x.y() < 0.2; }), 0));
	addGravity(a, { 0, -g });
	setGeneralContact(a, true);
	const Real dt       = 0.3 * stableTimeStep(a, nodalStiffness(a), a.state.inertia);
	const auto momentum = [&] {
		Vec2 sum = Vec2::Zero();
		for (int n = 0; n < a.nodeCount(); ++n)
			sum += a.mesh.mass[n] * a.state.velocity[n];
		return sum;
	};
	Balance    balance { a };
	Real       shift = 0, time = 0, errorOfEnergy = 0, errorOfMomentum = 0;
	const auto run = [&](Real duration, Real alpha) {
		Damping damping;
		damping.alpha = alpha;
		if (alpha == 0) damping.kind = Damping::Kind::none;
		Vec2 impulse = Vec2::Zero(), start = momentum();
		Real turnover = 0;
		for (const Real end = time + duration; time < end; time += dt) {
			errorOfEnergy = std::max(errorOfEnergy, std::abs(balance.step(damping, dt, time) + shift));
			Vec2 force(a.state.groups[0].force, a.state.groups[1].force);
			for (const Vec2& load : a.supports.load)
				force += load;
			impulse += dt * force;
			turnover += dt * force.norm();
		}
		if (alpha == 0) errorOfMomentum = std::max(errorOfMomentum, (momentum() - start - impulse).norm() / turnover);
	};
	const auto pull = [&](Real x) { // dead loads count from the reference: what is displaced already gets a share at once
		shift -= loadWork(a);
		addGravity(a, { x, 0 });
		shift += loadWork(a);
	};
	const auto speed = [&](int block) {
		Real sum = 0, mass = 0;
		for (int n = a.mesh.firstNode[block]; n < a.mesh.firstNode[block + 1]; ++n)
			sum += a.mesh.mass[n] * a.state.velocity[n].x(), mass += a.mesh.mass[n];
		return sum / mass;
	};
	run(0.05, 0.5); // the weight comes to rest
	pull(0.7 * g);
	run(0.15, 0);
	const Real first = speed(1), second = speed(2), friction = contactFriction(a), place = a.centroid(1).x();
	EXPECT_GT(first, 0.1);
	EXPECT_GT(second, 0.1);
	removeBlocks(a, { 3 });
	EXPECT_EQ(speed(1), first);
	EXPECT_EQ(speed(2), second);
	run(0.1, 0);
	EXPECT_GT(speed(1), 0.1);
	EXPECT_GT(a.centroid(1).x() - place, 0.01);
	EXPECT_GT(contactFriction(a), 1.2 * friction);
	pull(-0.7 * g);
	run(0.15, 0);
	run(0.2, 0.7);
	blocks::computeForces(a, Brittle {}, dt, true);
	EXPECT_LT(unbalancedRatio(a), 1e-4);
	Real weight = 0;
	for (Real mass : a.mesh.mass)
		weight += g * mass;
	EXPECT_NEAR(a.state.groups[1].force, weight, 1e-3 * weight);
	EXPECT_LT(errorOfMomentum, 1e-12);                   // rounding
	EXPECT_LT(errorOfEnergy, 5e-3 * contactFriction(a)); // steps are finite where edges slide and bounce: 1.2e-3 here
}

TEST(Removal, Refusals)
{
	BlockAssembly a = tower(3);
	expectRefusal([&] { removeBlocks(a, {}); }, { "one block at least" });
	expectRefusal([&] { removeBlocks(a, { 3 }); }, { "indices of blocks", "3" });
	expectRefusal([&] { removeBlocks(a, { 0 }); }, { "motion group \"foot\" must be released" });
	addViscous(a, "top", [&] {
		std::vector<int> list;
		for (int n = 0; n < a.nodeCount(); ++n)
			if (a.mesh.reference[n].y() > 1.5 - 1e-9) list.push_back(n);
		return list;
	}());
	expectRefusal([&] { removeBlocks(a, { 2 }); }, { "viscous boundary \"top\" must be released" });
	removeBlocks(a, { 1 });
	expectRefusal([&] { removeBlocks(a, { 1 }); }, { "once only", "1" });
	BlockAssembly b = column(2, 1, 1, 1, 1, stone(), elasticJoint(1, 1));
	expectRefusal([&] { removeBlocks(b, { 0, 1 }); }, { "one block must be left" });
	EXPECT_TRUE(b.mesh.removed.empty());
}
