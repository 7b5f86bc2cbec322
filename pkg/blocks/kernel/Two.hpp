// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/Types.hpp>
#include <cstring>

/// Two numbers side by side: x and y of a grid point, or the same of two neighbours in a column. Loops that go from points to columns and back,
/// two at a time, are written with it; the compiler does not find that by itself.
namespace blocks {

using Two = Real __attribute__((vector_size(2 * sizeof(Real))));

inline __attribute__((always_inline)) Two loadTwo(const Real* from)
{
	Two two;
	std::memcpy(&two, from, sizeof two);
	return two;
}
inline __attribute__((always_inline)) Two  loadTwo(const Vec2& from) { return loadTwo(from.data()); }
inline __attribute__((always_inline)) void store(Real* to, Two two) { std::memcpy(to, &two, sizeof two); }
inline __attribute__((always_inline)) void addTo(Real* to, Two two) { store(to, loadTwo(to) + two); }

/// The first numbers of both, and the second ones. What makes columns of points makes points of columns.
inline __attribute__((always_inline)) Two firsts(Two a, Two b) { return Two { a[0], b[0] }; }
inline __attribute__((always_inline)) Two seconds(Two a, Two b) { return Two { a[1], b[1] }; }

} // namespace blocks
