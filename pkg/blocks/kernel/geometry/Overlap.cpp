// yade-blocks, GPL-2.0-or-later

#include <blocks/kernel/geometry/Boxes.hpp>
#include <blocks/kernel/geometry/Polygon.hpp>

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_triangulation_decomposition_2.h>
#include <CGAL/Polygon_with_holes_2.h>

#include <list>

namespace blocks {
namespace {

	using Exact        = CGAL::Exact_predicates_exact_constructions_kernel;
	using ExactRing    = CGAL::Polygon_2<Exact>;
	using ExactPolygon = CGAL::Polygon_with_holes_2<Exact>;

	ExactRing exact(const Ring& ring)
	{
		ExactRing out;
		for (const Vec2& p : ring)
			out.push_back({ p.x(), p.y() });
		return out;
	}

	ExactPolygon exact(const Polygon& polygon)
	{
		ExactPolygon out(exact(polygon.outer));
		for (const Ring& hole : polygon.holes)
			out.add_hole(exact(hole));
		return out;
	}

} // namespace

Real overlapDepth(const Polygon& a, const Polygon& b)
{
	const Box common = boxOf(a.outer).intersection(boxOf(b.outer));
	if (common.isEmpty() || common.volume() == 0) return 0; // neighbours in a wall: most pairs that are asked for
	std::list<ExactPolygon> pieces;
	CGAL::intersection(exact(a), exact(b), std::back_inserter(pieces));
	Real depth = 0;
	for (const ExactPolygon& piece : pieces) {
		std::vector<ExactRing> triangles;
		CGAL::Polygon_triangulation_decomposition_2<Exact>()(piece, std::back_inserter(triangles));
		for (const ExactRing& triangle : triangles) {
			Vec2 centroid = Vec2::Zero();
			for (auto v = triangle.vertices_begin(); v != triangle.vertices_end(); ++v)
				centroid += Vec2(CGAL::to_double(v->x()), CGAL::to_double(v->y())) / 3;
			depth = std::max(depth, std::min(distanceFromOutline(centroid, a), distanceFromOutline(centroid, b)));
		}
	}
	return depth;
}

} // namespace blocks
