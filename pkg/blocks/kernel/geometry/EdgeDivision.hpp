// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/geometry/Zoning.hpp>

/// Cells of a tessellation, cut further.
namespace blocks {

/// Every edge in so many equal parts. The new points have the same bits whichever way round the edge is given, so cells that share it stay conforming.
inline Ring withEdgesDivided(const Ring& ring, int parts)
{
	Ring out;
	for (size_t i = 0; i < ring.size(); ++i) {
		const Vec2 &from = ring[i], &to = ring[(i + 1) % ring.size()];
		const bool  turned = to.x() < from.x() || (to.x() == from.x() && to.y() < from.y());
		out.push_back(from);
		for (int k = 1; k < parts; ++k) {
			const Vec2 &low = turned ? to : from, &high = turned ? from : to;
			out.push_back(low + (high - low) * (Real(turned ? parts - k : k) / parts));
		}
	}
	return out;
}

/// The triangles of a cell, each as a ring of its own.
inline std::vector<Ring> trianglesOf(const Ring& cell)
{
	const Zones       zones = cellZones(cell, Zoning::fan).zones;
	std::vector<Ring> out;
	for (const auto& t : zones.triangles)
		out.push_back({ zones.points[t[0]], zones.points[t[1]], zones.points[t[2]] });
	return out;
}

} // namespace blocks
