// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/geometry/Polygon.hpp>

/// Edges with further points on them.
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

/// The ring with those of `points` that lie on its edges (within `tolerance` [m], and farther than that from its vertices
/// and from each other) as further vertices, in order. Points keep their bits, so a neighbour's vertices become the ring's own.
Ring    withPointsOnEdges(const Ring&, const std::vector<Vec2>& points, Real tolerance);
Polygon withPointsOnEdges(const Polygon&, const std::vector<Vec2>& points, Real tolerance);

/// Parts into which an edge must be divided so that none is longer than `longest`; a multiple of it is not one part more.
int partsOf(Real length, Real longest);

/// The polygon with every edge longer than `longest` [m] divided into equal parts.
Polygon divided(const Polygon&, Real longest);

} // namespace blocks
