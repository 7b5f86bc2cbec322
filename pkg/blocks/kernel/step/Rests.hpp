// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/step/RaisedCorners.hpp>
#include <limits>

/// Which pairs of edges need no look: how far two blocks may go before they touch. Inline, for most that a step does about pairs that do not touch is here.
namespace blocks {

/// Paths are sums over up to 1e9 steps: what is derived from them keeps this much away from rounding.
constexpr Real roundingShare = 1 - 1e-6;

/// Whether edges touch follows from so many roundings of the corners' coordinates, at most.
constexpr Real roundings = 64 * std::numeric_limits<Real>::epsilon();

/// In place of Rest::until: the pair is in work, and to be asked whether it can rest.
constexpr Real inWorkButAsked = -inWork;
inline bool    isResting(Real until) { return std::isfinite(until); }

/// What the paths of two blocks add up to, at least and at most: they may have gone on since they were brought up to date [m].
struct Paths {
	Real least, most;
};
inline Paths pathsOf(const BlockAssembly& a, const std::array<int, 2>& block)
{
	const Odometer& o    = a.contacts.odometer;
	const Real      path = o.path[block[0]] + o.path[block[1]];
	return { path - o.unseenOfTwo(), path + o.unseenOfTwo() };
}

/// Where corners a1, b0, b1 have gone, as seen from a0 [m].
inline std::array<Vec2, 3> movesOf(const BlockAssembly& a, const std::array<int, 4>& node)
{
	const Vec2* u = a.state.displacement.data();
	const Vec2& o = u[node[0]];
	return { u[node[1]] - o, u[node[2]] - o, u[node[3]] - o };
}

/// What is left of the distance in which a pair surely does not touch [m].
inline Real leftOf(const BlockAssembly& a, const Rest& rest)
{
	const std::array<Vec2, 3> now = movesOf(a, rest.node);
	const Real                ofB = std::max((now[1] - rest.from[1]).squaredNorm(), (now[2] - rest.from[2]).squaredNorm());
	return rest.free - (now[0] - rest.from[0]).norm() - std::sqrt(ofB);
}

/// How far the corners of a pair that does not touch may move until it does; 0 if that is not known [m].
inline Real distanceOf(const FourPoints& p, const EdgePair& e)
{
	const Real lever  = 1 + 2 * std::abs(e.uplift) / (p[1] - p[0]).norm(); // what is raised moves more where the edge turns
	const Real extent = p[0].norm() + p[1].norm() + p[2].norm() + p[3].norm();
	return roundingShare * freeDistance(p, e.shape) / lever - roundings * extent;
}

/// Until where a pair surely does not touch, or inWork.
inline Real restOf(const BlockAssembly& a, const FreeContact& c, int pair, Rest& r, const Paths& path)
{
	if (r.free > 0)
		if (const Real left = leftOf(a, r); left > 0) return path.least + left;
	r.free            = 0;
	const EdgePair& e = c.edges[pair];
	if (e.touching || e.area > 0) return inWork;
	const Corners x = raisedCorners(a, e);
	if (edgeDepths(x).touch() > 0 && edgeGeometry(points(x), e.shape).active()) return inWork;
	r.free = distanceOf(points(x), e);
	if (!(r.free > 0)) return inWork;
	r.node = e.node;
	r.from = movesOf(a, e.node);
	return path.least + r.free;
}

/// Those pairs of a contact whose rest is over. Whether some begin or end their rest.
inline bool askRests(const BlockAssembly& a, const FreeContact& c, Rest* rests, int pairs, const Paths& path)
{
	bool changed = false;
	for (int k = 0; k < pairs; ++k) {
		Real& until = rests[k].until;
		if (path.most < until) continue;
		const bool rested = isResting(until);
		until             = restOf(a, c, k, rests[k], path);
		changed |= rested != isResting(until);
	}
	return changed;
}

} // namespace blocks
