// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/engines/BlockIntegrator.hpp>
#include <blocks/engines/Rescue.hpp>
#include <blocks/engines/RigidBodies.hpp>
#include <blocks/kernel/analysis/Energy.hpp>
#include <blocks/kernel/step/Step.hpp>
#include <blocks/kernel/step/TimeStep.hpp>
#include <blocks/views/ContactViews.hpp>
#include <core/EnergyTracker.hpp>
#include <core/Omega.hpp>

namespace yade {

CREATE_LOGGER(BlockIntegrator);

BlockIntegrator::~BlockIntegrator() = default;

void BlockIntegrator::postLoad(BlockIntegrator&)
{
	const Settings wanted { damping, alpha, watchPeriod };
	damping = accepted.damping, alpha = accepted.alpha, watchPeriod = accepted.watchPeriod; // what is refused must not stay
	const string name = getClassName();
	if (wanted.damping == "local")
		law.kind = blocks::Damping::Kind::local;
	else if (wanted.damping == "adaptive")
		law.kind = blocks::Damping::Kind::adaptive;
	else if (wanted.damping == "none")
		law.kind = blocks::Damping::Kind::none;
	else
		throw std::invalid_argument(name + ".damping must be 'local', 'adaptive' or 'none', got '" + wanted.damping + "'");
	blocks::require(wanted.alpha >= 0 && wanted.alpha < 1, name + ".alpha must lie in [0, 1)", wanted.alpha);
	blocks::require(wanted.watchPeriod >= 0, name + ".watchPeriod must not be negative", wanted.watchPeriod);
	accepted  = wanted;
	damping   = wanted.damping;
	law.alpha = alpha = wanted.alpha;
	watchPeriod       = wanted.watchPeriod;
	checkedVersion    = 0;
}

void BlockIntegrator::newScene()
{
	watch     = {};
	kineticId = zonesId = jointsId = dampingId = workId = viscousId = stiffnessId = removedId = -1;
}

Real BlockIntegrator::viscosity() const { return BlockModel::of(Omega::instance().getScene().get())->assembly.state.viscosity; }

void BlockIntegrator::checkStep(BlockModel& model)
{
	const blocks::BlockAssembly& a = model.assembly;
	model.requireProperties();
	blocks::require(scene->dt > 0 && std::isfinite(scene->dt), "O.dt must be positive and finite [s]", scene->dt);
	if (a.supports.stiffnessDamping > 0 && law.kind != blocks::Damping::Kind::none)
		throw std::runtime_error(
			getClassName() + ".damping must be 'none' with BlockModel.stiffnessDamping, which is the damping then, got '" + damping + "'");
	const Real share = scene->dt / blocks::stableTimeStep(a, model.stiffness(), a.state.inertia), limit = blocks::largestSafety(law);
	const Real rigidShare = scene->dt / blocks::rigidTimeStep(a, model.stiffness(), blocks::Masses::resisting),
		   rigidLimit = 0.95 / std::sqrt(1 + model.newtonDamping);
	blocks::require(
		share <= limit * (1 + 1e-9),
		"O.dt as a fraction of the stable time step must not exceed " + blocks::shown(limit) + " with damping='" + damping
			+ "' (smaller O.dt or safety)",
		share);
	blocks::require(
		rigidShare <= rigidLimit * (1 + 1e-9),
		"O.dt as a fraction of the stable time step of rigid blocks must not exceed " + blocks::shown(rigidLimit)
			+ " with NewtonIntegrator.damping=" + blocks::shown(model.newtonDamping) + " (smaller O.dt or safety)",
		rigidShare);
	const auto& removed = a.mesh.removed;
	const long  gone    = std::count(removed.begin(), removed.end(), true);
	if (gone != knownRemoved) watch = {}; // no earlier state can be put back, and other energy is to be kept
	knownRemoved   = gone;
	checkedVersion = model.stiffnessVersion();
	checkedDt      = scene->dt;
}

void BlockIntegrator::step(BlockModel& model)
{
	if (model.forcesAt != scene->iter) throw std::runtime_error("O.engines needs a BlockLoop (or BlockForces) before " + getClassName());
	prepareStep(model);
	if (model.stiffnessVersion() != checkedVersion || scene->dt != checkedDt) checkStep(model);
	if (watchPeriod > 0 && (scene->iter % watchPeriod == 0 || !watch.started())) watchStability(model);

	blocks::BlockAssembly& a       = model.assembly;
	const bool             account = scene->trackEnergy;
	if (account) { // of the time of the forces, before anything moves
		scene->energy->set(blocks::sumOf(a.forces.zoneEnergy), "blockZones", zonesId);
		scene->energy->set(blocks::bookedJointEnergy(a), "blockJoints", jointsId);
	}
	const Real       loadWork = account ? blocks::loadWork(a) : 0;
	blocks::StepWork work;
	if (!a.state.rigid.empty()) work = followRigidBodies(scene, model);
	work += blocks::move(a, law, scene->dt, scene->time, account, threadsFor(model, ompThreads));
	movedAt = scene->iter;
	if (watchPeriod > 0 && scene->stopAtIter == scene->iter + 1) lookAtEnd(model);
	if (account) {
		blocks::Accounts& booked = a.state.accounts;
		booked.damping += booked.pendingDamping + work.dampingBefore;
		booked.pendingDamping = work.dampingAfter;
		scene->energy->set(work.kinetic, "blockKinetic", kineticId);
		scene->energy->set(booked.damping, "blockDamping", dampingId);
		const blocks::FurtherAccounts& further = a.state.further;
		scene->energy->set(-blocks::groupWork(a) - blocks::rigidWork(a) - further.incoming - loadWork, "blockWork", workId);
		if (further.viscous != 0 || !a.supports.viscous.empty()) scene->energy->set(further.viscous, "blockViscous", viscousId);
		if (further.stiffness != 0 || a.supports.stiffnessDamping > 0) scene->energy->set(further.stiffness, "blockStiffness", stiffnessId);
		if (!a.mesh.removed.empty()) scene->energy->set(further.removed, "blockRemoved", removedId);
	}
}

void BlockIntegrator::watchStability(BlockModel& model)
{
	const long step    = scene->iter;
	const auto verdict = watch.look(model.assembly, step, scene->time, scene->dt);
	if (!verdict.warning.empty()) LOG_WARN("step " << step << ": " << verdict.warning);
	if (verdict.stable) {
		model.writeCentroids(scene, threadsFor(model, ompThreads));
		return;
	}

	stop(model, verdict);
}

void BlockIntegrator::lookAtEnd(BlockModel& model)
{
	const auto verdict = blocks::StabilityWatch::lookAtEnd(model.assembly);
	if (!verdict.stable) stop(model, verdict);
}

void BlockIntegrator::stop(BlockModel& model, const blocks::StabilityWatch::Verdict& verdict)
{
	string     message = "unstable at step " + std::to_string(scene->iter) + ", block " + std::to_string(verdict.block) + ": " + verdict.reason;
	const long good    = watch.restore(model.assembly);
	if (good >= 0) {
		restoreRigidBodies(scene, model);
		model.writeCentroids(scene, threadsFor(model, ompThreads));
		model.stiffnessChanged();
		showAllContacts(scene, model); // they were those of a state that is no more
		scene->iter = good;
		movedAt = model.forcesAt = -1; // between two steps
		scene->time              = watch.goodTime();
		message += "; the last good state, of step " + std::to_string(good) + ", is put back" + rescued();
	}
	throw std::runtime_error(message);
}

/// Saves the scene as between two steps; what is to be said of it.
string BlockIntegrator::rescued()
{
	if (rescueFile.empty()) return "";
	struct Between {
		Scene*    scene;
		const int subStep = scene->subStep;
		~Between() { scene->subStep = subStep; }
	} between { scene };
	scene->subStep       = -1;
	const string trouble = saveScene(rescueFile);
	return trouble.empty() ? " and saved as " + rescueFile : ", but could not be saved: " + trouble;
}

YADE_PLUGIN((BlockIntegrator));

} // namespace yade
