// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/python/ModelPython.hpp>

namespace yade {

/// The methods that build a BlockModel.
void defineBuilding(PythonModel&);

/// A polygon from its points and those of its holes, which may run either way round.
blocks::Polygon polygon(const py::object& outer, const py::object& holes);

} // namespace yade
