// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/BlockModel.hpp>

namespace yade {

/// A material of the assembly or of O.materials, by its label; nothing is added.
blocks::Material materialOf(const BlockModel&, const std::string& label);

} // namespace yade
