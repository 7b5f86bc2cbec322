// yade-blocks, GPL-2.0-or-later
#include <blocks/python/ModelPython.hpp>

/// What Python sees of a BlockModel: its parts, and its way into the scene.
namespace yade {

void BlockModelPython::visit(PythonModel& c) const
{
	defineGroups(c);
	defineLoads(c);
	defineBoundaries(c);
	defineAnalysis(c);
	defineArrays(c);
	defineJointChoice(c);
	defineJoints(c);
	defineBuilding(c);
	defineMeasures(c);
	defineSaving(c);
	using py::arg;
	c.def("bodyOf", &BlockModel::bodyOf, (arg("block")), "Id of the body of a block; after insert().")
		.def("insert",
	             &BlockModel::insert,
	             (arg("interactions") = true),
	             "Hands the model over to the scene: one Body a block into O.bodies, one Interaction a pair into O.interactions (and one a free contact, "
	             "while it lasts). interactions=False leaves those out, for scenes in which an InteractionLoop works on other bodies only, and for very "
	             "large "
	             "ones; :yref:`BlockLoop` does without.");
}

} // namespace yade
