// yade-blocks, GPL-2.0-or-later

#include <algorithm>
#include <blocks/kernel/geometry/CellMerger.hpp>
#include <blocks/kernel/geometry/Merging.hpp>
#include <set>

namespace blocks {

CellMerger::CellMerger(Diagram& diagram, const Walls& w, Real shortestEdge, Real coincidence)
	: d(diagram)
	, walls(w)
	, shortest(shortestEdge)
	, tolerance(coincidence)
{
	around.resize(d.position.size());
	for (size_t c = 0; c < d.pieces.size(); ++c) {
		cells.push_back(d.pieces[c].ring);
		for (int node : cells[c])
			around[node].push_back(int(c));
	}
	const int corners = int(walls.corner.size());
	reflex.assign(corners, 0);
	for (int k = 0; k < corners; ++k)
		if (cross(walls.along(k), walls.along(walls.next[k])) < 0) reflex[walls.next[k]] = 1;
}

Cells CellMerger::run()
{
	for (size_t c = 0; c < cells.size(); ++c)
		queueEdges(int(c));
	mergeEdges();
	divideNecks();
	for (size_t c = 0; c < cells.size(); ++c)
		if (!cells[c].empty() && thin(int(c))) flatten(int(c));
	mergeEdges();
	// Flattening may leave arms along walls beyond a corner that is not convex.
	if (std::count(reflex.begin(), reflex.end(), 1) > 0) divideNecks();
	return result();
}

void CellMerger::mergeEdges()
{
	while (!queue.empty()) {
		const auto [was, a, b] = queue.top();
		while (!queue.empty() && queue.top() == Edge(was, a, b))
			queue.pop(); // each interior edge was queued by both its cells
		if (length(a, b) == was) merge(a, b);
	}
}

void CellMerger::merge(int a, int b)
{
	std::vector<int> common;
	std::set_intersection(around[a].begin(), around[a].end(), around[b].begin(), around[b].end(), std::back_inserter(common));
	for (int c : common)
		if (!adjacent(cells[c], a, b)) return; // would pinch the cell
	if (common.empty()) return;                    // not an edge (any more)

	if (d.place[b].kind < d.place[a].kind) std::swap(a, b); // a is at least as fixed as b
	const bool alongWall = common.size() == 1;
	if (d.place[b].kind == Place::corner) return;
	if (d.place[b].kind == Place::onWall && !alongWall) return; // an edge across the region

	std::vector<Vec2> targets { d.position[a] };
	if (d.place[a].kind == d.place[b].kind) targets = { (d.position[a] + d.position[b]) / 2, d.position[a], d.position[b] };
	for (const Vec2& target : targets)
		if (collapse(a, b, target)) return;
}

bool CellMerger::collapse(int a, int b, const Vec2& target)
{
	changed.clear();
	std::set<int> loose; // nodes that lose a cell
	for (int node : { a, b })
		for (int c : around[node]) {
			IntRing& ring = changed[c] = cells[c];
			std::replace(ring.begin(), ring.end(), b, a);
			ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
			if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
			if (ring.size() > 2) continue;
			loose.insert(ring.begin(), ring.end());
			ring.clear();
		}
	const bool coincide = length(a, b) <= tolerance;
	const Vec2 old      = d.position[a];
	d.position[a]       = target;
	for (int node : loose)
		dissolve(node);
	if (acceptChanges(coincide)) return true;
	d.position[a] = old;
	return false;
}

Cells CellMerger::result() const
{
	Cells            out;
	std::vector<int> number(d.position.size(), -1);
	for (const IntRing& ring : cells)
		for (int node : ring)
			number[node] = 0;
	for (size_t node = 0; node < number.size(); ++node)
		if (number[node] == 0) {
			number[node] = int(out.vertices.size());
			out.vertices.push_back(d.position[node]);
		}
	Real inner = 0, sqrtArea = 0;
	int  innerSides = 0;
	for (const IntRing& ring : cells) {
		if (ring.empty()) continue;
		IntRing cell;
		for (int node : ring)
			cell.push_back(number[node]);
		out.cells.push_back(cell);
		sqrtArea += std::sqrt(signedArea(ringOf(out, out.cells.size() - 1)));
		for (size_t k = 0, n = ring.size(); k < n; ++k) {
			if (cellsAlong(ring[k], ring[(k + 1) % n]) < 2) continue;
			inner += length(ring[k], ring[(k + 1) % n]);
			++innerSides;
		}
	}
	out.meanEdge     = innerSides ? inner / innerSides : 0;
	out.meanSqrtArea = sqrtArea / Real(out.cells.size());
	return out;
}

Cells mergeShortEdges(Diagram& diagram, const Walls& region, Real shortest, Real tolerance) { return CellMerger(diagram, region, shortest, tolerance).run(); }

} // namespace blocks
