// yade-blocks, GPL-2.0-or-later
#include "BlockEngines.hpp"
#include "RigidBodies.hpp"
#include <blocks/kernel/model/FreeContacts.hpp>
#include <blocks/kernel/step/CentralDifference.hpp>
#include <blocks/kernel/step/NodalForces.hpp>
#include <blocks/kernel/step/TimeStep.hpp>
#include <chrono>
#include <core/Body.hpp>
#include <core/BodyContainer.hpp>
#include <core/EnergyTracker.hpp>
#include <core/Omega.hpp>
#include <lib/base/Logging.hpp>
#include <omp.h>
#include <thread>

namespace yade {

CREATE_LOGGER(BlockTimeStepper);
CREATE_LOGGER(BlockIntegrator);

BlockTimeStepper::~BlockTimeStepper() = default;
BlockForces::~BlockForces()           = default;
BlockIntegrator::~BlockIntegrator()   = default;

int threadsFor(const BlockModel& model, int ompThreads)
{
	constexpr int zonesPerThread = 3000; // below, starting a thread costs more than it saves
	const int     available      = ompThreads > 0 ? std::min(ompThreads, omp_get_max_threads()) : omp_get_max_threads();
	return std::max(1, std::min(available, model.assembly.zoneCount() / zonesPerThread));
}

void visibly(const std::function<void()>& step)
{
	try {
		step();
	} catch (...) {
		std::this_thread::sleep_for(std::chrono::milliseconds(100));
		throw;
	}
}

void BlockTimeStepper::computeTimeStep(Scene* scene)
{
	visibly([&] { adjust(scene); });
}

void BlockForces::action()
{
	visibly([&] { gather(); });
}

void BlockIntegrator::action()
{
	visibly([&] { advance(); });
}

void BlockTimeStepper::adjust(Scene* scene)
{
	BlockModel& model = modelOf(scene);
	model.throwComplaint();
	noteFreedom(scene, model);
	if (modelOf.changed) {
		brought   = 0;
		scalingId = -1;
	}
	if (scene->trackEnergy && scalingId < 0) scene->energy->set(brought, "blockScaling", scalingId);
	if (model.stiffnessVersion() == doneVersion && scene->dt == doneDt && safety == doneSafety && quasiStatic == doneQuasiStatic) return;
	blocks::require(safety > 0 && safety <= 0.95, "BlockTimeStepper.safety must lie in (0, 0.95]", safety);

	const auto& stiffness = model.stiffness();
	stableStep            = std::min(
                blocks::stableTimeStep(model.assembly, stiffness, model.assembly.mesh.mass),
                blocks::rigidTimeStep(model.assembly, stiffness, blocks::Masses::actual));
	const Real kinetic = scene->trackEnergy ? blocks::gridPointsKineticEnergy(model.assembly) : 0;
	if (quasiStatic) {
		blocks::require(scene->dt > 0 && std::isfinite(scene->dt), "O.dt must be positive and finite [s]", scene->dt);
		blocks::scaleInertia(model.assembly, stiffness, scene->dt, safety);
		blocks::scaleRigidInertia(model.assembly, stiffness, scene->dt, safety);
	} else {
		if (std::isfinite(stableStep))
			scene->dt = safety * stableStep;
		else if (toldDt != scene->dt) { // only rigid blocks, and they touch nothing
			toldDt = scene->dt;
			LOG_WARN(
				"BlockTimeStepper: nothing limits the time step, as no block has zones and none touches another; O.dt stays "
				<< blocks::shown(scene->dt) << " s unless you set it");
		}
		model.assembly.inertia = model.assembly.mass;
		model.assembly.updateMobility();
		blocks::restoreRigidInertia(model.assembly);
	}
	if (scene->trackEnergy) scene->energy->set(brought -= blocks::gridPointsKineticEnergy(model.assembly) - kinetic, "blockScaling", scalingId);
	writeMasses(scene, model);
	doneVersion     = model.stiffnessVersion();
	doneDt          = scene->dt;
	doneSafety      = safety;
	doneQuasiStatic = quasiStatic;
}

void BlockForces::gather()
{
	BlockModel& model = modelOf(scene);
	model.throwComplaint();
	blocks::BlockAssembly& a       = model.assembly;
	const int              threads = threadsFor(model, ompThreads);
	blocks::computeJointForces(a, threads);
	blocks::gatherForces(a, threads);
	const bool look = modelOf.changed || !looked || scene->iter % askPeriod == 0;
	if (look || !a.rigid.empty()) {
		noteFreedom(scene, model);
		const Engine* newton = requireMovers(scene, model);
		if (newton && (newton != asked || look)) {
			const Real known = model.newtonDamping, damping = newtonDamping(*newton);
			if (!a.rigid.empty()) model.newtonDamping = damping;
			if (model.newtonDamping != known) model.stiffnessChanged(); // it lowers the stable step
		}
		asked  = newton;
		looked = true;
	}
	if (!a.rigid.empty()) addRigidForces(scene, model);
	model.forcesAt = scene->iter;

	if (modelOf.changed) { // whether or not energy is tracked now: it may be later
		dissipation = {};
		frictionId = fractureId = -1;
	}
	if (!scene->trackEnergy) return;
	if (dissipation.before.size() != a.state.status.size())
		dissipation.start(a);
	else
		dissipation.book(a);
	scene->energy->set(dissipation.friction + blocks::contactFriction(a), "blockFriction", frictionId);
	scene->energy->set(dissipation.fracture, "blockFracture", fractureId);
}

void BlockIntegrator::postLoad(BlockIntegrator&)
{
	const Settings wanted { damping, alpha, watchPeriod };
	damping = accepted.damping, alpha = accepted.alpha, watchPeriod = accepted.watchPeriod; // what is refused must not stay
	if (wanted.damping == "local")
		law.kind = blocks::Damping::Kind::local;
	else if (wanted.damping == "adaptive")
		law.kind = blocks::Damping::Kind::adaptive;
	else if (wanted.damping == "none")
		law.kind = blocks::Damping::Kind::none;
	else
		throw std::invalid_argument("BlockIntegrator.damping must be 'local', 'adaptive' or 'none', got '" + wanted.damping + "'");
	blocks::require(wanted.alpha >= 0 && wanted.alpha < 1, "BlockIntegrator.alpha must lie in [0, 1)", wanted.alpha);
	blocks::require(wanted.watchPeriod >= 0, "BlockIntegrator.watchPeriod must not be negative", wanted.watchPeriod);
	accepted  = wanted;
	damping   = wanted.damping;
	law.alpha = alpha = wanted.alpha;
	watchPeriod       = wanted.watchPeriod;
	checkedVersion    = 0;
}

void BlockIntegrator::checkStep(BlockModel& model)
{
	const blocks::BlockAssembly& a = model.assembly;
	for (size_t pair = 0; pair < a.joints.pairs.size(); ++pair)
		if (!(a.joints.ofPair[pair].kn > 0))
			throw std::runtime_error(
				"the joint between blocks " + std::to_string(a.joints.pairs[pair].block[0]) + " and " + std::to_string(a.joints.pairs[pair].block[1])
				+ " has no properties: O.engines needs an InteractionLoop with Ip2_BlockMat_BlockMat_JointPhys before BlockIntegrator");
	blocks::require(scene->dt > 0 && std::isfinite(scene->dt), "O.dt must be positive and finite [s]", scene->dt);
	const Real share = scene->dt / blocks::stableTimeStep(a, model.stiffness(), a.state.inertia), limit = blocks::largestSafety(law);
	const Real rigidShare = scene->dt / blocks::rigidTimeStep(a, model.stiffness(), blocks::Masses::resisting),
		   rigidLimit = 0.95 / std::sqrt(1 + model.newtonDamping);
	blocks::require(
		share <= limit * (1 + 1e-9),
		"O.dt as a fraction of the stable time step must not exceed " + blocks::shown(limit) + " with damping='" + damping
			+ "' (smaller O.dt or BlockTimeStepper.safety)",
		share);
	blocks::require(
		rigidShare <= rigidLimit * (1 + 1e-9),
		"O.dt as a fraction of the stable time step of rigid blocks must not exceed " + blocks::shown(rigidLimit)
			+ " with NewtonIntegrator.damping=" + blocks::shown(model.newtonDamping) + " (smaller O.dt or BlockTimeStepper.safety)",
		rigidShare);
	checkedVersion = model.stiffnessVersion();
	checkedDt      = scene->dt;
}

static void writeCentroids(Scene* scene, const BlockModel& model)
{
	const blocks::BlockAssembly& a = model.assembly;
	for (int i = 0; i < a.blockCount(); ++i) {
		const auto& body = (*scene->bodies)[model.firstBody + i];
		if (!body) throw std::runtime_error("body " + std::to_string(model.firstBody + i) + " was erased, but blocks cannot leave their model");
		if (a.mesh.firstZone[i] == a.mesh.firstZone[i + 1]) continue; // it was the body that moved
		const blocks::Vec2 centroid = a.centroid(i);
		body->state->pos            = Vector3r(centroid.x(), centroid.y(), 0);
	}
}

void BlockIntegrator::advance()
{
	BlockModel& model = modelOf(scene);
	model.throwComplaint();
	if (model.forcesAt != scene->iter) throw std::runtime_error("O.engines needs a BlockForces before BlockIntegrator");
	if (modelOf.changed) {
		watch     = {};
		viscosity = dissipated = pending = 0;
		kineticId = zonesId = jointsId = dampingId = workId = -1;
	}
	if (model.stiffnessVersion() != checkedVersion || scene->dt != checkedDt) checkStep(model);
	if (watchPeriod > 0 && (scene->iter % watchPeriod == 0 || !watch.started())) watchStability(model);

	blocks::BlockAssembly& a       = model.assembly;
	const bool             account = scene->trackEnergy;
	if (account) { // of the time of the forces, before anything moves
		scene->energy->set(blocks::zoneEnergy(a), "blockZones", zonesId);
		scene->energy->set(blocks::jointEnergy(a), "blockJoints", jointsId);
	}
	const Real loadWork = account ? blocks::loadWork(a) : 0;
	law.c               = viscosity;
	blocks::StepWork work;
	if (!a.state.rigid.empty()) work = followRigidBodies(scene, model);
	work += blocks::integrate(a, law, scene->dt, scene->time, account, threadsFor(model, ompThreads));
	viscosity = law.c;
	if (account) {
		scene->energy->set(work.kinetic, "blockKinetic", kineticId);
		scene->energy->set(dissipated += pending + work.dampingBefore, "blockDamping", dampingId);
		scene->energy->set(-blocks::groupWork(a) - blocks::rigidWork(a) - loadWork, "blockWork", workId);
		pending = work.dampingAfter;
	}
	writeCentroids(scene, model);
}

/// The engine that books what joints dissipate.
static BlockForces* forcesOf(Scene* scene)
{
	for (const auto& engine : scene->engines)
		if (auto* forces = dynamic_cast<BlockForces*>(engine.get())) return forces;
	return nullptr;
}

void BlockIntegrator::keepAccounts()
{
	const BlockForces* forces = forcesOf(scene);
	good                      = { dissipated, pending, forces ? forces->dissipation : blocks::JointDissipation() };
}

void BlockIntegrator::restoreAccounts()
{
	dissipated = good.dissipated;
	pending    = good.pending;
	if (BlockForces* forces = forcesOf(scene)) forces->dissipation = good.joints;
}

void BlockIntegrator::watchStability(BlockModel& model)
{
	const long step    = scene->iter;
	const auto verdict = watch.look(model.assembly, step, scene->time, scene->dt);
	if (!verdict.warning.empty()) LOG_WARN("step " << step << ": " << verdict.warning);
	if (verdict.stable) {
		if (scene->trackEnergy && watch.goodStep() == step) keepAccounts();
		return;
	}

	string     message = "unstable at step " + std::to_string(step) + ", block " + std::to_string(verdict.block) + ": " + verdict.reason;
	const long good    = watch.restore(model.assembly);
	if (good >= 0) {
		restoreRigidBodies(scene, model);
		writeCentroids(scene, model);
		if (scene->trackEnergy) restoreAccounts();
		scene->iter = good;
		scene->time = watch.goodTime();
		message += "; the last good state, of step " + std::to_string(good) + ", is put back";
		if (!rescueFile.empty()) {
			const int subStep = scene->subStep;
			scene->subStep    = -1; // saved as between two steps
			Omega::instance().saveSimulation(rescueFile, /*quiet*/ true);
			scene->subStep = subStep;
			message += " and saved as " + rescueFile;
		}
	}
	throw std::runtime_error(message);
}

YADE_PLUGIN((BlockTimeStepper)(BlockForces)(BlockIntegrator));

} // namespace yade
