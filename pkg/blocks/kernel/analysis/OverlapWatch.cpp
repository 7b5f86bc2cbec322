// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/analysis/OverlapWatch.hpp>
#include <blocks/kernel/model/BlockAssembly.hpp>
#include <limits>

namespace blocks {
namespace {

	Vec2 meanOf(const std::vector<Vec2>& x, const std::array<int, 3>& node) { return (x[node[0]] + x[node[1]] + x[node[2]]) / 3; }

	/// Square of the distance from a point to a block's outline, in the reference positions.
	Real squareToOutline(const BlockAssembly& a, int block, const Vec2& p)
	{
		Real least = std::numeric_limits<Real>::infinity();
		for (int e = a.firstEdge[block]; e < a.firstEdge[block + 1]; ++e) {
			const Vec2 from = a.reference[a.edgeNodes[e][0]], along = a.reference[a.edgeNodes[e][1]] - from;
			const Real s = std::min(Real(1), std::max(Real(0), (p - from).dot(along) / along.squaredNorm()));
			least        = std::min(least, (p - from - s * along).squaredNorm());
		}
		return least;
	}

} // namespace

void OverlapWatch::measure(const BlockAssembly& a)
{
	std::vector<int> next(a.nodeCount(), -1); // along the outline, material on the left, as zones have it
	for (const auto& [from, to] : a.edgeNodes)
		next[from] = to;
	zoneHeight.assign(a.nodeCount(), std::numeric_limits<Real>::infinity());
	innermost.assign(a.blockCount(), { -1, -1, -1 });
	for (int block = 0; block < a.blockCount(); ++block) {
		Real farthest = 0;
		auto consider = [&](const std::array<int, 3>& point) {
			const Real square = squareToOutline(a, block, meanOf(a.reference, point));
			if (square > farthest) farthest = square, innermost[block] = point;
		};
		for (int z = a.firstZone[block]; z < a.firstZone[block + 1]; ++z) {
			const auto& node = a.zoneNodes[z];
			consider(node);
			for (int i = 0; i < 3; ++i) {
				const int from = node[i], to = node[(i + 1) % 3];
				if (next[from] == to) zoneHeight[from] = 2 * a.zoneVolume[z] / a.thickness / (a.reference[to] - a.reference[from]).norm();
				if (next[from] < 0) consider({ from, from, from });
			}
		}
	}
}

/// Whether a block's innermost point lies within another block, by the number of edges to its right.
bool OverlapWatch::entered(const BlockAssembly& a, int block, int other) const
{
	if (innermost[block][0] < 0) return false;
	const Vec2 p   = meanOf(a.position, innermost[block]);
	bool       odd = false;
	for (int e = a.firstEdge[other]; e < a.firstEdge[other + 1]; ++e) {
		const Vec2 &from = a.position[a.edgeNodes[e][0]], &to = a.position[a.edgeNodes[e][1]];
		if ((from.y() > p.y()) != (to.y() > p.y()) && p.x() < from.x() + (p.y() - from.y()) / (to.y() - from.y()) * (to.x() - from.x())) odd = !odd;
	}
	return odd;
}

void OverlapWatch::look(const BlockAssembly& a)
{
	if (int(zoneHeight.size()) != a.nodeCount()) measure(a);
	joint = contact = {};
	through         = { -1, -1 };
	inverted        = -1;
	entries         = 0;
	auto enter      = [&](const std::array<int, 2>& block) {
                for (int side : { 0, 1 })
                        if (entered(a, block[side], block[1 - side]) && entries++ == 0) through = { block[side], block[1 - side] };
	};

	Real closed = 0, shares = 0; // areas of joints, and times their shares [m2]
	for (const Pair& pair : a.pairs) {
		Overlap worst;
		for (int i = pair.first; i < pair.last; ++i) {
			const Segment& g     = a.segments[i];
			const Real     depth = -std::min(a.points[2 * i].opening, a.points[2 * i + 1].opening);
			if (!(depth > 0) || g.released()) continue;
			const Real height = std::min(zoneHeight[g.node[0]], zoneHeight[g.node[2]]);
			worst.raise(pair.block, depth, height);
			closed += g.area, shares += g.area * depth / height;
		}
		if (worst.share() > thin) enter(pair.block); // others need not be asked
		if (worst.share() > joint.share()) joint = worst;
	}
	mean = closed > 0 ? shares / closed : 0;
	for (int i : a.contacts.order) {
		const FreeContact& c = a.contacts.all[i];
		Overlap            worst;
		for (int index : c.active) {
			const EdgePair& e = c.edges[index];
			worst.raise(c.block, -std::min(e.sigma[0], e.sigma[1]) / c.joint.kn, std::min(zoneHeight[e.node[0]], zoneHeight[e.node[2]]));
		}
		if (c.active.empty() || worst.share() > thin) enter(c.block); // edges that are too deep do not touch any more
		if (worst.share() > contact.share()) contact = worst;
	}

	for (int z = 0; z < a.zoneCount() && inverted < 0; ++z) {
		const auto& node = a.zoneNodes[z];
		if (!(cross(a.position[node[1]] - a.position[node[0]], a.position[node[2]] - a.position[node[0]]) > 0)) inverted = a.blockOfNode(node[0]);
	}
}

} // namespace blocks
