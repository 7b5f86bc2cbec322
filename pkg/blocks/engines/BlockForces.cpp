// yade-blocks, GPL-2.0-or-later
#include <blocks/engines/BlockForces.hpp>
#include <blocks/engines/EngineList.hpp>
#include <blocks/engines/RigidBodies.hpp>
#include <blocks/kernel/step/ContactResults.hpp>
#include <blocks/kernel/step/Release.hpp>
#include <blocks/kernel/step/Step.hpp>
#include <core/EnergyTracker.hpp>

namespace yade {

CREATE_CPP_LOCAL_LOGGER("BlockForces.cpp")

BlockForces::~BlockForces() = default;

void BlockForces::newScene()
{
	frictionId = fractureId = modeIId = modeIIId = capId = -1;
	looked = saidSnapped = told = false;
	lastStatus.clear();
}

void BlockForces::computeForces(BlockModel& model, int threads)
{
	blocks::BlockAssembly& a = model.assembly;
	if (a.contacts.wanted) blocks::noteBroken(a, lastStatus); // a Law2 of somebody else's does not say which
	blocks::sumForces(a, scene->trackEnergy, threads);
	blocks::JointHistory& before = a.forces.before; // kept by the assembly, which may be put back to an earlier state
	if (!scene->trackEnergy) return before.status.clear();
	if (before.status.size() == a.state.status.size()) blocks::bookDissipation(a, before);
	before.take(a.state);
}

void BlockForces::lookAtEngines(BlockModel& model, int threads)
{
	const bool look = !looked || scene->iter % askPeriod == 0, rigid = !model.assembly.state.rigid.empty();
	if (look) {
		requireEngines(scene, model, stepsJoints());
		requireUntouched(scene, model, threads);
	}
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
	if (told) return;
	told                = true;
	const string remark = remarks(scene, model);
	if (!remark.empty()) LOG_WARN(remark);
}

void BlockForces::step(BlockModel& model)
{
	const int threads = threadsFor(model, ompThreads);
	model.requireBodies(scene, threads);
	lookAtEngines(model, threads);
	computeForces(model, threads);
	blocks::BlockAssembly& a = model.assembly;
	if (!a.state.rigid.empty()) addRigidForces(scene, model);
	model.forcesAt = scene->iter;
	if (a.state.softened.snapped > 0 && !saidSnapped) {
		saidSnapped = true;
		LOG_WARN(
			"step " << scene->iter
				<< ": a contact point snapped back: it softens faster than its stiffness lets the stress fall. In shear ks must exceed c (c + "
				   "p (tan phi - "
				   "tan phi_res))/GfII under a pressure p. Its stress drops to the softening curve, and no energy comes of it. "
				   "BlockModel.snappedBack counts them");
	}
	if (!scene->trackEnergy) return;
	scene->energy->set(a.state.accounts.friction + blocks::contactFriction(a), "blockFriction", frictionId);
	scene->energy->set(a.state.accounts.fracture, "blockFracture", fractureId);
	const blocks::Softened& soft = a.state.softened;
	if (soft.empty()) return;
	scene->energy->set(soft.modeI, "blockModeI", modeIId);
	scene->energy->set(soft.modeII, "blockModeII", modeIIId);
	scene->energy->set(soft.cap, "blockCap", capId);
}

YADE_PLUGIN((BlockForces));

} // namespace yade
