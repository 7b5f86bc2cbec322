// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/geometry/Cgal.hpp>
#include <blocks/kernel/geometry/Zoning.hpp>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

/// A block's zones while they are being made: CGAL's constrained Delaunay triangulation, and what goes into it and out of it.
namespace blocks {

using Vertex        = CGAL::Triangulation_vertex_base_with_info_2<int, K>;
using InFace        = CGAL::Triangulation_face_base_with_info_2<bool, K, CGAL::Constrained_triangulation_face_base_2<K>>; // info: inside the block?
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<K, CGAL::Triangulation_data_structure_2<Vertex, InFace>, CGAL::No_constraint_intersection_tag>;

/// Triangulates the outline and marks the faces inside it.
void triangulateOutline(Triangulation&, const Zones& outline);

std::array<int, 3> nodesOf(Triangulation::Face_handle);

/// The faces inside the outline as triangles, in an order that does not depend on CGAL's.
void takeTriangles(const Triangulation&, Zones&);

/// Nothing else says that a zone can be computed with: positive area in floating point, not only in exact arithmetic.
Zones checked(Zones, const std::string& name);

void requireZoneSize(const std::string& name, Real zoneSize, const Ring& outline);

} // namespace blocks
