// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/engines/BlockEngine.hpp>
#include <blocks/kernel/analysis/StabilityWatch.hpp>
#include <blocks/kernel/laws/Damping.hpp>
#include <lib/base/Logging.hpp>

namespace yade {

class BlockIntegrator : public BlockEngine {
public:
	virtual ~BlockIntegrator();
	void step(BlockModel&) override;
	void newScene() override;
	void leaveScene() override { watch = {}; }
	void postLoad(BlockIntegrator&);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(BlockIntegrator, BlockEngine,
		"Moves the grid points by central differences (paper, Eqs. 4-9), with damping and prescribed motion. Stands behind BlockForces or "
		":yref:`BlockLoop`. Grid points of rigid blocks follow their bodies, which NewtonIntegrator has moved. "
		"A run that turns unstable (a number that is none, or energy that nobody put in) is stopped with a message that names step and block; the last "
		"good state is put back and saved. The last step of a run is looked at too. "
		"With ``O.trackEnergy``, ``O.energy`` gets 'blockKinetic', 'blockZones', 'blockJoints', 'blockDamping' and, negative, 'blockWork' (loads, "
		"driven grid points, waves that come in, and what acts on rigid blocks from outside): they sum to zero with those of the other engines, less "
		"what was there at the start. "
		"Where there are viscous boundaries, damping proportional to stiffness or removed blocks, there are 'blockViscous', 'blockStiffness' and "
		"'blockRemoved' too (see :yref:`BlockModel`). "
		"Rigid blocks are in 'blockKinetic' and NewtonIntegrator's damping of them in 'blockDamping'; what NewtonIntegrator itself writes to "
		"``O.energy`` ('kinetic', 'nonviscDamp') is the same once more, to be left out of the sum.",
		((string, damping, "local", Attr::triggerPostLoad, "'local': a force of alpha |F| against the motion of each degree of freedom; 'adaptive': "
			"the paper's viscous damping, adjusted to the kinetic energy; 'none'."))
		((Real, alpha, 0.3, Attr::triggerPostLoad, "Coefficient of the local damping, in [0, 1)."))
		((int, watchPeriod, 100, Attr::triggerPostLoad, "Steps between two looks at the stability; 0: never."))
		((string, rescueFile, "unstable.yade.bz2", , "Where an unstable run saves its last good state, in the format of the name as O.save; empty: "
			"nowhere. Where it cannot be written the message says so.")),
		/*ctor*/,
		.add_property("viscosity", &BlockIntegrator::viscosity, "Coefficient c of the adaptive damping as it stands now [1/s].")
	);
	// clang-format on
	DECLARE_LOGGER;

	Real viscosity() const;
	/// The step whose motion is done; -1 where the state was put back since.
	long movedAt = -1;

protected:
	/// Before anything moves, with the forces of this step.
	virtual void prepareStep(BlockModel&) { }

private:
	void checkStep(BlockModel&);
	void watchStability(BlockModel&);
	void lookAtEnd(BlockModel&);
	/// Puts the last good state back, saves it and throws.
	[[noreturn]] void stop(BlockModel&, const blocks::StabilityWatch::Verdict&);
	string            rescued();

	struct Settings {
		string damping     = "local";
		Real   alpha       = 0.3;
		int    watchPeriod = 100;
	};
	Settings               accepted;
	blocks::Damping        law;
	blocks::StabilityWatch watch;
	long                   checkedVersion = 0;
	long                   knownRemoved   = 0; ///< blocks that had been taken out when the watch last began
	Real                   checkedDt      = 0;
	int                    kineticId = -1, zonesId = -1, jointsId = -1, dampingId = -1, workId = -1, viscousId = -1, stiffnessId = -1, removedId = -1;
};
REGISTER_SERIALIZABLE(BlockIntegrator);

} // namespace yade
