// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/engines/OnBlocks.hpp>
#include <blocks/engines/StepLength.hpp>
#include <core/TimeStepper.hpp>

namespace yade {

class BlockTimeStepper : public OnBlocks<TimeStepper> {
public:
	virtual ~BlockTimeStepper();
	void computeTimeStep(Scene*) override;
	void newScene() override { length.newScene(); }

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(BlockTimeStepper, TimeStepper,
		"Makes the time step stable (paper, Eq. 10, with a nodal stiffness that is a bound and not an estimate), for lists of engines with "
		":yref:`BlockIntegrator`; :yref:`BlockMotion` does so itself. Stands behind InteractionLoop, which creates the joints whose stiffness counts. "
		"Works only when the stiffness, the step or its own attributes have changed.\n\n"
		"quasiStatic: ``O.dt`` is the user's and every grid point gets the mass with which its limit is O.dt/safety (gravity and loads keep the true "
		"masses). Otherwise masses are true and O.dt is set to safety times the limit, in which springs of free contacts count four times, see "
		":yref:`BlockMotion`. "
		"With ``O.trackEnergy``, ``O.energy`` gets 'blockScaling': minus the kinetic energy that grid points' masses have brought which were scaled "
		"anew while they moved (rigid blocks keep their momentum, and what they lose is 'blockDamping').",
		((Real, safety, 0.7, , "Time step as a fraction of the stable one; at most 0.95/sqrt(1+alpha) with local damping, else 0.95."))
		((bool, quasiStatic, true, , "Scaled masses at the user's O.dt instead of the largest stable O.dt at true masses."))
		((Real, stableStep, 0, Attr::readonly, "Limit of the time step with the true masses, as computed last [s]."))
	);
	// clang-format on

private:
	StepLength length;
};
REGISTER_SERIALIZABLE(BlockTimeStepper);

} // namespace yade
