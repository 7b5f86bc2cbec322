// yade-blocks, GPL-2.0-or-later
#include <analysis/PressedBlocks.hpp>

using namespace pressed;

TEST(StabilityWatch, SeesAZoneThatHasTurnedInsideOutOrIsNoNumber)
{
	BlockAssembly a = twoMeshes();
	EXPECT_EQ(firstInverted(a), -1);
	EXPECT_TRUE(StabilityWatch().look(a, 0, 0, 1e-9).stable);
	rotateAbout(a, { 0.3, 0.2 }, 2, { 1, 0 }); // turning is none of that
	EXPECT_EQ(firstInverted(a), -1);
	EXPECT_TRUE(StabilityWatch().look(a, 0, 0, 1e-9).stable);
	const int  n  = a.mesh.firstNode[1];
	const Vec2 at = a.position(n);
	a.place(n, a.position(n + 1)), a.place(n + 1, at);
	EXPECT_EQ(firstInverted(a), 1);
	StabilityWatch::Verdict verdict = StabilityWatch().look(a, 0, 0, 1e-9);
	EXPECT_FALSE(verdict.stable);
	EXPECT_EQ(verdict.block, 1);
	EXPECT_EQ(verdict.reason, "a zone has turned inside out");
	a.state.displacement[n].x() = std::nan("");
	verdict                     = StabilityWatch().look(a, 0, 0, 1e-9);
	EXPECT_EQ(verdict.block, 1);
	EXPECT_EQ(verdict.reason, "the motion of a grid point is not a number");
}

TEST(StabilityWatch, WarnsOnceOfThickJointsAndStopsWhereTheirMeanIsTooThick)
{
	BlockAssembly  a = twoMeshes();
	StabilityWatch watch;
	auto           pressed = [&](Real overlap, long step) {
                for (int n = a.mesh.firstNode[1]; n < a.mesh.firstNode[2]; ++n)
                        a.place(n, a.mesh.reference[n] - Vec2(0, overlap));
                computeForces(a);
                return watch.look(a, step, step * 1e-3, 1e-3);
	};
	EXPECT_EQ(pressed(0.0035, 0).warning, "");
	a.state.groups.push_back(driven("press", { 2 * a.mesh.firstNode[1] }, 0));
	a.state.groups[0].work = a.state.groups[0].workTurnover = 1e30; // whoever presses does the work
	const auto first = pressed(0.006, 100), second = pressed(0.0075, 200), gone = pressed(0.009, 300);
	EXPECT_TRUE(first.stable && second.stable);
	EXPECT_NE(first.warning.find("blocks 0 and 1 overlap by 0.006"), std::string::npos) << first.warning;
	EXPECT_NE(first.warning.find("8 % of the height of the zones behind (0.08 m)"), std::string::npos) << first.warning;
	EXPECT_EQ(second.warning, "");
	EXPECT_FALSE(gone.stable);
	EXPECT_EQ(gone.block, 0);
	EXPECT_NE(gone.reason.find("joints overlap by 11 % of the height of the zones behind in the mean"), std::string::npos) << gone.reason;
	EXPECT_EQ(watch.restore(a), 200);
}

TEST(StabilityWatch, StopsABondedBlockThatEntersAnother)
{
	// One joint in 21 has given way, so that their mean is thin: the innermost point of the lower block of the two is in the higher one.
	for (bool flipped : { false, true }) {
		BlockAssembly a;
		a.addMaterial(stone());
		const Real low = flipped ? 0.4 : 0.2, high = 0.6 - low;
		addGrid(a, { 0, 0 }, 0.6, low, 3, flipped ? 5 : 2);
		addGrid(a, { 0, low }, 0.6, high, 2, flipped ? 2 : 5);
		for (int i = 1; i <= 20; ++i)
			addGrid(a, { 2. * i, 0 }, 0.6, 0.2, 1, 1), addGrid(a, { 2. * i, 0.2 }, 0.6, 0.2, 1, 1);
		bondAll(a, elasticJoint(100e9, 40e9));
		for (int block = 1; block < a.blockCount(); block += 2)
			for (int n = a.mesh.firstNode[block]; n < a.mesh.firstNode[block + 1]; ++n)
				a.state.displacement[n].y() -= block == 1 ? 0.12 : 1e-4;
		computeForces(a);
		const auto gone = StabilityWatch().look(a, 0, 0, 1e-6);
		EXPECT_FALSE(gone.stable);
		EXPECT_EQ(gone.block, flipped);
		EXPECT_NE(gone.reason.find(flipped ? "gone into block 0" : "gone into block 1"), std::string::npos) << gone.reason;
	}
}

TEST(StabilityWatch, TellsOfLostFragmentsAndStopsWhereManyAre)
{
	// Two squares in each other: both innermost points are lost, 2 of 150 blocks or of 250.
	for (int count : { 150, 250 }) {
		Pressed p;
		for (int i = 2; i < count; ++i)
			addGrid(p.a, { 3. * i, 50 }, 1, 1, 1, 1);
		p.put(0.8);
		StabilityWatch watch;
		const auto     verdict = watch.look(p.a, 0, 0, 1e-6);
		EXPECT_EQ(verdict.stable, count == 250);
		if (count == 150) {
			EXPECT_NE(verdict.reason.find("more than half"), std::string::npos);
		} else {
			EXPECT_NE(verdict.warning.find("fragments"), std::string::npos);
			EXPECT_EQ(watch.look(p.a, 100, 0, 1e-6).warning, ""); // once
		}
	}
}
