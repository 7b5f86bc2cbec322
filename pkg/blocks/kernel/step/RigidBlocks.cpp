// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/step/RigidBlocks.hpp>

namespace blocks {

RigidStiffness rigidStiffness(const BlockAssembly& a, const std::vector<Real>& stiffness, const RigidBlock& r)
{
	RigidStiffness sum { 0, 0, 0 };
	Vec2           first = Vec2::Zero();
	for (int n = a.mesh.firstNode[r.block]; n < a.mesh.firstNode[r.block + 1]; ++n) {
		const Vec2 arm = a.mesh.reference[n] - r.origin;
		sum.translation += stiffness[n];
		first += stiffness[n] * arm;
		sum.rotation += stiffness[n] * arm.squaredNorm();
	}
	sum.coupling = first.norm();
	return sum;
}

Real rigidTimeStep(const BlockAssembly& a, const std::vector<Real>& stiffness, Masses masses)
{
	Real fastest = 0; // omega^2
	for (const RigidBlock& r : a.state.rigid) {
		const RigidStiffness k          = rigidStiffness(a, stiffness, r);
		const bool           translates = r.free[0] || r.free[1], rotates = r.free[2], actual = masses == Masses::actual;
		const Real           m = actual ? r.mass : r.inertia, moment = actual ? r.moment : r.rotaryInertia;
		const Real           p = translates ? k.translation / m : 0, q = rotates ? k.rotation / moment : 0;
		const Real           both = translates && rotates ? k.coupling * k.coupling / (m * moment) : 0;
		fastest                   = std::max(fastest, (p + q) / 2 + std::sqrt((p - q) * (p - q) / 4 + both));
	}
	return 2 / std::sqrt(fastest);
}

void scaleRigidInertia(BlockAssembly& a, const std::vector<Real>& stiffness, Real dt, Real safety)
{
	require(dt > 0 && std::isfinite(dt), "the time step must be positive [s]", dt);
	require(safety > 0, "safety must be positive", safety);
	restoreRigidInertia(a);
	const Real c = dt * dt / (4 * safety * safety);
	for (RigidBlock& r : a.state.rigid) {
		const RigidStiffness k = rigidStiffness(a, stiffness, r);
		if (!(k.rotation > 0)) continue;
		const Real length = std::sqrt(k.rotation / k.translation);
		r.inertia         = c * (k.translation + k.coupling / length);
		r.rotaryInertia   = c * (k.rotation + k.coupling * length);
	}
}

void restoreRigidInertia(BlockAssembly& a)
{
	for (RigidBlock& r : a.state.rigid)
		r.inertia = r.mass, r.rotaryInertia = r.moment;
}

void changeInertia(RigidBlock& r, const Vec3& old, Vec3& velocity)
{
	Real gained = 0;
	for (int i = 0; i < 3; ++i) {
		const Real inertia = i < 2 ? r.inertia : r.rotaryInertia, before = velocity[i];
		if (r.free[i] && inertia > old[i]) velocity[i] *= old[i] / inertia;
		gained += (inertia * velocity[i] * velocity[i] - old[i] * before * before) / 2;
	}
	r.work += gained;
	r.workTurnover += std::abs(gained);
}

void gatherRigidForces(BlockAssembly& a)
{
	for (RigidBlock& r : a.state.rigid) {
		r.force = { r.load.x(), r.load.y(), 0 };
		for (int n = a.mesh.firstNode[r.block]; n < a.mesh.firstNode[r.block + 1]; ++n)
			r.force += Vec3(a.forces.nodal[n].x(), a.forces.nodal[n].y(), cross(a.position(n) - r.centre, a.forces.nodal[n]));
	}
}

StepWork followRigidMotion(BlockAssembly& a, RigidBlock& r, const RigidMotion& now, Real dt)
{
	const Real c = now.halfTurn.x(), s = now.halfTurn.y(), cosine = c * c - s * s, sine = 2 * c * s;
	for (int n = a.mesh.firstNode[r.block]; n < a.mesh.firstNode[r.block + 1]; ++n) {
		const Vec2 arm      = a.mesh.reference[n] - r.origin;
		const Vec2 there    = now.centre + Vec2(cosine * arm.x() - sine * arm.y(), sine * arm.x() + cosine * arm.y());
		a.state.velocity[n] = (there - a.position(n)) / dt;
	}

	StepWork work;
	Real     booked = r.pendingWork;
	r.pendingWork   = 0;
	for (int i = 0; i < 3; ++i) {
		const Real inertia = i < 2 ? r.inertia : r.rotaryInertia, before = r.velocity[i], after = now.velocity[i];
		const Real inertial = inertia * (after - before) / dt;
		const Real applied = (r.free[i] ? now.force[i] : inertial) - r.force[i], drag = r.free[i] ? now.force[i] - inertial : 0;
		booked += applied * before * dt / 2;
		r.pendingWork += applied * after * dt / 2;
		work.kinetic += inertia * after * before / 2;
		work.dampingBefore += drag * before * dt / 2;
		work.dampingAfter += drag * after * dt / 2;
		r.unbalanced[i] = r.free[i] ? now.force[i] : 0;
	}
	r.work += booked;
	r.workTurnover += std::abs(booked);
	r.centre   = now.centre;
	r.halfTurn = now.halfTurn;
	r.velocity = now.velocity;
	return work;
}

} // namespace blocks
