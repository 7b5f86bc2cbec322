// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/python/Building.hpp>

/// What Python sees of a BlockModel: its parts, and its way into the scene.
namespace yade {

namespace {

	/// Models whose scene another one has replaced, and what is to be said when they are used.
	vector<std::pair<boost::weak_ptr<Factorable>, string>> leftBehind;

	string gone(const BlockModel& model)
	{
		for (const auto& [left, sentence] : leftBehind)
			if (left.lock().get() == &model) return sentence;
		return "";
	}

	void leave(BlockModel& model, const string& sentence)
	{
		leftBehind.erase(std::remove_if(leftBehind.begin(), leftBehind.end(), [](const auto& left) { return left.first.expired(); }), leftBehind.end());
		leftBehind.emplace_back(model.shared_from_this(), sentence);
	}

} // namespace

void BlockModelPython::visit(PythonModel& c) const
{
	defineSupports(c);
	defineArrays(c);
	defineJoints(c);
	defineBuilding(c);
	using py::arg;
	c.add_property("_gone", &gone, &leave, "Why the model must not be used any more; empty if it may. yadeblocks.saving sets it and looks at it.");
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
