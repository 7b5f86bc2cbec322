// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/BlockModel.hpp>

/// Numbers that Python hands over.
namespace yade {

/// Whole numbers from any sequence; floats that are none are refused.
vector<long> integers(const py::object& sequence);

/// Numbers from any sequence; nothing if it is none, or holds something else.
vector<Real> numbers(const py::object& sequence);

/// Within what an int holds; the assembly knows how many there are.
int inRange(long index, const string& what);

} // namespace yade
