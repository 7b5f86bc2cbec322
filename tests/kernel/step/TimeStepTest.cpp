// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>

using namespace specimens;

namespace {

struct Specimen {
	std::string   name;
	BlockAssembly assembly;
};

/// Meshes of every kind, joints of k = ratio x E/size.
std::vector<Specimen> meshes(Real ratio)
{
	const JointParams     joint = elasticJoint(ratio * 20e9 / 0.2, 0.4 * ratio * 20e9 / 0.2);
	std::vector<Specimen> list;
	list.push_back({ "voronoi", voronoi(1, 0.6, 4, 2, stone(), joint, 0.5) });
	list.push_back({ "column", column(3, 0.5, 0.2, 2, 1, stone(), joint) });
	list.push_back({ "slivers", column(2, 0.4, 0.004, 2, 1, { 20e9, 0.45, 2000 }, joint) }); // zones 50 times wider than high
	BlockAssembly mixed; // unequal meshes, materials and a shear stiffness above the normal one
	mixed.thickness = 0.3;
	mixed.plane     = Plane::stress;
	mixed.addMaterial(stone());
	mixed.addMaterial({ 1e9, 0.1, 900 });
	addGrid(mixed, { 0, 0 }, 1, 0.5, 2, 1);
	addGrid(mixed, { 0.3, 0.5 }, 1.3, 0.1, 3, 1, 1);
	addGrid(mixed, { 1, -0.1 }, 1, 0.6, 1, 2);
	bondAll(mixed, elasticJoint(0.4 * ratio * 20e9 / 0.2, ratio * 20e9 / 0.2));
	list.push_back({ "mixed", mixed });
	return list;
}

/// 2/omega of the fastest mode. A tenth of a micrometre is small enough for linear frames, large enough against rounding (1e-9).
Real trueLimit(const BlockAssembly& a) { return 2 / modes(a, 1e-7).omega.maxCoeff(); }

/// Largest displacement from the reference after so many undamped steps from a small random start [m].
Real excursion(BlockAssembly a, Damping damping, Real dt, int steps)
{
	std::mt19937                         random(5);
	std::uniform_real_distribution<Real> shift(-1e-12, 1e-12);
	for (int n = 0; n < a.nodeCount(); ++n)
		for (int axis : { 0, 1 }) {
			const Real d = shift(random);
			if (a.supports.mobility[n][axis] > 0) a.state.displacement[n][axis] += d;
		}
	for (int i = 0; i < steps; ++i) {
		computeForces(a);
		move(a, damping, dt, i * dt);
	}
	Real most = 0;
	for (int n = 0; n < a.nodeCount(); ++n)
		most = std::max(most, a.state.displacement[n].norm());
	return std::isfinite(most) ? most : 1e300;
}

Damping undamped()
{
	Damping none;
	none.kind = Damping::Kind::none;
	return none;
}

} // namespace

TEST(TimeStep, BoundIsBelowTheTrueLimitAndNotFarBelow)
{
	// Not above: block Gershgorin, derived in TimeStep.hpp; 1e-6 for the numerical derivatives.
	// Not far below: the largest eigenvalue is at least the largest |K_nn|/m_n. A joint's row sums to 2 k A w against k A w on the
	// diagonal for conforming points (w = 1), a zone's to at most 3 times the largest of its diagonal blocks:
	// 1/sqrt(3) = 0.58 of the true limit, less where the largest blocks belong to different nodes. Half is asked for.
	for (const Real ratio : { 1e-3, 1., 1e3 })
		for (const Specimen& m : meshes(ratio)) {
			SCOPED_TRACE(m.name + " joints x " + shown(ratio));
			const Real bound = stableTimeStep(m.assembly, nodalStiffness(m.assembly), m.assembly.state.inertia), limit = trueLimit(m.assembly);
			EXPECT_LE(bound, limit * (1 + 1e-6));
			EXPECT_GE(bound, limit * 0.5);
		}
}

TEST(TimeStep, BoundHoldsWhereverBlocksHaveTurned)
{
	for (const Specimen& m : meshes(1)) {
		SCOPED_TRACE(m.name);
		BlockAssembly a = m.assembly;
		rotateAbout(a, { 0.3, 0.1 }, 0.7, { 0, 0 });
		const Real bound = stableTimeStep(a, nodalStiffness(a), a.state.inertia);
		EXPECT_LE(bound, trueLimit(a) * (1 + 1e-6));
	}
}

TEST(TimeStep, OneZoneInClosedForm)
{
	// A right-angled triangle of legs 1 and unit thickness, lambda = mu = 1 (E = 2.5, nu = 0.25, plane strain): V = 1/2, gradients
	// (-1,-1), (1,0), (0,1). Blocks V (lambda gi gj' + mu (gj gi' + gi.gj 1)):
	//   K00 = [2 1... = 1/2 [4 2; 2 4]: norm 3;  K01 = 1/2 [-3 -1; -1 -1]: (2 + sqrt 2)/2;  K11 = 1/2 [3 0; 0 1]: 1.5;
	//   K12 = 1/2 [0 1; 1 0]: 1/2.  (sums of 4 terms, some 30 roundings)
	BlockAssembly a;
	a.addMaterial({ 2.5, 0.25, 6 });
	a.addBlock({ { 0, 0 }, { 1, 0 }, { 0, 1 } }, { { 0, 1, 2 } }, { { 0, 1, 2 } }, 0);
	const auto K = nodalStiffness(a);
	EXPECT_NEAR(K[0], 3 + 2 + std::sqrt(2), 100 * eps);
	EXPECT_NEAR(K[1], 1.5 + 1 + std::sqrt(0.5) + 0.5, 100 * eps);
	EXPECT_NEAR(K[2], K[1], 100 * eps);
	EXPECT_NEAR(stableTimeStep(a, K, a.state.inertia), 2 / std::sqrt(5 + std::sqrt(2)), 100 * eps); // masses 1
}

TEST(TimeStep, JointsShareInClosedForm)
{
	// 2 max(kn, ks) A w a point, and dilation's kn tan: kn = 3, ks = 5, tan = 0.5: 6.5 k, area 0.4 a point.
	// Lower edge split 1:1, upper whole: its end nodes carry w = 1 and 1/2, the lower middle node 1 twice.
	BlockAssembly a;
	a.addMaterial({ 1e-9, 0, 1 });
	addGrid(a, { 0, 0 }, 1.6, 0.5, 2, 1);
	addGrid(a, { 0, 0.5 }, 1.6, 0.5, 1, 1);
	JointParams joint    = elasticJoint(3, 5);
	joint.tanPhiResidual = joint.tanDilation = 0.5;
	bondAll(a, joint);
	const auto K    = nodalStiffness(a);
	const Real unit = 2 * 6.5 * 0.4;
	EXPECT_NEAR(K[3], unit, 1e-7); // the zones' share is below 10 E = 1e-8
	EXPECT_NEAR(K[4], 2 * unit, 1e-7);
	EXPECT_NEAR(K[5], unit, 1e-7);
	EXPECT_NEAR(K[a.mesh.firstNode[1]], 2 * unit, 1e-7); // 1 at its own end, 1/2 from each of two points in the middle
	EXPECT_NEAR(K[a.mesh.firstNode[1] + 1], 2 * unit, 1e-7);
}

TEST(TimeStep, StableBelowTheTrueLimitUnstableAbove)
{
	// Above by 2 %: the fastest mode grows by exp(2 acosh(1.02)) = exp(0.4) a step: 1e17 in 100 steps. Below by 2 % every mode
	// stays within 1/sqrt(1 - 0.98^2) = 5 times its start (velocities too: random starts of 1e-12, at most 1e-9 in all).
	for (const Real ratio : { 1e-3, 1., 1e3 })
		for (const Specimen& m : meshes(ratio)) {
			SCOPED_TRACE(m.name + " joints x " + shown(ratio));
			const Real limit = trueLimit(m.assembly);
			EXPECT_LT(excursion(m.assembly, undamped(), 0.98 * limit, 300), 1e-9);
			EXPECT_GT(excursion(m.assembly, undamped(), 1.02 * limit, 100), 1e-6);
		}
}

TEST(TimeStep, LocalDampingLowersTheLimit)
{
	// One degree of freedom (no other joins in): the fastest motion turns at every step, against the force all the time, so
	// that k (1 + alpha) acts: the limit is 2 / (omega sqrt(1 + alpha)).
	BlockAssembly a;
	a.strain = Strain::small;
	a.addMaterial({ 2000, 0.3, 5 });
	a.addBlock({ { 0.1, 0 }, { 1.2, 0.3 }, { 0.4, 0.9 } }, { { 0, 1, 2 } }, { { 0, 1, 2 } }, 0);
	a.addGroup(driven("rest", { 0, 1, 2, 3, 4 }, 0));
	const Real limit = trueLimit(a);
	for (const Real alpha : { 0.2, 0.8 }) {
		Damping local;
		local.alpha = alpha;
		// That motion, x and -x in turn, grows by exp(2 acosh(1.005)) = exp(0.2) a step at 1.005 of the lowered limit, by 3e10 in 120
		// steps, and is bounded below it. (Farther above, it gets ahead of the velocity's sign and so out of the worst case.)
		for (const Real part : { 0.98, 1.005 }) {
			BlockAssembly b  = a;
			const Real    dt = part * limit / std::sqrt(1 + alpha);
			b.state.displacement[2].y() += 1e-6;
			b.state.velocity[2].y() = 2e-6 / dt;
			Real most               = 0;
			for (int i = 0; i < 120; ++i) {
				computeForces(b);
				move(b, local, dt, i * dt);
				most = std::max(most, std::abs(b.state.displacement[2].y()));
			}
			EXPECT_EQ(most > 1, part > 1);
			EXPECT_EQ(most < 1e-5, part < 1); // 1/sqrt(1 - 0.98^2) = 5 times the start
		}
		EXPECT_LT(largestSafety(local), 1 / std::sqrt(1 + alpha));
	}
}

TEST(TimeStep, ScaledInertiaPutsEveryNodeAtTheSameFraction)
{
	for (const Specimen& m : meshes(1)) {
		SCOPED_TRACE(m.name);
		BlockAssembly a = m.assembly;
		const auto    K = nodalStiffness(a);
		scaleInertia(a, K, 0.25, 0.8);
		for (int n = 0; n < a.nodeCount(); ++n) {
			EXPECT_NEAR(2 * std::sqrt(a.state.inertia[n] / K[n]) * 0.8, 0.25, 8 * eps);
			EXPECT_NEAR(a.supports.mobility[n].x() * a.state.inertia[n], 1, 4 * eps);
		}
		EXPECT_NEAR(stableTimeStep(a, K, a.state.inertia), 0.25 / 0.8, 8 * eps);
		EXPECT_LE(0.25, 0.8 * trueLimit(a) * (1 + 1e-6));
		for (int n = 0; n < a.nodeCount(); ++n)
			EXPECT_EQ(a.mesh.mass[n], m.assembly.mesh.mass[n]); // true masses stay, for gravity
	}
}

TEST(TimeStep, PlatenUnderForceCountsDrivenOneDoesNot)
{
	// A thin stiff layer (0.01 m) on a thick one (1 m), the platen on top held sideways: the platen's own mode is the fastest,
	// omega^2 = 2 E'/(rho h^2) against some E'/(rho h H) of the free nodes. Both ends of the bar can move.
	const auto build = [](bool force) {
		BlockAssembly a;
		a.addMaterial({ 20e9, 0, 2000 });
		a.addBlock(
			{ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 }, { 1, 1.01 }, { 0, 1.01 } },
			{ { 0, 1, 2, 4, 5, 3 } },
			{ { 0, 1, 2 }, { 0, 2, 3 }, { 3, 2, 4 }, { 3, 4, 5 } },
			0);
		a.addGroup(driven("sides", dofs(a, 0, [](const Vec2&) { return true; }), 0));
		std::vector<int> top { 9, 11 };
		a.addGroup(force ? pushed("platen", top, 0) : driven("platen", top, 0));
		a.addGroup(pushed("middle", { 5, 7 }, 0)); // free, but straight
		a.addGroup(pushed("foot", { 1, 3 }, 0));
		return a;
	};
	// The bar by hand, E = 20e9, areas 1, nu = 0; masses lumped per layer in halves: 1010 in the middle, 10 on top, 1000 below.
	// Platen against middle: k = E/0.01 = 2e12; omega^2 is nearly k (1/10 + 1/1010), less than 1 % from the other layer.
	const Real    limit = 2 / std::sqrt(2e12 * (1 / 10. + 1 / 1010.));
	BlockAssembly a     = build(true);
	EXPECT_LT(stableTimeStep(a, nodalStiffness(a), a.state.inertia), limit * 1.01);
	BlockAssembly held = build(false); // then middle and foot remain; still bounded by their own rows
	EXPECT_GE(stableTimeStep(held, nodalStiffness(held), held.state.inertia), stableTimeStep(a, nodalStiffness(a), a.state.inertia));
}

TEST(TimeStep, DrivenNodesDoNotCount)
{
	BlockAssembly     a = column(2, 0.5, 0.2, 2, 1, stone(), elasticJoint(100e9, 40e9));
	std::vector<Real> K = nodalStiffness(a);
	K[4] *= 1e6; // makes this node the fastest by far
	const Real fast = stableTimeStep(a, K, a.state.inertia);
	EXPECT_NEAR(fast, 2 * std::sqrt(a.state.inertia[4] / K[4]), 8 * eps * fast);
	a.addGroup(driven("x", { 8 }, 0));
	EXPECT_EQ(stableTimeStep(a, K, a.state.inertia), fast); // y is still free
	a.addGroup(driven("y", { 9 }, 0));
	EXPECT_GT(stableTimeStep(a, K, a.state.inertia), 100 * fast);
}

TEST(TimeStep, RefusesBadInput)
{
	BlockAssembly a = column(2, 0.5, 0.2, 1, 1, stone(), elasticJoint(1, 1));
	const auto    K = nodalStiffness(a);
	expectRefusal([&] { scaleInertia(a, K, 0, 0.7); }, { "time step", "positive [s]", "got 0" });
	expectRefusal([&] { scaleInertia(a, K, std::nan(""), 0.7); }, { "time step", "nan" });
	expectRefusal([&] { scaleInertia(a, K, 1, -0.5); }, { "safety", "positive", "got -0.5" });
	EXPECT_EQ(a.state.inertia, a.mesh.mass);
}

TEST(Convergence, StandingPWaveBar)
{
	// A bar of length 1 held sideways, free at both ends: omega = pi c, c^2 = E'/rho, E' = 20e9 x 0.8/(1.2 x 0.6), of the first axial
	// mode. n cells with lumped masses: omega_n = 2 n c sin(pi/(2n)) if cross-sections stay plane: error (pi/n)^2/24. The two
	// triangles of a cell lump masses unequally and so shear a little: another term of the same order. Observed order 2.
	const Real exact = M_PI * std::sqrt(20e9 * 0.8 / (1.2 * 0.6) / 2000);
	auto       error = [&](int n) {
                BlockAssembly a;
                a.addMaterial(stone());
                a.strain = Strain::small;
                addGrid(a, { 0, 0 }, 1, 0.1, n, 1);
                a.addGroup(driven("y", dofs(a, 1, [](const Vec2&) { return true; }), 0));
                const Modes m = modes(a, 0.1);
                return std::abs(m.omega[1] - exact) / exact; // after the rigid mode
	};
	const Real coarse = error(8), fine = error(16), finer = error(32);
	EXPECT_LT(fine, std::pow(M_PI / 16, 2) / 24 * 2);
	EXPECT_NEAR(std::log2(coarse / fine), 2, 0.15);
	EXPECT_NEAR(std::log2(fine / finer), 2, 0.05);
}
