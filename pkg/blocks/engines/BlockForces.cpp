// yade-blocks, GPL-2.0-or-later
#include <blocks/engines/BlockForces.hpp>
#include <blocks/engines/RigidBodies.hpp>
#include <blocks/kernel/step/Step.hpp>
#include <core/EnergyTracker.hpp>

namespace yade {

BlockForces::~BlockForces() = default;

void BlockForces::newScene()
{
	before     = {};
	frictionId = fractureId = -1;
	looked                  = false;
}

void BlockForces::computeForces(BlockModel& model, int threads)
{
	blocks::BlockAssembly& a = model.assembly;
	blocks::updateJointForces(a, blocks::allJoints(a), threads);
	blocks::sumForces(a, scene->trackEnergy, threads);
	if (!scene->trackEnergy) return;
	if (before.status.size() == a.state.status.size()) blocks::bookDissipation(a, before);
	before.take(a.state);
}

void BlockForces::lookAtEngines(BlockModel& model)
{
	const bool look = !looked || scene->iter % askPeriod == 0, rigid = !model.assembly.state.rigid.empty();
	if (!look && !rigid) return;
	noteFreedom(scene, model);
	const Engine* newton = requireMovers(scene, model);
	if (newton && (newton != asked || look)) {
		const Real known = model.newtonDamping, damping = newtonDamping(*newton);
		if (rigid) model.newtonDamping = damping;
		if (model.newtonDamping != known) model.stiffnessChanged(); // it lowers the stable step
	}
	asked  = newton;
	looked = true;
}

void BlockForces::step(BlockModel& model)
{
	model.requireBodies(scene);
	lookAtEngines(model);
	computeForces(model, threadsFor(model, ompThreads));
	blocks::BlockAssembly& a = model.assembly;
	if (!a.state.rigid.empty()) addRigidForces(scene, model);
	model.forcesAt = scene->iter;
	if (!scene->trackEnergy) return;
	scene->energy->set(a.state.accounts.friction + blocks::contactFriction(a), "blockFriction", frictionId);
	scene->energy->set(a.state.accounts.fracture, "blockFracture", fractureId);
}

YADE_PLUGIN((BlockForces));

} // namespace yade
