// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>

using namespace specimens;

TEST(ZoneForces, FansAndZonesOfAnyShapeAgree)
{
	// Polygons of 3 to 100 corners (more than a batch of zones), once as fans that are known as such, once with zones that start at another
	// of their nodes. Two materials, so that runs end. The zones of the two differ by rounding: strains of 0.1 and forces of order
	// 50 x 0.1 x 0.7 at the inner point from up to 100 zones with 20 roundings each.
	for (const Strain strain : { Strain::large, Strain::small }) {
		BlockAssembly a, b;
		for (BlockAssembly* s : { &a, &b }) {
			s->strain    = strain;
			s->thickness = 0.7;
			s->addMaterial({ 20, 0.2, 1 });
			s->addMaterial({ 50, 0.3, 1 });
		}
		std::mt19937 random(5);
		for (int corners : { 3, 4, 5, 6, 30, 30, 7, 64, 65, 4, 100, 3, 5 }) {
			const int  material = random() % 3 == 0;
			Ring       ring;
			const Real shiftX = 3 * a.blockCount();
			for (int i = 0; i < corners; ++i)
				ring.push_back({ shiftX + std::cos(2 * M_PI * i / corners), 0.7 * std::sin(2 * M_PI * i / corners) });
			addFan(a, ring, material);
			Ring                            points = ring;
			std::vector<int>                outline;
			std::vector<std::array<int, 3>> zones;
			points.push_back(0.9 * mean(ring) + 0.1 * ring[0]);
			for (int i = 0; i < corners; ++i)
				outline.push_back(i), zones.push_back({ (i + 1) % corners, corners, i });
			b.addBlock(points, { outline }, zones, material);
			EXPECT_TRUE(a.mesh.isFan[a.blockCount() - 1]);
			EXPECT_FALSE(b.mesh.isFan[b.blockCount() - 1]);
		}
		std::uniform_real_distribution<Real> shift(-0.03, 0.03);
		for (Vec2& u : a.state.displacement) {
			const Real dx = shift(random), dy = shift(random);
			u = { dx, dy };
		}
		if (strain == Strain::large) rotateAbout(a, { 1, 1 }, 1.1, { 0, 0 });
		b.state.displacement = a.state.displacement;
		for (int threads : { 1, 2 }) {
			sumForces(a, true, threads), sumForces(b, true, threads);
			for (int n = 0; n < a.nodeCount(); ++n)
				EXPECT_LT((a.forces.nodal[n] - b.forces.nodal[n]).norm(), 1000 * eps * 35) << "node " << n;
			EXPECT_GT(largestForce(a), 0.1);
			Real sum = 0, other = 0;
			for (int block = 0; block < a.blockCount(); ++block) {
				EXPECT_NEAR(a.forces.zoneEnergy[block], b.forces.zoneEnergy[block], 1000 * eps * a.forces.zoneEnergy[block]);
				EXPECT_GT(a.forces.zoneEnergy[block], 0);
				sum += a.forces.zoneEnergy[block], other += b.forces.zoneEnergy[block];
			}
			EXPECT_NEAR(sum, zoneEnergy(a), 1000 * eps * sum);
			EXPECT_NEAR(other, zoneEnergy(b), 1000 * eps * sum);
			const auto booked = a.forces.nodal;
			sumForces(a, false, threads); // accounts change no bit of a force
			EXPECT_TRUE(a.forces.nodal == booked);
		}
	}
}

TEST(ZoneForces, ABlockThatOnlyLooksLikeAFanIsNone)
{
	// As many zones as corners and an inner grid point, but not from corner to corner.
	BlockAssembly a;
	a.addMaterial(stone());
	const Ring points { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 }, { 0.5, 0.5 } };
	a.addBlock(points, { { 0, 1, 2, 3 } }, { { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 }, { 3, 0, 4 } }, 0);
	a.addBlock(points, { { 0, 1, 2, 3 } }, { { 1, 2, 4 }, { 0, 1, 4 }, { 2, 3, 4 }, { 3, 0, 4 } }, 0); // in another order
	a.addBlock(points, { { 0, 1, 2, 3 } }, { { 0, 1, 4 }, { 1, 2, 4 }, { 2, 3, 4 }, { 0, 4, 3 } }, 0); // the last one turned
	const Ring shuffled { { 0, 0 }, { 1, 1 }, { 1, 0 }, { 0, 1 }, { 0.5, 0.5 } };                      // grid points not in the order of the outline
	a.addBlock(shuffled, { { 0, 2, 1, 3 } }, { { 2, 1, 4 }, { 0, 2, 4 }, { 1, 3, 4 }, { 3, 0, 4 } }, 0);
	EXPECT_TRUE(a.mesh.isFan[0]);
	EXPECT_FALSE(a.mesh.isFan[1]);
	EXPECT_FALSE(a.mesh.isFan[2]);
	EXPECT_FALSE(a.mesh.isFan[3]);
	BlockAssembly rigid;
	rigid.addMaterial(stone());
	rigid.addBlock({ { 0, 0 }, { 1, 0 }, { 0, 1 } }, { { 0, 1, 2 } }, {}, 0);
	EXPECT_FALSE(rigid.mesh.isFan[0]);
	computeForces(rigid);
	EXPECT_EQ(largestForce(rigid), 0);
}
