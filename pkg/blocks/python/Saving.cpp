// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/engines/BlockIntegrator.hpp>
#include <blocks/python/ModelPython.hpp>
#include <core/Omega.hpp>

/// What yadeblocks.saving needs of a BlockModel: whether its scene is still there, and a moment between two steps.
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

	/// Calls what saves the scene, within a step or not. Behind the motion of a step the scene is saved as that of the next one: loaded, it would move
	/// once more else. Between forces and motion it is neither.
	void betweenSteps(const BlockModel& model, const py::object& save)
	{
		Scene* const scene = Omega::instance().getScene().get();
		bool         moves = false, moved = false;
		for (const auto& engine : scene->engines)
			if (const auto* mover = dynamic_cast<const BlockIntegrator*>(engine.get()); mover && !mover->dead)
				moves = true, moved = moved || mover->movedAt == scene->iter;
		if (moves && !moved && model.forcesAt == scene->iter)
			throw std::runtime_error(
				"O.save between the forces and the motion of a step, where a run cannot go on: what calls it must stand behind "
				"BlockMotion (or BlockIntegrator) in O.engines, or before BlockLoop");
		struct Next {
			Scene*     scene;
			const long iter    = scene->iter;
			const Real time    = scene->time;
			const int  subStep = scene->subStep;
			~Next() { scene->iter = iter, scene->time = time, scene->subStep = subStep; }
		} next { scene };
		if (moved) ++scene->iter, scene->time += scene->dt, scene->subStep = -1;
		save();
	}

} // namespace

void defineSaving(PythonModel& c)
{
	using py::arg;
	c.add_property("_gone", &gone, &leave, "Why the model must not be used any more; empty if it may. yadeblocks.saving sets it and looks at it.");
	c.def("_betweenSteps", &betweenSteps, (arg("save")), "Calls a function that saves the scene as between two steps; see yadeblocks.saving.");
}

} // namespace yade
