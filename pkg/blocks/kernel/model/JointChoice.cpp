// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/geometry/Polygon.hpp>
#include <blocks/kernel/model/JointChoice.hpp>

namespace blocks {

bool isBetween(const BlockAssembly& a, int joint, int material1, int material2)
{
	const auto& block = a.joints.segments[joint].block;
	const int   first = a.mesh.blockMaterial[block[0]], second = a.mesh.blockMaterial[block[1]];
	return (first == material1 && second == material2) || (first == material2 && second == material1);
}

Vec2 builtAt(const BlockAssembly& a, int joint)
{
	const Segment& g     = a.joints.segments[joint];
	const auto     along = [&](int side, Real s) {
                const Vec2 &from = a.mesh.reference[g.node[2 * side]], &to = a.mesh.reference[g.node[2 * side + 1]];
                return Vec2(from + s * (to - from));
	};
	return (along(0, (g.s1[0] + g.s1[1]) / 2) + along(1, (g.s2[0] + g.s2[1]) / 2)) / 2;
}

std::vector<int> jointsWithin(const BlockAssembly& a, const Polygon& region, const std::vector<int>& joints)
{
	const Real       onIt = 1e-9 * perimeter(region); // a joint along the outline has the rounding of its builder, which is far less
	std::vector<int> chosen;
	for (int i : joints)
		if (const Vec2 x = builtAt(a, i); strictlyInside(x, region) || distanceFromOutline(x, region) <= onIt) chosen.push_back(i);
	return chosen;
}

} // namespace blocks
