// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>

using namespace specimens;
using Matrix = Eigen::Matrix<Real, 2, 2>;

namespace {

constexpr Real width = 1.0, height = 0.8, thickness = 0.5;

} // namespace

TEST(BlockAssembly, MassesRangesCentroid)
{
	BlockAssembly a;
	a.thickness = 0.5;
	a.addMaterial(stone());
	a.addMaterial({ 1e9, 0.3, 1250 });
	addGrid(a, { 0, 0 }, 0.4, 0.3, 2, 3);
	addGrid(a, { 0.4, 0 }, 0.7, 0.3, 1, 2, 1);
	const int rigid   = a.addBlock({ { 0, -1 }, { 1, -1 }, { 1, 0 }, { 0, 0 } }, { { 0, 1, 2, 3 } }, {}, 0);
	Real      mass[3] = { 0, 0, 0 };
	for (int n = 0; n < a.nodeCount(); ++n)
		mass[a.blockOfNode(n)] += a.mesh.mass[n];
	EXPECT_NEAR(mass[0], 2000 * 0.4 * 0.3 * 0.5, 1e-12 * 120); // 12 zones x a few roundings each: 100 eps < 1e-12
	EXPECT_NEAR(mass[1], 1250 * 0.7 * 0.3 * 0.5, 1e-12 * 120);
	EXPECT_EQ(mass[rigid], 0);
	EXPECT_EQ(a.supports.mobility[a.mesh.firstNode[rigid]], Vec2::Zero());
	EXPECT_EQ(a.mesh.firstZone, (std::vector<int> { 0, 12, 16, 16 }));
	EXPECT_EQ(a.mesh.firstEdge, (std::vector<int> { 0, 10, 16, 20 }));
	EXPECT_NEAR((a.centroid(rigid) - Vec2(0.5, -0.5)).norm(), 0, 4 * eps);

	// a triangle's mass is lumped in thirds, so the centroid is the triangle's
	BlockAssembly one;
	one.addMaterial(stone());
	one.addBlock({ { 10, 2 }, { 11, 2.5 }, { 10.3, 4 } }, { { 0, 1, 2 } }, { { 0, 1, 2 } }, 0);
	EXPECT_NEAR((one.centroid(0) - Vec2(31.3, 8.5) / 3).norm(), 0, 40 * eps);
	EXPECT_EQ(one.firstBadNode(), -1);
	one.state.velocity[1].y() = std::nan("");
	EXPECT_EQ(one.firstBadNode(), 1);
}

TEST(BlockAssembly, GravityAndTractionsAddUp)
{
	BlockAssembly a = twoBlocks(elasticJoint(1e9, 1e9), 0.7);
	addGravity(a, { 0.5, -9.81 });
	addTraction(a, 1, { 3, 7 }); // nodes 1 and 2, of length sqrt(0.73)
	addTraction(a, 1, { 0, 1 });
	Real mass = 0;
	for (Real m : a.mesh.mass)
		mass += m;
	computeForces(a);
	const Real length = std::sqrt(0.73), rounding = 200 * eps * 2e4; // 20 terms, the weight is about 2e4 N
	EXPECT_NEAR(totalForce(a).x(), 0.5 * mass + 3 * length * 0.7, rounding);
	EXPECT_NEAR(totalForce(a).y(), -9.81 * mass + 8 * length * 0.7, rounding);
	EXPECT_NEAR(a.supports.load[1].x() - 0.5 * a.mesh.mass[1], 3 * length * 0.7 / 2, rounding); // half on each node
	EXPECT_NEAR(a.supports.load[2].y() + 9.81 * a.mesh.mass[2], 8 * length * 0.7 / 2, rounding);

	// the joint and zones make no force of their own at rest: the undeformed specimen has only its loads
	for (int n = 0; n < a.nodeCount(); ++n)
		EXPECT_LT((a.forces.nodal[n] - a.supports.load[n]).norm(), 100 * eps * 20e9); // strains of 100 roundings times E
}

TEST(BlockAssembly, AllForcesAreTheGradientOfTheStoredEnergy)
{
	// Zones and joints together, gathered: what one node gets is minus the derivative of zoneEnergy + jointEnergy.
	// Central differences d = 1e-6: truncation d^2/6 U''' ~ 1e-12/6 x 1e3, rounding eps U/d = 2e-16 x 10/1e-6 = 2e-9: times 5.
	for (const Strain strain : { Strain::large, Strain::small }) {
		BlockAssembly a;
		a.thickness = 0.7;
		a.strain    = strain;
		a.addMaterial({ 20, 0.2, 1 });
		a.addMaterial({ 50, 0.3, 1 });
		addFan(a, { { 0, 0.1 }, { 1, 0 }, { 1.3, 0.8 }, { 0.2, 0.9 } });
		addFan(a, { { 1, 0 }, { 2.1, -0.2 }, { 1.9, 0.4 }, { 1.8, 1.0 }, { 1.3, 0.8 } }, 1);
		bondAll(a, elasticJoint(70, 30));
		std::mt19937                         random(5);
		std::uniform_real_distribution<Real> shift(-0.08, 0.08);
		for (Vec2& x : a.state.displacement) {
			const Real dx = shift(random), dy = shift(random);
			x += Vec2(dx, dy);
		}
		computeForces(a);
		const std::vector<Vec2> f = a.forces.nodal;
		const Real              d = 1e-6;
		for (int n = 0; n < a.nodeCount(); ++n)
			for (int axis : { 0, 1 }) {
				const Real at                 = a.state.displacement[n][axis];
				a.state.displacement[n][axis] = at + d;
				computeForces(a);
				const Real ahead              = specimens::storedEnergy(a);
				a.state.displacement[n][axis] = at - d;
				computeForces(a);
				const Real behind             = specimens::storedEnergy(a);
				a.state.displacement[n][axis] = at;
				EXPECT_NEAR(f[n][axis], -(ahead - behind) / (2 * d), 1e-8) << "node " << n << " axis " << axis;
			}
	}
}

TEST(BlockAssembly, GatheringAddsEveryZoneOfEveryMaterial)
{
	// More zones than the kernel takes at a time, two materials in turn: against one zone after the other. Terms of order
	// 50 x 0.1 x 0.1, a dozen a node.
	for (const Strain strain : { Strain::large, Strain::small }) {
		BlockAssembly a;
		a.strain    = strain;
		a.thickness = 0.7;
		a.addMaterial({ 20, 0.2, 1 });
		a.addMaterial({ 50, 0.3, 1 });
		addGrid(a, { 0, 0 }, 1, 1, 9, 9, 0);
		addGrid(a, { 1, 0 }, 1, 1, 4, 4, 0);
		addGrid(a, { 2, 0 }, 1, 1, 2, 1, 1);
		addGrid(a, { 3, 0 }, 1, 1, 7, 5, 0);
		std::mt19937                         random(5);
		std::uniform_real_distribution<Real> shift(-0.02, 0.02);
		for (Vec2& x : a.state.displacement) {
			const Real dx = shift(random), dy = shift(random);
			x += Vec2(dx, dy);
		}
		rotateAbout(a, { 1, 1 }, strain == Strain::large ? 1.1 : 0, { 0, 0 });
		std::vector<Vec2> f(a.nodeCount(), Vec2::Zero());
		for (int block = 0; block < a.blockCount(); ++block)
			for (int z = a.mesh.firstZone[block]; z < a.mesh.firstZone[block + 1]; ++z) {
				const Material& m    = a.mesh.materials[a.mesh.blockMaterial[block]];
				const auto&     node = a.mesh.zoneNodes[z];
				const auto&     u    = a.state.displacement;
				const Vec2      p = u[node[1]] - u[node[0]], q = u[node[2]] - u[node[0]];
				const auto      g = a.mesh.zoneGradient[z];
				const auto      e = strain == Strain::large ? zoneStrain<Strain::large>(g, p.x(), p.y(), q.x(), q.y())
									    : zoneStrain<Strain::small>(g, p.x(), p.y(), q.x(), q.y());
				const auto      t = zoneStress(planeModuli(m.young, m.poisson, a.plane), e);
				const auto      k = strain == Strain::large ? zoneForces<Strain::large>(g, a.mesh.zoneVolume[z], t, e)
									    : zoneForces<Strain::small>(g, a.mesh.zoneVolume[z], t, e);
				f[node[1]] += Vec2(k.f1x, k.f1y);
				f[node[2]] += Vec2(k.f2x, k.f2y);
				f[node[0]] -= Vec2(k.f1x + k.f2x, k.f1y + k.f2y);
			}
		for (int threads : { 1, 2 }) {
			sumForces(a, false, threads);
			for (int n = 0; n < a.nodeCount(); ++n)
				EXPECT_LT((a.forces.nodal[n] - f[n]).norm(), 1000 * eps) << "node " << n;
		}
	}
}

TEST(BlockAssembly, CauchyStress)
{
	// F = R(0.6) U: sigma = R S U R^T / det U. Every entry unequal. E = 20: stresses of order 4, 30 roundings of strains.
	BlockAssembly a;
	a.thickness = 0.7;
	a.addMaterial({ 20, 0.3, 1 });
	addFan(a, { { 0, 0.1 }, { 1, 0 }, { 1.3, 0.8 }, { 0.2, 0.9 } });
	addFan(a, { { 1, 0 }, { 2.1, -0.2 }, { 1.9, 0.4 }, { 1.3, 0.8 } });
	const Matrix U = (Matrix() << 1.11, 0.07, 0.07, 0.94).finished();
	const Matrix R = (Matrix() << std::cos(0.6), -std::sin(0.6), std::sin(0.6), std::cos(0.6)).finished();
	for (int n = 0; n < a.nodeCount(); ++n)
		a.place(n, R * U * a.mesh.reference[n]);
	const ZoneStress s        = zoneStress(planeModuli(20, 0.3, Plane::strain), { 0.11, -0.06, 0.07, 1, 0 });
	const Matrix     S        = (Matrix() << s.sxx, s.sxy, s.sxy, s.syy).finished();
	const Matrix     expected = R * S * U * R.transpose() / U.determinant();
	for (int block : { 0, 1 })
		for (int z = a.mesh.firstZone[block]; z < a.mesh.firstZone[block + 1]; ++z) {
			const ZoneStress t = cauchyStress(a, block, z);
			EXPECT_NEAR(t.sxx, expected(0, 0), 1e-12);
			EXPECT_NEAR(t.syy, expected(1, 1), 1e-12);
			EXPECT_NEAR(t.sxy, expected(0, 1), 1e-12);
		}
	a.strain               = Strain::small; // no rotation is taken out: sigma of sym(F) - 1
	const Matrix     F     = R * U;
	const ZoneStress t     = cauchyStress(a, 1, a.mesh.firstZone[1]),
			 small = zoneStress(planeModuli(20, 0.3, Plane::strain), { F(0, 0) - 1, F(1, 1) - 1, (F(0, 1) + F(1, 0)) / 2, 1, 0 });
	EXPECT_NEAR(t.sxx, small.sxx, 1e-12);
	EXPECT_NEAR(t.syy, small.syy, 1e-12);
	EXPECT_NEAR(t.sxy, small.sxy, 1e-12);
}

TEST(BlockAssembly, RebuiltFromWhatMustBeKept)
{
	// What O.save leaves out is computed again: forces to the bit.
	BlockAssembly a = voronoi(width, height, 4, 3, stone(), elasticJoint(100e9, 40e9), thickness);
	a.addGroup(driven("foot", dofs(a, 1, [](const Vec2& x) { return x.y() == 0; }), 0));
	for (int n = 0; n < a.nodeCount(); ++n) {
		const Vec2& x           = a.mesh.reference[n];
		a.state.displacement[n] = 1e-5 * Vec2(std::sin(7 * x.y()), x.x() * x.y());
	}
	computeForces(a);
	BlockAssembly b     = a;
	b.mesh.zoneGradient = {}, b.mesh.zoneVolume.clear(), b.mesh.isFan.clear(), b.supports.mobility.clear(), b.forces = {};
	b.joints.node.clear(), b.joints.columns = {}, b.joints.effective.clear(), b.joints.kindOfBatch.clear(), b.joints.blocksOfBatch.clear();
	b.rebuild();
	EXPECT_TRUE(b.supports.mobility == a.supports.mobility);
	computeForces(b);
	EXPECT_TRUE(b.forces.nodal == a.forces.nodal);
}

TEST(BlockAssembly, SameBitsOnAnyNumberOfThreads)
{
	// 400 cells, some 3000 nodes: more than one range of the integrator, and blocks enough to share out.
	struct Run {
		std::vector<Vec2> displacement, velocity;
		Real              c = 0, damping = 0, kinetic = 0;
	};
	for (const auto kind : { Damping::Kind::none, Damping::Kind::local, Damping::Kind::adaptive }) {
		std::vector<Run> runs;
		for (int threads : { 1, 2, 3 }) {
			JointParams joint = elasticJoint(100e9, 40e9);
			joint.tension = joint.cohesion = 2e5; // some break on the way
			BlockAssembly a                = voronoi(width, height, 20, 20, stone(), joint, thickness);
			ASSERT_GT(2 * a.nodeCount(), 4096);
			std::mt19937                         random(5);
			std::uniform_real_distribution<Real> shift(-1e-6, 1e-6);
			for (Vec2& x : a.state.displacement) {
				const Real dx = shift(random), dy = shift(random);
				x += Vec2(dx, dy);
			}
			a.addGroup(driven("foot", dofs(a, 1, [](const Vec2& x) { return x.y() == 0; }), 0));
			a.addGroup(pushed("head", dofs(a, 1, [](const Vec2& x) { return x.y() == height; }), -1e5));
			scaleInertia(a, nodalStiffness(a), 1e-5, 0.7);
			Damping damping;
			damping.kind = kind;
			Run run;
			for (int i = 0; i < 30; ++i) {
				computeForces(a, threads);
				const StepWork work = move(a, damping, 1e-5, i * 1e-5, true, threads);
				run.damping += work.dampingBefore + work.dampingAfter, run.kinetic += work.kinetic;
			}
			run.displacement = a.state.displacement, run.velocity = a.state.velocity, run.c = a.state.viscosity;
			runs.push_back(run);
			int broken = 0;
			for (Joint status : a.state.status)
				broken += status != Joint::intact;
			EXPECT_GT(broken, 0);
		}
		for (int i : { 1, 2 }) {
			EXPECT_TRUE(runs[i].displacement == runs[0].displacement) << i + 1 << " threads";
			EXPECT_TRUE(runs[i].velocity == runs[0].velocity);
			EXPECT_EQ(runs[i].c, runs[0].c);
			EXPECT_EQ(runs[i].damping, runs[0].damping);
			EXPECT_EQ(runs[i].kinetic, runs[0].kinetic);
		}
	}
}

TEST(BlockAssembly, RefusesBadInput)
{
	const Real    nan = std::nan(""), inf = 1 / Real(0);
	BlockAssembly a;
	expectRefusal([&] { a.addMaterial({ 0, 0.2, 2000 }); }, { "young", "positive and finite [Pa]", "got 0" });
	expectRefusal([&] { a.addMaterial({ inf, 0.2, 2000 }); }, { "young", "inf" });
	expectRefusal([&] { a.addMaterial({ 1e9, 0.5, 2000 }); }, { "poisson", "(-1, 0.5)", "got 0.5" });
	expectRefusal([&] { a.addMaterial({ 1e9, -1, 2000 }); }, { "poisson", "(-1, 0.5)", "got -1" });
	expectRefusal([&] { a.addMaterial({ 1e9, nan, 2000 }); }, { "poisson", "nan" });
	expectRefusal([&] { a.addMaterial({ 1e9, 0.2, -7 }); }, { "density", "positive and finite [kg/m3]", "got -7" });
	EXPECT_TRUE(a.mesh.materials.empty());

	const std::vector<Vec2> square { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
	using Rings = std::vector<std::vector<int>>;
	using Zones = std::vector<std::array<int, 3>>;
	const Rings ring { { 0, 1, 2, 3 } };
	const Zones zones { { 0, 1, 2 }, { 0, 2, 3 } };
	expectRefusal([&] { a.addBlock(square, ring, zones, 0); }, { "material", "index of a known one", "got 0" });
	a.addMaterial(stone());
	expectRefusal([&] { a.addBlock(square, ring, zones, -1); }, { "material", "got -1" });
	expectRefusal([&] { a.addBlock(square, {}, zones, 0); }, { "outline", "got 0" });
	expectRefusal([&] { a.addBlock(square, Rings { { 0, 1 } }, zones, 0); }, { "outline", "at least 3", "got 2" });
	expectRefusal([&] { a.addBlock({ { 0, 0 }, { nan, 0 }, { 1, 1 }, { 0, 1 } }, ring, zones, 0); }, { "points", "finite", "nan" });
	expectRefusal([&] { a.addBlock(square, ring, Zones { { 0, 1, 4 }, { 0, 2, 3 } }, 0); }, { "zone's node", "got 4" });
	expectRefusal([&] { a.addBlock(square, ring, Zones { { 0, 2, 1 }, { 0, 2, 3 } }, 0); }, { "zone's area", "positive", "got -0.5" });
	expectRefusal([&] { a.addBlock(square, ring, Zones { { 0, 1, 2 } }, 0); }, { "every point", "zone", "got 0" });
	expectRefusal([&] { a.addBlock(square, Rings { { 0, 1, 2, 9 } }, zones, 0); }, { "outline's node", "got 9" });
	expectRefusal([&] { a.addBlock(square, Rings { { 3, 2, 1, 0 } }, zones, 0); }, { "counter-clockwise", "got -1" });
	expectRefusal([&] { a.addBlock({ { 0, 0 }, { 1, 0 }, { 1, 0 }, { 0, 1 } }, ring, Zones {}, 0); }, { "edges", "length", "got 0" });
	a.thickness = 0;
	expectRefusal([&] { a.addBlock(square, ring, zones, 0); }, { "thickness", "positive and finite [m]", "got 0" });
	a.thickness = nan;
	expectRefusal([&] { a.addBlock(square, ring, zones, 0); }, { "thickness", "nan" });
	a.thickness = 1;

	// what was refused has left nothing behind
	EXPECT_EQ(a.blockCount(), 0);
	EXPECT_EQ(a.nodeCount(), 0);
	EXPECT_EQ(a.zoneCount(), 0);
	EXPECT_TRUE(a.mesh.edgeNodes.empty() && a.mesh.zoneGradient.g1x.empty() && a.mesh.zoneVolume.empty() && a.mesh.mass.empty());

	a.addBlock(square, ring, zones, 0);
	expectRefusal([&] { addGravity(a, { 0, nan }); }, { "gravity", "finite [m/s2]", "nan" });
	expectRefusal([&] { addTraction(a, 4, { 1, 0 }); }, { "traction", "boundary edge", "got 4" });
	expectRefusal([&] { addTraction(a, -1, { 1, 0 }); }, { "traction", "boundary edge", "got -1" });
	expectRefusal([&] { addTraction(a, 0, { inf, 0 }); }, { "traction", "finite [Pa]" });
	EXPECT_TRUE(a.supports.load.empty());
}
