// yade-blocks, GPL-2.0-or-later

// How it works. The Voronoi diagram is the dual of CGAL's Delaunay triangulation. Each edge of the region ("wall")
// is walked through the diagram, cell by cell; which Voronoi edge it crosses next is decided by exact predicates only,
// so the combinatorial result is right for every input, and coordinates are rounded once, at the end. Cells that no
// wall enters are the plain dual, which costs a neighbour walk each.
//
// Degenerate positions (a Voronoi vertex on a wall, a wall along a Voronoi edge: the rule with regular grids) are decided
// as if the region had been shifted by (eps, eps^2), eps > 0 infinitesimal; then nothing coincides. The shift is never
// carried out; it leaves edges of length zero, which merging removes together with the short ones.

#include <blocks/kernel/geometry/Tessellation.hpp>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <limits>
#include <map>
#include <queue>
#include <random>
#include <set>
#include <tuple>
#include <unordered_map>

namespace blocks {
namespace {

	using K        = CGAL::Exact_predicates_inexact_constructions_kernel;
	using Exact    = CGAL::Exact_predicates_exact_constructions_kernel;
	using Delaunay = CGAL::Delaunay_triangulation_2<
		K,
		CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_with_info_2<int, K>, CGAL::Triangulation_face_base_with_info_2<int, K>>>;
	using Face       = Delaunay::Face_handle;
	using ExactPoint = Exact::Point_2;
	using IntRing    = std::vector<int>;

	/// Vertices nearer than this fraction of the cell size are one, and cells may be dented by so much: far above rounding, far below any use.
	constexpr Real coincident = 1e-9;

	K::Point_2  toK(const Vec2& p) { return { p.x(), p.y() }; }
	std::string shownPoint(const Vec2& p) { return "(" + shown(p.x()) + ", " + shown(p.y()) + ")"; }
	int         sign(Real value) { return (value > 0) - (value < 0); }

	std::vector<K::Point_2> toK(const Ring& ring)
	{
		std::vector<K::Point_2> points;
		for (const Vec2& p : ring)
			points.push_back(toK(p));
		return points;
	}

	/// The edges of the region, rings one after another: wall k leads from corner k to corner next[k], the material on its left.
	struct Walls {
		std::vector<Vec2> corner;
		std::vector<int>  next;
		std::vector<int>  start; ///< first corner of each ring, and the number of corners at the end

		explicit Walls(const Polygon& region)
		{
			add(region.outer);
			for (const Ring& hole : region.holes)
				add(hole);
			start.push_back(int(corner.size()));
		}
		void add(const Ring& ring)
		{
			const int first = int(corner.size()), n = int(ring.size());
			start.push_back(first);
			for (int i = 0; i < n; ++i) {
				corner.push_back(ring[i]);
				next.push_back(first + (i + 1) % n);
			}
		}
		Vec2 along(int k) const { return corner[next[k]] - corner[k]; }
	};

	// ---------------------------------------------------------------- refusing bad regions

	std::string ringName(int ring) { return ring == 0 ? "outer" : "holes[" + std::to_string(ring - 1) + "]"; }

	/// Refuses walls that cross, touch or fold back, naming both; a sweep over their x-ranges leaves few pairs to test.
	void requireApart(const Walls& walls, const std::vector<int>& ringOfWall, const std::string& name)
	{
		const int        n = int(walls.corner.size());
		std::vector<int> byLeft(n);
		for (int i = 0; i < n; ++i)
			byLeft[i] = i;
		const auto left  = [&](int k) { return std::min(walls.corner[k].x(), walls.corner[walls.next[k]].x()); };
		const auto right = [&](int k) { return std::max(walls.corner[k].x(), walls.corner[walls.next[k]].x()); };
		const auto wall  = [&](int k) { return K::Segment_2(toK(walls.corner[k]), toK(walls.corner[walls.next[k]])); };
		std::sort(byLeft.begin(), byLeft.end(), [&](int a, int b) { return std::make_pair(left(a), a) < std::make_pair(left(b), b); });

		const auto edgeName = [&](int k) {
			return ringName(ringOfWall[k]) + " edge " + std::to_string(k - walls.start[ringOfWall[k]]) + " from " + shownPoint(walls.corner[k])
				+ " to " + shownPoint(walls.corner[walls.next[k]]);
		};
		const auto clash = [&](int a, int b) { // do they share more than the corner they should share?
			if (walls.next[a] == b || walls.next[b] == a) {
				if (walls.next[b] == a) std::swap(a, b);
				if (walls.next[b] == a) return true; // a ring of two edges
				const auto p = toK(walls.corner[a]), q = toK(walls.corner[b]), r = toK(walls.corner[walls.next[b]]);
				return CGAL::collinear(p, q, r) && !CGAL::collinear_are_strictly_ordered_along_line(p, q, r);
			}
			return CGAL::do_intersect(wall(a), wall(b));
		};
		std::vector<int> open;
		for (int k : byLeft) {
			open.erase(std::remove_if(open.begin(), open.end(), [&](int o) { return right(o) < left(k); }), open.end());
			for (int o : open)
				if (clash(o, k))
					throw std::invalid_argument(
						name + " must not cross or touch itself, got " + edgeName(std::min(o, k)) + " and " + edgeName(std::max(o, k)));
			open.push_back(k);
		}
	}

	// ---------------------------------------------------------------- the clipped Voronoi diagram

	/// Where a vertex lies, and so how it may move.
	struct Place {
		enum Kind { corner, onWall, inside } kind;
		int wall; ///< the wall it lies on (onWall), the corner's own number (corner)
	};

	/// One connected piece of a Voronoi cell.
	struct Piece {
		IntRing              ring;
		int                  seed;
		std::vector<IntRing> holes; ///< holes of the region that lie in the piece, clockwise
	};

	struct Diagram {
		std::vector<Vec2>  position;
		std::vector<Place> place;
		std::vector<Piece> pieces;
	};

	class ClippedVoronoi {
	public:
		ClippedVoronoi(const Walls& walls, const std::vector<Vec2>& seeds)
			: walls(walls)
			, seeds(seeds)
		{
			for (size_t k = 0; k < walls.corner.size(); ++k) {
				exactCorner.emplace_back(walls.corner[k].x(), walls.corner[k].y());
				addNode(walls.corner[k], { Place::corner, int(k) });
			}
			triangulate();
			walkWalls();
			classify();
			for (size_t i = 0; i < seeds.size(); ++i)
				addPieces(int(i));
		}
		Diagram diagram;

		/// The shortest distance between two seeds [m]: some Delaunay edge has it.
		Real closestSeeds() const
		{
			Real closest = std::numeric_limits<Real>::infinity();
			for (auto e = delaunay.finite_edges_begin(); e != delaunay.finite_edges_end(); ++e)
				closest = std::min(closest, std::sqrt(delaunay.segment(*e).squared_length()));
			return closest;
		}

	private:
		struct Crossing { ///< of a wall with the Voronoi edge between two cells
			int        node;
			bool       enters; ///< does one enter the region there, going counter-clockwise around the cell of the lower number?
			ExactPoint point;
		};
		struct Link {
			int from, to;
		}; ///< a piece of a cell's outline, the cell's part of the region on its left

		const Walls&                                         walls;
		const std::vector<Vec2>&                             seeds;
		std::vector<ExactPoint>                              exactCorner;
		Delaunay                                             delaunay;
		std::vector<Delaunay::Vertex_handle>                 cellOf;     ///< a seed's vertex in the triangulation
		std::vector<char>                                    vertexIn;   ///< by face: is its Voronoi vertex in the region?
		std::vector<int>                                     vertexNode; ///< by face: its node, or -1
		std::unordered_map<int, ExactPoint>                  exactCentre;
		std::map<std::pair<int, int>, std::vector<Crossing>> crossings; ///< by the two cells, lower number first; in order along the edge
		std::map<int, std::vector<Link>>                     wallLinks; ///< by cell: the region's outline inside it

		int addNode(const Vec2& position, Place place)
		{
			diagram.position.push_back(position);
			diagram.place.push_back(place);
			return int(diagram.position.size()) - 1;
		}
		bool isSeed(Delaunay::Vertex_handle v) const { return !delaunay.is_infinite(v) && v->info() < int(seeds.size()); }

		/// Besides the seeds, four guards so far away that none is nearest to any point of the region: every seed's cell is bounded.
		void triangulate()
		{
			std::vector<std::pair<K::Point_2, int>> points;
			Vec2                                    low = walls.corner[0], high = low;
			for (const Vec2& c : walls.corner) {
				low  = low.cwiseMin(c);
				high = high.cwiseMax(c);
			}
			for (size_t i = 0; i < seeds.size(); ++i)
				points.emplace_back(toK(seeds[i]), int(i));
			const Vec2 middle = (low + high) / 2;
			const Real far    = 5 * (high - low).norm(); // the region's points are within 1 diagonal of a seed, 4 of no guard
			for (const Vec2& direction : { Vec2(-1, -1), Vec2(1, -1), Vec2(1, 1), Vec2(-1, 1) })
				points.emplace_back(toK(middle + far * direction), int(points.size()));

			delaunay.insert(points.begin(), points.end());
			if (delaunay.number_of_vertices() != points.size())
				throw std::invalid_argument("Tessellation.seeds must be distinct, got two that coincide");

			cellOf.resize(seeds.size());
			for (auto v = delaunay.finite_vertices_begin(); v != delaunay.finite_vertices_end(); ++v)
				if (isSeed(v)) cellOf[v->info()] = v;
			int faces = 0;
			for (auto f = delaunay.all_faces_begin(); f != delaunay.all_faces_end(); ++f)
				f->info() = faces++;
			vertexIn.assign(faces, 0);
			vertexNode.assign(faces, -1);
		}

		const ExactPoint& centre(Face f)
		{
			auto [known, isNew] = exactCentre.try_emplace(f->info());
			if (isNew) {
				const auto exact = [&](int i) { return ExactPoint(f->vertex(i)->point().x(), f->vertex(i)->point().y()); };
				known->second    = CGAL::circumcenter(exact(0), exact(1), exact(2));
			}
			return known->second;
		}

		/// +1 if the face's Voronoi vertex is to the left of the (shifted) wall's line, else -1.
		int sideOf(int wall, Face f)
		{
			const int exact = CGAL::orientation(exactCorner[wall], exactCorner[walls.next[wall]], centre(f));
			if (exact != 0) return exact;
			const Vec2 d = walls.along(wall); // orientation changes by d.y eps - d.x eps^2
			return d.y() != 0 ? sign(d.y()) : -sign(d.x());
		}

		/// Is the (shifted) corner nearer to seed i than to j (a seed or a guard)?
		bool nearer(int corner, Delaunay::Vertex_handle i, Delaunay::Vertex_handle j) const
		{
			const auto exact = CGAL::compare_distance_to_point(toK(walls.corner[corner]), i->point(), j->point());
			if (exact != CGAL::EQUAL) return exact == CGAL::SMALLER;
			// |c-i|^2 - |c-j|^2 changes by 2 (j-i).(eps, eps^2)
			return i->point().x() != j->point().x() ? j->point().x() < i->point().x() : j->point().y() < i->point().y();
		}

		Delaunay::Vertex_handle ownerOf(int corner)
		{
			auto owner = delaunay.nearest_vertex(toK(walls.corner[corner]));
			for (bool found = false; !found;) { // the shift may hand it to a neighbour
				found  = true;
				auto v = delaunay.incident_vertices(owner), end = v;
				do {
					if (!delaunay.is_infinite(v) && !nearer(corner, owner, v)) {
						owner = v;
						found = false;
						break;
					}
				} while (++v != end);
			}
			return owner;
		}

		/// The neighbour into which the wall's line leaves the convex cell: where its outline passes from right to left.
		Delaunay::Vertex_handle exitFrom(Delaunay::Vertex_handle cell, int wall)
		{
			auto f = delaunay.incident_faces(cell), end = f;
			int  here = sideOf(wall, f);
			do {
				const Face now  = f++;
				const int  then = sideOf(wall, f);
				if (here < 0 && then > 0) return now->vertex(Delaunay::ccw(Delaunay::ccw(now->index(cell))));
				here = then;
			} while (f != end);
			throw std::logic_error("Tessellation: a wall does not leave the cell it entered");
		}

		/// Where wall k meets the bisector of seeds i and j.
		ExactPoint crossingPoint(int wall, int i, int j) const
		{
			const ExactPoint  a(seeds[i].x(), seeds[i].y()), b(seeds[j].x(), seeds[j].y());
			const ExactPoint &p = exactCorner[wall], &q = exactCorner[walls.next[wall]];
			const auto        atP = CGAL::squared_distance(p, a) - CGAL::squared_distance(p, b);
			const auto        atQ = CGAL::squared_distance(q, a) - CGAL::squared_distance(q, b);
			return p + (q - p) * (atP / (atP - atQ)); // linear along the wall; the wall really crosses, so atP != atQ
		}

		void walkWalls()
		{
			for (size_t ring = 0; ring + 1 < walls.start.size(); ++ring) {
				auto cell = ownerOf(walls.start[ring]);
				for (int wall = walls.start[ring]; wall < walls.start[ring + 1]; ++wall) {
					int from = wall;
					for (;;) {
						const auto into = exitFrom(cell, wall);
						if (nearer(walls.next[wall], cell, into)) break;
						const int  i = cell->info(), j = into->info();
						ExactPoint point = crossingPoint(wall, i, j);
						CGAL::exact(point); // so that rounding is to the nearest
						const int node = addNode({ CGAL::to_double(point.x()), CGAL::to_double(point.y()) }, { Place::onWall, wall });
						// Going counter-clockwise around i along its edge with j, j is on the right: a wall from i to j leads
						// to the right, and the region is on its left, that is ahead.
						crossings[std::minmax(i, j)].push_back({ node, i < j, point });
						wallLinks[i].push_back({ from, node });
						from = node;
						cell = into;
					}
					wallLinks[cell->info()].push_back({ from, walls.next[wall] });
				}
			}
			for (auto& [cells, list] : crossings)
				sortAlong(cells.first, cells.second, list);
		}

		/// How far crossing b lies behind a, going counter-clockwise around cell i along its edge with j: only the sign counts.
		CGAL::Sign order(int i, int j, const Crossing& a, const Crossing& b) const
		{
			const Exact::Vector_2 along(Exact::FT(seeds[i].y()) - Exact::FT(seeds[j].y()), Exact::FT(seeds[j].x()) - Exact::FT(seeds[i].x()));
			return CGAL::sign((b.point - a.point) * along);
		}

		void sortAlong(int i, int j, std::vector<Crossing>& list) const
		{
			if (list.size() < 2) return;
			std::stable_sort(list.begin(), list.end(), [&](const Crossing& a, const Crossing& b) { return order(i, j, a, b) == CGAL::POSITIVE; });
		}

		const std::vector<Crossing>* crossingsOf(Delaunay::Vertex_handle a, Delaunay::Vertex_handle b) const
		{
			if (!isSeed(a) || !isSeed(b)) return nullptr;
			const auto found = crossings.find(std::minmax(a->info(), b->info()));
			return found == crossings.end() ? nullptr : &found->second;
		}

		/// Which Voronoi vertices lie in the region: those of the guards do not; each crossing changes sides.
		void classify()
		{
			std::vector<Face> todo;
			std::vector<char> known(vertexIn.size(), 0);
			for (auto f = delaunay.all_faces_begin(); f != delaunay.all_faces_end(); ++f)
				if (!isSeed(f->vertex(0)) || !isSeed(f->vertex(1)) || !isSeed(f->vertex(2))) {
					known[f->info()] = 1;
					todo.push_back(f);
				}
			while (!todo.empty()) {
				const Face f = todo.back();
				todo.pop_back();
				for (int e = 0; e < 3; ++e) {
					const Face g = f->neighbor(e);
					if (known[g->info()]) continue;
					const auto* list    = crossingsOf(f->vertex(Delaunay::cw(e)), f->vertex(Delaunay::ccw(e)));
					known[g->info()]    = 1;
					vertexIn[g->info()] = vertexIn[f->info()] ^ (list && list->size() % 2);
					todo.push_back(g);
				}
			}
		}

		int nodeOf(Face f)
		{
			int& node = vertexNode[f->info()];
			if (node < 0) {
				const auto known = exactCentre.find(f->info());
				const auto point = delaunay.circumcenter(f);
				node             = addNode(
                                        known == exactCentre.end() ? Vec2(point.x(), point.y())
                                                                   : Vec2(CGAL::to_double(known->second.x()), CGAL::to_double(known->second.y())),
					{ Place::inside, -1 });
			}
			return node;
		}

		void addPieces(int i)
		{
			const auto walled = wallLinks.find(i);
			auto       f = delaunay.incident_faces(cellOf[i]), end = f;
			if (walled == wallLinks.end()) {
				if (!vertexIn[f->info()]) return; // only where the seed lies outside
				Piece piece { {}, i, {} };
				do
					piece.ring.push_back(nodeOf(f));
				while (++f != end);
				diagram.pieces.push_back(std::move(piece));
				return;
			}

			std::vector<Link> links = walled->second;
			do {
				const Face now = f++;
				addInnerLinks(i, now, f, links);
			} while (f != end);
			trace(i, links);
		}

		/// The parts inside the region of the Voronoi edge from `now` to `then`, counter-clockwise around cell i.
		void addInnerLinks(int i, Face now, Face then, std::vector<Link>& links)
		{
			const auto neighbour = now->vertex(Delaunay::ccw(Delaunay::ccw(now->index(cellOf[i]))));
			int        from      = vertexIn[now->info()] ? nodeOf(now) : -1;
			const auto found     = isSeed(neighbour) ? crossings.find(std::minmax(i, neighbour->info())) : crossings.end();
			if (found != crossings.end()) {
				auto&      list     = found->second;
				const int  n        = int(list.size());
				const bool backward = neighbour->info() < i;
				for (int k = 0; k < n; ++k) {
					const auto at = [&](int m) -> Crossing& { return list[backward ? n - 1 - m : m]; };
					// Crossings at one point are in arbitrary order; in the right one, entering and leaving alternate.
					// (The lower cell comes first and leaves the list in order for the other.)
					for (int m = k + 1; m < n && (at(k).enters != backward) != (from < 0) && order(i, neighbour->info(), at(k), at(m)) == 0;
					     ++m)
						std::swap(at(k), at(m));
					if ((at(k).enters != backward) != (from < 0))
						throw std::logic_error("Tessellation: the region's outline crosses a Voronoi edge inconsistently");
					if (from < 0)
						from = at(k).node;
					else {
						links.push_back({ from, at(k).node });
						from = -1;
					}
				}
			}
			if (vertexIn[then->info()]) links.push_back({ from, nodeOf(then) });
		}

		/// Joins the links of cell i to closed lines: outlines of pieces, and whole holes.
		void trace(int i, const std::vector<Link>& links)
		{
			std::unordered_map<int, int> next;
			for (const Link& link : links)
				next[link.from] = link.to;
			const size_t         firstPiece = diagram.pieces.size();
			std::vector<IntRing> holes;
			for (const Link& link : links) {
				IntRing ring;
				bool    onlyCorners = true;
				for (int node = link.from;;) {
					const auto step = next.find(node);
					if (step == next.end()) break; // traced before
					ring.push_back(node);
					onlyCorners = onlyCorners && node < int(walls.corner.size());
					node        = step->second;
					next.erase(step);
				}
				if (ring.empty()) continue;
				if (onlyCorners && ring[0] >= walls.start[1])
					holes.push_back(ring);
				else
					diagram.pieces.push_back({ ring, i, {} });
			}
			for (const IntRing& hole : holes)
				diagram.pieces[pieceAround(hole, firstPiece)].holes.push_back(hole);
		}

		size_t pieceAround(const IntRing& hole, size_t firstPiece) const
		{
			for (size_t p = firstPiece; p + 1 < diagram.pieces.size(); ++p) {
				std::vector<K::Point_2> outline;
				for (int node : diagram.pieces[p].ring)
					outline.push_back(toK(diagram.position[node]));
				if (CGAL::bounded_side_2(outline.begin(), outline.end(), toK(diagram.position[hole[0]]), K()) == CGAL::ON_BOUNDED_SIDE)
					return p;
			}
			return diagram.pieces.size() - 1;
		}
	};

	// ---------------------------------------------------------------- Lloyd's iteration

	struct Moments {
		Real area     = 0;
		Vec2 centroid = Vec2::Zero();
	};

	Moments momentsOf(const Diagram& d, const Piece& piece)
	{
		const Vec2 origin = d.position[piece.ring[0]];
		Real       area   = 0;
		Vec2       first  = Vec2::Zero();
		const auto add    = [&](const IntRing& ring) {
                        for (size_t k = 0, n = ring.size(); k < n; ++k) {
                                const Vec2 a = d.position[ring[k]] - origin, b = d.position[ring[(k + 1) % n]] - origin;
                                area += cross(a, b) / 2;
                                first += cross(a, b) / 6 * (a + b);
                        }
		};
		add(piece.ring);
		for (const IntRing& hole : piece.holes)
			add(hole);
		return { area, area > 0 ? Vec2(origin + first / area) : origin };
	}

	bool contains(const Diagram& d, const Piece& piece, const Vec2& point)
	{
		const auto side = [&](const IntRing& ring) {
			std::vector<K::Point_2> outline;
			for (int node : ring)
				outline.push_back(toK(d.position[node]));
			return CGAL::bounded_side_2(outline.begin(), outline.end(), toK(point), K());
		};
		if (side(piece.ring) != CGAL::ON_BOUNDED_SIDE) return false;
		for (const IntRing& hole : piece.holes)
			if (side(hole) != CGAL::ON_UNBOUNDED_SIDE) return false;
		return true;
	}

	/// Each seed goes to the centroid of the largest piece of its cell; it stays where it is if that lies outside the piece.
	std::vector<Vec2> centroids(const Diagram& d, std::vector<Vec2> seeds)
	{
		std::vector<Real> largest(seeds.size(), 0);
		const auto        old = seeds;
		for (const Piece& piece : d.pieces) {
			const Moments m = momentsOf(d, piece);
			if (!(m.area > largest[piece.seed])) continue;
			largest[piece.seed] = m.area;
			seeds[piece.seed]   = contains(d, piece, m.centroid) ? m.centroid : old[piece.seed];
		}
		return seeds;
	}

	// ---------------------------------------------------------------- cells around whole holes

	/// Cuts pieces that surround whole holes: from every such hole one straight cut forward and one backward, to what they meet first.
	/// The direction is none that a user would draw, so that cuts rarely run along edges.
	class HoleCutter {
	public:
		HoleCutter(Diagram& d, const Walls& walls, Real size)
			: d(d)
			, walls(walls)
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

	// ---------------------------------------------------------------- merging short edges

	/// Merges short edges, shortest first, and flattens thin cells. An operation is carried out only if every cell it
	/// touches stays a valid cell; otherwise nothing changes.
	class Merger {
	public:
		Merger(Diagram& d, const Walls& walls, Real shortest, Real size)
			: d(d)
			, walls(walls)
			, shortest(shortest)
			, tolerance(coincident * size)
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
			for (size_t c = 0; c < cells.size(); ++c) // cells added by divide() have their turn too
				while (trim(int(c)) || divide(int(c))) { }
			mergeEdges();
			for (size_t c = 0; c < cells.size(); ++c)
				if (!cells[c].empty() && thin(int(c))) flatten(int(c));
			mergeEdges();
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
				const Vec2 a = d.position[ring[k]] - d.position[ring[0]], b = d.position[ring[k + 1]] - d.position[ring[0]];
				if (cross(a, b) < -tolerance * (a.norm() + b.norm())) return false;
			}
			return true;
		}

		/// No more area than rounding gives.
		bool empty(const IntRing& ring) const { return meanWidth(ring) <= tolerance; }

		/// Twice the area by the perimeter [m]: less than the width.
		Real meanWidth(const IntRing& ring) const
		{
			Real twice = 0, perimeter = 0;
			for (size_t k = 0, n = ring.size(); k < n; ++k) {
				const Vec2 &a = d.position[ring[k]], &b = d.position[ring[(k + 1) % n]];
				twice += cross(a - d.position[ring[0]], b - d.position[ring[0]]);
				perimeter += (b - a).norm();
			}
			return perimeter > 0 ? twice / perimeter : 0;
		}

		bool simple(const IntRing& ring) const
		{
			std::vector<K::Point_2> outline; // without edges of rounding length, whose direction means nothing
			for (size_t k = 0, n = ring.size(); k < n; ++k)
				if (length(ring[k], ring[(k + 1) % n]) > tolerance) outline.push_back(toK(d.position[ring[k]]));
			return CGAL::is_simple_2(outline.begin(), outline.end(), K());
		}

		/// Where the cell's base begins: that edge from which the others are least far; and how far that is [m].
		std::pair<size_t, Real> base(const IntRing& ring) const
		{
			std::pair<size_t, Real> best { 0, std::numeric_limits<Real>::infinity() };
			for (size_t k = 0, n = ring.size(); k < n; ++k) {
				const Vec2 a = d.position[ring[k]], t = (d.position[ring[(k + 1) % n]] - a).normalized();
				Real       farthest = 0;
				for (int node : ring)
					farthest = std::max(farthest, cross(t, d.position[node] - a));
				if (farthest < best.second) best = { k, farthest };
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
					if (std::abs(cross(arm, p)) >= shortest * arm.norm()) continue;

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
					dissolve(tip);
					if (acceptChanges()) return true;
				}
			return false;
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

		/// Moves the cell's other nodes onto its base; the cell vanishes and its neighbour beyond the base (if any) takes the nodes over.
		void flatten(int cell)
		{
			IntRing ring = cells[cell];
			std::rotate(ring.begin(), ring.begin() + base(ring).first, ring.end());
			const int        a = ring[0], b = ring[1];
			std::vector<int> common;
			std::set_intersection(around[a].begin(), around[a].end(), around[b].begin(), around[b].end(), std::back_inserter(common));
			common.erase(std::find(common.begin(), common.end(), cell));
			if (common.size() > 1) return;
			const int wall = common.empty() ? d.place[a].wall : -1; // a wall's pieces begin at its corner or at a point on it

			const Vec2        start = d.position[a], base = d.position[b] - start;
			std::vector<Vec2> old;
			bool              possible = true;
			Real              last     = 1; // the others follow b, going back to a
			for (size_t k = 2; k < ring.size(); ++k) {
				const Real along = (d.position[ring[k]] - start).dot(base) / base.squaredNorm();
				possible         = possible && d.place[ring[k]].kind == Place::inside && along < last && along > 0;
				last             = along;
			}
			if (!possible) return;
			changed.clear();
			for (size_t k = 2; k < ring.size(); ++k) {
				Vec2& position = d.position[ring[k]];
				old.push_back(position);
				position = start + (position - start).dot(base) / base.squaredNorm() * base;
				if (wall >= 0 && walls.along(wall).x() == 0) position.x() = walls.corner[wall].x();
				if (wall >= 0 && walls.along(wall).y() == 0) position.y() = walls.corner[wall].y();
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
			if (wall >= 0)
				for (size_t k = 2; k < ring.size(); ++k)
					d.place[ring[k]] = { Place::onWall, wall };
			for (int node : ring)
				dissolve(node);
			if (possible && acceptChanges()) return;
			for (size_t k = 2; k < ring.size(); ++k) {
				d.position[ring[k]] = old[k - 2];
				d.place[ring[k]]    = { Place::inside, -1 };
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

	// ---------------------------------------------------------------- the way in

	int cellCount(Real area, Real s) { return std::max(1, int(std::lround(area / (s * s)))); }

	/// The same numbers on every machine and library, unlike std::uniform_real_distribution: 53 bits, in [0, 1).
	Real uniform(std::mt19937_64& random) { return Real(random() >> 11) * 0x1p-53; }

	bool strictlyInside(const std::vector<std::vector<K::Point_2>>& rings, const Vec2& p)
	{
		for (size_t r = 0; r < rings.size(); ++r)
			if (CGAL::bounded_side_2(rings[r].begin(), rings[r].end(), toK(p), K()) != (r == 0 ? CGAL::ON_BOUNDED_SIDE : CGAL::ON_UNBOUNDED_SIDE))
				return false;
		return true;
	}

	std::vector<std::vector<K::Point_2>> ringsOf(const Polygon& region)
	{
		std::vector<std::vector<K::Point_2>> rings { toK(region.outer) };
		for (const Ring& hole : region.holes)
			rings.push_back(toK(hole));
		return rings;
	}

	std::vector<Vec2> randomSeeds(const Polygon& region, int count, std::uint64_t seed)
	{
		std::mt19937_64 random(seed);
		const auto      rings = ringsOf(region);
		Vec2            low = region.outer[0], high = low;
		for (const Vec2& p : region.outer) {
			low  = low.cwiseMin(p);
			high = high.cwiseMax(p);
		}
		std::vector<Vec2> seeds;
		while (int(seeds.size()) < count) {
			const Real x = uniform(random), y = uniform(random);
			const Vec2 p = low + Vec2(x, y).cwiseProduct(high - low);
			if (strictlyInside(rings, p)) seeds.push_back(p);
		}
		return seeds;
	}

	Real areaOf(const Polygon& region)
	{
		Real area = signedArea(region.outer);
		for (const Ring& hole : region.holes)
			area += signedArea(hole);
		return area;
	}

	/// Checks the options and returns s, the nominal sqrt(area) of a cell [m].
	Real requireOptions(const Polygon& region, const TessellationOptions& o)
	{
		const bool edge = o.meaning == SizeMeaning::edge;
		const Real s = edge ? sqrtAreaOfUnitEdge * o.size : o.size, largest = std::sqrt(areaOf(region));
		require(o.size > 0 && std::isfinite(o.size), "Tessellation.size must be positive", o.size);
		require(s <= largest,
		        "Tessellation.size must not exceed " + shown(edge ? largest / sqrtAreaOfUnitEdge : largest) + ", at which the region is one cell",
		        o.size);
		require(areaOf(region) / (s * s) < 1e8, "Tessellation.size must be larger than sqrt(area)/1e4, as 1e8 cells are too many", o.size);
		require(o.lloyd >= 0, "Tessellation.lloyd must not be negative", o.lloyd);
		require(o.mergeFraction >= 0 && o.mergeFraction < 0.5, "Tessellation.mergeFraction must lie in [0, 0.5)", o.mergeFraction);
		const auto rings = ringsOf(region);
		for (size_t i = 0; i < o.seeds.size(); ++i)
			if (!o.seeds[i].allFinite() || !strictlyInside(rings, o.seeds[i]))
				throw std::invalid_argument(
					"Tessellation.seeds must lie inside the region, got " + shownPoint(o.seeds[i]) + " at index " + std::to_string(i));
		return s;
	}

} // namespace

void requireSimple(const Polygon& region, const std::string& name)
{
	const Walls      walls(region);
	std::vector<int> ringOfWall;
	for (int r = 0; r + 1 < int(walls.start.size()); ++r) {
		const int         n    = walls.start[r + 1] - walls.start[r];
		const std::string ring = name + "." + ringName(r);
		require(n >= 3, ring + " must have at least 3 vertices", n);
		ringOfWall.insert(ringOfWall.end(), n, r);
		Real perimeter = 0;
		for (int k = walls.start[r]; k < walls.start[r + 1]; ++k) {
			const Vec2& p = walls.corner[k];
			if (!p.allFinite())
				throw std::invalid_argument(
					ring + " must have finite coordinates, got " + shownPoint(p) + " at vertex " + std::to_string(k - walls.start[r]));
			if (p == walls.corner[walls.next[k]])
				throw std::invalid_argument(
					ring + " must have distinct vertices, got " + shownPoint(p) + " twice, at vertex " + std::to_string(k - walls.start[r])
					+ " and the next");
			perimeter += walls.along(k).norm();
		}
		const Real area = signedArea(r == 0 ? region.outer : region.holes[r - 1]);
		require(std::abs(area) > 1e-12 * perimeter * perimeter, ring + " must have an area", area);
	}
	requireApart(walls, ringOfWall, name);
	require(signedArea(region.outer) > 0, name + ".outer must be counter-clockwise (area positive)", signedArea(region.outer));
	const auto rings = ringsOf(region);
	for (size_t h = 0; h < region.holes.size(); ++h) {
		const std::string hole = name + "." + ringName(int(h) + 1);
		require(signedArea(region.holes[h]) < 0, hole + " must be clockwise (area negative)", signedArea(region.holes[h]));
		for (size_t r = 0; r < rings.size(); ++r) {
			if (r == h + 1) continue;
			const bool within = CGAL::bounded_side_2(rings[r].begin(), rings[r].end(), rings[h + 1][0], K()) == CGAL::ON_BOUNDED_SIDE;
			if (within != (r == 0))
				throw std::invalid_argument(
					hole + (r == 0 ? " must lie inside " : " must lie outside ") + ringName(int(r)) + ", got its vertex "
					+ shownPoint(region.holes[h][0]));
		}
	}
}

Cells tessellate(const Polygon& region, const TessellationOptions& options)
{
	requireSimple(region, "Tessellation.region");
	const Real  s = requireOptions(region, options);
	const Walls walls(region);
	auto        seeds = options.seeds.empty() ? randomSeeds(region, cellCount(areaOf(region), s), options.seed) : options.seeds;

	for (int i = 0;; ++i) {
		ClippedVoronoi voronoi(walls, seeds);
		if (i == 0 && !options.seeds.empty())
			require(voronoi.closestSeeds() > 1e-6 * s,
			        "Tessellation.seeds must be farther apart than 1e-6 of the cell size",
			        voronoi.closestSeeds());
		if (i < options.lloyd) {
			seeds = centroids(voronoi.diagram, seeds);
			continue;
		}
		HoleCutter(voronoi.diagram, walls, s).run();
		return Merger(voronoi.diagram, walls, std::max(options.mergeFraction, coincident) * s, s).run();
	}
}

Ring withPointsOnEdges(const Ring& ring, const std::vector<Vec2>& points, Real tolerance)
{
	require(tolerance >= 0 && std::isfinite(tolerance), "withPointsOnEdges: tolerance must be positive", tolerance);
	Ring out;
	for (size_t k = 0, n = ring.size(); k < n; ++k) {
		const Vec2 &a = ring[k], &b = ring[(k + 1) % n];
		const Real  length = (b - a).norm();
		const Vec2  t      = (b - a) / length;

		std::vector<std::pair<Real, const Vec2*>> onEdge; // by distance from a
		for (const Vec2& p : points) {
			const Real along = t.dot(p - a);
			if (along > tolerance && along < length - tolerance && std::abs(cross(t, p - a)) <= tolerance) onEdge.emplace_back(along, &p);
		}
		std::stable_sort(onEdge.begin(), onEdge.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
		out.push_back(a);
		Real last = 0;
		for (const auto& [along, p] : onEdge) {
			if (along - last <= tolerance) continue;
			out.push_back(*p);
			last = along;
		}
	}
	return out;
}

Ring ringOf(const Cells& cells, size_t index)
{
	Ring ring;
	for (int node : cells.cells[index])
		ring.push_back(cells.vertices[node]);
	return ring;
}

std::vector<int> boundaryVertices(const Cells& cells)
{
	std::vector<std::pair<int, int>> sides;
	for (const auto& ring : cells.cells)
		for (size_t k = 0, n = ring.size(); k < n; ++k)
			sides.push_back({ ring[k], ring[(k + 1) % n] });
	std::sort(sides.begin(), sides.end());
	std::vector<int> out;
	for (const auto& [a, b] : sides)
		if (!std::binary_search(sides.begin(), sides.end(), std::make_pair(b, a))) out.push_back(a); // each outline vertex begins one such side
	out.erase(std::unique(out.begin(), out.end()), out.end());
	return out;
}

} // namespace blocks
