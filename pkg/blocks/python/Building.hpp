// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/python/ModelPython.hpp>

namespace yade {

/// The methods that build a BlockModel.
void defineBuilding(PythonModel&);

} // namespace yade
