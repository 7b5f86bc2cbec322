// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/Types.hpp>
#include <cstdint>
#include <cstring>

/// An exponential with the same bits on every processor: the library's has variants, chosen when the program starts.
namespace blocks {

/// e^-k for k >= 0, to 2 units in the last place; 0 from k = 700 on.
/// With n = round(k / ln 2) and r = n ln 2 - k, e^-k = 2^-n e^r, and |r| <= 0.347 leaves r^14/14! < 5e-18 of the series of e^r.
/// Only sums, products and a floor, so every processor that keeps to IEEE 754 agrees; products must not be fused with sums (-ffp-contract=off).
inline Real decay(Real k)
{
	if (!(k < 700)) return 0;
	constexpr Real invLn2 = 1.4426950408889634;
	constexpr Real ln2Hi  = 0.693147180369123816490; // its last 21 bits are zero: n ln2Hi is exact for n < 2^21
	constexpr Real ln2Lo  = 1.90821492927058770002e-10;

	const Real n = std::floor(k * invLn2 + 0.5);
	const Real r = (n * ln2Hi - k) + n * ln2Lo;

	Real sum = 1 / 6227020800.0; // 1/13!
	for (Real inverse :
	     { 1 / 479001600.0, 1 / 39916800.0, 1 / 3628800.0, 1 / 362880.0, 1 / 40320.0, 1 / 5040.0, 1 / 720.0, 1 / 120.0, 1 / 24.0, 1 / 6.0, 0.5 })
		sum = sum * r + inverse;
	sum = r + r * r * sum;

	const std::uint64_t bits = std::uint64_t(1023 - std::int64_t(n)) << 52; // 2^-n
	Real                power;
	std::memcpy(&power, &bits, sizeof power);
	return (1 + sum) * power;
}

} // namespace blocks
