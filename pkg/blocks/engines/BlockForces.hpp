// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/engines/BlockEngine.hpp>
#include <blocks/kernel/step/Dissipation.hpp>

namespace yade {

class BlockForces : public BlockEngine {
public:
	virtual ~BlockForces();
	void step(BlockModel&) override;
	void newScene() override;

	// clang-format off
	YADE_CLASS_BASE_DOC(BlockForces, BlockEngine,
		"Unbalanced force of every grid point behind YADE's InteractionLoop, which has computed the joint stresses: loads, joint stresses times areas, "
		"zone stresses; summed in a fixed order, so that the same scene gives the same bits on any number of threads. "
		":yref:`BlockLoop` does without InteractionLoop. Force and torque on rigid blocks go to ``O.forces``, for NewtonIntegrator. "
		"With ``O.trackEnergy``, ``O.energy`` gets 'blockFriction' and 'blockFracture', and with joints that soften 'blockModeI', 'blockModeII' and "
		"'blockCap': what they dissipated by opening, by slip (without friction) and by crushing.");
	// clang-format on

protected:
	/// a.forces.nodal, and with O.trackEnergy the accounts of what joints dissipate.
	virtual void computeForces(BlockModel&, int threads);
	/// Whether joints are stepped here, not by an InteractionLoop.
	virtual bool stepsJoints() const { return false; }

private:
	void lookAtEngines(BlockModel&, int threads);

	vector<blocks::Joint> lastStatus; ///< of contact points at the last step, where an InteractionLoop's law may have broken some

	int  frictionId = -1, fractureId = -1, modeIId = -1, modeIIId = -1, capId = -1;
	bool saidSnapped = false;

	const Engine*         asked     = nullptr; ///< the NewtonIntegrator that was asked for its attributes last
	bool                  told      = false;   ///< whether what is remarkable was said
	bool                  looked    = false;   ///< whether O.engines was looked at in this scene
	static constexpr long askPeriod = 100;     ///< steps until it is looked at again
};
REGISTER_SERIALIZABLE(BlockForces);

} // namespace yade
