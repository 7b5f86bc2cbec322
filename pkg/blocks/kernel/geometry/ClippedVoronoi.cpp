// yade-blocks, GPL-2.0-or-later

// How it works. The Voronoi diagram is the dual of CGAL's Delaunay triangulation. Each edge of the region ("wall")
// is walked through the diagram, cell by cell; which Voronoi edge it crosses next is decided by exact predicates only,
// so the combinatorial result is right for every input, and coordinates are rounded once, at the end. Cells that no
// wall enters are the plain dual, which costs a neighbour walk each.
//
// Degenerate positions (a Voronoi vertex on a wall, a wall along a Voronoi edge: the rule with regular grids) are decided
// as if the region had been shifted by (eps, eps^2), eps > 0 infinitesimal; then nothing coincides. The shift is never
// carried out; it leaves edges of length zero, which merging removes together with the short ones.

#include <blocks/kernel/geometry/Cgal.hpp>
#include <blocks/kernel/geometry/ClippedVoronoi.hpp>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <limits>
#include <map>
#include <unordered_map>

namespace blocks {
namespace {

	using Exact    = CGAL::Exact_predicates_exact_constructions_kernel;
	using Delaunay = CGAL::Delaunay_triangulation_2<
		K,
		CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_with_info_2<int, K>, CGAL::Triangulation_face_base_with_info_2<int, K>>>;
	using Face       = Delaunay::Face_handle;
	using ExactPoint = Exact::Point_2;

	int sign(Real value) { return (value > 0) - (value < 0); }

	class Clipping {
	public:
		Clipping(const Walls& w, const std::vector<Vec2>& s)
			: walls(w)
			, seeds(s)
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
			for (size_t p = firstPiece; p + 1 < diagram.pieces.size(); ++p)
				if (strictlyInside(diagram.position[hole[0]], { ringOf(diagram, diagram.pieces[p].ring), {} })) return p;
			return diagram.pieces.size() - 1;
		}
	};

} // namespace

ClippedVoronoi clippedVoronoi(const Walls& region, const std::vector<Vec2>& seeds)
{
	Clipping clipping(region, seeds);
	return { std::move(clipping.diagram), clipping.closestSeeds() };
}

} // namespace blocks
