// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/Types.hpp>
#include <cstdint>

/// Strengths that differ from joint to joint: a random field, made once, before the first step.
///
/// A standard normal g at every place, with correlation e^(-(r/length)^2), becomes a factor of mean 1:
///   lognormal: e^(s g - s^2/2), s^2 = ln(1 + cov^2);
///   Weibull:   (-ln(1 - U))^(1/m) / Gamma(1 + 1/m), U = Phi(g), with the modulus m that has this cov.
/// The field is a sum of 512 plane waves of random direction, length and phase (Shinozuka and Deodatis 1991); places without correlation (length 0) draw on
/// their own.
namespace blocks {

struct StrengthScatter {
	enum class Kind { weibull, lognormal } kind = Kind::weibull;
	Real          cov                           = 0; ///< standard deviation by mean; 0: none [-]
	Real          correlationLength             = 0; ///< [m]
	std::uint64_t seed                          = 1;
};

/// Modulus m of the Weibull distribution that has this coefficient of variation, in (0, 1].
Real weibullModulus(Real cov);

/// A factor of mean 1 for each place, positive. The same for the same seed, places and their order.
std::vector<Real> strengthFactors(const std::vector<Vec2>& places, const StrengthScatter&);

} // namespace blocks
