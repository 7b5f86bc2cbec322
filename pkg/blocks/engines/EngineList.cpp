// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/engines/BlockForces.hpp>
#include <blocks/engines/BlockIntegrator.hpp>
#include <blocks/engines/EngineList.hpp>
#include <blocks/kernel/Parallel.hpp>
#include <blocks/views/BlockGeom.hpp>
#include <blocks/views/BlockMat.hpp>
#include <blocks/views/PythonLock.hpp>
#include <core/Body.hpp>
#include <core/BodyContainer.hpp>
#include <core/Interaction.hpp>
#include <core/InteractionContainer.hpp>
#include <cstring>
#include <typeinfo>

namespace yade {

namespace {
	/// Whether one of an InteractionLoop's functors is for two blocks.
	bool stepsBlocks(const Engine& loop)
	{
		const PythonLock lock;
		const py::dict   attributes = loop.pyDict();
		const py::object functors   = py::object(attributes["geomDispatcher"]).attr("functors");
		for (long i = 0; i < py::len(functors); ++i) {
			const py::object bases = functors[i].attr("bases");
			if (py::len(bases) == 2 && bases[0] == "Block" && bases[1] == "Block") return true;
		}
		return false;
	}

	bool isInteractionLoop(const Engine& engine) { return std::strcmp(typeid(engine).name(), "N4yade15InteractionLoopE") == 0; }

	string named(const BlockModel& model, int block)
	{
		return "block " + std::to_string(block) + " (body " + std::to_string(model.firstBody + block) + ")";
	}

	void requireBody(const Scene* scene, const BlockModel& model, int i)
	{
		const auto& body  = (*scene->bodies)[model.firstBody + i];
		const auto* shape = dynamic_cast<const Block*>(body->shape.get());
		if (!shape || shape->model.get() != &model || shape->index != i)
			throw std::runtime_error(
				"the shape of " + named(model, i) + " was replaced, but blocks keep the shape that BlockModel.insert() gave them");
		const blocks::Material& known = model.assembly.mesh.materials[model.assembly.mesh.blockMaterial[i]];
		const auto*             now   = dynamic_cast<const BlockMat*>(body->material.get());
		if (!now || now->young != known.young || now->poisson != known.poisson || now->density != known.density)
			throw std::runtime_error(
				"the material of " + named(model, i) + " was changed after the block was built with young=" + blocks::shown(known.young)
				+ " Pa, poisson=" + blocks::shown(known.poisson) + ", density=" + blocks::shown(known.density)
				+ " kg/m3, which the model keeps: set it before addRegion or addVoronoi");
		if (model.assembly.isRigid(i)) return; // YADE's engines see to that
		if (body->state->blockedDOFs != State::DOF_ALL)
			throw std::runtime_error(
				"blockedDOFs of " + named(model, i) + " were changed, but its grid points move, not its body: hold them by BlockModel.drive");
		auto& forces = const_cast<Scene*>(scene)->forces;
		if (!forces.getForce(body->id).isZero() || !forces.getTorque(body->id).isZero())
			throw std::runtime_error(
				"somebody has put a force on " + named(model, i)
				+ " through O.forces (addF, setPermF, an engine), whose grid points would not feel it: use BlockModel.traction, push or "
				  "gravity");
	}

	void requireJoints(const BlockModel& model)
	{
		const auto& kinds = model.assembly.joints.kinds;
		for (const auto& joint : model.jointMats) {
			const blocks::JointParams now = joint->params();
			if (std::find(kinds.begin(), kinds.end(), now) == kinds.end())
				throw std::runtime_error(
					"the JointMat for \"" + joint->material1 + "\" and \"" + joint->material2
					+ "\" was changed after bond(), whose joints keep what they were given: use BlockModel.setJoints");
		}
	}

	void requireInteractions(const Scene* scene, const BlockModel& model)
	{
		if (!model.showsInteractions) return;
		vector<char> seen;
		for (const auto& pair : model.assembly.joints.pairs)
			seen.push_back(model.assembly.isRemoved(pair.block[0]) || model.assembly.isRemoved(pair.block[1]));
		for (const auto& interaction : *scene->interactions) {
			const auto* geom = dynamic_cast<const BlockGeom*>(interaction->geom.get());
			if (geom && geom->pair >= 0 && geom->model.get() == &model) seen[geom->pair] = true;
		}
		const auto gone = std::find(seen.begin(), seen.end(), false);
		if (gone == seen.end()) return;
		const auto& block = model.assembly.joints.pairs[gone - seen.begin()].block;
		throw std::runtime_error(
			"the interaction of " + named(model, block[0]) + " and " + named(model, block[1])
			+ " was erased or its geom replaced, but their joint stays in the model: let it break, by BlockModel.setJoints with no strength");
	}
}

void requireEngines(const Scene* scene, const BlockModel& model, bool flat)
{
	int forces = 0;
	for (size_t i = 0; i < scene->engines.size(); ++i) {
		const Engine& engine = *scene->engines[i];
		if (engine.dead) continue;
		if (std::find(scene->engines.begin(), scene->engines.begin() + i, scene->engines[i]) != scene->engines.begin() + i)
			throw std::runtime_error("the same " + engine.getClassName() + " stands twice in O.engines and would work twice in a step");
		if (dynamic_cast<const BlockForces*>(&engine) && ++forces > 1)
			throw std::runtime_error("O.engines must have one BlockLoop or BlockForces, or joints would be stepped twice, got two");
		if (!isInteractionLoop(engine)) continue;
		const bool blocks = stepsBlocks(engine);
		if (flat && blocks)
			throw std::runtime_error("InteractionLoop has functors for blocks beside BlockLoop, and joints would be stepped twice: leave "
			                         "Ig2_Block_Block_BlockGeom out, or "
			                         "use BlockForces in place of BlockLoop");
		if (!blocks && model.showsInteractions)
			throw std::runtime_error(
				"InteractionLoop has no functors for blocks, whose pairs are in O.interactions, and YADE would abort in the next step: leave "
				"them out "
				"by BlockModel.insert(interactions=False), or give it Ig2_Block_Block_BlockGeom, Ip2_BlockMat_BlockMat_JointPhys and a law");
	}
}

void requireUntouched(const Scene* scene, const BlockModel& model, int threads)
{
	const_cast<Scene*>(scene)->forces.sync();
	blocks::forEachInParallel(model.assembly.blockCount(), threads, [&](int i) {
		if (!model.assembly.isRemoved(i)) requireBody(scene, model, i);
	});
	requireJoints(model);
	requireInteractions(scene, model);
}

string remarks(const Scene* scene, const BlockModel& model)
{
	const BlockIntegrator* mover = nullptr;
	for (const auto& engine : scene->engines)
		if (const auto* integrator = dynamic_cast<const BlockIntegrator*>(engine.get()); integrator && !engine->dead) mover = integrator;
	if (!mover) return "O.engines has no BlockMotion or BlockIntegrator: deformable blocks do not move";
	if (mover->damping == "none" && model.newtonDamping > 0)
		return mover->getClassName() + ".damping is 'none', but NewtonIntegrator.damping=" + blocks::shown(model.newtonDamping)
			+ " (0.2 is its default) damps rigid blocks: NewtonIntegrator(damping=0) does not";
	return "";
}

} // namespace yade
