// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>

using namespace specimens;
using Matrix = Eigen::Matrix<Real, 2, 2>;

namespace {

constexpr Real width = 1.0, height = 0.8, thickness = 0.5;

Real shortestEdge(const BlockAssembly& a)
{
	Real least = 1e300;
	for (const auto& e : a.mesh.edgeNodes)
		least = std::min(least, (a.mesh.reference[e[1]] - a.mesh.reference[e[0]]).norm());
	return least;
}

void addTractions(BlockAssembly& a, const Matrix& P)
{
	forEachOuterEdge(a, width, height, [&](int edge, const Vec2& normal) { addTraction(a, edge, P * normal); });
}

/// Joint stiffnesses kappa / (distance of the two cells' seeds).
void setStiffnesses(BlockAssembly& a, const std::vector<Vec2>& seeds, Real kappaN, Real kappaS)
{
	for (size_t pair = 0; pair < a.joints.pairs.size(); ++pair) {
		const auto& b = a.joints.pairs[pair].block;
		const Real  d = (seeds[b[1]] - seeds[b[0]]).norm();
		a.setJoints(a.joints.pairs[pair].first, a.joints.pairs[pair].last, elasticJoint(kappaN / d, kappaS / d));
	}
}

} // namespace

// A uniform stress P puts the traction P n on every joint. A joint of kn = ks = kappa/d opens by the vector P n d/kappa. In a
// Voronoi tessellation n = (s_j - s_i)/d with the cells' seeds s, d apart: the jump is P (s_j - s_i)/kappa, and cell i moved by
// P s_i/kappa makes all jumps at once. So x = U X + P s_i/kappa is the exact answer of any Voronoi tessellation whatever its zones,
// at any strain: cells' edges stay parallel, their areas are those of the reference, and kn = ks has no couple.
TEST(Patch, UniformStressThroughAnyVoronoiTessellation)
{
	std::vector<Vec2> seeds;
	BlockAssembly     a = voronoi(width, height, 5, 4, stone(), elasticJoint(1, 1), thickness, &seeds);
	ASSERT_EQ(a.blockCount(), 20);
	const Real kappa = 30e9;
	setStiffnesses(a, seeds, kappa, kappa);

	const Matrix     U      = (Matrix() << 1.02, 0.007, 0.007, 0.99).finished();
	const Moduli     moduli = planeModuli(stone().young, stone().poisson, Plane::strain);
	const ZoneStress s      = zoneStress(moduli, { 0.02, -0.01, 0.007, 1, 0 });
	const Matrix     P      = (Matrix() << s.sxx, s.sxy, s.sxy, s.syy).finished();
	addTractions(a, P);
	for (int block = 0; block < a.blockCount(); ++block)
		for (int n = a.mesh.firstNode[block]; n < a.mesh.firstNode[block + 1]; ++n)
			a.place(n, U * a.mesh.reference[n] + P * seeds[block] / kappa);
	computeForces(a);
	// Strains come from differences of positions of order 1 over the shortest edge: 20 roundings; times E' and an edge x thickness.
	const Real rounding = 20 * eps / shortestEdge(a) * (moduli.lambda + 2 * moduli.mu) * 0.3 * thickness;
	EXPECT_LT(rounding, 1e-6 * P.norm() * thickness * 0.2) << "of the forces in play";
	EXPECT_LT(largestForce(a), rounding);
}

TEST(Patch, DynamicRelaxationFindsIt)
{
	std::vector<Vec2> seeds;
	BlockAssembly     a     = voronoi(width, height, 4, 3, stone(), elasticJoint(1, 1), thickness, &seeds, 11);
	const Real        kappa = 30e9;
	setStiffnesses(a, seeds, kappa, kappa);
	const Moduli     moduli = planeModuli(stone().young, stone().poisson, Plane::strain);
	const Matrix     U      = (Matrix() << 1 + 3e-4, 1e-4, 1e-4, 1 + 2e-4).finished(); // stretched both ways: dead loads then hold it
	const ZoneStress s      = zoneStress(moduli, { 3e-4, 2e-4, 1e-4, 1, 0 });
	const Matrix     P      = (Matrix() << s.sxx, s.sxy, s.sxy, s.syy).finished();
	addTractions(a, P);
	std::vector<Vec2> exact;
	for (int n = 0; n < a.nodeCount(); ++n)
		exact.push_back(U * a.mesh.reference[n] + P * seeds[a.blockOfNode(n)] / kappa);

	// Three degrees of freedom are held where they belong, so that nothing moves as a whole; they take no force.
	std::vector<int> held = dofs(a, 1, [](const Vec2& x) { return x.norm() < 1e-9 || (x - Vec2(width, 0)).norm() < 1e-9; });
	held.push_back(dofs(a, 0, [](const Vec2& x) { return x.norm() < 1e-9; }).front());
	ASSERT_EQ(held.size(), 3u);
	for (int dof : held)
		a.state.displacement[dof / 2][dof % 2] = (exact[dof / 2] - a.mesh.reference[dof / 2])[dof % 2];
	a.addGroup(driven("held", held, 0));
	scaleInertia(a, nodalStiffness(a), 1, 0.7);
	Damping damping;
	damping.alpha   = 0.7;
	const int steps = relax(a, damping, 1, 1e-9, 20000);
	ASSERT_GT(steps, 0) << "did not settle";
	// What is unbalanced by 1e-9 of the contact forces is wrong by that times the number of nodes across squared (100), by and large.
	// Displacements are of order 1e-3.
	for (int n = 0; n < a.nodeCount(); ++n)
		EXPECT_LT((a.position(n) - exact[n]).norm(), 1e-10) << "node " << n;
	for (int z = 0; z < a.zoneCount(); ++z) {
		const ZoneStress t = stressOfZone(a, z);
		EXPECT_NEAR(t.sxx, s.sxx, s.sxx * 1e-6) << "zone " << z;
		EXPECT_NEAR(t.syy, s.syy, s.sxx * 1e-6) << "zone " << z;
		EXPECT_NEAR(t.sxy, s.sxy, s.sxx * 1e-6) << "zone " << z;
	}
	for (size_t i = 0; i < a.state.status.size(); ++i) { // Joints' stresses are the components of P n0 in the present frame; n0, the normal
		const Vec2       d = seeds[a.joints.segments[i / 2].block[1]] - seeds[a.joints.segments[i / 2].block[0]], n0 = d.normalized(); // at the start
		const JointFrame frame = frameOf(a, int(i / 2));
		const Vec2       n(frame.nx, frame.ny), t(-n.y(), n.x());
		EXPECT_NEAR(a.state.sigma[i], n.dot(P * n0), s.sxx * 1e-6);
		EXPECT_NEAR(a.state.tau[i], t.dot(P * n0), s.sxx * 1e-6);
	}
}

// Under a hydrostatic stress there is no shear on any joint, so that ks is free.
TEST(Patch, HydrostaticStressWhateverTheShearStiffness)
{
	std::vector<Vec2> seeds;
	BlockAssembly     a     = voronoi(width, height, 5, 4, stone(), elasticJoint(1, 1), thickness, &seeds, 5);
	const Real        kappa = 30e9, e = -0.013;
	setStiffnesses(a, seeds, kappa, 0.37 * kappa);
	const Moduli moduli = planeModuli(stone().young, stone().poisson, Plane::strain);
	const Real   p      = 2 * (moduli.lambda + moduli.mu) * e;
	addTractions(a, p * Matrix::Identity());
	for (int block = 0; block < a.blockCount(); ++block)
		for (int n = a.mesh.firstNode[block]; n < a.mesh.firstNode[block + 1]; ++n)
			a.place(n, (1 + e) * a.mesh.reference[n] + p / kappa * seeds[block]);
	computeForces(a);
	EXPECT_LT(largestForce(a), 20 * eps / shortestEdge(a) * (moduli.lambda + 2 * moduli.mu) * 0.3 * thickness);
}

// Joints of one stiffness everywhere disturb the uniform stress by an amount that goes as 1/k: ten times stiffer, a tenth of it,
// to first order in E/(k s) = 0.01 (s the cell size).
TEST(Patch, StiffJointsApproachTheContinuum)
{
	const Matrix P           = (Matrix() << 3e4, 1e4, 1e4, -2e4).finished(); // small, so that nothing but 1/k matters
	auto         disturbance = [&](Real k) {
                BlockAssembly a = voronoi(width, height, 4, 3, stone(), elasticJoint(k, k / 2), thickness, nullptr, 11);
                addTractions(a, P);
                solveStatics(a, 1e-6, true);
                Real worst = 0;
                for (int z = 0; z < a.zoneCount(); ++z) {
                        const ZoneStress s = stressOfZone(a, z);
                        worst              = std::max({ worst, std::abs(s.sxx - P(0, 0)), std::abs(s.syy - P(1, 1)), std::abs(s.sxy - P(0, 1)) });
                }
                return worst / 3e4;
	};
	const Real k = 20e9 / 0.25 / 0.01, soft = disturbance(k), stiff = disturbance(10 * k);
	EXPECT_LT(soft, 0.1); // 10 E/(k s): the zones at short edges take most
	EXPECT_NEAR(soft / stiff, 10, 10 * 5 * 0.01 + 0.1);
}

TEST(Patch, ColumnIsSpringsInSeries)
{
	// Laterally held, plane strain: E' = E(1-nu)/((1+nu)(1-2nu)); free with nu = 0, plane stress: E' = E.
	// Pushed by a platen: displacement = F/(w t) (n h/E' + (n-1)/kn), exact: strains are linear in U - 1 and areas the reference's.
	for (const bool held : { true, false }) {
		SCOPED_TRACE(held ? "held" : "free");
		const Material m { 20e9, held ? 0.2 : 0.0, 2000 };
		const int      n  = 4;
		const Real     kn = 150e9, F = -3e5, w = 0.3, h = 0.2;
		BlockAssembly  a   = column(n, w, h, 2, 1, m, elasticJoint(kn, 0.4 * kn), thickness);
		a.plane            = held ? Plane::strain : Plane::stress;
		const Real modulus = held ? 20e9 * 0.8 / (1.2 * 0.6) : 20e9;
		if (held)
			a.addGroup(driven("sides", dofs(a, 0, [](const Vec2&) { return true; }), 0));
		else
			a.addGroup(driven("corner", { 0 }, 0));
		a.addGroup(driven("foot", dofs(a, 1, [](const Vec2& x) { return x.y() == 0; }), 0));
		const int top = a.addGroup(pushed("platen", dofs(a, 1, [&](const Vec2& x) { return x.y() > n * h - 1e-6; }), F));
		scaleInertia(a, nodalStiffness(a), 1, 0.7);
		Damping damping;
		damping.alpha = 0.7;
		ASSERT_GT(relax(a, damping, 1, 1e-11, 50000), 0) << "did not settle";
		const Real expected = F / (w * thickness) * (n * h / modulus + (n - 1) / kn);
		// unbalanced 1e-11 of contact forces, amplified by (nodes in the column)^2 = 64 at worst; positions of order 1 round by eps
		EXPECT_NEAR(a.state.groups[top].travelled, expected, std::abs(expected) * 1e-9 + 50 * eps);
		for (Real sigma : a.state.sigma)
			EXPECT_NEAR(sigma, F / (w * thickness), 2e6 * 1e-8);

		// reactions: the unbalanced force of the foot's degrees of freedom is what the support takes
		Real reaction = 0;
		for (int dof : a.state.groups[1].dofs)
			reaction += a.forces.nodal[dof / 2][dof % 2];
		EXPECT_NEAR(reaction, F, 3e5 * 1e-8);
	}
}
