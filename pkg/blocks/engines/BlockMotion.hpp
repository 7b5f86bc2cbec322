// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/engines/BlockIntegrator.hpp>
#include <blocks/engines/StepLength.hpp>

namespace yade {

class BlockMotion : public BlockIntegrator {
public:
	virtual ~BlockMotion();
	void newScene() override;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(BlockMotion, BlockIntegrator,
		"Moves the grid points, as :yref:`BlockIntegrator` does, at a time step that it keeps stable itself (paper, Eq. 10, with a nodal stiffness "
		"that is a bound and not an estimate). Stands behind :yref:`BlockLoop`. "
		"With ``O.trackEnergy``, ``O.energy`` gets 'blockScaling' too: minus the kinetic energy that grid points' masses have brought which were "
		"scaled anew while they moved (rigid blocks keep their momentum, and what they lose is 'blockDamping').",
		((Real, safety, 0.7, , "Time step as a fraction of the stable one; at most 0.95/sqrt(1+alpha) with local damping, else 0.95."))
		((bool, quasiStatic, true, , "``O.dt`` is the user's and every grid point gets the mass with which its limit is O.dt/safety (gravity and loads "
			"keep the true masses). Collapse is slow to be seen then, as soft mechanisms get the masses of stiff springs: true masses (False) show "
			"it. False: true masses, and O.dt is set to safety times the limit; springs of free contacts count four times in it, since a spring "
			"that comes and goes within a step keeps its energy less well (below 1 % so, up to 9 % else)."))
		((Real, stableStep, 0, Attr::readonly, "Limit of the time step with the true masses, as computed last [s]."))
	);
	// clang-format on

protected:
	void prepareStep(BlockModel&) override;

private:
	StepLength length;
};
REGISTER_SERIALIZABLE(BlockMotion);

} // namespace yade
