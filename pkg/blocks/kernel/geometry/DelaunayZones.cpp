// yade-blocks, GPL-2.0-or-later

#include <blocks/kernel/geometry/EdgeDivision.hpp>
#include <blocks/kernel/geometry/PolygonRules.hpp>
#include <blocks/kernel/geometry/ZoneMesh.hpp>

#include <algorithm>
#include <limits>
#include <queue>
#include <tuple>

namespace blocks {
namespace {

	/// Wanted edge length: zoneSize, but no more than the outline's own spacing nearby allows. Away from a point of the
	/// outline it grows by half the distance.
	class Sizing {
	public:
		Sizing(const Zones& outline, Real largest)
			: zoneSize(largest)
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
		Refinement(Triangulation& m, Zones& z, const Sizing& s)
			: mesh(m)
			, zones(z)
			, sizing(s)
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
		Triangulation& mesh;
		Zones&         zones;
		const Sizing&  sizing;

		using Nodes = std::array<int, 3>;
		struct Large {
			Real                       excess; ///< circumradius by wanted circumradius
			Nodes                      nodes;
			Triangulation::Face_handle face;
			bool                       operator<(const Large& other) const { return std::tie(excess, nodes) < std::tie(other.excess, other.nodes); }
		};
		std::priority_queue<Large> queue;

		static Nodes sorted(Nodes nodes)
		{
			std::sort(nodes.begin(), nodes.end());
			return nodes;
		}

		void consider(Triangulation::Face_handle f)
		{
			if (mesh.is_infinite(f) || !f->info()) return;
			const auto centre = mesh.circumcenter(f);
			const Real radius = std::sqrt(CGAL::squared_distance(centre, f->vertex(0)->point()));
			// Radii end up between 1/2 and 1 of the limit; 0.75 times the limit is the radius of equilateral zones of the wanted edge.
			const Real excess = radius / (sizing.at(fromK(centre)) / (0.75 * std::sqrt(3.0)));
			if (excess > 1 && std::isfinite(excess)) queue.push({ excess, sorted(nodesOf(f)), f });
		}

		/// The circumcentre, or, where a long edge of the outline is in its way, the centroid of a zone that is too large.
		void divide(Triangulation::Face_handle f)
		{
			const auto corner   = [&](int i) { return fromK(f->vertex(i)->point()); };
			const Vec2 centroid = (corner(0) + corner(1) + corner(2)) / 3;
			const Real wanted   = std::sqrt(3.0) / 4 * std::pow(sizing.at(centroid), 2); // the area of an equilateral zone
			const bool tooLarge = twiceArea(corner(0), corner(1), corner(2)) / 2 > 1.5 * wanted;
			if (!insert(mesh.circumcenter(f), f) && tooLarge) insert(toK(centroid), f);
		}

		bool insert(const K::Point_2& p, Triangulation::Face_handle near)
		{
			Triangulation::Locate_type       type;
			int                              i;
			const Triangulation::Face_handle at = mesh.locate(p, type, i, near);
			if (type == Triangulation::VERTEX || type == Triangulation::OUTSIDE_CONVEX_HULL || type == Triangulation::OUTSIDE_AFFINE_HULL
			    || !at->info())
				return false;
			if (type == Triangulation::EDGE && at->is_constrained(i)) return false;
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

} // namespace

Zones delaunayZones(const Polygon& polygon, Real zoneSize, Outline outline)
{
	requireSimple(polygon, "delaunayZones");
	requireZoneSize("delaunayZones", zoneSize, polygon.outer);
	Zones         zones         = outlineOf(outline == Outline::split ? divided(polygon, zoneSize) : polygon);
	const size_t  firstInterior = zones.points.size();
	Triangulation mesh;
	triangulateOutline(mesh, zones);
	const Sizing sizing(zones, zoneSize);
	Refinement(mesh, zones, sizing).run();
	takeTriangles(mesh, zones);
	smooth(zones, firstInterior, 5);
	return checked(zones, "delaunayZones");
}

Zones delaunayZones(const Ring& ring, Real zoneSize, Outline outline) { return delaunayZones(Polygon { ring, {} }, zoneSize, outline); }

} // namespace blocks
