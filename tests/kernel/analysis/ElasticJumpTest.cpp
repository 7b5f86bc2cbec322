// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/analysis/ElasticJump.hpp>

using namespace specimens;

namespace {

JointParams brittle(Real tension, Real cohesion, Real tanPhi)
{
	JointParams p = elasticJoint(2e12, 1e12);
	p.tension     = tension;
	p.cohesion    = cohesion;
	p.tanPhi      = tanPhi;
	return p;
}

/// Voronoi wall, 1 x 0.6 m, held below; its top moves by (vx, vy) under a platen that presses with `pressure`.
BlockAssembly wall(const JointParams& joint, Real vx, Real vy, Real pressure)
{
	BlockAssembly a    = voronoi(1, 0.6, 6, 4, stone(), joint, 0.5);
	auto          low  = [](const Vec2& x) { return x.y() < 1e-9; };
	auto          high = [](const Vec2& x) { return x.y() > 0.6 - 1e-9; };
	auto          both = dofs(a, 0, low);
	for (int dof : dofs(a, 1, low))
		both.push_back(dof);
	a.addGroup(driven("low", both, 0));
	a.addGroup(driven("x", dofs(a, 0, high), vx, 7));
	if (pressure > 0)
		a.addGroup(pushed("y", dofs(a, 1, high), -pressure * 0.5, 3));
	else
		a.addGroup(driven("y", dofs(a, 1, high), vy, 7));
	return a;
}

/// How much of its strength in tension and in shear either way a contact point has used up.
std::array<Real, 3> usedShares(const BlockAssembly& a, int point)
{
	const JointParams& p     = a.joints.ofPoint(point);
	const Real         sigma = a.state.sigma[point], tau = a.state.tau[point];
	return { sigma / p.tension, (tau + sigma * p.tanPhi) / p.cohesion, (-tau + sigma * p.tanPhi) / p.cohesion };
}

} // namespace

TEST(ElasticJump, ColumnInTensionInClosedForm)
{
	// No lateral strain (poisson 0): every joint of a column of three blocks carries sigma = u / (3 h / E + 2 / kn) and fails at T.
	const Real    E = 20e9, h = 0.3, T = 1e6, kn = 2e12, speed = 1e-3, fraction = 0.9;
	BlockAssembly a = column(3, 0.4, h, 2, 2, { E, 0, 2000 }, brittle(T, 1e9, 0));
	a.addGroup(driven("low", dofs(a, 1, [](const Vec2& x) { return x.y() < 1e-9; }), 0));
	a.addGroup(driven("side", dofs(a, 0, [](const Vec2& x) { return x.x() < 1e-9; }), 0));
	a.addGroup(driven("top", dofs(a, 1, [&](const Vec2& x) { return x.y() > 3 * h - 1e-9; }), speed, 5));
	const ElasticJump jump = elasticJump(a, fraction, 11);

	const Real time = T * (3 * h / E + 2 / kn) / speed;
	// 900 N/m2 of strain T/E = 5e-5: large strain differs from the linear answer by that
	EXPECT_NEAR(jump.time, fraction * time, 1e-4 * time);
	for (Real sigma : a.state.sigma)
		EXPECT_NEAR(sigma, fraction * T, 1e-4 * T);
	const MotionGroup& top = a.state.groups[2];
	EXPECT_NEAR(top.force, fraction * T * 0.4, 1e-4 * T * 0.4);
	EXPECT_NEAR(top.travelled, speed * jump.time, 1e-15);
	EXPECT_NEAR(top.work, storedEnergy(a), 1e-4 * top.work); // linear: half force times path, up to the strain
	EXPECT_EQ(top.velocity, speed);
	EXPECT_EQ(top.ramp(11), 1);
}

TEST(ElasticJump, StandsInEquilibriumJustBelowTheFirstFailure)
{
	struct Case {
		Real vx, vy, pressure;
	};
	for (const Case& c : { Case { 1e-3, 0, 0.2e6 }, Case { 0, 1e-3, 0 }, Case { 0, -1e-3, 0 }, Case { -1e-3, 0, 1e6 } }) {
		BlockAssembly a = wall(brittle(0.6e6, 1.5e6, 0.7), c.vx, c.vy, c.pressure);
		addGravity(a, { 0, -9.81 });
		BlockAssembly     loaded = a;
		const ElasticJump start = elasticJump(loaded, 1e-9, 0), jump = elasticJump(a, 0.97, 0);
		// the share of the strength grows in proportion from that under the loads alone to 1, up to strains of 1e-4
		const auto before = usedShares(loaded, jump.point), after = usedShares(a, jump.point);
		const auto mode = std::max_element(after.begin(), after.end()) - after.begin();
		EXPECT_EQ(start.point, jump.point);
		EXPECT_NEAR(after[mode], before[mode] + 0.97 * (1 - before[mode]), 1e-4);
		for (size_t i = 0; i < a.state.status.size(); ++i)
			for (Real used : usedShares(a, int(i)))
				ASSERT_LT(used, 1);
		computeForces(a);
		EXPECT_LT(unbalancedRatio(a, 0), 1e-9); // four rounds, each leaving a share of the strain (1e-4)
		for (Joint status : a.state.status)
			ASSERT_EQ(status, Joint::intact);
		if (c.pressure > 0) {
			Real reaction = 0;
			for (int dof : dofs(a, 1, [](const Vec2& x) { return x.y() < 1e-9; }))
				reaction -= a.forces.nodal[dof / 2].y();
			const Real weight = 9.81 * 2000 * 0.6 * 0.5;
			EXPECT_NEAR(reaction, c.pressure * 0.5 + weight, 1e-9 * reaction);
		}
	}
}

TEST(ElasticJump, ShearFailsEitherWay)
{
	// Without friction and tension cut-off, loading the other way turns all stresses round: the same point fails at the same time,
	// up to the strain.
	BlockAssembly     right = wall(brittle(1e15, 1.5e6, 0), 1e-3, 0, 0), left = wall(brittle(1e15, 1.5e6, 0), -1e-3, 0, 0);
	const ElasticJump one = elasticJump(right, 0.9, 0), other = elasticJump(left, 0.9, 0);
	EXPECT_EQ(one.point, other.point);
	EXPECT_NEAR(one.time, other.time, 1e-3 * one.time);
}

TEST(ElasticJump, IsWhereSlowLoadingArrives)
{
	// The same wall, loaded by damped steps to the same place: what differs is what is left of its motion (ratio 1e-7).
	BlockAssembly     leapt = wall(brittle(0.6e6, 1.5e6, 0.7), 1e-3, 0, 0.2e6), walked = wall(brittle(1e30, 1e30, 0.7), 1e-3, 0, 0.2e6);
	const ElasticJump jump = elasticJump(leapt, 0.9, 0);
	const Real        dt   = 1e-3 * jump.time;
	scaleInertia(walked, nodalStiffness(walked), dt, 0.7);
	Damping damping;
	damping.alpha                   = 0.5;
	walked.state.groups[1].rampTime = walked.state.groups[2].rampTime = jump.time / 4;
	Real time                                                         = 0;
	for (; walked.state.groups[1].travelled < 1e-3 * jump.time; time += dt) {
		computeForces(walked);
		move(walked, damping, dt, time);
	}
	for (int n : { 1, 2 })
		walked.state.groups[n].rampTime = 0, walked.state.groups[n].startTime = 0;
	walked.state.groups[1].target = 0;
	for (int i = 0; i < 20000; ++i, time += dt) {
		computeForces(walked);
		move(walked, damping, dt, time);
	}
	const Real excess  = walked.state.groups[1].travelled / leapt.state.groups[1].travelled;
	Real       largest = 0;
	for (int n = 0; n < leapt.nodeCount(); ++n)
		largest = std::max(largest, leapt.state.displacement[n].norm());
	for (int n = 0; n < leapt.nodeCount(); ++n)
		EXPECT_LT((leapt.position(n) - walked.position(n)).norm(), (std::abs(excess - 1) + 1e-4) * largest);
	EXPECT_NEAR(excess, 1, 2e-3); // the last step overshoots by one thousandth at most
}

TEST(ElasticJump, GoesOnWithoutAStart)
{
	// At constant speed everything grows in proportion, so nothing is accelerated: the ratio stays that of the damping force,
	// m a = 0 up to the strain. Without the velocities the ratio would jump to the order of the inertial share, 1e-3 here.
	BlockAssembly     a    = wall(brittle(0.6e6, 1.5e6, 0.7), 1e-3, 0, 0.2e6);
	const ElasticJump jump = elasticJump(a, 0.5, 0);
	const Real        dt   = 1e-4 * jump.time;
	scaleInertia(a, nodalStiffness(a), dt, 0.7);
	Damping damping;
	damping.kind = Damping::Kind::none;
	for (int i = 0; i < 200; ++i) {
		computeForces(a);
		EXPECT_LT(unbalancedRatio(a, 0), 1e-5);
		move(a, damping, dt, i * dt);
	}
}

TEST(ElasticJump, RefusesWhatIsNotLinear)
{
	const JointParams joint   = brittle(0.6e6, 1.5e6, 0.7);
	auto              refuses = [](BlockAssembly a, const std::string& part, Real fraction = 0.9) {
                const auto before = a.state.displacement;
                try {
                        elasticJump(a, fraction, 0);
                        ADD_FAILURE() << "not refused: " << part;
                } catch (const std::exception& e) {
                        EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
                }
                EXPECT_EQ(a.state.displacement, before) << part;
	};
	refuses(wall(joint, 1e-3, 0, 1e5), "(0, 1)", 1);
	refuses(wall(joint, 0, 0, 1e5), "driven by a velocity");
	refuses(wall(brittle(0.6e6, 1e3, 0), 1e-3, 0, 1e6), "dead loads alone break");
	refuses(wall(elasticJoint(2e12, 1e12), 0, 1e-3, 0), "up to the first failure"); // strength 1e30: strains without bound
	// Joints as strong as this fail at strains of 50, where the linear answer is far from any equilibrium; they are so stiff that they slip by 1 mm.
	JointParams strong = brittle(1e12, 1e12, 0.7);
	strong.kn = strong.ks = 1e15;
	refuses(wall(strong, 1e-3, 0, 1e5), "in large displacement");
	BlockAssembly broken   = wall(joint, 1e-3, 0, 1e5);
	broken.state.status[3] = Joint::brokenInShear;
	refuses(broken, "not bonded");
	BlockAssembly bare = wall(joint, 1e-3, 0, 1e5);
	bare.bond(detectSegments(bare));
	refuses(bare, "no properties yet");
	BlockAssembly loose = column(2, 0.4, 0.3, 2, 2, stone(), joint);
	loose.addGroup(driven("top", dofs(loose, 1, [](const Vec2& x) { return x.y() > 0.6 - 1e-9; }), 1e-3));
	refuses(loose, "hold them");
}
