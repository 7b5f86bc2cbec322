// yade-blocks, GPL-2.0-or-later

#include <blocks/kernel/geometry/ZoneMesh.hpp>

#include <algorithm>

namespace blocks {

Zones outlineOf(const Polygon& polygon)
{
	Zones      zones;
	const auto add = [&](const Ring& ring) {
		zones.rings.emplace_back();
		for (const Vec2& p : ring) {
			zones.rings.back().push_back(int(zones.points.size()));
			zones.points.push_back(p);
		}
	};
	add(polygon.outer);
	for (const Ring& hole : polygon.holes)
		add(hole);
	return zones;
}

void triangulateOutline(Triangulation& mesh, const Zones& zones)
{
	std::vector<Triangulation::Vertex_handle> node;
	for (size_t i = 0; i < zones.points.size(); ++i) {
		node.push_back(mesh.insert(toK(zones.points[i])));
		node.back()->info() = int(i);
	}
	for (const auto& ring : zones.rings)
		for (size_t k = 0, n = ring.size(); k < n; ++k)
			mesh.insert_constraint(node[ring[k]], node[ring[(k + 1) % n]]);

	for (auto f = mesh.all_faces_begin(); f != mesh.all_faces_end(); ++f)
		f->info() = false;
	std::vector<Triangulation::Face_handle> todo;
	const auto                              enter = [&](Triangulation::Face_handle f) {
                if (f->info()) return;
                f->info() = true;
                todo.push_back(f);
	};
	for (const auto& ring : zones.rings) // the material is on the left of every outline edge; from there to where no outline is crossed
		for (size_t k = 0, n = ring.size(); k < n; ++k) {
			Triangulation::Face_handle f;
			int                        i = 0;
			mesh.is_edge(node[ring[k]], node[ring[(k + 1) % n]], f, i);
			if (f->vertex(Triangulation::ccw(i)) != node[ring[k]]) f = f->neighbor(i);
			enter(f);
		}
	while (!todo.empty()) {
		const auto f = todo.back();
		todo.pop_back();
		for (int e = 0; e < 3; ++e)
			if (!f->is_constrained(e)) enter(f->neighbor(e));
	}
}

std::array<int, 3> nodesOf(Triangulation::Face_handle f) { return { f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info() }; }

void takeTriangles(const Triangulation& mesh, Zones& zones)
{
	for (auto f = mesh.finite_faces_begin(); f != mesh.finite_faces_end(); ++f) {
		if (!f->info()) continue;
		auto t = nodesOf(f);
		std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
		zones.triangles.push_back(t);
	}
	std::sort(zones.triangles.begin(), zones.triangles.end());
}

Zones checked(Zones zones, const std::string& name)
{
	for (const auto& t : zones.triangles)
		require(twiceArea(zones.points[t[0]], zones.points[t[1]], zones.points[t[2]]) > 0,
		        name + ": every zone must have a positive area",
		        twiceArea(zones.points[t[0]], zones.points[t[1]], zones.points[t[2]]) / 2);
	return zones;
}

void requireZoneSize(const std::string& name, Real zoneSize, const Ring& ring)
{
	require(zoneSize > 0 && std::isfinite(zoneSize), name + ": zoneSize must be positive", zoneSize);
	require(signedArea(ring) / (zoneSize * zoneSize) < 1e7,
	        name + ": zoneSize must be larger than sqrt(area)/3e3, as 1e7 zones in a block are too many",
	        zoneSize);
}

} // namespace blocks
