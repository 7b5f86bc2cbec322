// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/BlockModel.hpp>

/// What Python sees of a BlockModel, in parts: building (BlockModelPython.cpp), supports and loads, joints' properties, arrays.
namespace yade {

using PythonModel = py::class_<BlockModel, shared_ptr<BlockModel>, py::bases<Serializable>, boost::noncopyable>;

void defineSupports(PythonModel&);
void defineArrays(PythonModel&);
void defineJoints(PythonModel&);

/// A polygon from its points and those of its holes, which may run either way round.
blocks::Polygon polygon(const py::object& outer, const py::object& holes);

/// Whole numbers from any sequence; floats that are none are refused.
vector<long> integers(const py::object& sequence);

} // namespace yade
