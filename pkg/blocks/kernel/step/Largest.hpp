// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/Types.hpp>

/// The largest of many numbers in size. A number that is none is larger than all: it is never lost.
namespace blocks {

Real largest(const Real* values, int count);

/// The largest difference between two lists.
Real farthest(const Real* now, const Real* then, int count);

} // namespace blocks
