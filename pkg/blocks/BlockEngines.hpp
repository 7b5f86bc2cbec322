// yade-blocks, GPL-2.0-or-later
#pragma once
#include "BlockModel.hpp"
#include <blocks/kernel/analysis/Energy.hpp>
#include <blocks/kernel/analysis/StabilityWatch.hpp>
#include <blocks/kernel/laws/Damping.hpp>
#include <core/GlobalEngine.hpp>
#include <core/TimeStepper.hpp>
#include <functional>

namespace yade {

/// The scene's model; engines outlive scenes and are given to new ones, so each step asks again.
class ModelOfScene {
public:
	/// Whether the model is another one than in the last step: what the engine remembers belongs to an earlier scene.
	/// (An engine that was just loaded has had no model yet; what it remembers is the loaded one's.)
	bool changed = false;

	BlockModel& operator()(const Scene* scene)
	{
		const auto& found = BlockModel::of(scene);
		changed           = model && found != model;
		if (found != model) model = found;
		return *model;
	}

private:
	shared_ptr<BlockModel> model; // held, so that no other one can get its address
};

/// Runs an engine's step; what it throws is held back for a moment, because O.run(n, wait=True) sees only the errors of a run
/// that is still alive when it begins to wait.
void visibly(const std::function<void()>& step);

/// Threads worth starting for so many zones.
int threadsFor(const BlockModel&, int ompThreads);

class BlockTimeStepper : public TimeStepper {
public:
	virtual ~BlockTimeStepper();
	void computeTimeStep(Scene*) override;
	void adjust(Scene*);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(BlockTimeStepper, TimeStepper,
		"Makes the time step stable (paper, Eq. 10, with a nodal stiffness that is a bound and not an estimate). Stands behind InteractionLoop, which creates the joints whose stiffness counts. "
		"Works only when the stiffness, the step or its own attributes have changed.\n\n"
		"quasiStatic: ``O.dt`` is the user's and every grid point gets the mass with which its limit is O.dt/safety (gravity and loads keep the true masses). Otherwise masses are true and O.dt is set to safety times the limit. "
		"With ``O.trackEnergy``, ``O.energy`` gets 'blockScaling': minus the kinetic energy that grid points' masses have brought which were scaled anew while they moved (rigid blocks keep their momentum, and what they lose is 'blockDamping').",
		((Real, safety, 0.7, , "Time step as a fraction of the stable one; at most 0.95/sqrt(1+alpha) with local damping, else 0.95."))
		((bool, quasiStatic, true, , "Scaled masses at the user's O.dt instead of the largest stable O.dt at true masses."))
		((Real, stableStep, 0, Attr::readonly, "Limit of the time step with the true masses, as computed last [s]."))
		((Real, brought, 0, Attr::hidden, "blockScaling [J]."))
		,
		/*ctor*/,
		/*py*/
	);
	// clang-format on
	DECLARE_LOGGER;

private:
	ModelOfScene modelOf;
	long         doneVersion = 0;
	Real         doneDt = 0, doneSafety = 0, toldDt = 0;
	bool         doneQuasiStatic = false;
	int          scalingId       = -1;
};
REGISTER_SERIALIZABLE(BlockTimeStepper);

class BlockForces : public GlobalEngine {
public:
	virtual ~BlockForces();
	void action() override;
	void gather();

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(BlockForces, GlobalEngine,
		"Unbalanced force of every grid point: loads, joint stresses times areas, zone stresses; summed in a fixed order, so that the same scene gives the same bits on any number of threads. "
		"Force and torque on rigid blocks go to ``O.forces``, for NewtonIntegrator. "
		"With ``O.trackEnergy``, ``O.energy`` gets 'blockFriction' and 'blockFracture'.",
		((blocks::JointDissipation, dissipation, , Attr::hidden, "Accounts, kept only with O.trackEnergy."))
	);
	// clang-format on

private:
	ModelOfScene modelOf;
	int          frictionId = -1, fractureId = -1;

	bool                  looked    = false;   ///< at the other engines
	const Engine*         asked     = nullptr; ///< the NewtonIntegrator that was asked for its attributes last
	static constexpr long askPeriod = 100;     ///< steps until it is asked again
};
REGISTER_SERIALIZABLE(BlockForces);

class BlockIntegrator : public GlobalEngine {
public:
	virtual ~BlockIntegrator();
	void action() override;
	void advance();
	void postLoad(BlockIntegrator&);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(BlockIntegrator, GlobalEngine,
		"Moves the grid points by central differences (paper, Eqs. 4-9), with damping and prescribed motion, and writes the centroids to ``state.pos``. Grid points of rigid blocks follow their bodies, which NewtonIntegrator has moved. "
		"A run that turns unstable (a number that is none, or energy that nobody put in) is stopped with a message that names step and block; the last good state is put back and saved. "
		"With ``O.trackEnergy``, ``O.energy`` gets 'blockKinetic', 'blockZones', 'blockJoints', 'blockDamping' and, negative, 'blockWork' (loads, driven grid points, and what acts on rigid blocks from outside): they sum to zero with those of BlockTimeStepper and BlockForces, less what was there at the start. "
		"Rigid blocks are in 'blockKinetic' and NewtonIntegrator's damping of them in 'blockDamping'; what NewtonIntegrator itself writes to ``O.energy`` ('kinetic', 'nonviscDamp') is the same once more, to be left out of the sum.",
		((string, damping, "local", Attr::triggerPostLoad, "'local': a force of alpha |F| against the motion of each degree of freedom; 'adaptive': the paper's viscous damping, adjusted to the kinetic energy; 'none'."))
		((Real, alpha, 0.3, Attr::triggerPostLoad, "Coefficient of the local damping, in [0, 1)."))
		((Real, viscosity, 0, , "Coefficient c of the adaptive damping as it stands now [1/s]."))
		((int, watchPeriod, 100, Attr::triggerPostLoad, "Steps between two looks at the stability; 0: never."))
		((string, rescueFile, "unstable.yade.bz2", , "Where an unstable run saves its last good state; empty: nowhere."))
		((Real, dissipated, 0, Attr::hidden, "By damping, up to the last time of forces [J]."))
		((Real, pending, 0, Attr::hidden, "By damping in the half step since [J]."))
	);
	// clang-format on
	DECLARE_LOGGER;

private:
	void checkStep(BlockModel&);
	void watchStability(BlockModel&);
	void keepAccounts();
	void restoreAccounts();

	struct Settings {
		string damping     = "local";
		Real   alpha       = 0.3;
		int    watchPeriod = 100;
	};
	/// What goes with the last good state, with O.trackEnergy.
	struct Accounts {
		Real                     dissipated = 0, pending = 0;
		blocks::JointDissipation joints;
	};
	Settings               accepted;
	Accounts               good;
	ModelOfScene           modelOf;
	blocks::Damping        law;
	blocks::StabilityWatch watch;
	long                   checkedVersion = 0;
	Real                   checkedDt      = 0;
	int                    kineticId = -1, zonesId = -1, jointsId = -1, dampingId = -1, workId = -1;
};
REGISTER_SERIALIZABLE(BlockIntegrator);

} // namespace yade
