// yade-blocks, GPL-2.0-or-later
#pragma once

/// Conventions of the whole kernel, stated once:
///  - SI units; two dimensions, the x-y plane; the out-of-plane thickness belongs to the assembly [m];
///  - polygons are counter-clockwise, their holes clockwise; the outward normal of an edge a->b is (dy, -dx)/L;
///  - tension is positive, in zones and in joints; an opening joint has a positive opening;
///  - things refer to each other by index, never by pointer.

#include <Eigen/Core>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace blocks {

using Real = double;
using Vec2 = Eigen::Matrix<Real, 2, 1>;
using Ring = std::vector<Vec2>; ///< a closed polygonal line, the last vertex joined to the first

/// A simple polygon with holes [m].
struct Polygon {
	Ring              outer; ///< counter-clockwise
	std::vector<Ring> holes; ///< clockwise each
};

inline Real cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// A number as a message should show it: all 17 digits unless fewer are asked for, no zeros that were not meant, and a decimal point whatever
/// the locale.
inline std::string shown(Real value, int digits = 17)
{
	char       text[40];
	const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
	return { text, end };
}

/// The one way in which the kernel refuses input: what, the rule, the value.
inline void require(bool rule, const std::string& sentence, Real value)
{
	if (!rule) throw std::invalid_argument(sentence + ", got " + shown(value));
}

} // namespace blocks
