// yade-blocks, GPL-2.0-or-later

#include <CGAL/Polygon_2_algorithms.h>
#include <algorithm>
#include <blocks/kernel/geometry/CellMerger.hpp>
#include <blocks/kernel/geometry/Cgal.hpp>

namespace blocks {

void CellMerger::queueEdges(int cell)
{
	const IntRing& ring = cells[cell];
	for (size_t k = 0, n = ring.size(); k < n; ++k) {
		const int a = ring[k], b = ring[(k + 1) % n];
		if (length(a, b) < shortest) queue.emplace(length(a, b), std::min(a, b), std::max(a, b));
	}
}

bool CellMerger::adjacent(const IntRing& ring, int a, int b)
{
	for (size_t k = 0, n = ring.size(); k < n; ++k)
		if ((ring[k] == a && ring[(k + 1) % n] == b) || (ring[k] == b && ring[(k + 1) % n] == a)) return true;
	return false;
}

void CellMerger::dissolve(int node)
{
	if (d.place[node].kind == Place::corner) return;
	std::vector<IntRing*> owners;
	for (auto& [c, ring] : changed)
		if (std::find(ring.begin(), ring.end(), node) != ring.end()) owners.push_back(&ring);
	for (int c : around[node])
		if (!changed.count(c)) return;
	if (owners.size() != (d.place[node].kind == Place::inside ? 2 : 1)) return;
	for (IntRing* ring : owners)
		ring->erase(std::find(ring->begin(), ring->end(), node));
}

bool CellMerger::acceptChanges(bool harmless)
{
	for (const auto& [c, ring] : changed)
		if (!harmless && !ring.empty() && !valid(ring)) return false;
	for (const auto& [c, ring] : changed) {
		for (int node : cells[c])
			around[node].erase(std::find(around[node].begin(), around[node].end(), c));
		for (int node : ring)
			around[node].insert(std::upper_bound(around[node].begin(), around[node].end(), c), c);
		cells[c] = ring;
	}
	for (const auto& [c, ring] : changed)
		queueEdges(c);
	return true;
}

bool CellMerger::valid(const IntRing& ring) const
{
	const size_t n = ring.size();
	if (n < 3) return false;
	bool hasReflex = false;
	for (size_t k = 0; k < n; ++k) {
		const Vec2 &a = d.position[ring[k]], &b = d.position[ring[(k + 1) % n]], &c = d.position[ring[(k + 2) % n]];
		const int   middle  = ring[(k + 1) % n];
		const bool  mayDent = d.place[middle].kind == Place::corner && reflex[middle];
		hasReflex           = hasReflex || mayDent;
		if (mayDent) continue;
		const Real turn = cross(b - a, c - b), slack = tolerance * (c - a).norm();
		if (turn < -slack || (turn <= 0 && (b - a).dot(c - b) < -slack)) return false; // dented, or folded back
	}
	if (empty(ring)) return false;
	if (hasReflex) return simple(ring);
	for (size_t k = 1; k + 1 < n; ++k) { // it turns left everywhere; once only?
		const Vec2 &o = d.position[ring[0]], &a = d.position[ring[k]], &b = d.position[ring[k + 1]];
		if (twiceArea(o, a, b) < -tolerance * ((a - o).norm() + (b - o).norm())) return false;
	}
	return true;
}

Real CellMerger::meanWidth(const IntRing& ring) const
{
	Real perimeter = 0;
	for (size_t k = 0, n = ring.size(); k < n; ++k)
		perimeter += length(ring[k], ring[(k + 1) % n]);
	const Real area = signedArea(ring.size(), [&](size_t k) -> const Vec2& { return d.position[ring[k]]; });
	return perimeter > 0 ? 2 * area / perimeter : 0;
}

bool CellMerger::simple(const IntRing& ring) const
{
	std::vector<K::Point_2> outline; // without edges of rounding length, whose direction means nothing
	for (size_t k = 0, n = ring.size(); k < n; ++k)
		if (length(ring[k], ring[(k + 1) % n]) > tolerance) outline.push_back(toK(d.position[ring[k]]));
	return CGAL::is_simple_2(outline.begin(), outline.end(), K());
}

int CellMerger::cellsAlong(int a, int b) const
{
	int n = 0;
	for (int c : around[a])
		n += adjacent(cells[c], a, b);
	return n;
}

void CellMerger::moveToWall(int node, const Vec2& position, int wall)
{
	d.position[node] = position;
	d.place[node]    = { Place::onWall, wall };
	if (walls.along(wall).x() == 0) d.position[node].x() = walls.corner[wall].x();
	if (walls.along(wall).y() == 0) d.position[node].y() = walls.corner[wall].y();
}

} // namespace blocks
