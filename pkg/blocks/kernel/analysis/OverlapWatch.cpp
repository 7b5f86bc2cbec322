// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/analysis/OverlapWatch.hpp>
#include <blocks/kernel/geometry/Polygon.hpp>
#include <blocks/kernel/model/JointEdges.hpp>
#include <blocks/kernel/model/Outline.hpp>
#include <limits>

namespace blocks {
namespace {

	Vec2 meanOf(const std::vector<Vec2>& x, const std::array<int, 3>& node) { return (x[node[0]] + x[node[1]] + x[node[2]]) / 3; }

	/// Looks for the point of a block that is farthest from its outline, in the reference positions.
	class Innermost {
	public:
		Innermost(const BlockAssembly& assembly, int ofBlock)
			: a(assembly)
			, first(a.mesh.firstEdge[ofBlock])
			, last(a.mesh.firstEdge[ofBlock + 1])
			, nearest(first)
		{
		}
		/// Whether a point is farther than all before. Neighbours are near the same edge: asked first, it saves most of them all others.
		bool isFarther(const Vec2& p)
		{
			Real least = squareTo(nearest, p);
			for (int e = first; e < last && least > farthest; ++e)
				if (const Real square = squareTo(e, p); square < least) least = square, nearest = e;
			if (!(least > farthest)) return false;
			farthest = least;
			return true;
		}

	private:
		/// Square of the distance to an edge [m2].
		Real squareTo(int edge, const Vec2& p) const
		{
			return awayFrom(a.mesh.reference[a.mesh.edgeNodes[edge][0]], a.mesh.reference[a.mesh.edgeNodes[edge][1]], p).squaredNorm();
		}

		const BlockAssembly& a;
		const int            first, last;
		int                  nearest;
		Real                 farthest = 0; // square [m2]
	};

	/// Means of three vertices of an outline that lie within it; of very many vertices some are left out.
	template <class Consider> void considerOutline(const BlockAssembly& a, int block, const Consider& consider)
	{
		constexpr int few     = 24;
		const Polygon outline = referenceOutlineOf(a, block);
		const int     last = a.mesh.firstNode[block + 1], stride = 1 + (last - a.mesh.firstNode[block] - 1) / few;
		for (int i = a.mesh.firstNode[block]; i < last; i += stride)
			for (int j = i + stride; j < last; j += stride)
				for (int k = j + stride; k < last; k += stride)
					if (strictlyInside(meanOf(a.mesh.reference, { i, j, k }), outline)) consider({ i, j, k });
	}

} // namespace

void OverlapWatch::measure(const BlockAssembly& a)
{
	std::vector<int> next(a.nodeCount(), -1); // along the outline, material on the left, as zones have it
	for (const auto& [from, to] : a.mesh.edgeNodes)
		next[from] = to;
	zoneHeight.assign(a.nodeCount(), std::numeric_limits<Real>::infinity());
	innermost.assign(a.blockCount(), { -1, -1, -1 });
	for (int block = 0; block < a.blockCount(); ++block) {
		Innermost search(a, block);
		auto      consider = [&](const std::array<int, 3>& point) {
                        if (search.isFarther(meanOf(a.mesh.reference, point))) innermost[block] = point;
		};
		for (int z = a.mesh.firstZone[block]; z < a.mesh.firstZone[block + 1]; ++z) {
			const auto& node = a.mesh.zoneNodes[z];
			consider(node);
			for (int i = 0; i < 3; ++i) {
				const int from = node[i], to = node[(i + 1) % 3];
				if (next[from] == to)
					zoneHeight[from] = 2 * a.mesh.zoneVolume[z] / a.thickness / (a.mesh.reference[to] - a.mesh.reference[from]).norm();
				if (next[from] < 0) consider({ from, from, from });
			}
		}
		if (a.isRigid(block)) considerOutline(a, block, consider);
	}
}

/// Whether a block's innermost point lies within another block.
bool OverlapWatch::entered(const BlockAssembly& a, int block, int other) const
{
	if (innermost[block][0] < 0) return false;
	const auto& n = innermost[block];
	const Vec2  p = (a.position(n[0]) + a.position(n[1]) + a.position(n[2])) / 3;
	return boxOf(a, other).contains(p) && strictlyInside(p, outlineOf(a, other));
}

int firstStrayed(const BlockAssembly& a)
{
	for (int joint = 0; joint < a.joints.count(); ++joint) {
		const int p = 2 * joint;
		if (a.state.released[joint] || (a.state.status[p] == Joint::intact && a.state.status[p + 1] == Joint::intact)
		    || (a.state.sigma[p] == 0 && a.state.sigma[p + 1] == 0))
			continue;
		if (a.contacts.wanted ? edgesTurned(a, joint) : edgesPassed(a, joint)) return joint;
	}
	return -1;
}

int firstInverted(const BlockAssembly& a)
{
	for (int z = 0; z < a.zoneCount(); ++z) {
		const auto& node = a.mesh.zoneNodes[z];
		if (!(cross(a.between(node[0], node[1]), a.between(node[0], node[2])) > 0)) return a.blockOfNode(node[0]);
	}
	return -1;
}

void OverlapWatch::look(const BlockAssembly& a)
{
	if (int(zoneHeight.size()) != a.nodeCount()) measure(a);
	joint = contact = {};
	through         = { -1, -1 };
	entries         = 0;
	auto enter      = [&](const std::array<int, 2>& block) {
                for (int side : { 0, 1 })
                        if (entered(a, block[side], block[1 - side]) && entries++ == 0) through = { block[side], block[1 - side] };
	};

	Real closed = 0, shares = 0; // areas of joints, and times their shares [m2]
	for (const Pair& pair : a.joints.pairs) {
		Overlap worst;
		for (int i = pair.first; i < pair.last; ++i) {
			const Segment& g     = a.joints.segments[i];
			const Real     depth = -std::min(a.state.opening[2 * i], a.state.opening[2 * i + 1]);
			if (!(depth > 0) || a.state.released[i]) continue;
			const Real height = std::min(zoneHeight[g.node[0]], zoneHeight[g.node[2]]);
			worst.raise(pair.block, depth, height);
			closed += g.area, shares += g.area * depth / height;
		}
		if (worst.share() > thin) enter(pair.block); // others need not be asked
		if (worst.share() > joint.share()) joint = worst;
	}
	mean = closed > 0 ? shares / closed : 0;
	for (int i : a.contacts.order) {
		const FreeContact& c = a.state.contacts[i];
		Overlap            worst;
		for (int index : c.active) {
			const EdgePair& e = c.edges[index];
			const Real height = std::min(zoneHeight[e.node[0]], zoneHeight[e.node[2]]); // of rigid blocks the depth at which the contact is lost
			worst.raise(c.block, -std::min(e.sigma[0], e.sigma[1]) / c.joint.kn, std::isfinite(height) ? height : e.shape.depthLimit);
		}
		if (c.active.empty() || worst.share() > thin) enter(c.block); // edges that are too deep do not touch any more
		if (worst.share() > contact.share()) contact = worst;
	}
}

} // namespace blocks
