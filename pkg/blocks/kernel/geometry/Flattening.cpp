// yade-blocks, GPL-2.0-or-later

#include <algorithm>
#include <blocks/kernel/geometry/CellMerger.hpp>
#include <limits>
#include <set>

namespace blocks {

std::pair<size_t, Real> CellMerger::base(const IntRing& ring) const
{
	std::pair<size_t, Real> best { 0, std::numeric_limits<Real>::infinity() };
	Real                    longest = 0;
	for (size_t k = 0, n = ring.size(); k < n; ++k) {
		const Vec2 a = d.position[ring[k]], edge = d.position[ring[(k + 1) % n]] - a, t = edge.normalized();
		Real       farthest = 0;
		for (int node : ring)
			farthest = std::max(farthest, cross(t, d.position[node] - a));
		const bool alike = std::abs(farthest - best.second) <= tolerance; // a cell of no width: all its nodes on one line
		if (alike ? edge.norm() > longest : farthest < best.second) best = { k, farthest }, longest = edge.norm();
	}
	return best;
}

void CellMerger::flatten(int cell)
{
	IntRing ring = cells[cell];
	std::rotate(ring.begin(), ring.begin() + base(ring).first, ring.end());
	const int        a = ring[0], b = ring[1];
	std::vector<int> common;
	std::set_intersection(around[a].begin(), around[a].end(), around[b].begin(), around[b].end(), std::back_inserter(common));
	common.erase(std::find(common.begin(), common.end(), cell));
	// those beyond the base, not those that merely meet both of its ends: these may be corners of one hole
	common.erase(std::remove_if(common.begin(), common.end(), [&](int c) { return !adjacent(cells[c], a, b); }), common.end());
	if (common.size() > 1) return;
	const int wall = common.empty() ? d.place[a].wall : -1; // a wall's pieces begin at its corner or at a point on it

	const Vec2        start = d.position[a], base = d.position[b] - start;
	std::vector<Vec2> old;
	bool              possible = true;
	const auto        moves    = [&](int node) { return d.place[node].kind == Place::inside; };
	Real              last     = 1; // the others follow b, going back to a
	for (size_t k = 2; k < ring.size(); ++k) {
		const Real along = (d.position[ring[k]] - start).dot(base) / base.squaredNorm();
		possible         = possible && (moves(ring[k]) || wall < 0) && along < last && along > 0;
		last             = along;
	}
	if (!possible) return;
	std::vector<Place> places;
	changed.clear();
	for (size_t k = 2; k < ring.size(); ++k) {
		const int  node     = ring[k];
		const Vec2 position = d.position[node];
		old.push_back(position), places.push_back(d.place[node]);
		if (moves(node)) d.position[node] = start + (position - start).dot(base) / base.squaredNorm() * base;
		if (wall >= 0) moveToWall(node, d.position[node], wall);
		for (int c : around[ring[k]])
			changed[c] = cells[c];
	}
	for (int end : { a, b })
		for (int c : around[end])
			changed[c] = cells[c];
	changed[cell].clear();
	if (!common.empty()) {
		const int  beyond = common[0];
		IntRing&   other  = changed[beyond];
		const auto atB    = std::find(other.begin(), other.end(), b);
		if (ring.size() > 2) other.insert(atB + 1, ring.begin() + 2, ring.end());
		std::set<int> distinct(other.begin(), other.end());
		possible = distinct.size() == other.size();
	}
	for (int node : ring)
		dissolve(node);
	if (possible && acceptChanges()) return;
	for (size_t k = 2; k < ring.size(); ++k) {
		d.position[ring[k]] = old[k - 2];
		d.place[ring[k]]    = places[k - 2];
	}
}

} // namespace blocks
