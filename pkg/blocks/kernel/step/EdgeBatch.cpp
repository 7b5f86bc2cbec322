// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/Wide.hpp>
#include <blocks/kernel/laws/EdgeContactLaw.hpp>
#include <blocks/kernel/step/EdgeBatch.hpp>

namespace blocks {
namespace {

	ALWAYS XY chosen(bool first, const XY& a, const XY& b) { return { first ? a.x : b.x, first ? a.y : b.y }; }

	/// In a batch without raised edges nobody asks for uplifts.
	template <bool anyRaised> ALWAYS void advance(EdgeColumns& c, EdgeBatch& b, Real thickness, Real dt)
	{
#pragma GCC ivdep
		for (int i = 0, whole = (c.count + 3) / 4 * 4; i < whole; ++i) { // a few lanes of old numbers cost less than a loop of their own
			Corners   p, v, force;
			EdgeShape shape;
			eachOf<4>([&](auto n) INLINE {
				p[n]               = { b.px[n][i], b.py[n][i] };
				v[n]               = { b.vx[n][i], b.vy[n][i] };
				force[n]           = { 0, 0 };
				shape.sharpness[n] = c.sharpness[n][i];
			});
			shape.rounding                       = { c.rounding[0][i], c.rounding[1][i] };
			shape.farRounding                    = { c.farRounding[0][i], c.farRounding[1][i] };
			shape.depthLimit                     = c.depthLimit[i];
			[[maybe_unused]] const Real uplift   = anyRaised ? c.uplift[i] : 0;
			[[maybe_unused]] const bool isRaised = uplift != 0;
			if constexpr (anyRaised) {
				Corners at = p, moving = v;
				raiseEdge(at, uplift);
				raiseVelocity(at, uplift, moving);
				eachOf<2>([&](auto n) INLINE { p[n] = chosen(isRaised, at[n], p[n]), v[n] = chosen(isRaised, moving[n], v[n]); });
			}

			const EdgeGeometry g  = geometryOfEdges(p, shape);
			const Real         kn = c.kn[i], ks = c.ks[i], area = thickness * g.area;
			pushEdges(p, shape, g, kn * thickness, force);
			// where the area changes the springs keep their energy, so that a contact which grows and shrinks neither makes nor wears any
			const bool some     = area > 0;
			const Real ratio    = std::sqrt(c.area[i] / area);
			const Real regrown  = some ? ratio : 0;
			Real       friction = 0;
			eachOf<2>([&](auto k) INLINE {
				const Real    pressure = kn * g.depth[k], slip = c.slip[k][i], before = ks * c.area[i] * slip * slip / 2;
				const Real    bearing = some ? pressure : 0;
				const bool    pressed = bearing > 0;
				const EdgeEnd end     = endOfEdges<k>(p, g);
				Real          ds      = 0;
				eachOf<4>([&](auto n) INLINE { ds += dt * dot(end.slipGradient[n], v[n]); });
				const Real old = slip * regrown, limit = (c.cohesion[i] + pressure * c.tanPhi[i]) / ks;
				const Real moved = old + ds, least = moved < -limit ? -limit : moved, held = least > limit ? limit : least;
				const Real now = pressed ? held : 0, drag = pressed ? ks * area * held : 0;
				const Real done = (ks * area * old + drag) / 2 * ds, work = pressed ? done : 0;
				eachOf<4>([&](auto n) INLINE { force[n] -= drag * end.slipGradient[n]; });
				friction += work + before - ks * area * now * now / 2;
				c.slip[k][i]  = now;
				b.sigma[k][i] = -pressure;
				b.tau[k][i]   = ks * now;
			});
			c.area[i]      = area;
			b.friction[i]  = friction;
			b.potential[i] = potentialOfEdges(g);
			b.touches[i]   = g.touches;
			if constexpr (anyRaised) {
				Corners lowered = force;
				lowerEdgeForces(p, uplift, lowered);
				eachOf<2>([&](auto n) INLINE { force[n] = chosen(isRaised, lowered[n], force[n]); });
			}
			eachOf<4>([&](auto n) INLINE { b.fx[n][i] = force[n].x, b.fy[n][i] = force[n].y; });
		}
	}
	WIDE void advanceAny(EdgeColumns& c, EdgeBatch& b, Real thickness, Real dt) { advance<true>(c, b, thickness, dt); }
	WIDE void advanceFlat(EdgeColumns& c, EdgeBatch& b, Real thickness, Real dt) { advance<false>(c, b, thickness, dt); }

} // namespace

void advanceEdges(EdgeColumns& c, EdgeBatch& b, Real thickness, Real dt) { (c.raised ? advanceAny : advanceFlat)(c, b, thickness, dt); }

} // namespace blocks
