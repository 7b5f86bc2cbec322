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
			work = integrate(a, damping, dt, step * dt, true, threads);
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

inline void moveSecond(BlockAssembly& a, const Vec2& u)
{
	for (int n = a.mesh.firstNode[1]; n < a.nodeCount(); ++n)
		a.state.displacement[n] += u, a.state.velocity[n] = u;
}

/// Slips of 4e-7 m, with the joint's law alone.
inline void slideSecond(BlockAssembly& a, int steps)
{
	for (int i = 0; i < steps; ++i) {
		moveSecond(a, 4e-7 * along);
		updateKinematics(a, { 0, 1 });
		advanceStresses(a, jointsOf(a, 0), Brittle {});
	}
}

/// Nodal forces of the joint as it is, everything stopped.
inline std::vector<Vec2> forcesAtRest(BlockAssembly& a)
{
	for (Vec2& v : a.state.velocity)
		v.setZero();
	sumForces(a);
	return a.forces.nodal;
}

/// Largest change of the force on block 1 from step to step when it is moved along `path` in `count` steps, frictionless; by the largest force.
inline Real roughness(const BlockAssembly& start, const std::function<Vec2(Real)>& path, int count, Real turn = 0)
{
	BlockAssembly a = start;
	Vec2          before;
	Real          jump = 0, largest = 0;
	for (int i = 0; i <= count; ++i) {
		const Real s = Real(i) / count;
		for (int n = a.mesh.firstNode[1]; n < a.mesh.firstNode[2]; ++n)
			a.state.displacement[n] = start.state.displacement[n];
		moveBlock(a, 1, path(s), turn * s);
		computeAllForces(a, frictional(1e6, 1e6, 0), 0);
		const Vec2 f = contactForce(a, 1);
		if (i) jump = std::max(jump, (f - before).norm());
		largest = std::max(largest, f.norm());
		before  = f;
	}
	return jump / largest;
}

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

struct Stress {
	int  poses = 0, touched = 0;
	Real gain      = 0; ///< worst, of what there was
	Real lost      = 0; ///< worst imbalance of energy and friction, of what there was
	long edgePairs = 0, active = 0;
};

/// Two random polygons each time: slivers, tiny edges, reentrant corners, shared vertices and edges, started in touch or overlapping.
inline Stress stress(int count, int steps, unsigned seed)
{
	Stress                               result;
	std::mt19937                         random(seed);
	std::uniform_real_distribution<Real> u(-1, 1);
	for (int pose = 0; pose < count; ++pose) {
		auto polygon = [&] {
			const int kind = int(random() % 5);
			Ring      ring = randomPolygon(random, 0.5, 3 + int(random() % 6), kind == 0 ? 0.04 : 1);
			if (kind == 1) { // a corner cut by a tiny edge
				const size_t i = random() % ring.size(), n = ring.size();
				const Vec2   p = ring[i], next = ring[(i + 1) % n], last = ring[(i + n - 1) % n];
				ring[i] = p + 1e-3 * (next - p);
				ring.insert(ring.begin() + long(i), p + 1e-3 * (last - p));
			}
			if (kind == 2) { // a grid point in the middle of an edge
				const size_t i = random() % ring.size();
				ring.insert(ring.begin() + long(i) + 1, Vec2((ring[i] + ring[(i + 1) % ring.size()]) / 2));
			}
			if (kind == 3) { // a corner that bends inward a little
				const size_t i = random() % ring.size();
				const Vec2   p = ring[i], q = ring[(i + 1) % ring.size()], e = q - p;
				ring.insert(ring.begin() + long(i) + 1, Vec2((p + q) / 2 + 0.05 * Vec2(-e.y(), e.x())));
			}
			return ring;
		};
		auto usable = [](const Ring& ring) { // addFan's zones must not overlap
			const Vec2 inner = 0.9 * mean(ring) + 0.1 * ring[0];
			for (size_t i = 0; i < ring.size(); ++i)
				if (cross(ring[i] - inner, ring[(i + 1) % ring.size()] - inner) <= 0) return false;
			return true;
		};
		Ring first = polygon(), second = polygon();
		while (!usable(first))
			first = polygon();
		while (!usable(second))
			second = polygon();
		const Vec2 apart(std::cos(6 * u(random)), std::sin(6 * u(random)));
		switch (random() % 4) {
		case 0:
			second = shifted(second, 0.9 * apart);
			break;
		case 1:
			second = shifted(second, first[0] * 1.0 - second[second.size() / 2]);
			break; // vertex upon vertex
		case 2: {      // its mirror image across an edge
			const Vec2 p = first[0], e = (first[1] - first[0]).normalized();
			second.clear();
			for (auto it = first.rbegin(); it != first.rend(); ++it) {
				const Vec2 d = *it - p;
				second.push_back(p + 2 * d.dot(e) * e - d);
			}
			if (!usable(second)) second = shifted(box(0, 0, 0.3, 0.4), first[0]); // another inner point
			break;
		}
		default:
			second = shifted(second, 1.05 * apart);
		}
		BlockAssembly a = scene(5e7);
		if (random() % 3)
			addFan(a, first);
		else
			addRigid(a, first);
		addFan(a, second);
		Simulation run(a, frictional(1e6, 5e5, (pose % 3) * 15 * degree), 0.5);
		for (int b : { 0, 1 })
			if (a.mesh.firstZone[b] < a.mesh.firstZone[b + 1])
				setVelocity(a, b, 0.5 * Vec2(u(random), u(random)) + (b ? -0.3 : 0.3) * apart, u(random));
		Real start = 0, most = 0, imbalance = 0;
		bool touched = false;
		run.steps(steps, [&](Real energy) {
			if (run.step == 0) start = energy;
			most      = std::max(most, energy);
			imbalance = std::max(imbalance, std::abs(energy + contactFriction(a) - start));
			for (int c : a.contacts.order)
				for (const EdgePair& e : a.state.contacts[c].edges)
					touched |= e.touching, ++result.edgePairs, result.active += e.touching;
		});
		EXPECT_EQ(a.firstBadNode(), -1) << "pose " << pose;
		const Real gain = most / start - 1;
		if (gain > 0.01) std::printf("pose %d gains %.3f\n", pose, gain);
		result.gain = std::max(result.gain, gain);
		result.lost = std::max(result.lost, imbalance / start);
		result.touched += touched;
		++result.poses;
	}
	return result;
}

} // namespace contacts
