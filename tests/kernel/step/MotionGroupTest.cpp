// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>

using namespace specimens;

TEST(MotionGroup, SmoothStart)
{
	MotionGroup g = driven("g", { 0 }, 3, 2);
	g.startTime   = 10;
	EXPECT_EQ(g.ramp(9.9), 0);
	EXPECT_EQ(g.ramp(10), 0);
	EXPECT_NEAR(g.ramp(10.5), 0.15625, 4 * eps); // 3/16 - 2/64
	EXPECT_NEAR(g.ramp(11), 0.5, 4 * eps);
	EXPECT_EQ(g.ramp(12), 1);
	EXPECT_EQ(g.ramp(13), 1);
	g.rampTime = 0;
	EXPECT_EQ(g.ramp(9.9), 0);
	EXPECT_EQ(g.ramp(10), 1);
}

TEST(MotionGroup, DrivenBlocksGoWhereTheyAreTold)
{
	// After the ramp of T = 0.2 s the way is v (t - T/2): midpoint velocities integrate the ramp with an error of v dt^3/24 x [f''] =
	// v T (dt/T)^4 x 12/... below 1e-7 v T at 100 steps. The throttle halves the velocity from t = 0.5 s on.
	BlockAssembly a = triangle();
	const int     y = a.addGroup(driven("y", { 1, 3, 5 }, -0.6, 0.2));
	a.addGroup(driven("x", { 0, 2, 4 }, 0));
	const Real dt   = 0.002;
	Damping    none = damped(Damping::Kind::none);
	for (int i = 0; i < 500; ++i) {
		if (i == 250) a.state.groups[y].throttle = 0.5;
		integrate(a, none, dt, i * dt);
		if (i == 50) {
			EXPECT_NEAR(a.state.groups[y].velocity, -0.6 * a.state.groups[y].ramp(50.5 * dt), 4 * eps);
		}
	}
	const Real way = -0.6 * ((0.5 - 0.1) + 0.5 * 0.5);
	EXPECT_NEAR(a.state.groups[y].travelled, way, 0.6 * 0.2 * 1e-7);
	EXPECT_EQ(a.state.groups[y].velocity, -0.3);
	for (int n = 0; n < 3; ++n) {
		EXPECT_EQ(a.state.displacement[n].y(), a.state.groups[y].travelled); // the same sum
		EXPECT_EQ(a.state.displacement[n].x(), 0);
		EXPECT_EQ(a.state.velocity[n].y(), -0.3);
	}
}

TEST(MotionGroup, PlatenMovesAsOneUnderItsForce)
{
	// Two of three nodes joined in y, unequal in mass: acceleration = (sum of forces + applied) / sum of masses. The ramp counts at
	// the time of the forces.
	BlockAssembly a = triangle();
	a.state.inertia = { 2, 3, 5 };
	const int g     = a.addGroup(pushed("platen", { 5, 1 }, 40, 4));
	a.forces.nodal  = { { 1, -7 }, { 2, 6 }, { 3, 9 } };
	Damping none    = damped(Damping::Kind::none);
	integrate(a, none, 0.1, 2, true); // ramp(2) = 1/2
	EXPECT_NEAR(a.state.groups[g].velocity, (-7 + 9 + 20) / 7. * 0.1, 8 * eps);
	EXPECT_EQ(a.state.velocity[0].y(), a.state.groups[g].velocity);
	EXPECT_EQ(a.state.velocity[2].y(), a.state.groups[g].velocity);
	EXPECT_NEAR(a.state.velocity[1].y(), 6 / 3. * 0.1, 8 * eps);
	EXPECT_NEAR(a.state.velocity[2].x(), 3 / 5. * 0.1, 8 * eps);
	EXPECT_NEAR(a.state.groups[g].travelled, a.state.groups[g].velocity * 0.1, 8 * eps);
	EXPECT_EQ(a.state.groups[g].force, 20);

	// with damping: the group as a whole is what moves
	Damping local  = damped(Damping::Kind::local, 0.3);
	a.forces.nodal = { { 1, -7 }, { 2, 6 }, { 3, 9 } };
	Real before    = a.state.groups[g].velocity;
	integrate(a, local, 0.1, 4);
	EXPECT_NEAR(a.state.groups[g].velocity, before + 0.7 * (2 + 40) / 7. * 0.1, 16 * eps);
	Damping viscous   = damped(Damping::Kind::adaptive);
	a.state.viscosity = 4;
	before            = a.state.groups[g].velocity;
	integrate(a, viscous, 0.1, 4);
	EXPECT_NEAR(a.state.groups[g].velocity, (0.8 * before + 42 / 7. * 0.1) / 1.2, 16 * eps);
}

TEST(MotionGroup, ForceOnADrivenGroup)
{
	// What a driven group puts on the blocks: sum m a - sum F. From 0 to -0.5 m/s in one step of 0.1 s.
	BlockAssembly a = triangle();
	a.state.inertia = { 2, 3, 5 };
	const int g     = a.addGroup(driven("g", { 1, 5 }, -0.5));
	a.forces.nodal  = { { 1, -7 }, { 2, 6 }, { 3, 10 } };
	Damping none    = damped(Damping::Kind::none);
	integrate(a, none, 0.1, 0);
	EXPECT_NEAR(a.state.groups[g].force, -0.5 / 0.1 * 7 - 3, 40 * 4 * eps);
	integrate(a, none, 0.1, 0.1); // velocity kept: only -F
	EXPECT_NEAR(a.state.groups[g].force, -3, 40 * 4 * eps);
	// work: applied at n over half of each neighbouring step: -38 x (0 + -0.5)/2 x 0.1 at the first time, -3 x -0.5 x 0.05 so far
	EXPECT_NEAR(a.state.groups[g].work, 0.95 + 0.075, 40 * eps);
}

TEST(MotionGroup, RefusesBadInput)
{
	BlockAssembly a   = triangle();
	const Real    nan = std::nan("");
	a.addGroup(driven("foot", { 1, 3 }, 0));
	expectRefusal([&] { a.addGroup(driven("head", { 5, 3 }, 0)); }, { "\"head\"", "overlaps \"foot\"", "degree of freedom", "got 3" });
	expectRefusal([&] { a.addGroup(driven("head", {}, 0)); }, { "\"head\"", "at least one", "got 0" });
	expectRefusal([&] { a.addGroup(driven("head", { 4, 5, 4 }, 0)); }, { "\"head\"", "twice", "got 4" });
	expectRefusal([&] { a.addGroup(driven("head", { 6 }, 0)); }, { "\"head\"", "no such degree of freedom", "got 6" });
	expectRefusal([&] { a.addGroup(driven("head", { -1 }, 0)); }, { "\"head\"", "no such degree of freedom", "got -1" });
	expectRefusal([&] { a.addGroup(driven("head", { 5 }, nan)); }, { "\"head\"", "target", "finite", "nan" });
	expectRefusal([&] { a.addGroup(driven("head", { 5 }, 1, -0.25)); }, { "\"head\"", "rampTime", "not be negative [s]", "got -0.25" });
	const int rigid = a.addBlock({ { 0, -1 }, { 1, -1 }, { 0.5, -0.5 } }, { { 0, 1, 2 } }, {}, 0);
	expectRefusal([&] { a.addGroup(pushed("head", { 2 * a.mesh.firstNode[rigid] }, 1)); }, { "\"head\"", "rigid block", "got " });
	EXPECT_EQ(a.state.groups.size(), 1u);
	EXPECT_EQ(a.supports.mobility[2].y() > 0, true); // what was refused holds nothing
}
