// yade-blocks, GPL-2.0-or-later

#include <blocks/kernel/geometry/EdgeDivision.hpp>
#include <blocks/kernel/geometry/PolygonRules.hpp>
#include <blocks/kernel/geometry/ZoneMesh.hpp>

#include <algorithm>
#include <limits>

namespace blocks {
namespace {

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

	/// Whether a point is on the inner side of every edge, by more than rounding.
	bool sees(const Vec2& p, const Ring& ring)
	{
		const Real scale = std::sqrt(signedArea(ring));
		for (size_t k = 0, n = ring.size(); k < n; ++k) {
			const Vec2 d = ring[(k + 1) % n] - ring[k];
			if (!(cross(d, p - ring[k]) > 1e-9 * d.norm() * scale)) return false;
		}
		return true;
	}

	/// The centroid; where that does not see every edge, the centroid of the points that do, if there are any.
	Vec2 centreOf(const Ring& ring)
	{
		const Vec2 centroid = moments(ring).centroid();
		if (sees(centroid, ring)) return centroid;
		const Ring kernel = kernelOf(ring);
		return kernel.size() > 2 && signedArea(kernel) > 0 ? moments(kernel).centroid() : centroid;
	}

	/// Whether every vertex given is one of the grid's on the outline, nearly; those take its bits then, so that neighbours' vertices stay their own.
	bool passThrough(std::vector<Vec2>& grid, const Ring& given)
	{
		std::vector<Vec2> taken = grid;
		for (const Vec2& p : given) {
			const auto nearest = std::min_element(
				grid.begin(), grid.end(), [&](const Vec2& a, const Vec2& b) { return (a - p).squaredNorm() < (b - p).squaredNorm(); });
			if ((*nearest - p).norm() > 1e-6 * (grid[1] - grid[0]).norm()) return false;
			taken[nearest - grid.begin()] = p;
		}
		grid = taken;
		return true;
	}

	/// The rectangle's four corners, without the vertices on its sides; refuses what is no rectangle.
	Ring cornersOf(const Ring& ring)
	{
		Ring corners;
		for (size_t k = 0, n = ring.size(); k < n; ++k) {
			const Vec2 in = ring[k] - ring[(k + n - 1) % n], out = ring[(k + 1) % n] - ring[k];
			if (std::abs(cross(in, out)) > 1e-6 * in.norm() * out.norm()) corners.push_back(ring[k]);
		}
		require(corners.size() == 4, "regularZones: the block must be a rectangle; corners", Real(corners.size()));
		const Vec2 u = corners[1] - corners[0], v = corners[3] - corners[0];
		const Real skew = std::max((corners[2] - corners[0] - u - v).norm() / (u.norm() + v.norm()), std::abs(u.dot(v)) / (u.norm() * v.norm()));
		require(skew < 1e-9, "regularZones: the block must be a rectangle to 1e-9; deviation", skew);
		return corners;
	}

} // namespace

Zones fanZones(const Ring& ring)
{
	requireSimple({ ring, {} }, "fanZones");
	Zones      zones  = outlineOf({ ring, {} });
	const int  n      = int(ring.size());
	const Vec2 centre = centreOf(ring);
	require(sees(centre, ring), "fanZones: some point must see every edge of the block (else use cornerZones or delaunayZones), none does; vertices", n);
	zones.points.push_back(centre);
	for (int k = 0; k < n; ++k)
		zones.triangles.push_back({ k, (k + 1) % n, n });
	return checked(zones, "fanZones");
}

Zones cornerZones(const Ring& ring) { return cornerZones(Polygon { ring, {} }); }

Zones cornerZones(const Polygon& polygon)
{
	requireSimple(polygon, "cornerZones");
	Zones         zones = outlineOf(polygon);
	Triangulation mesh;
	triangulateOutline(mesh, zones);
	takeTriangles(mesh, zones);
	return checked(zones, "cornerZones");
}

Zones regularZones(const Ring& given, Real zoneSize)
{
	requireSimple({ given, {} }, "regularZones");
	requireZoneSize("regularZones", zoneSize, given);
	const Ring ring = cornersOf(given);
	const Vec2 u = ring[1] - ring[0], v = ring[3] - ring[0];
	const int  nu = partsOf(u.norm(), zoneSize), nv = partsOf(v.norm(), zoneSize);
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
	if (!passThrough(zones.points, given)) return delaunayZones(given, zoneSize);
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

Zones regionZones(const Polygon& region, Zoning zoning, Real zoneSize)
{
	if (zoning == Zoning::delaunay) return delaunayZones(region, zoneSize);
	requireZoneSize("regionZones", zoneSize, region.outer);
	if (zoning == Zoning::corners) return cornerZones(divided(region, zoneSize));
	require(region.holes.empty(),
	        "zoning 'fan' and 'regular' have no place for holes (else use 'delaunay' or 'corners'); holes",
	        Real(region.holes.size()));
	return zoning == Zoning::fan ? fanZones(divided(region, zoneSize).outer) : regularZones(region.outer, zoneSize);
}

CellZones cellZones(const Ring& cell, Zoning wanted)
{
	requireSimple({ cell, {} }, "cell");
	std::vector<CellZones> found;
	std::vector<Real>      aspect;
	std::string            error;
	const auto             attempt = [&](Zoning zoning) {
                if (zoning == Zoning::fan && !sees(centreOf(cell), cell)) return false;
                try {
                        const Zones zones = zoning == Zoning::fan ? fanZones(cell)
					    : zoning == Zoning::corners       ? cornerZones(cell)
									      : delaunayZones(cell, std::sqrt(signedArea(cell)), Outline::kept);
                        found.push_back({ zones, zoning });
                } catch (const std::invalid_argument& refusal) { // a zone without an area
                        error = refusal.what();
                        return false;
                }
                aspect.push_back(quality(found.back().zones).worstAspect);
                return aspect.back() <= sliverAspect;
	};
	if (attempt(wanted)) return found[0];
	for (Zoning other : { Zoning::fan, Zoning::corners, Zoning::delaunay })
		if (other != wanted) attempt(other);
	if (found.empty()) throw std::invalid_argument(error);
	return found[std::min_element(aspect.begin(), aspect.end()) - aspect.begin()];
}

std::vector<Ring> trianglesOf(const Ring& cell)
{
	const Zones       zones = cellZones(cell, Zoning::fan).zones;
	std::vector<Ring> out;
	for (const auto& t : zones.triangles)
		out.push_back({ zones.points[t[0]], zones.points[t[1]], zones.points[t[2]] });
	return out;
}

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
