// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/step/InSitu.hpp>

using namespace specimens;

namespace {

/// Edges of the outline of all: those without joints.
std::vector<int> outerEdges(const BlockAssembly& a)
{
	std::vector<int> list;
	for (int e = 0; e < int(a.mesh.edgeNodes.size()); ++e) {
		bool bonded = false;
		for (const Segment& g : a.joints.segments)
			bonded = bonded || g.node[0] == a.mesh.edgeNodes[e][0] || g.node[2] == a.mesh.edgeNodes[e][0];
		if (!bonded) list.push_back(e);
	}
	return list;
}

BlockAssembly rock(unsigned seed = 7) { return voronoi(3, 2, 5, 4, stone(), elasticJoint(5e9, 2e9), 0.7, nullptr, seed); }

} // namespace

TEST(InSitu, InEquilibriumNothingMoves)
{
	// Uniform, and linear with weight: syy = rho g (y - 2), K0 = 0.6, with shear. Residuals are sums of forces of 2e6 Pa x 0.7 m x 0.6 m that round by a
	// few eps each, of coordinates that do so, too.
	const Real weight = 2000 * 9.81;
	for (const InSituStress& field :
	     { InSituStress { { -2e6, -3e6, 0.7e6 }, {}, 0 }, InSituStress { { -0.4e6, -0.2e6, 0.1e6 }, { 0.6 * weight, weight, 0 }, 2 } }) {
		BlockAssembly a = rock();
		setInSitu(a, field);
		if (field.gradient.syy > 0) addGravity(a, { 0, -9.81 });
		for (int e : outerEdges(a))
			addInSituTraction(a, e, field);
		Real loads = 0;
		for (const Vec2& f : a.supports.load)
			loads = std::max(loads, f.norm());
		computeForces(a);
		EXPECT_GT(loads, 1e4);
		EXPECT_LT(largestForce(a), 1e3 * eps * 3e6);
		for (int block = 0; block < a.blockCount(); ++block)
			for (int z = a.mesh.firstZone[block]; z < a.mesh.firstZone[block + 1]; ++z) {
				Real y = 0;
				for (int n : a.mesh.zoneNodes[z])
					y += a.mesh.reference[n].y() / 3;
				const ZoneStress s = cauchyStress(a, block, z), expected = field(y);
				EXPECT_NEAR(s.sxx, expected.sxx, 1e3 * eps * 3e6);
				EXPECT_NEAR(s.syy, expected.syy, 1e3 * eps * 3e6);
				EXPECT_NEAR(s.sxy, expected.sxy, 1e3 * eps * 3e6);
			}
	}
}

TEST(InSitu, EnergyIsKnown)
{
	// A column of two bricks, 0.8 x 0.5 x 2, nu = 0: syy = -2e6 holds syy^2/(2E) in its volume and sigma^2/(2 kn) on the joint.
	for (const Strain kind : { Strain::small, Strain::large }) {
		BlockAssembly a = column(2, 0.8, 0.5, 2, 1, { 20e9, 0, 2000 }, elasticJoint(100e9, 40e9), 2);
		a.strain        = kind;
		setInSitu(a, { { 0, -2e6, 0.5e6 }, {}, 0 });
		blocks::computeForces(a, Brittle {}, 0, true);
		const Real zones = 4e12 / 40e9 * 1.6 + 0.25e12 / (2 * 10e9) * 1.6, joints = (4e12 / 200e9 + 0.25e12 / 80e9) * 1.6;
		EXPECT_NEAR(zoneEnergy(a), zones, 1e-12 * zones);
		EXPECT_NEAR(sumOf(a.forces.zoneEnergy), zones, 1e-12 * zones);
		EXPECT_NEAR(jointEnergy(a), joints, 1e-12 * joints);
		EXPECT_NEAR(bookedJointEnergy(a), joints, 1e-12 * joints);
		EXPECT_NEAR(a.state.accounts.friction, 0, 1e-12 * joints);
		EXPECT_NEAR(a.state.accounts.fracture, 0, 1e-12 * joints);
	}
}

TEST(InSitu, ForcesAreTheGradientOfTheEnergyAndTurnWithTheBlocks)
{
	BlockAssembly a = rock();
	setInSitu(a, { { -40e6, -90e6, 25e6 }, { 3e6, 5e6, -2e6 }, 0.4 });
	std::mt19937                         random(2);
	std::uniform_real_distribution<Real> shift(-2e-3, 2e-3);
	rotateAbout(a, { 0.3, 0.2 }, 0.8, { 0.2, -0.1 });
	for (int n = 0; n < a.nodeCount(); ++n)
		a.state.displacement[n] += Vec2(shift(random), shift(random));
	computeForces(a);
	const auto forces = a.forces.nodal;
	const Real scale  = largestForce(a);
	EXPECT_LT(totalForce(a).norm(), 1e4 * eps * scale);
	EXPECT_LT(std::abs(totalMoment(a)), 1e5 * eps * scale);
	const Real d = 1e-6; // central differences: d^2 of a third derivative, and energies of 1e6 J by eps/d: 1e-4 N of 1e7
	for (int dof : { 0, 7, 12, 31, 44 }) {
		Real& x = a.state.displacement[dof / 2][dof % 2];
		x += d;
		computeForces(a);
		const Real above = specimens::storedEnergy(a);
		x -= 2 * d;
		computeForces(a);
		const Real below = specimens::storedEnergy(a);
		x += d;
		EXPECT_NEAR(forces[dof / 2][dof % 2], -(above - below) / (2 * d), 1e-6 * scale);
	}
	// turned once more, all forces turn with it
	const Real angle = 2.1;
	rotateAbout(a, { 0, 0 }, angle, { 0, 0 });
	computeForces(a);
	for (int n = 0; n < a.nodeCount(); ++n) {
		const Vec2& f = forces[n];
		EXPECT_LT(
			(a.forces.nodal[n] - Vec2(std::cos(angle) * f.x() - std::sin(angle) * f.y(), std::sin(angle) * f.x() + std::cos(angle) * f.y())).norm(),
			1e5 * eps * scale);
	}
}

TEST(InSitu, BoundsTheStep)
{
	// Stresses of a tenth of E, far beyond any rock's: the bound holds.
	for (const Real sign : { -1., 1. }) {
		BlockAssembly a = rock();
		setInSitu(a, { { sign * 2e9, sign * 1e9, 0.5e9 }, {}, 0 });
		EXPECT_LE(stableTimeStep(a, nodalStiffness(a), a.state.inertia), 2 / modes(a, 1e-7).omega.maxCoeff());
	}
}

TEST(InSitu, Refusals)
{
	BlockAssembly a = rock();
	expectRefusal([&] { setInSitu(a, { { std::nan(""), 0, 0 }, {}, 0 }); }, { "stresses in situ must be finite" });
	a.state.displacement[3].x() = 0.5;
	expectRefusal([&] { setInSitu(a, { { 1, 0, 0 }, {}, 0 }); }, { "before anything moves", "0.5" });
	JointParams weak = elasticJoint(5e9, 2e9);
	weak.tension = 1e5, weak.cohesion = 1e6;
	BlockAssembly b = voronoi(3, 2, 5, 4, stone(), weak, 0.7);
	expectRefusal([&] { setInSitu(b, { { 2e5, 2e5, 0 }, {}, 0 }); }, { "the joint between blocks", "must be able to carry", "200000" });
	EXPECT_TRUE(b.mesh.inSitu.empty() && b.joints.inSituOpening.empty());
	BlockAssembly c = column(2, 1, 1, 1, 1, stone(), elasticJoint(1, 1));
	c.bond(detectSegments(c));
	expectRefusal([&] { setInSitu(c, { { 0, -1, 0 }, {}, 0 }); }, { "joints that have their properties" });
}
