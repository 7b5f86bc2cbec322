// yade-blocks, GPL-2.0-or-later
#pragma once
#include <Specimens.hpp>
#include <blocks/kernel/analysis/StabilityWatch.hpp>
#include <blocks/kernel/step/ContactResults.hpp>
#include <blocks/kernel/step/TimeStep.hpp>

/// Scenes of blocks that touch without a bond.
namespace contacts {

using namespace specimens;

constexpr Real degree = M_PI / 180;

/// A joint that was never bonded.
inline JointParams frictional(Real kn, Real ks, Real phi)
{
	JointParams p;
	p.kn     = kn;
	p.ks     = ks;
	p.tanPhi = p.tanPhiResidual = std::tan(phi);
	return p;
}

inline BlockAssembly scene(Real young = 1e8, Real thickness = 1, Real density = 2000)
{
	BlockAssembly a;
	a.thickness = thickness;
	a.addMaterial({ young, 0.2, density });
	return a;
}

/// A polygon without zones; nobody moves it unless the test does.
inline int addRigid(BlockAssembly& a, const Ring& ring)
{
	std::vector<int> outline(ring.size());
	for (size_t i = 0; i < ring.size(); ++i)
		outline[i] = int(i);
	return a.addBlock(ring, { outline }, {}, 0);
}

inline Ring box(Real x, Real y, Real w, Real h) { return { { x, y }, { x + w, y }, { x + w, y + h }, { x, y + h } }; }

/// General contact in a scene of one material.
inline void wantContacts(BlockAssembly& a, const JointParams& joint)
{
	a.contacts.wanted    = true;
	a.joints.ofMaterials = { int(a.joints.kinds.size()) };
	a.joints.kinds.push_back(joint);
}

/// Everything between positions and forces, in a scene with free contacts.
inline void computeAllForces(BlockAssembly& a, const JointParams& joint, Real dt, int threads = 1)
{
	if (!a.contacts.wanted) wantContacts(a, joint);
	blocks::computeForces(a, Brittle {}, dt, false, threads);
}

/// A run without damping unless told; `each(step)` sees the state of the forces.
struct Simulation {
	BlockAssembly& a;
	JointParams    joint;
	Real           dt;
	Damping        damping;
	StepWork       work;
	int            threads = 1;
	long           step    = 0;

	Simulation(BlockAssembly& assembly, const JointParams& p, Real safety = 0.3, Real alpha = -1)
		: a(assembly)
		, joint(p)
	{
		damping.kind  = alpha < 0 ? Damping::Kind::none : Damping::Kind::local;
		damping.alpha = std::max(alpha, Real(0));
		computeAllForces(a, joint, 0); // makes the contacts, on which the time step depends
		dt = safety * boundedStep();
	}
	/// Another assembly, in the same state as the first.
	Simulation(BlockAssembly& assembly, const Simulation& o)
		: a(assembly)
		, joint(o.joint)
		, dt(o.dt)
		, damping(o.damping)
		, step(o.step)
	{
	}
	/// As if every pair of blocks touched.
	Real boundedStep()
	{
		BlockAssembly b = a;
		for (int i = 0; i < b.blockCount(); ++i)
			for (int j = i + 1; j < b.blockCount(); ++j)
				if (contactOf(b, i, j) < 0) {
					FreeContact c;
					c.block = { i, j };
					c.joint = joint;
					b.state.contacts.all().push_back(c);
					b.contacts.order.push_back(int(b.state.contacts.size()) - 1);
				}
		return stableTimeStep(b, nodalStiffness(b), b.mesh.mass);
	}
	template <class Each> void steps(long count, const Each& each)
	{
		for (long i = 0; i < count; ++i, ++step) {
			computeAllForces(a, joint, dt, threads);
			const BlockAssembly* before = &a;
			const Real           stored = zoneEnergy(*before) + jointEnergy(*before), loads = loadWork(*before);
			for (int n = 0; n < a.nodeCount(); ++n) // blocks without mass that a test moves
				if (a.mesh.mass[n] == 0) a.state.velocity[n] = rigidVelocity(n);
			work = move(a, damping, dt, step * dt, true, threads);
			each(stored + work.kinetic - loads);
		}
	}
	void steps(long count)
	{
		steps(count, [](Real) {});
	}
	std::function<Vec2(int)> rigidVelocity = [](int) { return Vec2(0, 0); };
};

inline void moveBlock(BlockAssembly& a, int block, const Vec2& shift, Real angle = 0)
{
	const Vec2 centre = a.centroid(block);
	rotateAbout(a, centre, angle, shift, a.mesh.firstNode[block], a.mesh.firstNode[block + 1]);
}

inline void setVelocity(BlockAssembly& a, int block, const Vec2& v, Real spin = 0)
{
	const Vec2 centre = a.centroid(block);
	for (int n = a.mesh.firstNode[block]; n < a.mesh.firstNode[block + 1]; ++n)
		a.state.velocity[n] = v + spin * Vec2(-(a.position(n) - centre).y(), (a.position(n) - centre).x());
}

inline Vec2 meanVelocity(const BlockAssembly& a, int block)
{
	Vec2 p = Vec2::Zero();
	Real m = 0;
	for (int n = a.mesh.firstNode[block]; n < a.mesh.firstNode[block + 1]; ++n)
		p += a.mesh.mass[n] * a.state.velocity[n], m += a.mesh.mass[n];
	return p / m;
}

/// A convex polygon with corners on a circle, some of them close to each other.
inline Ring randomPolygon(std::mt19937& random, Real radius, int corners, Real squeeze = 1)
{
	std::uniform_real_distribution<Real> u(0, 1);
	std::vector<Real>                    angles;
	for (int i = 0; i < corners; ++i)
		angles.push_back(2 * M_PI * (i + 0.8 * u(random)) / corners);
	const Real turn = 2 * M_PI * u(random);
	Ring       ring;
	for (Real w : angles) {
		const Vec2 p(radius * std::cos(w), squeeze * radius * std::sin(w));
		ring.push_back({ p.x() * std::cos(turn) - p.y() * std::sin(turn), p.x() * std::sin(turn) + p.y() * std::cos(turn) });
	}
	return ring;
}

inline Ring shifted(Ring ring, const Vec2& by)
{
	for (Vec2& p : ring)
		p += by;
	return ring;
}

// Along the joint of twoBlocks and out of the first one.
inline const Vec2 along = Vec2(0.3, 0.8).normalized(), normal(along.y(), -along.x());

/// Blocks that fall into a trough.
inline BlockAssembly heap(int count)
{
	std::mt19937  random(9);
	BlockAssembly a = scene(1e8, 1);
	addRigid(a, { { -2, -0.5 }, { 2, -0.5 }, { 2, 0.4 }, { 1, 0 }, { -1, 0 }, { -2, 0.4 } });
	for (int i = 0; i < count; ++i)
		addFan(a, shifted(randomPolygon(random, 0.2, 3 + i % 5), { -0.8 + 0.41 * (i % 5), 0.35 + 0.42 * (i / 5) }));
	addGravity(a, { 0, -9.81 });
	for (int i = 1; i <= count; ++i)
		setVelocity(a, i, { 0.3 * (i % 3 - 1), -0.5 }, i % 4 - 1.5);
	return a;
}

inline void expectSameBits(const BlockAssembly& a, const BlockAssembly& b)
{
	for (int n = 0; n < a.nodeCount(); ++n) {
		ASSERT_EQ(a.state.displacement[n], b.state.displacement[n]) << n;
		ASSERT_EQ(a.forces.nodal[n], b.forces.nodal[n]) << n;
	}
}

} // namespace contacts
