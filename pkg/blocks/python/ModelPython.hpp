// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/BlockModel.hpp>

/// What Python sees of a BlockModel, in parts; each has a file of its name.
namespace yade {

using PythonModel = py::class_<BlockModel, shared_ptr<BlockModel>, py::bases<Serializable>, boost::noncopyable>;

void defineGroups(PythonModel&);
void defineLoads(PythonModel&);
void defineBoundaries(PythonModel&);
void defineAnalysis(PythonModel&);
void defineArrays(PythonModel&);
void defineMeasures(PythonModel&);
void defineJointChoice(PythonModel&);
void defineJoints(PythonModel&);
void defineBuilding(PythonModel&);
void defineSaving(PythonModel&);

} // namespace yade
