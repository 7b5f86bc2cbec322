// yade-blocks, GPL-2.0-or-later

#include <blocks/kernel/geometry/Cgal.hpp>
#include <blocks/kernel/geometry/Merging.hpp>

#include <CGAL/Polygon_2_algorithms.h>

#include <algorithm>
#include <limits>
#include <map>
#include <queue>
#include <set>
#include <tuple>

namespace blocks {
namespace {

	/// Merges short edges, shortest first, and flattens thin cells. An operation is carried out only if every cell it
	/// touches stays a valid cell; otherwise nothing changes.
	class Merger {
	public:
		Merger(Diagram& diagram, const Walls& w, Real shortestEdge, Real coincidence)
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

		Cells run()
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

	private:
		Diagram&                      d;
		const Walls&                  walls;
		const Real                    shortest, tolerance; ///< [m]
		std::vector<IntRing>          cells;               ///< empty where a cell has vanished
		std::vector<std::vector<int>> around;              ///< by node: its cells
		std::vector<char>             reflex;              ///< by corner

		using Edge = std::tuple<Real, int, int>; // length, lower node, higher node: a total order
		std::priority_queue<Edge, std::vector<Edge>, std::greater<>> queue;
		std::map<int, IntRing>                                       changed; ///< the operation under test: new rings by cell

		void divideNecks()
		{
			for (size_t c = 0; c < cells.size(); ++c) // cells added by divide() have their turn too
				while (trim(int(c)) || shorten(int(c)) || divide(int(c)) || divideAtEdge(int(c))) { }
			mergeEdges();
		}

		Real length(int a, int b) const { return (d.position[a] - d.position[b]).norm(); }

		void queueEdges(int cell)
		{
			const IntRing& ring = cells[cell];
			for (size_t k = 0, n = ring.size(); k < n; ++k) {
				const int a = ring[k], b = ring[(k + 1) % n];
				if (length(a, b) < shortest) queue.emplace(length(a, b), std::min(a, b), std::max(a, b));
			}
		}

		void mergeEdges()
		{
			while (!queue.empty()) {
				const auto [was, a, b] = queue.top();
				while (!queue.empty() && queue.top() == Edge(was, a, b))
					queue.pop(); // each interior edge was queued by both its cells
				if (length(a, b) == was) merge(a, b);
			}
		}

		void merge(int a, int b)
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

		static bool adjacent(const IntRing& ring, int a, int b)
		{
			for (size_t k = 0, n = ring.size(); k < n; ++k)
				if ((ring[k] == a && ring[(k + 1) % n] == b) || (ring[k] == b && ring[(k + 1) % n] == a)) return true;
			return false;
		}

		bool collapse(int a, int b, const Vec2& target)
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

		/// Drops a node of the changed rings if it no longer separates anything. (All its cells are among them if so.)
		void dissolve(int node)
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

		/// Carries the operation out if every new ring is valid. `harmless`: only coincident nodes were joined, which makes no
		/// ring worse; rings that coincidences of region and diagram have left invalid become valid in this way.
		bool acceptChanges(bool harmless = false)
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

		/// Convex but for the region's reflex corners, dented by no more than the tolerance, and not degenerate.
		bool valid(const IntRing& ring) const
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

		/// No more area than rounding gives.
		bool empty(const IntRing& ring) const { return meanWidth(ring) <= tolerance; }

		/// Twice the area by the perimeter [m]: less than the width.
		Real meanWidth(const IntRing& ring) const
		{
			Real perimeter = 0;
			for (size_t k = 0, n = ring.size(); k < n; ++k)
				perimeter += length(ring[k], ring[(k + 1) % n]);
			const Real area = signedArea(ring.size(), [&](size_t k) -> const Vec2& { return d.position[ring[k]]; });
			return perimeter > 0 ? 2 * area / perimeter : 0;
		}

		bool simple(const IntRing& ring) const
		{
			std::vector<K::Point_2> outline; // without edges of rounding length, whose direction means nothing
			for (size_t k = 0, n = ring.size(); k < n; ++k)
				if (length(ring[k], ring[(k + 1) % n]) > tolerance) outline.push_back(toK(d.position[ring[k]]));
			return CGAL::is_simple_2(outline.begin(), outline.end(), K());
		}

		/// Where the cell's base begins: that edge from which the others are least far, the longest of several; and how far that is [m].
		std::pair<size_t, Real> base(const IntRing& ring) const
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

		bool thin(int cell) const { return meanWidth(cells[cell]) < shortest && base(cells[cell]).second < shortest; } // the cheap test first

		/// A cell may reach around a corner of the region, its far side running (almost) along the wall. Gives the thin arm's
		/// tip, a triangle from that corner on, to the neighbour on the far side.
		bool trim(int cell)
		{
			const IntRing ring = cells[cell];
			const size_t  n    = ring.size();
			for (size_t k = 0; k < n && n > 3; ++k)
				for (bool forward : { true, false }) {
					const int corner = ring[k], tip = ring[forward ? (k + 1) % n : (k + n - 1) % n],
						  far  = ring[forward ? (k + 2) % n : (k + n - 2) % n];
					const Vec2 arm = d.position[far] - d.position[tip], p = d.position[corner] - d.position[tip];
					if (d.place[corner].kind != Place::corner || p.dot(arm) <= 0 || p.dot(arm) > arm.squaredNorm() + tolerance * arm.norm())
						continue;
					const Real width = std::abs(cross(arm, p)) / arm.norm();
					if (width >= shortest) continue;

					changed.clear();
					changed[cell] = ring;
					changed[cell].erase(changed[cell].begin() + (std::find(ring.begin(), ring.end(), tip) - ring.begin()));
					for (int c : around[tip]) {
						if (c == cell || !adjacent(cells[c], tip, far)) continue;
						IntRing&   other = changed[c] = cells[c];
						const auto at = std::find(other.begin(), other.end(), forward ? far : tip); // the neighbour runs the other way
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

		/// Shortens an arm where the far side's next node comes before that corner: the node goes onto the wall, and the arm ends there.
		bool shorten(int cell)
		{
			const IntRing ring = cells[cell];
			const size_t  n    = ring.size();
			for (size_t k = 0; k < n && n > 3; ++k)
				for (bool forward : { true, false }) {
					const int corner = ring[k], tip = ring[forward ? (k + 1) % n : (k + n - 1) % n],
						  far   = ring[forward ? (k + 2) % n : (k + n - 2) % n];
					const Vec2 side = d.position[corner] - d.position[tip], q = d.position[far] - d.position[tip];
					if (d.place[corner].kind != Place::corner || d.place[far].kind != Place::inside || cellsAlong(corner, tip) != 1)
						continue;
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

		void moveToWall(int node, const Vec2& position, int wall)
		{
			d.position[node] = position;
			d.place[node]    = { Place::onWall, wall };
			if (walls.along(wall).x() == 0) d.position[node].x() = walls.corner[wall].x();
			if (walls.along(wall).y() == 0) d.position[node].y() = walls.corner[wall].y();
		}

		/// A cell may pass a reflex corner of the region by a neck narrower than a short edge. Moves the node on the other
		/// side of the neck to the corner, so that the cell becomes two.
		bool divide(int cell)
		{
			const IntRing ring = cells[cell];
			const size_t  n    = ring.size();
			for (size_t k = 0; k < n; ++k)
				for (size_t m = 2; m + 1 < n; ++m) { // the nodes that are not next to k
					const int corner = ring[k], node = ring[(k + m) % n];
					if (d.place[corner].kind != Place::corner || d.place[node].kind != Place::inside || length(corner, node) >= shortest)
						continue;
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

		/// Divides a cell at a neck whose other side is an edge: the corner becomes a vertex of the neighbour beyond it.
		bool divideAtEdge(int cell)
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
						if (beyond == cell || !adjacent(cells[beyond], a, b)
						    || std::count(cells[beyond].begin(), cells[beyond].end(), corner))
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

		static int nextTo(const IntRing& ring, int node, bool after)
		{
			const size_t n = ring.size(), at = std::find(ring.begin(), ring.end(), node) - ring.begin();
			return ring[(at + (after ? 1 : n - 1)) % n];
		}

		/// Moves a node from behind the line between two others onto it, along its edge with a fourth, if that meets the line.
		void giveWay(int node, int from, int to, int along)
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

		/// Moves the cell's other nodes onto its base; the cell vanishes and its neighbour beyond the base (if any) takes the nodes over. Nodes of the
		/// region's outline cannot move; the neighbour takes them over where they are.
		void flatten(int cell)
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

		Cells result() const
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

		int cellsAlong(int a, int b) const
		{
			int n = 0;
			for (int c : around[a])
				n += adjacent(cells[c], a, b);
			return n;
		}
	};

} // namespace

Cells mergeShortEdges(Diagram& diagram, const Walls& region, Real shortest, Real tolerance) { return Merger(diagram, region, shortest, tolerance).run(); }

} // namespace blocks
