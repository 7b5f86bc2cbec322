// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/step/ContactResults.hpp>

using namespace specimens;

namespace {

/// Depth of two convex blocks in each other: the least over the edges' normals, negative if they are apart [m].
Real depthOf(const BlockAssembly& a)
{
	Real least = std::numeric_limits<Real>::infinity();
	for (int block : { 0, 1 })
		for (int e = a.mesh.firstEdge[block]; e < a.mesh.firstEdge[block + 1]; ++e) {
			const Vec2 p = a.position(a.mesh.edgeNodes[e][0]), along = a.between(a.mesh.edgeNodes[e][0], a.mesh.edgeNodes[e][1]).normalized();
			Real       deepest = -std::numeric_limits<Real>::infinity();
			for (int n = a.mesh.firstNode[1 - block]; n < a.mesh.firstNode[2 - block]; ++n)
				deepest = std::max(deepest, cross(along, a.position(n) - p));
			least = std::min(least, deepest);
		}
	return least;
}

} // namespace

TEST(ContactInTime, NoSpeedAndNoOffsetMakesItLate)
{
	// A square goes at another one, straight, aside, corner first, turning; its size by the other's is 1 or 1/20. The step that takes it in by
	// more than rounding must find it in contact: nobody is deeper than one step's motion without a force.
	std::mt19937                         random(2);
	std::uniform_real_distribution<Real> u(0, 1);
	int                                  hits = 0;
	for (const Real size : { 1., 0.05 })
		for (const Real share : { 1e-4, 1e-3, 0.007, 0.016, 0.033, 0.1, 0.2 }) // of the smaller edge, a step
			for (int pose = 0; pose < 40; ++pose) {
				SCOPED_TRACE("size " + shown(size) + ", " + shown(share) + " of an edge a step, pose " + std::to_string(pose));
				BlockAssembly a;
				a.addMaterial(stone());
				auto square = [&](Vec2 centre, Real side, Real turn) {
					Ring ring;
					for (int i = 0; i < 4; ++i)
						ring.push_back(
							centre
							+ side / std::sqrt(2)
								* Vec2(std::cos(turn + (i + 0.5) * M_PI / 2), std::sin(turn + (i + 0.5) * M_PI / 2)));
					std::vector<int> outline { 0, 1, 2, 3 };
					a.addBlock(ring, { outline }, {}, 0);
				};
				square({ 0, 0 }, 1, 0);
				const Real step  = share * size,
					   turn  = pose % 4 == 0 ? 0
					 : pose % 4 == 1         ? M_PI / 4
								 : 2 * M_PI * u(random),
					   spin  = pose % 8 == 7 ? 0.3 * share : 0;
				const Real gap   = (0.001 + 0.3 * u(random)) * size + (pose % 5 == 0 ? 20 * step : 0),
					   aside = 0.9 * (u(random) - 0.5) * (1 + size);
				square({ -0.5 - size * std::sqrt(0.5) - gap, aside }, size, turn);
				const Vec2 v         = step * Vec2(std::cos(0.3 * (pose % 3 - 1)), std::sin(0.3 * (pose % 3 - 1)));
				a.contacts.wanted    = true;
				a.joints.ofMaterials = { 1 };
				a.joints.kinds.push_back(elasticJoint(1e6, 5e5));
				const int most    = int(3 * (gap + size) / step) + 10;
				bool      touched = false;
				for (int i = 0; i < most && !touched; ++i) {
					blocks::computeForces(a, Brittle {}, 1e-3);
					const Real depth = depthOf(a);
					ASSERT_LT(depth, (1 + spin / std::max(share, 1e-9)) * step + 1e-12);
					touched = contactEnergy(a) > 0;
					ASSERT_EQ(touched, depth > 0) << "depth " << depth;
					const Vec2 centre = a.centroid(1);
					rotateAbout(a, centre, spin, v, a.mesh.firstNode[1]);
				}
				hits += touched;
				if (share <= 1e-3) { // it is not looked for in every step: half of mayMove lies between two looks, at least
					EXPECT_LT(a.contacts.looks, 3 + 2 * most * step / (FreeContacts::mayMove * size));
				}
			}
	EXPECT_GT(hits, 2 * 7 * 30);
}
