// yade-blocks, GPL-2.0-or-later
#include <blocks/engines/RigidBodies.hpp>
#include <blocks/engines/StepLength.hpp>
#include <blocks/kernel/analysis/Energy.hpp>
#include <blocks/kernel/step/Release.hpp>
#include <blocks/kernel/step/TimeStep.hpp>
#include <core/EnergyTracker.hpp>
#include <iostream>

namespace yade {
namespace {

	Real limitOf(const blocks::BlockAssembly& a, const vector<Real>& stiffness)
	{
		return std::min(blocks::stableTimeStep(a, stiffness, a.mesh.mass), blocks::rigidTimeStep(a, stiffness, blocks::Masses::actual));
	}

} // namespace

Real StepLength::adjust(Scene* scene, BlockModel& model, Real safety, bool quasiStatic, const char* engine)
{
	blocks::BlockAssembly& a        = model.assembly;
	Real&                  scaling  = a.state.accounts.scaling;
	const bool             tracking = scene->trackEnergy;
	a.contacts.mostAStep            = quasiStatic ? blocks::nearing::scaledMasses : blocks::nearing::trueMasses;
	noteFreedom(scene, model);
	if (tracking && scalingId < 0) scene->energy->set(scaling, "blockScaling", scalingId);
	if (model.stiffnessVersion() == doneVersion && scene->dt == doneDt && safety == doneSafety && quasiStatic == doneQuasiStatic) return limit;
	blocks::require(safety > 0 && safety <= 0.95, std::string(engine) + ".safety must lie in (0, 0.95]", safety);

	if (quasiStatic && !a.supports.viscous.empty())
		throw std::runtime_error(
			std::string(engine) + ".quasiStatic must be False with viscous boundaries: scaled masses have other waves, got True (boundary \""
			+ a.supports.viscous.front().name + "\")");
	if (quasiStatic && a.supports.stiffnessDamping > 0)
		throw std::runtime_error(
			std::string(engine) + ".quasiStatic must be False with BlockModel.stiffnessDamping: scaled masses have other frequencies, got True ("
			+ blocks::shown(a.supports.stiffnessDamping) + " s)");
	const auto& stiffness = model.stiffness();
	limit                 = limitOf(a, stiffness);
	const Real kinetic    = tracking ? blocks::gridPointsKineticEnergy(a) : 0;
	if (quasiStatic) {
		blocks::require(scene->dt > 0 && std::isfinite(scene->dt), "O.dt must be positive and finite [s]", scene->dt);
		blocks::scaleInertia(a, stiffness, scene->dt, safety);
		blocks::scaleRigidInertia(a, stiffness, scene->dt, safety);
	} else {
		if (std::isfinite(limit))
			scene->dt = safety * (a.contacts.order.empty() ? limit : limitOf(a, blocks::touchStiffness(a, stiffness)));
		else if (toldDt != scene->dt) { // only rigid blocks, and they touch nothing
			toldDt = scene->dt;
			std::cerr << "WARN " << engine << ": nothing limits the time step, as no block has zones and none touches another; O.dt stays "
				  << blocks::shown(scene->dt) << " s unless you set it" << std::endl;
		}
		if (a.state.inertia != a.mesh.mass) blocks::askAllWhether(a); // joints stay only with scaled masses
		a.state.inertia = a.mesh.mass;
		a.updateMobility();
		blocks::restoreRigidInertia(a);
	}
	if (tracking) scene->energy->set(scaling -= blocks::gridPointsKineticEnergy(a) - kinetic, "blockScaling", scalingId);
	writeMasses(scene, model);
	doneVersion     = model.stiffnessVersion();
	doneDt          = scene->dt;
	doneSafety      = safety;
	doneQuasiStatic = quasiStatic;
	return limit;
}

} // namespace yade
