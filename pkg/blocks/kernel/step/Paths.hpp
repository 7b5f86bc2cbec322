// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// How far blocks go, see Odometer.
namespace blocks {

/// Before blocks get contacts that had none: their paths count from here.
void followAll(BlockAssembly&);

/// In every step: brings the paths of blocks that have contacts up to date, now and then.
void followContacts(BlockAssembly&);

} // namespace blocks
