// yade-blocks, GPL-2.0-or-later
#include <CGAL/box_intersection_d.h>
#include <algorithm>
#include <blocks/kernel/model/ContactDetection.hpp>

namespace blocks {
namespace {

	struct Edge {
		Vec2 a, b, along; // from a to b, unit direction
		Real length;
		int  block, index;
	};

	/// Whether two edges cross, or run the same way along each other: either means that their blocks overlap.
	/// Ends that come within the tolerance of the other edge are touching, not crossing.
	bool penetrate(const Edge& e1, const Edge& e2, Real tolerance)
	{
		const Real reach = tolerance * std::min(e1.length, e2.length);
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
		const Real reach = tolerance * std::min(e1.length, e2.length);

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

} // namespace

std::vector<Segment> detectSegments(const BlockAssembly& a, Real tolerance)
{
	require(tolerance > 0 && tolerance < 0.1, "detectSegments: tolerance must lie in (0, 0.1)", tolerance);
	std::vector<Edge> edges(a.mesh.edgeNodes.size());
	for (int block = 0; block < a.blockCount(); ++block)
		for (int i = a.mesh.firstEdge[block]; i < a.mesh.firstEdge[block + 1]; ++i) {
			const Vec2 p = a.position(a.mesh.edgeNodes[i][0]), q = a.position(a.mesh.edgeNodes[i][1]);
			edges[i] = { p, q, (q - p).normalized(), (q - p).norm(), block, i };
		}

	using Box = CGAL::Box_intersection_d::Box_with_handle_d<Real, 2, const Edge*, CGAL::Box_intersection_d::ID_EXPLICIT>;
	std::vector<Box> boxes;
	boxes.reserve(edges.size());
	for (const Edge& e : edges) {
		const Real margin = tolerance * e.length;
		Real       lo[]   = { std::min(e.a.x(), e.b.x()) - margin, std::min(e.a.y(), e.b.y()) - margin };
		Real       hi[]   = { std::max(e.a.x(), e.b.x()) + margin, std::max(e.a.y(), e.b.y()) + margin };
		boxes.emplace_back(lo, hi, &e);
	}
	struct Found {
		int     edge1, edge2;
		Segment segment;
	};
	std::vector<Found> found;
	CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& p, const Box& q) {
		const Edge *e1 = p.handle(), *e2 = q.handle();
		if (e1->block == e2->block) return;
		if (e1->block > e2->block) std::swap(e1, e2);
		if (penetrate(*e1, *e2, tolerance))
			throw std::invalid_argument(
				"blocks " + std::to_string(e1->block) + " and " + std::to_string(e2->block) + " overlap near (" + shown(e1->a.x()) + ", "
				+ shown(e1->a.y()) + "): regions must not overlap");
		Segment g;
		if (!overlap(*e1, *e2, tolerance, g)) return;
		const auto &n1 = a.mesh.edgeNodes[e1->index], &n2 = a.mesh.edgeNodes[e2->index];
		g.node  = { n1[0], n1[1], n2[0], n2[1] };
		g.block = { e1->block, e2->block };
		g.area *= a.thickness;
		found.push_back({ e1->index, e2->index, g });
	});
	std::sort(found.begin(), found.end(), [](const Found& x, const Found& y) { // by block pair, then edge by edge
		return std::tie(x.segment.block, x.edge1, x.edge2) < std::tie(y.segment.block, y.edge1, y.edge2);
	});
	std::vector<Segment> segments;
	segments.reserve(found.size());
	for (const Found& f : found)
		segments.push_back(f.segment);
	return segments;
}

} // namespace blocks
