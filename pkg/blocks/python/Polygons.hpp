// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/BlockModel.hpp>

/// Polygons that Python hands over.
namespace yade {

/// Points of any sequence of pairs; none of an empty one.
blocks::Ring ring(const py::object& points);

/// A polygon from its points and those of its holes, which may run either way round.
blocks::Polygon polygon(const py::object& outer, const py::object& holes);

} // namespace yade
