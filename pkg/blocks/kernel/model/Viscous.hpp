// yade-blocks, GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <blocks/kernel/Types.hpp>

/// Boundaries behind which the medium goes on: dashpots that take in what waves bring there (Lysmer and Kuhlemeyer 1969).
namespace blocks {

/// Resistance of a grid point on a viscous boundary: a symmetric matrix, force by velocity [N s/m].
struct Dashpot {
	int  node     = -1;
	int  boundary = -1; ///< index of the boundary it belongs to
	Real xx = 0, xy = 0, yy = 0;

	Vec2 operator*(const Vec2& v) const { return { xx * v.x() + xy * v.y(), xy * v.x() + yy * v.y() }; }
};

/// A viscous boundary, and the wave that comes in through it.
struct ViscousBoundary {
	std::string       name;
	std::vector<Real> times;    ///< ascending; empty if nothing comes in [s]
	std::vector<Vec2> incoming; ///< velocity of the incoming wave at these times; linear between them, zero outside [m/s]

	Vec2 incomingAt(Real time) const
	{
		if (times.empty() || time < times.front() || time > times.back()) return Vec2::Zero();
		const size_t i = std::upper_bound(times.begin(), times.end(), time) - times.begin();
		if (i == times.size()) return incoming.back();
		const Real x = (time - times[i - 1]) / (times[i] - times[i - 1]);
		return (1 - x) * incoming[i - 1] + x * incoming[i];
	}
};

} // namespace blocks
