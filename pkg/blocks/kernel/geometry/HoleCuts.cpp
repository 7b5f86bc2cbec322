// yade-blocks, GPL-2.0-or-later

#include <blocks/kernel/geometry/HoleCuts.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace blocks {
namespace {

	/// Cuts pieces that surround whole holes: from every such hole one straight cut forward and one backward, to what they meet first.
	/// The direction is none that a user would draw, so that cuts rarely run along edges.
	class HoleCutter {
	public:
		HoleCutter(Diagram& diagram, const Walls& w, Real size)
			: d(diagram)
			, walls(w)
			, tolerance(coincident * size)
		{
		}

		void run()
		{
			for (size_t p = 0, n = d.pieces.size(); p < n; ++p)
				if (!d.pieces[p].holes.empty()) cut(p);
		}

	private:
		Diagram&     d;
		const Walls& walls;
		const Real   tolerance; ///< [m]
		const Vec2   forward = Vec2(std::cos(0.5), std::sin(0.5));

		struct Hit {
			Real     distance = std::numeric_limits<Real>::infinity();
			IntRing* ring     = nullptr;
			size_t   edge     = 0;
		};

		void cut(size_t p)
		{
			std::set<std::pair<int, int>> cuts; // lower node first, so that a cut met from both sides counts once
			for (size_t h = 0; h < d.pieces[p].holes.size(); ++h)
				for (const Vec2& direction : { forward, Vec2(-forward) }) {
					const IntRing& hole = d.pieces[p].holes[h];
					const int      from = *std::max_element(hole.begin(), hole.end(), [&](int a, int b) {
                                                return d.position[a].dot(direction) < d.position[b].dot(direction);
                                        });
					cuts.insert(std::minmax(from, firstNodeMet(p, from, direction)));
				}
			retrace(p, cuts);
		}

		int firstNodeMet(size_t p, int from, const Vec2& direction)
		{
			Hit        hit;
			const auto look = [&](IntRing& ring) {
				for (size_t e = 0, n = ring.size(); e < n; ++e) {
					if (ring[e] == from || ring[(e + 1) % n] == from) continue;
					const Vec2 a = d.position[ring[e]] - d.position[from], b = d.position[ring[(e + 1) % n]] - d.position[from];
					const Real leftA = cross(direction, a), leftB = cross(direction, b);
					if ((leftA > 0) == (leftB > 0)) continue;
					const Real distance = cross(a, b) / (leftB - leftA);
					if (distance > 0 && distance < hit.distance) hit = { distance, &ring, e };
				}
			};
			look(d.pieces[p].ring);
			for (IntRing& hole : d.pieces[p].holes)
				look(hole);
			if (!hit.ring) throw std::logic_error("Tessellation: a cut from a hole meets nothing");

			const int  a = (*hit.ring)[hit.edge], b = (*hit.ring)[(hit.edge + 1) % hit.ring->size()];
			const Vec2 point = d.position[from] + hit.distance * direction;
			for (int end : { a, b })
				if ((d.position[end] - point).norm() < tolerance) return end;
			return splitEdge(p, a, b, point);
		}

		/// A new node on the edge from a to b of piece p, also in the piece on the other side.
		int splitEdge(size_t p, int a, int b, const Vec2& point)
		{
			const int node  = int(d.position.size());
			bool      inner = false;
			for (Piece& piece : d.pieces)
				inner = insertBetween(piece.ring, b, a, node) || inner;
			insertBetween(d.pieces[p].ring, a, b, node);
			for (IntRing& hole : d.pieces[p].holes)
				insertBetween(hole, a, b, node);
			d.position.push_back(point);
			if (inner)
				d.place.push_back({ Place::inside, -1 });
			else {
				const int  wall = d.place[a].wall; // a wall's pieces begin at its corner or at a crossing with it
				const Vec2 t    = walls.along(wall);
				if (t.x() == 0) d.position.back().x() = walls.corner[wall].x();
				if (t.y() == 0) d.position.back().y() = walls.corner[wall].y();
				d.place.push_back({ Place::onWall, wall });
			}
			return node;
		}

		static bool insertBetween(IntRing& ring, int a, int b, int node)
		{
			for (size_t e = 0, n = ring.size(); e < n; ++e)
				if (ring[e] == a && ring[(e + 1) % n] == b) {
					ring.insert(ring.begin() + e + 1, node);
					return true;
				}
			return false;
		}

		/// The faces of the piece's outline, holes and cuts, each cut walked in both directions.
		void retrace(size_t p, const std::set<std::pair<int, int>>& cuts)
		{
			std::map<int, std::vector<int>> out;
			const auto                      addRing = [&](const IntRing& ring) {
                                for (size_t e = 0, n = ring.size(); e < n; ++e)
                                        out[ring[e]].push_back(ring[(e + 1) % n]);
			};
			addRing(d.pieces[p].ring);
			for (const IntRing& hole : d.pieces[p].holes)
				addRing(hole);
			for (const auto& [a, b] : cuts) {
				out[a].push_back(b);
				out[b].push_back(a);
			}
			std::vector<Piece> parts;
			for (auto& start : out)
				while (!start.second.empty()) {
					Piece part { {}, d.pieces[p].seed, {} };
					int   at = start.first, to = start.second.back();
					start.second.pop_back();
					for (;;) {
						part.ring.push_back(at);
						if (to == start.first) break;
						const int came = at;
						at             = to;
						to             = takeLeftmost(out[at], came, at);
					}
					parts.push_back(part);
				}
			d.pieces[p] = parts[0];
			d.pieces.insert(d.pieces.end(), parts.begin() + 1, parts.end());
		}

		/// Removes and returns that way out which keeps the same face on the left: the first one clockwise from the way back.
		int takeLeftmost(std::vector<int>& ways, int came, int at) const
		{
			const Vec2 back  = d.position[came] - d.position[at];
			const auto angle = [&](int to) { // clockwise from the way back, in (0, 2 pi]
				const Vec2 way  = d.position[to] - d.position[at];
				const Real turn = std::atan2(-cross(back, way), back.dot(way));
				return to == came ? 2 * M_PI : turn > 0 ? turn : turn + 2 * M_PI;
			};
			const auto best = std::min_element(ways.begin(), ways.end(), [&](int a, int b) { return angle(a) < angle(b); });
			const int  to   = *best;
			ways.erase(best);
			return to;
		}
	};

} // namespace

void cutAroundHoles(Diagram& diagram, const Walls& region, Real size) { HoleCutter(diagram, region, size).run(); }

} // namespace blocks
