// yade-blocks, GPL-2.0-or-later
#include "OverlapWatch.hpp"
#include "BlockAssembly.hpp"
#include <limits>

namespace blocks {

void OverlapWatch::measure(const BlockAssembly& a)
{
	std::vector<int> next(a.nodeCount(), -1); // along the outline, material on the left, as zones have it
	for (const auto& [from, to] : a.edgeNodes)
		next[from] = to;
	zoneHeight.assign(a.nodeCount(), std::numeric_limits<Real>::infinity());
	for (int z = 0; z < a.zoneCount(); ++z)
		for (int i = 0; i < 3; ++i) {
			const int from = a.zoneNodes[z][i], to = a.zoneNodes[z][(i + 1) % 3];
			if (next[from] == to) zoneHeight[from] = 2 * a.zoneVolume[z] / a.thickness / (a.reference[to] - a.reference[from]).norm();
		}

	greatest.resize(a.blockCount());
	for (int block = 0; block < a.blockCount(); ++block) {
		Real area = 0, outline = 0;
		for (int e = a.firstEdge[block]; e < a.firstEdge[block + 1]; ++e) {
			const Vec2 origin = a.reference[a.firstNode[block]], p = a.reference[a.edgeNodes[e][0]], q = a.reference[a.edgeNodes[e][1]];
			area += cross(p - origin, q - origin) / 2;
			outline += (q - p).norm();
		}
		greatest[block] = lostFrom * area / outline;
	}
}

void OverlapWatch::compare(const std::array<int, 2>& block, int edge1, int edge2, Real end0, Real end1)
{
	if (!(end0 > 0 || end1 > 0)) return;
	const Real d0 = std::max(end0, Real(0)), d1 = std::max(end1, Real(0));
	auto       worse = [&](Overlap& worst, Real depth, Real bound) {
                if (depth > worst.share() * bound) worst = { block, depth, bound };
	};
	worse(thickest, std::max(d0, d1), std::min(zoneHeight[edge1], zoneHeight[edge2]));
	worse(deepest, std::sqrt((d0 * d0 + d1 * d1) / 2), std::min(greatest[block[0]], greatest[block[1]]));
}

void OverlapWatch::look(const BlockAssembly& a)
{
	if (int(zoneHeight.size()) != a.nodeCount()) measure(a);
	thickest = deepest = {};
	inverted           = -1;

	for (size_t i = 0; i < a.segments.size(); ++i) {
		const Segment& g = a.segments[i];
		if (g.area > 0) compare(g.block, g.node[0], g.node[2], -a.points[2 * i].opening, -a.points[2 * i + 1].opening);
	}
	for (int i : a.contacts.order) {
		const FreeContact& c = a.contacts.all[i];
		for (int index : c.active) {
			const EdgePair& e = c.edges[index];
			compare(c.block, e.node[0], e.node[2], -e.sigma[0] / c.joint.kn, -e.sigma[1] / c.joint.kn);
		}
		if (c.lost > deepest.share() * std::min(greatest[c.block[0]], greatest[c.block[1]]))
			deepest = { c.block, c.lost, std::min(greatest[c.block[0]], greatest[c.block[1]]) };
	}

	for (int z = 0; z < a.zoneCount(); ++z) {
		const auto& node = a.zoneNodes[z];
		if (cross(a.position[node[1]] - a.position[node[0]], a.position[node[2]] - a.position[node[0]]) > 0) continue;
		inverted = a.blockOfNode(node[0]);
		break;
	}
}

} // namespace blocks
