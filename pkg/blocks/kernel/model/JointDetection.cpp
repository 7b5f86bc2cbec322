// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/geometry/Boxes.hpp>
#include <blocks/kernel/geometry/Polygon.hpp>
#include <blocks/kernel/model/JointDetection.hpp>
#include <blocks/kernel/model/Outline.hpp>
#include <limits>

namespace blocks {
namespace {

	struct Edge {
		Vec2 a, b, along; // from a to b, unit direction
		Real length;
		Real scale; // the edge's length or its block's mean width, the lesser [m]
		int  block, index;
	};

	[[noreturn]] void refuse(int block1, int block2, const Vec2& place)
	{
		throw std::invalid_argument(
			"blocks " + std::to_string(block1) + " and " + std::to_string(block2) + " overlap near (" + shown(place.x()) + ", " + shown(place.y())
			+ "): regions must not overlap");
	}

	/// Coordinates are known to a few units of their last place, however small the blocks are [m].
	Real reachOf(const Edge& e1, const Edge& e2, Real tolerance)
	{
		const Real rounding = 4 * std::numeric_limits<Real>::epsilon() * std::max(e1.a.lpNorm<Eigen::Infinity>(), e2.a.lpNorm<Eigen::Infinity>());
		return std::max(tolerance * std::min(e1.scale, e2.scale), rounding);
	}

	/// Whether two edges cross, or run the same way along each other: either means that their blocks overlap.
	/// Ends that come within the tolerance of the other edge are touching, not crossing.
	bool penetrate(const Edge& e1, const Edge& e2, Real tolerance)
	{
		const Real reach = reachOf(e1, e2, tolerance);
		const Real a = cross(e1.along, e2.a - e1.a), b = cross(e1.along, e2.b - e1.a); // distances from the first edge's line
		const Real c = cross(e2.along, e1.a - e2.a), d = cross(e2.along, e1.b - e2.a);
		if (std::min(a, b) < -reach && std::max(a, b) > reach && std::min(c, d) < -reach && std::max(c, d) > reach) return true;
		if (std::max(std::abs(a), std::abs(b)) > reach || e1.along.dot(e2.along) < 0) return false;
		const Real begin = (e2.a - e1.a).dot(e1.along), end = (e2.b - e1.a).dot(e1.along);
		return std::min(e1.length, end) - std::max(Real(0), begin) > reach;
	}

	/// The overlap of two edges that face each other, as a Segment of unit thickness; false if there is none.
	bool overlap(const Edge& e1, const Edge& e2, Real tolerance, Segment& out)
	{
		if (e1.along.dot(e2.along) > 0) return false;
		const Real reach = reachOf(e1, e2, tolerance);

		// parameters along the first edge [m]; e2 runs the other way
		const Real begin = (e2.b - e1.a).dot(e1.along), end = (e2.a - e1.a).dot(e1.along);
		const Real lo = std::max(Real(0), begin), hi = std::min(e1.length, end);
		if (!(hi - lo > reach)) return false;

		auto hosts = [&](Real along, Real& s1, Real& s2) {
			s1              = along / e1.length;
			const Vec2 x1   = e1.a + along * e1.along;
			s2              = (x1 - e2.a).dot(e2.along) / e2.length;
			const Vec2 x2   = e2.a + s2 * e2.length * e2.along;
			const Real snap = tolerance; // a point this close to a grid point is that grid point
			for (Real* s : { &s1, &s2 })
				*s = *s < snap ? 0 : *s > 1 - snap ? 1 : *s;
			return (x2 - x1).norm() <= reach;
		};
		if (!hosts(lo, out.s1[0], out.s2[0]) || !hosts(hi, out.s1[1], out.s2[1])) return false;
		out.area = (hi - lo) / 2;
		return true;
	}

	using Chosen = std::vector<char>; ///< of all edges

	/// Blocks whose edges do not cross may still lie one within another: then so does the smaller one's box. Asked of blocks of which an edge is chosen.
	void requireNoneWithin(const BlockAssembly& a, const Chosen& chosen)
	{
		std::vector<Box> boxes, some;
		std::vector<int> asked; // the blocks of `some`
		for (int block = 0; block < a.blockCount(); ++block) {
			boxes.push_back(boxOf(a, block));
			const auto first = chosen.begin() + a.mesh.firstEdge[block], last = chosen.begin() + a.mesh.firstEdge[block + 1];
			if (std::find(first, last, true) != last) some.push_back(boxes.back()), asked.push_back(block);
		}
		const auto within = [&](int inner, int outer) {
			return boxes[outer].contains(boxes[inner]) && strictlyInside(innerPoint(outlineOf(a, inner)), outlineOf(a, outer));
		};
		forEachMeeting(some, boxes, [&](int i, int other) {
			const int block = asked[i];
			if (block != other && (within(block, other) || within(other, block)))
				refuse(std::min(block, other), std::max(block, other), a.centroid(std::max(block, other)));
		});
	}

	/// As detectSegments, of pairs of edges of which at least one is chosen.
	std::vector<Segment> detectSome(const BlockAssembly& a, Real tolerance, const Chosen& chosen)
	{
		require(tolerance > 0 && tolerance < 0.1, "detectSegments: tolerance must lie in (0, 0.1)", tolerance);
		std::vector<Edge> edges(a.mesh.edgeNodes.size());
		for (int block = 0; block < a.blockCount(); ++block) {
			const Real width = meanWidth(outlineOf(a, block));
			for (int i = a.mesh.firstEdge[block]; i < a.mesh.firstEdge[block + 1]; ++i) {
				const Vec2 p = a.position(a.mesh.edgeNodes[i][0]), q = a.position(a.mesh.edgeNodes[i][1]);
				edges[i] = { p, q, (q - p).normalized(), (q - p).norm(), std::min((q - p).norm(), width), block, i };
			}
		}

		std::vector<Box> boxes, some;
		std::vector<int> asked; // the edges of `some`
		boxes.reserve(edges.size());
		for (const Edge& e : edges) {
			boxes.push_back(grown(boxOf(e.a, e.b), tolerance * e.length));
			if (chosen[e.index]) some.push_back(boxes.back()), asked.push_back(e.index);
		}
		struct Found {
			int     edge1, edge2;
			Segment segment;
		};
		std::vector<Found> found;
		const auto         meet = [&](int one, int other) {
                        const Edge *e1 = &edges[one], *e2 = &edges[other];
                        if (e1->block == e2->block) return;
                        if (e1->block > e2->block) std::swap(e1, e2);
                        if (penetrate(*e1, *e2, tolerance)) refuse(e1->block, e2->block, e1->a);
                        Segment g;
                        if (!overlap(*e1, *e2, tolerance, g)) return;
                        const auto &n1 = a.mesh.edgeNodes[e1->index], &n2 = a.mesh.edgeNodes[e2->index];
                        g.node  = { n1[0], n1[1], n2[0], n2[1] };
                        g.block = { e1->block, e2->block };
                        g.area *= a.thickness;
                        found.push_back({ e1->index, e2->index, g });
		};
		if (some.size() == boxes.size())
			forEachMeeting(boxes, meet);
		else
			forEachMeeting(some, boxes, [&](int i, int other) {
				if (!chosen[other] || asked[i] < other) meet(asked[i], other); // two that are chosen meet twice
			});
		requireNoneWithin(a, chosen);
		std::sort(found.begin(), found.end(), [](const Found& x, const Found& y) { // by block pair, then edge by edge
			return std::tie(x.segment.block, x.edge1, x.edge2) < std::tie(y.segment.block, y.edge1, y.edge2);
		});
		std::vector<Segment> segments;
		segments.reserve(found.size());
		for (const Found& f : found)
			segments.push_back(f.segment);
		return segments;
	}

	/// Edges that are not joined over all of their length: others have no room for a further neighbour.
	Chosen edgesWithRoom(const BlockAssembly& a, Real tolerance)
	{
		std::vector<Real> joined(a.mesh.edgeNodes.size(), 0);
		std::vector<int>  startsAt(a.nodeCount(), -1);
		for (size_t e = 0; e < a.mesh.edgeNodes.size(); ++e)
			startsAt[a.mesh.edgeNodes[e][0]] = int(e);
		for (const Segment& g : a.joints.segments)
			for (int side : { 0, 2 })
				joined[startsAt[g.node[side]]] += 2 * g.area / a.thickness;
		Chosen chosen(joined.size());
		for (size_t e = 0; e < joined.size(); ++e)
			chosen[e] = joined[e] < (1 - tolerance) * a.between(a.mesh.edgeNodes[e][0], a.mesh.edgeNodes[e][1]).norm();
		return chosen;
	}

} // namespace

std::vector<Segment> detectSegments(const BlockAssembly& a, Real tolerance) { return detectSome(a, tolerance, Chosen(a.mesh.edgeNodes.size(), true)); }

std::vector<Unjoined> unjoinedBlocks(const BlockAssembly& a, Real tolerance)
{
	std::vector<Unjoined> list;
	for (const Segment& g : detectSome(a, tolerance, edgesWithRoom(a, tolerance))) {
		if (pairOf(a, g.block) >= 0) continue;
		if (list.empty() || list.back().block != g.block) list.push_back({ g.block, std::numeric_limits<Real>::infinity() });
		for (int k : { 0, 1 }) {
			const Vec2 first = a.position(g.node[0]) + g.s1[k] * a.between(g.node[0], g.node[1]);
			const Vec2 other = a.position(g.node[2]) + g.s2[k] * a.between(g.node[2], g.node[3]);
			list.back().gap  = std::min(list.back().gap, (other - first).norm());
		}
	}
	return list;
}

} // namespace blocks
