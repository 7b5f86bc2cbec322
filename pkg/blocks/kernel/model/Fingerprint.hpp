// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>
#include <cstdint>

namespace blocks {

/// A number that is the same only for the same bits (FNV-1a of 64 bits over words, field by field).
std::uint64_t fingerprint(const State&);

/// The fingerprint of everything that is saved.
std::uint64_t fingerprint(const BlockAssembly&);

} // namespace blocks
