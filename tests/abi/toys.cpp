/// One plugin class of every kind, as small as they can be: what the macros and bases of pkg/yade-api make of them is tested from Python.
#include "toys.hpp"
#include <lib/base/Logging.hpp>

namespace yade {

ToyShape::~ToyShape()   = default;
ToyState::~ToyState()   = default;
ToyMat::~ToyMat()       = default;
ToyGeom::~ToyGeom()     = default;
ToyPhys::~ToyPhys()     = default;
ToyHolder::~ToyHolder() = default;
CREATE_LOGGER(ToyEngine);

shared_ptr<State> ToyMat::newAssocState() const { return shared_ptr<State>(new ToyState); }

void Bo1_ToyShape_Aabb::go(const shared_ptr<Shape>& shape, shared_ptr<Bound>& bound, const Se3r& se3, const Body*)
{
	if (!bound) bound = shared_ptr<Bound>(new Aabb);
	const Vector3r half = Vector3r::Constant(static_cast<ToyShape&>(*shape).edge / 2);

	bound->min = se3.position - half;
	bound->max = se3.position + half;
}

bool Ig2_ToyShape_ToyShape_ToyGeom::go(
	const shared_ptr<Shape>& shape1,
	const shared_ptr<Shape>&,
	const State& state1,
	const State& state2,
	const Vector3r&,
	const bool&,
	const shared_ptr<Interaction>& interaction)
{
	if (!interaction->geom) interaction->geom = shared_ptr<IGeom>(new ToyGeom);
	static_cast<ToyGeom&>(*interaction->geom).gap = (state2.pos - state1.pos).norm() - static_cast<ToyShape&>(*shape1).edge;
	return true;
}

void Ip2_ToyMat_ToyMat_ToyPhys::go(const shared_ptr<Material>& material1, const shared_ptr<Material>&, const shared_ptr<Interaction>& interaction)
{
	if (interaction->phys) return;
	shared_ptr<ToyPhys> phys(new ToyPhys);
	phys->kn          = static_cast<ToyMat&>(*material1).young;
	interaction->phys = phys;
}

bool Law2_ToyGeom_ToyPhys_Toy::go(shared_ptr<IGeom>& geom, shared_ptr<IPhys>& phys, Interaction* interaction)
{
	auto& spring       = static_cast<ToyPhys&>(*phys);
	spring.normalForce = Vector3r(spring.kn * static_cast<ToyGeom&>(*geom).gap, 0, 0);
	scene->forces.addForce(interaction->getId1(), spring.normalForce);
	scene->forces.addForce(interaction->getId2(), -spring.normalForce);
	return true;
}

void ToyEngine::action()
{
	if (!timingDeltas) timingDeltas = shared_ptr<TimingDeltas>(new TimingDeltas);
	timingDeltas->start();
	bodies = 0;
	for (const auto& b : *scene->bodies)
		if (b->shape) bodies++;
	timingDeltas->checkpoint("bodies");
	if (scene->trackEnergy) scene->energy->add(bodies, "toy", energyId, true);
	timingDeltas->checkpoint("energy");
	LOG_INFO("counted " << bodies);
}

YADE_PLUGIN((
	ToyShape)(ToyState)(ToyMat)(ToyGeom)(ToyPhys)(ToyHolder)(Bo1_ToyShape_Aabb)(Ig2_ToyShape_ToyShape_ToyGeom)(Ip2_ToyMat_ToyMat_ToyPhys)(Law2_ToyGeom_ToyPhys_Toy)(ToyEngine)(ToyPartialEngine)(ToyPeriodicEngine)(ToyTimeStepper));

} // namespace yade
