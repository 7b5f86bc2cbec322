// yade-blocks, GPL-2.0-or-later

#include <blocks/kernel/geometry/Tessellation.hpp>
#include <blocks/kernel/geometry/Zoning.hpp>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>

namespace blocks {
namespace {

	using K      = CGAL::Exact_predicates_inexact_constructions_kernel;
	using Vertex = CGAL::Triangulation_vertex_base_with_info_2<int, K>;
	using InFace = CGAL::Triangulation_face_base_with_info_2<bool, K, CGAL::Constrained_triangulation_face_base_2<K>>; // info: inside the block?
	using Mesh = CGAL::Constrained_Delaunay_triangulation_2<K, CGAL::Triangulation_data_structure_2<Vertex, InFace>, CGAL::No_constraint_intersection_tag>;

	K::Point_2 toK(const Vec2& p) { return { p.x(), p.y() }; }
	Vec2       fromK(const K::Point_2& p) { return { p.x(), p.y() }; }

	Real twiceArea(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a); }

	/// The polygon's rings as nodes 0, 1, ... and no triangle yet.
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

	/// The points that see every edge of the ring from the inside: the ring cut by each edge's line. Empty if there are none.
	Ring kernelOf(const Ring& ring)
	{
		Ring kernel = ring;
		for (size_t k = 0, n = ring.size(); k < n; ++k) {
			const Vec2 &a = ring[k], d = ring[(k + 1) % n] - a;
			Ring        cut;
			for (size_t i = 0, m = kernel.size(); i < m; ++i) {
				const Vec2 &p = kernel[i], &q = kernel[(i + 1) % m];
				const Real  atP = cross(d, p - a), atQ = cross(d, q - a);
				if (atP >= 0) cut.push_back(p);
				if ((atP > 0 && atQ < 0) || (atP < 0 && atQ > 0)) cut.push_back(p + atP / (atP - atQ) * (q - p));
			}
			kernel = cut;
		}
		return kernel;
	}

	Vec2 centroidOf(const Ring& ring)
	{
		Vec2 first = Vec2::Zero();
		for (size_t k = 1; k + 1 < ring.size(); ++k)
			first += twiceArea(ring[0], ring[k], ring[k + 1]) / 6 * (ring[k] + ring[k + 1] - 2 * ring[0]);
		return ring[0] + first / signedArea(ring);
	}

	/// Triangulates the outline and marks the faces inside it.
	void triangulateOutline(Mesh& mesh, const Zones& zones)
	{
		std::vector<Mesh::Vertex_handle> node;
		for (size_t i = 0; i < zones.points.size(); ++i) {
			node.push_back(mesh.insert(toK(zones.points[i])));
			node.back()->info() = int(i);
		}
		for (const auto& ring : zones.rings)
			for (size_t k = 0, n = ring.size(); k < n; ++k)
				mesh.insert_constraint(node[ring[k]], node[ring[(k + 1) % n]]);

		for (auto f = mesh.all_faces_begin(); f != mesh.all_faces_end(); ++f)
			f->info() = false;
		std::vector<Mesh::Face_handle> todo;
		const auto                     enter = [&](Mesh::Face_handle f) {
                        if (f->info()) return;
                        f->info() = true;
                        todo.push_back(f);
		};
		for (const auto& ring : zones.rings) // the material is on the left of every outline edge; from there to where no outline is crossed
			for (size_t k = 0, n = ring.size(); k < n; ++k) {
				Mesh::Face_handle f;
				int               i;
				mesh.is_edge(node[ring[k]], node[ring[(k + 1) % n]], f, i);
				if (f->vertex(Mesh::ccw(i)) != node[ring[k]]) f = f->neighbor(i);
				enter(f);
			}
		while (!todo.empty()) {
			const auto f = todo.back();
			todo.pop_back();
			for (int e = 0; e < 3; ++e)
				if (!f->is_constrained(e)) enter(f->neighbor(e));
		}
	}

	std::array<int, 3> nodesOf(Mesh::Face_handle f) { return { f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info() }; }

	void takeTriangles(const Mesh& mesh, Zones& zones)
	{
		for (auto f = mesh.finite_faces_begin(); f != mesh.finite_faces_end(); ++f) {
			if (!f->info()) continue;
			auto t = nodesOf(f);
			std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
			zones.triangles.push_back(t);
		}
		std::sort(zones.triangles.begin(), zones.triangles.end()); // an order that does not depend on CGAL's
	}

	/// Nothing else says that a zone can be computed with: positive area in floating point, not only in exact arithmetic.
	Zones checked(Zones zones, const std::string& name)
	{
		for (const auto& t : zones.triangles)
			require(twiceArea(zones.points[t[0]], zones.points[t[1]], zones.points[t[2]]) > 0,
			        name + ": every zone must have a positive area",
			        twiceArea(zones.points[t[0]], zones.points[t[1]], zones.points[t[2]]) / 2);
		return zones;
	}

	/// Wanted edge length: zoneSize, but no more than the outline's own spacing nearby allows. Away from a point of the
	/// outline it grows by half the distance.
	class Sizing {
	public:
		Sizing(const Zones& outline, Real zoneSize)
			: zoneSize(zoneSize)
		{
			for (const auto& ring : outline.rings)
				for (size_t k = 0, n = ring.size(); k < n; ++k) {
					const Vec2 &a = outline.points[ring[k]], &b = outline.points[ring[(k + 1) % n]];
					edges.push_back({ a, b });
					if ((b - a).norm() < 0.8 * zoneSize) fine.push_back({ (a + b) / 2, (b - a).norm() });
				}
		}
		Real at(const Vec2& p) const
		{
			Real size = zoneSize;
			for (const auto& [place, length] : fine)
				size = std::min(size, length + 0.5 * (p - place).norm());
			return size;
		}
		/// Is p so near to an edge of the outline that it would make flat zones there? That is, in the circle over the edge, and,
		/// as edges that are kept may be long, nearer than half the wanted size.
		bool encroaches(const Vec2& p) const
		{
			const Real near = 0.5 * at(p);
			for (const auto& [a, b] : edges)
				if ((a - p).dot(b - p) < 0 && std::abs(cross(b - a, p - a)) < near * (b - a).norm()) return true;
			return false;
		}

	private:
		const Real                         zoneSize;
		std::vector<std::pair<Vec2, Vec2>> edges;
		std::vector<std::pair<Vec2, Real>> fine;
	};

	/// Adds points inside too large zones, the largest first, as long as they lie in the block and leave the outline alone.
	class Refinement {
	public:
		Refinement(Mesh& mesh, Zones& zones, const Sizing& sizing)
			: mesh(mesh)
			, zones(zones)
			, sizing(sizing)
		{
			for (auto f = mesh.finite_faces_begin(); f != mesh.finite_faces_end(); ++f)
				consider(f);
		}

		void run()
		{
			while (!queue.empty()) {
				const auto [size, nodes, f] = queue.top();
				queue.pop();
				if (sorted(nodesOf(f)) == nodes) divide(f);
			}
		}

	private:
		Mesh&         mesh;
		Zones&        zones;
		const Sizing& sizing;

		using Nodes = std::array<int, 3>;
		struct Large {
			Real              excess; ///< circumradius by wanted circumradius
			Nodes             nodes;
			Mesh::Face_handle face;
			bool              operator<(const Large& other) const { return std::tie(excess, nodes) < std::tie(other.excess, other.nodes); }
		};
		std::priority_queue<Large> queue;

		static Nodes sorted(Nodes nodes)
		{
			std::sort(nodes.begin(), nodes.end());
			return nodes;
		}

		void consider(Mesh::Face_handle f)
		{
			if (mesh.is_infinite(f) || !f->info()) return;
			const auto centre = mesh.circumcenter(f);
			const Real radius = std::sqrt(CGAL::squared_distance(centre, f->vertex(0)->point()));
			// Radii end up between 1/2 and 1 of the limit; 0.75 times the limit is the radius of equilateral zones of the wanted edge.
			const Real excess = radius / (sizing.at(fromK(centre)) / (0.75 * std::sqrt(3.0)));
			if (excess > 1 && std::isfinite(excess)) queue.push({ excess, sorted(nodesOf(f)), f });
		}

		/// The circumcentre, or, where a long edge of the outline is in its way, the centroid of a zone that is too large.
		void divide(Mesh::Face_handle f)
		{
			const auto corner   = [&](int i) { return fromK(f->vertex(i)->point()); };
			const Vec2 centroid = (corner(0) + corner(1) + corner(2)) / 3;
			const Real wanted   = std::sqrt(3.0) / 4 * std::pow(sizing.at(centroid), 2); // the area of an equilateral zone
			const bool tooLarge = twiceArea(corner(0), corner(1), corner(2)) / 2 > 1.5 * wanted;
			if (!insert(mesh.circumcenter(f), f) && tooLarge) insert(toK(centroid), f);
		}

		bool insert(const K::Point_2& p, Mesh::Face_handle near)
		{
			Mesh::Locate_type       type;
			int                     i;
			const Mesh::Face_handle at = mesh.locate(p, type, i, near);
			if (type == Mesh::VERTEX || type == Mesh::OUTSIDE_CONVEX_HULL || type == Mesh::OUTSIDE_AFFINE_HULL || !at->info()) return false;
			if (type == Mesh::EDGE && at->is_constrained(i)) return false;
			if (sizing.encroaches(fromK(p))) return false;

			const auto node = mesh.insert(p, type, at, i);
			node->info()    = int(zones.points.size());
			zones.points.push_back(fromK(p));
			auto star = mesh.incident_faces(node), end = star;
			do
				star->info() = true; // no outline within the star: all of it is inside
			while (++star != end);
			do
				consider(star);
			while (++star != end);
			return true;
		}
	};

	Real smallestAngle(const Vec2& a, const Vec2& b, const Vec2& c)
	{
		const auto angle = [](const Vec2& u, const Vec2& v) { return std::atan2(cross(u, v), u.dot(v)); }; // negative if turned over
		return std::min({ angle(b - a, c - a), angle(c - b, a - b), angle(a - c, b - c) });
	}

	/// Moves each interior point to the mean of its neighbours, where that raises the smallest angle around it.
	void smooth(Zones& zones, size_t firstInterior, int sweeps)
	{
		std::vector<std::vector<int>> star(zones.points.size());
		for (size_t t = 0; t < zones.triangles.size(); ++t)
			for (int node : zones.triangles[t])
				star[node].push_back(int(t));
		const auto worst = [&](size_t i) {
			Real angle = M_PI;
			for (int t : star[i])
				angle = std::min(
					angle,
					smallestAngle(
						zones.points[zones.triangles[t][0]], zones.points[zones.triangles[t][1]], zones.points[zones.triangles[t][2]]));
			return angle;
		};
		for (int sweep = 0; sweep < sweeps; ++sweep)
			for (size_t i = firstInterior; i < zones.points.size(); ++i) {
				Vec2 mean = Vec2::Zero(); // each neighbour belongs to two zones of the star
				for (int t : star[i])
					for (int node : zones.triangles[t])
						if (node != int(i)) mean += zones.points[node] / Real(2 * star[i].size());
				const Vec2 old    = zones.points[i];
				const Real before = worst(i);
				zones.points[i]   = mean;
				if (!(worst(i) > before)) zones.points[i] = old;
			}
	}

	Polygon split(const Polygon& polygon, Real zoneSize)
	{
		const auto splitRing = [&](const Ring& ring) {
			Ring out;
			for (size_t k = 0, n = ring.size(); k < n; ++k) {
				const Vec2 &a = ring[k], &b = ring[(k + 1) % n];
				const int   parts
					= std::max(1, int(std::ceil((b - a).norm() / zoneSize * (1 - 1e-9)))); // a multiple of zoneSize is not one part more
				for (int p = 0; p < parts; ++p)
					out.push_back(a + (b - a) * p / parts);
			}
			return out;
		};
		Polygon out { splitRing(polygon.outer), {} };
		for (const Ring& hole : polygon.holes)
			out.holes.push_back(splitRing(hole));
		return out;
	}

	void requireZoneSize(const std::string& name, Real zoneSize, const Ring& ring)
	{
		require(zoneSize > 0 && std::isfinite(zoneSize), name + ": zoneSize must be positive", zoneSize);
		require(signedArea(ring) / (zoneSize * zoneSize) < 1e7,
		        name + ": zoneSize must be larger than sqrt(area)/3e3, as 1e7 zones in a block are too many",
		        zoneSize);
	}

} // namespace

Zones fanZones(const Ring& ring)
{
	requireSimple({ ring, {} }, "fanZones");
	Zones      zones = outlineOf({ ring, {} });
	const int  n     = int(ring.size());
	const auto sees  = [&](const Vec2& p) { // from farther than rounding
                for (int k = 0; k < n; ++k) {
			 const Vec2 d = ring[(k + 1) % n] - ring[k];
			 if (!(cross(d, p - ring[k]) > 1e-9 * d.norm() * std::sqrt(signedArea(ring)))) return false;
                }
		 return true;
	};
	Vec2 centre = centroidOf(ring);
	if (!sees(centre)) {
		const Ring kernel = kernelOf(ring);
		if (kernel.size() > 2 && signedArea(kernel) > 0) centre = centroidOf(kernel);
		require(sees(centre), "fanZones: some point must see every edge of the block (else use cornerZones or delaunayZones), none does; vertices", n);
	}
	zones.points.push_back(centre);
	for (int k = 0; k < n; ++k)
		zones.triangles.push_back({ k, (k + 1) % n, n });
	return checked(zones, "fanZones");
}

Zones cornerZones(const Ring& ring) { return cornerZones(Polygon { ring, {} }); }

Zones cornerZones(const Polygon& polygon)
{
	requireSimple(polygon, "cornerZones");
	Zones zones = outlineOf(polygon);
	Mesh  mesh;
	triangulateOutline(mesh, zones);
	takeTriangles(mesh, zones);
	return checked(zones, "cornerZones");
}

Zones regularZones(const Ring& ring, Real zoneSize)
{
	if (ring.size() > 4) return delaunayZones(ring, zoneSize, Outline::kept);
	requireSimple({ ring, {} }, "regularZones");
	requireZoneSize("regularZones", zoneSize, ring);
	require(ring.size() == 4, "regularZones: the block must be a rectangle; vertices", Real(ring.size()));
	const Vec2 u = ring[1] - ring[0], v = ring[3] - ring[0];
	const Real skew = std::max((ring[2] - ring[0] - u - v).norm() / (u.norm() + v.norm()), std::abs(u.dot(v)) / (u.norm() * v.norm()));
	require(skew < 1e-9, "regularZones: the block must be a rectangle to 1e-9; deviation", skew);

	const auto parts = [&](Real length) { return std::max(1, int(std::ceil(length / zoneSize * (1 - 1e-9)))); };
	const int  nu = parts(u.norm()), nv = parts(v.norm());
	const auto place = [&](int i, int j) { // bilinear in the corners, so that edges and corners are met to the bit
		const Vec2 low = ring[0] + (ring[1] - ring[0]) * i / nu, high = ring[3] + (ring[2] - ring[3]) * i / nu;
		if (j == 0) return i == nu ? ring[1] : low;
		if (j == nv) return i == nu ? ring[2] : high;
		if (i == nu) return Vec2(ring[1] + (ring[2] - ring[1]) * j / nv);
		return Vec2(low + (high - low) * j / nv);
	};

	Zones                         zones;
	std::vector<std::vector<int>> number(nu + 1, std::vector<int>(nv + 1, -1));
	const auto                    add = [&](int i, int j) {
                if (number[i][j] >= 0) return;
                number[i][j] = int(zones.points.size());
                zones.points.push_back(place(i, j));
	};
	for (int i = 0; i < nu; ++i)
		add(i, 0);
	for (int j = 0; j < nv; ++j)
		add(nu, j);
	for (int i = nu; i > 0; --i)
		add(i, nv);
	for (int j = nv; j > 0; --j)
		add(0, j);
	zones.rings.emplace_back();
	for (size_t k = 0; k < zones.points.size(); ++k)
		zones.rings[0].push_back(int(k));
	for (int i = 1; i < nu; ++i)
		for (int j = 1; j < nv; ++j)
			add(i, j);

	for (int i = 0; i < nu; ++i)
		for (int j = 0; j < nv; ++j) {
			const int a = number[i][j], b = number[i + 1][j], c = number[i + 1][j + 1], d = number[i][j + 1];
			if ((i + j) % 2 == 0)
				zones.triangles.insert(zones.triangles.end(), { { a, b, c }, { a, c, d } });
			else
				zones.triangles.insert(zones.triangles.end(), { { a, b, d }, { b, c, d } });
		}
	return checked(zones, "regularZones");
}

Zones delaunayZones(const Polygon& polygon, Real zoneSize, Outline outline)
{
	requireSimple(polygon, "delaunayZones");
	requireZoneSize("delaunayZones", zoneSize, polygon.outer);
	Zones        zones         = outlineOf(outline == Outline::split ? split(polygon, zoneSize) : polygon);
	const size_t firstInterior = zones.points.size();
	Mesh         mesh;
	triangulateOutline(mesh, zones);
	const Sizing sizing(zones, zoneSize);
	Refinement(mesh, zones, sizing).run();
	takeTriangles(mesh, zones);
	smooth(zones, firstInterior, 5);
	return checked(zones, "delaunayZones");
}

Zones delaunayZones(const Ring& ring, Real zoneSize, Outline outline) { return delaunayZones(Polygon { ring, {} }, zoneSize, outline); }

ZoneQuality quality(const Zones& zones)
{
	const Real  none = std::numeric_limits<Real>::infinity();
	ZoneQuality q { none, 0, none, 0, 0 };
	for (const auto& t : zones.triangles) {
		const Vec2 p[3]    = { zones.points[t[0]], zones.points[t[1]], zones.points[t[2]] };
		const Real area    = twiceArea(p[0], p[1], p[2]) / 2;
		Real       longest = 0;
		for (int k = 0; k < 3; ++k) {
			const Vec2 u = p[(k + 1) % 3] - p[k], v = p[(k + 2) % 3] - p[k];
			const Real angle = std::atan2(cross(u, v), u.dot(v));
			q.minAngle       = std::min(q.minAngle, angle);
			q.maxAngle       = std::max(q.maxAngle, angle);
			longest          = std::max(longest, u.norm());
		}
		q.minArea     = std::min(q.minArea, area);
		q.maxArea     = std::max(q.maxArea, area);
		q.worstAspect = std::max(q.worstAspect, std::sqrt(3.0) / 2 * longest / (2 * area / longest));
	}
	return q;
}

} // namespace blocks
