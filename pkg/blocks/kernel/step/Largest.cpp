// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/Wide.hpp>
#include <blocks/kernel/step/Largest.hpp>
#include <cstdint>
#include <cstring>
#include <limits>

namespace blocks {
namespace {

	/// The bits of the number's size grow with it, and those of what is no number are above all.
	inline __attribute__((always_inline)) std::int64_t sizeBits(Real value)
	{
		std::int64_t bits;
		std::memcpy(&bits, &value, sizeof bits);
		return bits & std::numeric_limits<std::int64_t>::max(); // without the sign
	}

	Real ofBits(std::int64_t bits)
	{
		Real value;
		std::memcpy(&value, &bits, sizeof value);
		return value;
	}

	/// Of what `value` gives for 0 ... count - 1, in lanes that do not wait for each other.
	template <class F> inline __attribute__((always_inline)) Real largestOf(int count, const F& value)
	{
		constexpr int lanes       = 16;
		std::int64_t  most[lanes] = {};
		int           i           = 0;
		for (; i + lanes <= count; i += lanes)
			for (int k = 0; k < lanes; ++k)
				most[k] = std::max(most[k], sizeBits(value(i + k)));
		for (; i < count; ++i)
			most[0] = std::max(most[0], sizeBits(value(i)));
		return ofBits(*std::max_element(most, most + lanes));
	}

} // namespace

WIDE Real largest(const Real* values, int count)
{
	return largestOf(count, [=](int i) { return values[i]; });
}

WIDE Real farthest(const Real* __restrict now, const Real* __restrict then, int count)
{
	return largestOf(count, [=](int i) { return now[i] - then[i]; });
}

} // namespace blocks
