// yade-blocks, GPL-2.0-or-later

#include <blocks/kernel/geometry/HoleCuts.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace blocks {
namespace {

	/// Cuts with a smaller angle to what they meet than this are not chosen if there are others [rad].
	constexpr Real sharp = M_PI / 12;

	/// Cuts pieces that surround holes. Where a hole is surrounded whole, there is one straight cut forward and one backward, to what they meet first.
	/// The direction is none that a user would draw, so that cuts rarely run along edges. Where another piece reaches the hole by less than a short edge,
	/// there is one cut, away from that place: else this edge could not be merged, as the surrounding piece would touch itself there.
	class HoleCutter {
	public:
		HoleCutter(Diagram& diagram, const Walls& w, Real shortestEdge, Real coincidence)
			: d(diagram)
			, walls(w)
			, shortest(shortestEdge)
			, tolerance(coincidence)
		{
		}

		void run()
		{
			const size_t n = d.pieces.size();
			for (size_t p = 0; p < n; ++p)
				if (!d.pieces[p].holes.empty())
					cut(p);
				else if (walls.start.size() > 2)
					cutOpposite(p);
		}

	private:
		Diagram&     d;
		const Walls& walls;
		const Real   shortest, tolerance; ///< [m]
		const Vec2   forward = Vec2(std::cos(0.5), std::sin(0.5));

		using Cuts = std::set<std::pair<int, int>>; ///< lower node first, so that a cut met from both sides counts once

		struct Hit {
			Real     distance = std::numeric_limits<Real>::infinity();
			IntRing* ring     = nullptr;
			size_t   edge     = 0;
		};

		void cut(size_t p)
		{
			Cuts cuts;
			for (size_t h = 0; h < d.pieces[p].holes.size(); ++h)
				for (const Vec2& direction : { forward, Vec2(-forward) }) {
					const IntRing& hole = d.pieces[p].holes[h];
					const int      from = *std::max_element(hole.begin(), hole.end(), [&](int a, int b) {
                                                return d.position[a].dot(direction) < d.position[b].dot(direction);
                                        });
					cuts.insert(std::minmax(from, firstNodeMet(p, from, direction, cuts)));
				}
			retrace(p, cuts);
		}

		/// Which hole the ring's edge from its k-th node on lies on, or 0 for none: pieces go along walls in their direction.
		int holeAlong(const IntRing& ring, size_t k) const
		{
			const Place from = d.place[ring[k]], to = d.place[ring[(k + 1) % ring.size()]];
			if (from.kind == Place::inside || to.kind == Place::inside || from.wall < walls.start[1]) return 0;
			if (to.wall != (to.kind == Place::corner ? walls.next[from.wall] : from.wall)) return 0;
			return int(std::upper_bound(walls.start.begin(), walls.start.end(), from.wall) - walls.start.begin()) - 1;
		}

		void cutOpposite(size_t p)
		{
			const IntRing ring = d.pieces[p].ring;
			const size_t  n    = ring.size();
			for (size_t k = 0; k < n; ++k) {
				const int hole = holeAlong(ring, k);
				if (hole == 0 || holeAlong(ring, (k + n - 1) % n) == hole) continue; // the first edge on a hole
				Real   gap  = 0;
				size_t last = k;
				for (int corner = walls.start[hole]; corner < walls.start[hole + 1]; ++corner)
					gap += walls.along(corner).norm();
				for (; last < k + n && holeAlong(ring, last % n) == hole; ++last)
					gap -= (d.position[ring[(last + 1) % n]] - d.position[ring[last % n]]).norm();
				const Vec2 there = (d.position[ring[k]] + d.position[ring[last % n]]) / 2;
				Vec2       away  = Vec2::Zero();
				Real       turns = 0; // twice the area that the way along the hole encloses: negative if the hole is within it
				for (size_t m = k; m <= last; ++m) {
					away += d.position[ring[m % n]] - there;
					if (m < last) turns += cross(d.position[ring[m % n]] - there, d.position[ring[(m + 1) % n]] - there);
				}
				// A hole smaller than a short edge leaves no long gap, whoever touches it.
				if (gap >= shortest || turns >= 0) continue;
				Vec2 direction = forward;
				for (const Vec2& other : { Vec2(-forward.y(), forward.x()), Vec2(-forward), Vec2(forward.y(), -forward.x()) })
					if (other.dot(away) > direction.dot(away)) direction = other;
				int from = ring[k];
				for (size_t m = k; m <= last; ++m)
					if ((d.position[ring[m % n]] - d.position[from]).dot(direction) > 0) from = ring[m % n];
				if (from == ring[k] || from == ring[last % n]) continue;
				retrace(p, { std::minmax(from, firstNodeMet(p, from, direction, {})) });
				return;
			}
		}

		int firstNodeMet(size_t p, int from, const Vec2& direction, const Cuts& cuts)
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
			const int end = endOf(p, from, a, b, point, cuts);
			return end >= 0 ? end : splitEdge(p, a, b, point);
		}

		/// That end of the edge from a to b, met at a point, at which a cut would better end, or -1. A vertex in the middle of a neighbour's edge could
		/// be moved no more without denting the neighbour.
		int endOf(size_t p, int from, int a, int b, const Vec2& point, const Cuts& cuts) const
		{
			const bool inner = std::any_of(d.pieces.begin(), d.pieces.end(), [&](const Piece& piece) { return isEdge(piece.ring, b, a); });
			if (!inner || d.pieces[p].holes.size() > 1) return -1; // on a wall; or several holes, whose cuts could cross
			const Vec2 edge = d.position[b] - d.position[a], ray = point - d.position[from];
			const Real across = std::abs(angleBetween(edge, ray));
			Real       widest = std::min({ sharp, across, M_PI - across });
			int        best   = -1;
			for (int end : { a, b }) {
				if (!clear(p, from, end, point) || clashes(cuts, from, end)) continue;
				const Real narrowest = std::min(narrowestAngle(p, from, end), narrowestAngle(p, end, from));
				if (narrowest >= widest) best = end, widest = narrowest;
			}
			return best;
		}

		static Real angleBetween(const Vec2& u, const Vec2& v) { return std::atan2(cross(u, v), u.dot(v)); }

		static bool isEdge(const IntRing& ring, int a, int b)
		{
			for (size_t e = 0, n = ring.size(); e < n; ++e)
				if (ring[e] == a && ring[(e + 1) % n] == b) return true;
			return false;
		}

		/// Whether no other vertex of the piece lies in the triangle between the two ways, of which that to the point is known to be free.
		bool clear(size_t p, int from, int end, const Vec2& point) const
		{
			const Vec2& a = d.position[from];
			Vec2        b = point, c = d.position[end];
			if (cross(b - a, c - a) < 0) std::swap(b, c);
			const auto left   = [&](const Vec2& u, const Vec2& v, const Vec2& w) { return cross(v - u, w - u) >= -tolerance * (v - u).norm(); };
			const auto within = [&](int node) {
				const Vec2& q = d.position[node];
				return node != from && node != end && left(a, b, q) && left(b, c, q) && left(c, a, q);
			};
			const auto none = [&](const IntRing& ring) { return std::none_of(ring.begin(), ring.end(), within); };
			return none(d.pieces[p].ring) && std::all_of(d.pieces[p].holes.begin(), d.pieces[p].holes.end(), none);
		}

		/// Whether a way crosses a cut or ends where one does: two cuts from a hole to one vertex leave a piece that touches itself there.
		bool clashes(const Cuts& cuts, int from, int end) const
		{
			const Vec2 &a = d.position[from], &b = d.position[end];
			for (const auto& [first, second] : cuts) {
				const Vec2 &u = d.position[first], &v = d.position[second];
				if (first == end || second == end) return true;
				if (cross(b - a, u - a) * cross(b - a, v - a) < 0 && cross(v - u, a - u) * cross(v - u, b - u) < 0) return true;
			}
			return false;
		}

		/// The smallest angle of a way from a node to what leads there already.
		Real narrowestAngle(size_t p, int node, int to) const
		{
			Real       narrowest = M_PI;
			const Vec2 way       = d.position[to] - d.position[node];
			const auto meet
				= [&](int other) { narrowest = std::min(narrowest, std::abs(angleBetween(way, d.position[other] - d.position[node]))); };
			const auto look = [&](const IntRing& ring) {
				for (size_t e = 0, n = ring.size(); e < n; ++e)
					if (ring[e] == node) meet(ring[(e + 1) % n]), meet(ring[(e + n - 1) % n]);
			};
			look(d.pieces[p].ring);
			for (const IntRing& hole : d.pieces[p].holes)
				look(hole);
			return narrowest;
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
		void retrace(size_t p, const Cuts& cuts)
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

void cutAroundHoles(Diagram& diagram, const Walls& region, Real shortest, Real tolerance) { HoleCutter(diagram, region, shortest, tolerance).run(); }

} // namespace blocks
