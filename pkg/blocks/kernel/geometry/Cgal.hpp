// yade-blocks, GPL-2.0-or-later
#pragma once
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <blocks/kernel/Types.hpp>

/// Points as CGAL wants them. For the geometry's own source files; its headers are free of CGAL, which takes long to compile.
namespace blocks {

using K = CGAL::Exact_predicates_inexact_constructions_kernel;

inline K::Point_2 toK(const Vec2& p) { return { p.x(), p.y() }; }
inline Vec2       fromK(const K::Point_2& p) { return { p.x(), p.y() }; }

inline std::vector<K::Point_2> toK(const Ring& ring)
{
	std::vector<K::Point_2> points;
	for (const Vec2& p : ring)
		points.push_back(toK(p));
	return points;
}

} // namespace blocks
