// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/laws/EdgeContactLaw.hpp>
#include <blocks/kernel/model/BlockAssembly.hpp>

/// Where the edges of a pair act.
namespace blocks {

/// The corners of what touches, relative to where a0 was without stress, so that they are exact far from the origin too [m].
ALWAYS Corners raisedCorners(const BlockAssembly& a, const EdgePair& e)
{
	const Vec2 *X = a.mesh.reference.data(), *u = a.state.displacement.data();
	const Vec2& o = X[e.node[0]];
	Corners     c;
	c[0] = { u[e.node[0]].x(), u[e.node[0]].y() };
	eachOf<3>([&](auto k) INLINE {
		const int n = e.node[k + 1];
		c[k + 1]    = { X[n].x() - o.x() + u[n].x(), X[n].y() - o.y() + u[n].y() };
	});
	return e.uplift != 0 ? corners(raised(points(c), e.uplift)) : c;
}

} // namespace blocks
