// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/geometry/Polygon.hpp>
#include <limits>

/// Rings that tests of polygons are made of.
namespace rings {

using namespace blocks;

constexpr Real eps = std::numeric_limits<Real>::epsilon();

inline Ring rectangle(Real x0, Real y0, Real x1, Real y1) { return { { x0, y0 }, { x1, y0 }, { x1, y1 }, { x0, y1 } }; }
inline Ring reversed(const Ring& ring) { return { ring.rbegin(), ring.rend() }; }

} // namespace rings
