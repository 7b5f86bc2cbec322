// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>
#include <cstdint>

namespace blocks {

/// Which pairs of some columns may touch: a bit for each lane. The others rest on.
std::uint32_t stirring(const BlockAssembly&, const RestColumns&);

} // namespace blocks
