// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/step/ContactResults.hpp>

using namespace specimens;

namespace {

/// To 2^-20 m: so it is exact up to 2^32 m from the origin.
Vec2 dyadic(const Vec2& x) { return (x * 1048576).array().round() / 1048576; }

/// A wall of Voronoi cells, 1 x 0.6 m, and a block beside it that touches nothing but what it hits, all of it shifted.
BlockAssembly wall(const Vec2& shift)
{
	JointParams joint = elasticJoint(1e12, 4e11);
	joint.tension = joint.cohesion = 100; // some give way on the way
	joint.tanPhi = joint.tanPhiResidual = 0.5;
	TessellationOptions options;
	options.seeds         = jitteredSeeds(1, 0.6, 5, 3, 0.6, 7);
	options.size          = 0.2;
	options.mergeFraction = 0.1;
	const Cells   cells   = tessellate(rectangle(1, 0.6), options);
	BlockAssembly a;
	a.thickness = 0.5;
	a.addMaterial(stone());
	auto add = [&](Ring ring) {
		std::vector<int>                outline;
		std::vector<std::array<int, 3>> zones;
		const int                       corners = int(ring.size());
		ring.push_back(mean(ring));
		for (Vec2& x : ring)
			x = dyadic(x) + shift;
		for (int i = 0; i < corners; ++i)
			outline.push_back(i), zones.push_back({ i, (i + 1) % corners, corners });
		a.addBlock(ring, { outline }, zones, 0);
	};
	for (size_t i = 0; i < cells.cells.size(); ++i)
		add(ringOf(cells, i));
	add({ { 1.0078125, 0.25 }, { 1.25, 0.2265625 }, { 1.25, 0.5 }, { 1.03125, 0.5 } });
	bondAll(a, joint);
	a.contacts.wanted    = true;
	a.joints.ofMaterials = { int(a.joints.kinds.size()) };
	a.joints.kinds.push_back(elasticJoint(1e11, 4e10));
	a.joints.kinds.back().tanPhiResidual = 0.5;
	return a;
}

} // namespace

TEST(FarFromTheOrigin, EveryBitIsTheSame)
{
	// Reference positions that both places hold exactly. 5000 km away positions are 1e-9 m apart, three times what the head moves in a step
	// (4e-10 m): only displacements can tell. Strains, joints that break, a block that hits and rubs: nothing knows where it is.
	const Vec2    far(5e6, -3e6);
	BlockAssembly here = wall({ 0, 0 }), there = wall(far);
	const Real    dt = 1e-6;
	ASSERT_LT(2 * dt, stableTimeStep(here, nodalStiffness(here), here.state.inertia));
	EXPECT_EQ(here.joints.columns.bondOpening[0], there.joints.columns.bondOpening[0]);
	for (BlockAssembly* a : { &here, &there }) {
		const Vec2 shift = a == &here ? Vec2(0, 0) : far;
		a->addGroup(driven("foot", dofs(*a, 1, [&](const Vec2& x) { return x.y() == shift.y(); }), 0));
		a->addGroup(driven("head", dofs(*a, 1, [&](const Vec2& x) { return x.y() == shift.y() + dyadic({ 0, 0.6 }).y(); }), 4e-4));
		ASSERT_GT(a->state.groups[1].dofs.size(), 3u);
		const int last = a->blockCount() - 1;
		for (int n = a->mesh.firstNode[last]; n < a->mesh.firstNode[last + 1]; ++n)
			a->state.velocity[n] = { -12, 1 };
	}
	Damping damping;
	damping.alpha    = 0.2;
	bool touched     = false;
	auto elongations = [&](const BlockAssembly& a) { return a.state.groups[1].travelled; };
	for (int i = 0; i < 1000; ++i) {
		for (BlockAssembly* a : { &here, &there }) {
			blocks::computeForces(*a, Brittle {}, dt, true);
			move(*a, damping, dt, i * dt, true);
		}
		touched |= contactEnergy(there) > 0;
		ASSERT_TRUE(here.state.displacement == there.state.displacement) << "step " << i;
	}
	EXPECT_NEAR(elongations(there), 4e-7, 1e-15);
	const int head = there.state.groups[1].dofs[0] / 2;
	EXPECT_EQ(there.state.displacement[head].y(), there.state.groups[1].travelled);
	EXPECT_LT(std::abs((there.position(head) - there.mesh.reference[head]).y() / 4e-7 - 1), 0.01); // to the 1e-9 m that positions tell
	EXPECT_TRUE(here.forces.nodal == there.forces.nodal);
	EXPECT_EQ(here.state.status, there.state.status);
	EXPECT_EQ(here.state.accounts.friction, there.state.accounts.friction);
	EXPECT_EQ(contactFriction(here), contactFriction(there));
	EXPECT_EQ(zoneEnergy(here), zoneEnergy(there));
	EXPECT_TRUE(touched);
	EXPECT_GT(std::count(there.state.released.begin(), there.state.released.end(), true), 0);
	EXPECT_LT(std::count(there.state.released.begin(), there.state.released.end(), true), there.joints.count());
}
