// yade-blocks, GPL-2.0-or-later

#include <algorithm>
#include <blocks/kernel/geometry/CellMerger.hpp>

namespace blocks {

void CellMerger::divideNecks()
{
	for (size_t c = 0; c < cells.size(); ++c) // cells added by divide() have their turn too
		while (trim(int(c)) || shorten(int(c)) || divide(int(c)) || divideAtEdge(int(c))) { }
	mergeEdges();
}

bool CellMerger::trim(int cell)
{
	const IntRing ring = cells[cell];
	const size_t  n    = ring.size();
	for (size_t k = 0; k < n && n > 3; ++k)
		for (bool forward : { true, false }) {
			const int  corner = ring[k], tip = ring[forward ? (k + 1) % n : (k + n - 1) % n], far = ring[forward ? (k + 2) % n : (k + n - 2) % n];
			const Vec2 arm = d.position[far] - d.position[tip], p = d.position[corner] - d.position[tip];
			if (d.place[corner].kind != Place::corner || p.dot(arm) <= 0 || p.dot(arm) > arm.squaredNorm() + tolerance * arm.norm()) continue;
			const Real width = std::abs(cross(arm, p)) / arm.norm();
			if (width >= shortest) continue;

			changed.clear();
			changed[cell] = ring;
			changed[cell].erase(changed[cell].begin() + (std::find(ring.begin(), ring.end(), tip) - ring.begin()));
			for (int c : around[tip]) {
				if (c == cell || !adjacent(cells[c], tip, far)) continue;
				IntRing&   other = changed[c] = cells[c];
				const auto at                 = std::find(other.begin(), other.end(), forward ? far : tip); // the neighbour runs the other way
				other.insert(at + 1, corner);
				if (std::count(other.begin(), other.end(), corner) > 1) changed.clear(); // would meet itself there
				break;
			}
			if (changed.size() != 2) continue;
			const Vec2 old = d.position[far];
			if (width > tolerance) {
				const int beyond = changed.begin()->first == cell ? changed.rbegin()->first : changed.begin()->first;
				giveWay(far, corner, nextTo(changed[beyond], far, !forward), ring[forward ? (k + 3) % n : (k + n - 3) % n]);
			}
			dissolve(tip);
			if (acceptChanges(width <= tolerance)) return true;
			d.position[far] = old;
		}
	return false;
}

bool CellMerger::shorten(int cell)
{
	const IntRing ring = cells[cell];
	const size_t  n    = ring.size();
	for (size_t k = 0; k < n && n > 3; ++k)
		for (bool forward : { true, false }) {
			const int  corner = ring[k], tip = ring[forward ? (k + 1) % n : (k + n - 1) % n], far = ring[forward ? (k + 2) % n : (k + n - 2) % n];
			const Vec2 side = d.position[corner] - d.position[tip], q = d.position[far] - d.position[tip];
			if (d.place[corner].kind != Place::corner || d.place[far].kind != Place::inside || cellsAlong(corner, tip) != 1) continue;
			if (q.dot(side) <= 0 || q.dot(side) >= side.squaredNorm()) continue;
			const Real width = std::abs(cross(side, q)) / side.norm();
			if (width >= shortest) continue;

			const int wall = d.place[forward ? corner : tip].wall; // a wall's pieces begin at its corner or at a point on it
			changed.clear();
			for (int c : around[far])
				changed[c] = cells[c];
			changed[cell].erase(std::find(changed[cell].begin(), changed[cell].end(), tip));
			const Vec2 old = d.position[far];
			moveToWall(far, d.position[tip] + q.dot(side) / side.squaredNorm() * side, wall);
			dissolve(tip);
			if (acceptChanges(width <= tolerance)) return true;
			d.position[far] = old;
			d.place[far]    = { Place::inside, -1 };
		}
	return false;
}

bool CellMerger::divide(int cell)
{
	const IntRing ring = cells[cell];
	const size_t  n    = ring.size();
	for (size_t k = 0; k < n; ++k)
		for (size_t m = 2; m + 1 < n; ++m) { // the nodes that are not next to k
			const int corner = ring[k], node = ring[(k + m) % n];
			if (d.place[corner].kind != Place::corner || d.place[node].kind != Place::inside || length(corner, node) >= shortest) continue;
			changed.clear();
			bool possible = true;
			for (int c : around[node]) {
				possible       = possible && (c == cell || !std::count(cells[c].begin(), cells[c].end(), corner));
				IntRing& other = changed[c] = cells[c];
				std::replace(other.begin(), other.end(), node, corner);
			}
			IntRing turned = ring; // from the corner on
			std::rotate(turned.begin(), turned.begin() + k, turned.end());
			changed[cell]                      = IntRing(turned.begin(), turned.begin() + m);
			changed[int(cells.size())]         = IntRing(turned.begin() + m, turned.end());
			changed[int(cells.size())].front() = corner;
			if (!possible || m < 3 || n - m < 3) continue;
			cells.emplace_back();
			if (acceptChanges(length(corner, node) <= tolerance)) return true;
			cells.pop_back();
		}
	return false;
}

bool CellMerger::divideAtEdge(int cell)
{
	const IntRing ring = cells[cell];
	const size_t  n    = ring.size();
	for (size_t k = 0; k < n; ++k)
		for (size_t m = 2; m + 2 < n; ++m) { // edges from the m-th node after the corner to the next
			const int corner = ring[k], a = ring[(k + m) % n], b = ring[(k + m + 1) % n];
			if (d.place[corner].kind != Place::corner) break;
			const Vec2 along = d.position[b] - d.position[a], p = d.position[corner] - d.position[a];
			if (p.dot(along) <= 0 || p.dot(along) >= along.squaredNorm()) continue;
			const Real width = std::abs(cross(along, p)) / along.norm();
			if (width >= shortest) continue;
			for (int beyond : around[a]) {
				if (beyond == cell || !adjacent(cells[beyond], a, b) || std::count(cells[beyond].begin(), cells[beyond].end(), corner))
					continue;
				changed.clear();
				IntRing& other = changed[beyond] = cells[beyond];
				other.insert(std::find(other.begin(), other.end(), b) + 1, corner); // it runs from b to a
				IntRing turned = ring;                                              // from the corner on
				std::rotate(turned.begin(), turned.begin() + k, turned.end());
				changed[cell] = IntRing(turned.begin(), turned.begin() + m + 1);
				IntRing& rest = changed[int(cells.size())];
				rest          = IntRing(turned.begin() + m, turned.end());
				rest.front()  = corner;
				// The neighbour must not be dented at the edge's ends: these give way.
				const Vec2 oldA = d.position[a], oldB = d.position[b];
				if (width > tolerance) {
					giveWay(a, corner, nextTo(other, a, true), turned[m - 1]);
					giveWay(b, corner, nextTo(other, b, false), turned[(m + 2) % n]);
				}
				cells.emplace_back();
				if (acceptChanges(width <= tolerance)) return true;
				cells.pop_back();
				d.position[a] = oldA, d.position[b] = oldB;
				break;
			}
		}
	return false;
}

int CellMerger::nextTo(const IntRing& ring, int node, bool after)
{
	const size_t n = ring.size(), at = std::find(ring.begin(), ring.end(), node) - ring.begin();
	return ring[(at + (after ? 1 : n - 1)) % n];
}

void CellMerger::giveWay(int node, int from, int to, int along)
{
	if (d.place[node].kind != Place::inside) return;
	const Vec2 line = d.position[to] - d.position[from], p = d.position[node] - d.position[from];
	const Vec2 way    = d.position[along] - d.position[node];
	const Real behind = cross(line, p), pace = cross(line, way);
	if (pace == 0 || !(-behind / pace > 0 && -behind / pace < 1)) return;
	const Vec2 there = d.position[node] - behind / pace * way;
	const Real share = (there - d.position[from]).dot(line) / line.squaredNorm();
	if (!(share > 0 && share < 1)) return;
	d.position[node] = there;
	for (int c : around[node])
		changed.try_emplace(c, cells[c]);
}

} // namespace blocks
