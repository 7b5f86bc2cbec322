// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/geometry/EdgeDivision.hpp>

namespace blocks {

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

Polygon withPointsOnEdges(const Polygon& polygon, const std::vector<Vec2>& points, Real tolerance)
{
	Polygon out { withPointsOnEdges(polygon.outer, points, tolerance), {} };
	for (const Ring& hole : polygon.holes)
		out.holes.push_back(withPointsOnEdges(hole, points, tolerance));
	return out;
}

int partsOf(Real length, Real longest) { return std::max(1, int(std::ceil(length / longest * (1 - 1e-9)))); }

Polygon divided(const Polygon& polygon, Real longest)
{
	const auto divide = [&](const Ring& ring) {
		Ring out;
		for (size_t k = 0, n = ring.size(); k < n; ++k) {
			const Vec2 &a = ring[k], &b = ring[(k + 1) % n];
			const int   parts = partsOf((b - a).norm(), longest);
			for (int p = 0; p < parts; ++p)
				out.push_back(a + (b - a) * p / parts);
		}
		return out;
	};
	Polygon out { divide(polygon.outer), {} };
	for (const Ring& hole : polygon.holes)
		out.holes.push_back(divide(hole));
	return out;
}

} // namespace blocks
