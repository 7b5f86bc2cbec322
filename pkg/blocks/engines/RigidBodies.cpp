// yade-blocks, GPL-2.0-or-later
#include <blocks/engines/BlockForces.hpp>
#include <blocks/engines/BlockIntegrator.hpp>
#include <blocks/engines/RigidBodies.hpp>
#include <blocks/views/PythonLock.hpp>
#include <core/Body.hpp>
#include <core/BodyContainer.hpp>
#include <cstring>
#include <typeinfo>

namespace yade {

namespace {
	State& stateOf(const Scene* scene, const BlockModel& model, const blocks::RigidBlock& r)
	{
		const auto& body = (*scene->bodies)[model.firstBody + r.block];
		if (!body) throw std::runtime_error("body " + std::to_string(model.firstBody + r.block) + " was erased, but blocks cannot leave their model");
		return *body->state;
	}

	string named(const BlockModel& model, const blocks::RigidBlock& r)
	{
		return "rigid block " + std::to_string(r.block) + " (body " + std::to_string(model.firstBody + r.block) + ")";
	}

	bool isHeld(const State& state) { return state.blockedDOFs == State::DOF_ALL && state.vel == Vector3r::Zero() && state.angVel == Vector3r::Zero(); }

	/// Whether an engine is of YADE's class of this mangled name; a name costs nothing, a std::string would.
	bool is(const Engine& engine, const char* mangled) { return std::strcmp(typeid(engine).name(), mangled) == 0; }

	blocks::Vec3 inPlane(const Vector3r& translation, const Vector3r& rotation) { return { translation.x(), translation.y(), rotation.z() }; }
}

const Engine* requireMovers(const Scene* scene, const BlockModel& model)
{
	enum { resetter, forces, newton, integrator, count };
	int           place[count] = { -1, -1, -1, -1 }, i = 0;
	const Engine* mover = nullptr;
	auto          note  = [&](int which) {
                if (place[which] >= 0)
                        throw std::runtime_error(
                                std::string("O.engines must have one ") + (which == newton ? "NewtonIntegrator" : "BlockMotion or BlockIntegrator")
                                + ", or blocks would move twice in a step, got two");
                place[which] = i;
	};
	for (const auto& engine : scene->engines) {
		const Engine& e = *engine;
		++i;
		if (e.dead) continue;
		if (is(e, "N4yade13ForceResetterE"))
			place[resetter] = i;
		else if (is(e, "N4yade16NewtonIntegratorE"))
			note(newton), mover = &e;
		else if (dynamic_cast<const BlockForces*>(&e))
			place[forces] = i;
		else if (dynamic_cast<const BlockIntegrator*>(&e))
			note(integrator);
	}
	if (model.assembly.state.rigid.empty()) return mover; // wherever it stands, it moves no block
	if (place[resetter] < 0 || place[resetter] > place[forces])
		throw std::runtime_error(
			"O.engines needs a ForceResetter before BlockLoop or BlockForces because of " + named(model, model.assembly.state.rigid.front())
			+ ", or forces on its body would add up from step to step");
	if (place[newton] > place[forces] && place[newton] < place[integrator]) return mover;
	if (mover)
		throw std::runtime_error(
			"NewtonIntegrator must stand between BlockLoop and BlockMotion in O.engines, or rigid blocks would move one step late");
	for (const auto& r : model.assembly.state.rigid)
		if (!isHeld(stateOf(scene, model, r)))
			throw std::runtime_error(
				"O.engines needs a NewtonIntegrator between BlockLoop and BlockMotion to move " + named(model, r)
				+ ", which is not held (blockedDOFs 'xyzXYZ' and no velocity)");
	return nullptr;
}

Real newtonDamping(const Engine& newton)
{
	const PythonLock lock;
	const py::dict   attributes = newton.pyDict();
	const Vector3r   gravity    = py::extract<Vector3r>(attributes["gravity"]);
	if (gravity != Vector3r::Zero())
		throw std::runtime_error(
			"NewtonIntegrator.gravity must be zero with blocks, whose grid points it does not move and whose mass may be scaled: give it to "
			"BlockModel.gravity, got ("
			+ blocks::shown(gravity.x()) + ", " + blocks::shown(gravity.y()) + ", " + blocks::shown(gravity.z()) + ")");
	return py::extract<Real>(attributes["damping"]);
}

void noteFreedom(const Scene* scene, BlockModel& model)
{
	for (auto& r : model.assembly.state.rigid) {
		const unsigned            blocked = stateOf(scene, model, r).blockedDOFs;
		const std::array<bool, 3> free { !(blocked & State::DOF_X), !(blocked & State::DOF_Y), !(blocked & State::DOF_RZ) };
		if (free == r.free) continue;
		r.free = free;
		model.stiffnessChanged();
	}
}

void readRigidMotion(const Scene* scene, BlockModel& model)
{
	noteFreedom(scene, model);
	for (auto& r : model.assembly.state.rigid) {
		const State&       state    = stateOf(scene, model, r);
		const blocks::Vec3 velocity = inPlane(state.vel, state.angVel);
		for (int i = 0; i < 3; ++i)
			if (!r.free[i]) r.velocity[i] = velocity[i];
	}
}

void writeMasses(const Scene* scene, BlockModel& model)
{
	for (auto& r : model.assembly.state.rigid) {
		State& state = stateOf(scene, model, r);
		if (state.mass == r.inertia && state.inertia.z() == r.rotaryInertia) continue;
		const blocks::Vec3 old { state.mass, state.mass, state.inertia.z() };
		blocks::Vec3       velocity = inPlane(state.vel, state.angVel); // what is prescribed for the next step is yet to be reached
		for (int i = 0; i < 3; ++i)
			if (!r.free[i]) velocity[i] = r.velocity[i];
		blocks::changeInertia(r, old, velocity);
		if (r.free[0]) state.vel.x() = velocity[0];
		if (r.free[1]) state.vel.y() = velocity[1];
		if (r.free[2]) state.angVel.z() = velocity[2];
		state.mass    = r.inertia;
		state.inertia = Vector3r::Constant(r.rotaryInertia);
	}
}

void addRigidForces(Scene* scene, BlockModel& model)
{
	blocks::gatherRigidForces(model.assembly);
	for (auto& r : model.assembly.state.rigid) {
		const State& state = stateOf(scene, model, r);
		if (state.mass != r.inertia || state.inertia.z() != r.rotaryInertia)
			throw std::runtime_error(
				"state.mass and state.inertia of " + named(model, r) + " follow from its material and BlockTimeStepper, "
				+ blocks::shown(r.inertia) + " kg and " + blocks::shown(r.rotaryInertia) + " kg m2, got " + blocks::shown(state.mass) + " and "
				+ blocks::shown(state.inertia.z()));
		const blocks::Vec3 velocity = inPlane(state.vel, state.angVel);
		for (int i = 0; i < 3; ++i) // a script may have set it; along prescribed directions the change is work, which is booked
			if (r.free[i]) r.velocity[i] = velocity[i];
		const int id = model.firstBody + r.block;
		scene->forces.addForce(id, { r.force[0], r.force[1], 0 });
		scene->forces.addTorque(id, { 0, 0, r.force[2] });
	}
}

blocks::StepWork followRigidBodies(Scene* scene, BlockModel& model)
{
	scene->forces.sync(); // NewtonIntegrator has done so, if there is one
	blocks::StepWork work;
	for (auto& r : model.assembly.state.rigid) {
		const State&       state = stateOf(scene, model, r);
		const Quaternionr& ori   = state.ori;
		if (state.pos.z() != 0 || ori.x() != 0 || ori.y() != 0)
			throw std::runtime_error(named(model, r) + " has left the x-y plane: block 'zXY' in its blockedDOFs");
		const int id = model.firstBody + r.block;
		work += blocks::followRigidMotion(
			model.assembly,
			r,
			{ { state.pos.x(), state.pos.y() },
		          { ori.w(), ori.z() },
		          inPlane(state.vel, state.angVel),
		          inPlane(scene->forces.getForce(id), scene->forces.getTorque(id)) },
			scene->dt);
	}
	return work;
}

void restoreRigidBodies(const Scene* scene, const BlockModel& model)
{
	for (const auto& r : model.assembly.state.rigid) {
		State& state  = stateOf(scene, model, r);
		state.pos     = { r.centre.x(), r.centre.y(), 0 };
		state.ori     = Quaternionr(r.halfTurn.x(), 0, 0, r.halfTurn.y());
		state.vel     = { r.velocity[0], r.velocity[1], 0 };
		state.angVel  = { 0, 0, r.velocity[2] };
		state.mass    = r.inertia;
		state.inertia = Vector3r::Constant(r.rotaryInertia);
	}
}

} // namespace yade
