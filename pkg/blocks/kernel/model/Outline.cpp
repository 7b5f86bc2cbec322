// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/geometry/Polygon.hpp>
#include <blocks/kernel/geometry/Zoning.hpp>
#include <blocks/kernel/model/Outline.hpp>

namespace blocks {
namespace {

	/// The grid points of the outline, ring by ring.
	std::vector<std::vector<int>> nodesOfRings(const BlockAssembly& a, int block)
	{
		std::vector<std::vector<int>> rings;
		for (int e = a.mesh.firstEdge[block], first = -1; e < a.mesh.firstEdge[block + 1]; ++e) {
			const auto& edge = a.mesh.edgeNodes[e];
			if (first < 0) rings.emplace_back(), first = edge[0];
			rings.back().push_back(edge[0]);
			if (edge[1] == first) first = -1;
		}
		return rings;
	}

	template <class Place> Polygon polygonOf(const std::vector<std::vector<int>>& rings, const Place& placeOf)
	{
		std::vector<Ring> out;
		for (const auto& nodes : rings) {
			out.emplace_back();
			for (int n : nodes)
				out.back().push_back(placeOf(n));
		}
		return { out[0], { out.begin() + 1, out.end() } };
	}

} // namespace

Polygon outlineOf(const BlockAssembly& a, int block)
{
	return polygonOf(nodesOfRings(a, block), [&](int n) { return a.position(n); });
}

Polygon referenceOutlineOf(const BlockAssembly& a, int block)
{
	return polygonOf(nodesOfRings(a, block), [&](int n) { return a.mesh.reference[n]; });
}

Box boxOf(const BlockAssembly& a, int block)
{
	Box box;
	for (int e = a.mesh.firstEdge[block]; e < a.mesh.firstEdge[block + 1]; ++e)
		box.extend(a.position(a.mesh.edgeNodes[e][0]));
	return box;
}

AreaSum referenceMoments(const BlockAssembly& a, int block)
{
	const auto edges = a.mesh.edgeNodes.begin();
	return moments(a.mesh.reference, edges + a.mesh.firstEdge[block], edges + a.mesh.firstEdge[block + 1]);
}

Real meanEdge(const BlockAssembly& a, int block) { return referenceMoments(a, block).perimeter() / (a.mesh.firstEdge[block + 1] - a.mesh.firstEdge[block]); }

std::vector<std::array<int, 3>> cornerTriangles(const BlockAssembly& a, int block)
{
	const auto       rings = nodesOfRings(a, block);
	const Zones      zones = cornerZones(polygonOf(rings, [&](int n) { return a.mesh.reference[n]; }));
	std::vector<int> nodes;
	for (const auto& ring : rings)
		nodes.insert(nodes.end(), ring.begin(), ring.end());
	std::vector<std::array<int, 3>> triangles;
	for (const auto& t : zones.triangles)
		triangles.push_back({ nodes[t[0]], nodes[t[1]], nodes[t[2]] });
	return triangles;
}

} // namespace blocks
