// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/analysis/Energy.hpp>
#include <blocks/kernel/geometry/Tessellation.hpp>
#include <blocks/kernel/model/JointDetection.hpp>
#include <blocks/kernel/step/Loads.hpp>
#include <blocks/kernel/step/Step.hpp>
#include <blocks/kernel/step/TimeStep.hpp>
#include <blocks/kernel/step/ZoneForces.hpp>

#include <Eigen/Dense>
#include <functional>
#include <gtest/gtest.h>
#include <random>

/// Little assemblies for the kernel's tests, and what several tests need to look at them.
namespace specimens {

using namespace blocks;

constexpr Real eps = std::numeric_limits<Real>::epsilon();

inline Material stone() { return { 20e9, 0.2, 2000 }; }

/// Strengths so high that nothing breaks.
inline JointParams elasticJoint(Real kn, Real ks)
{
	JointParams p;
	p.kn       = kn;
	p.ks       = ks;
	p.cohesion = p.tension = 1e30;
	return p;
}

inline Vec2 mean(const Ring& ring)
{
	Vec2 sum = Vec2::Zero();
	for (const Vec2& p : ring)
		sum += p;
	return sum / Real(ring.size());
}

/// A convex polygon as a fan of zones about one inner point, a little beside the mean of its corners. Nodes: corners, inner point.
inline int addFan(BlockAssembly& a, const Ring& ring, int material = 0)
{
	Ring      points = ring;
	const int n      = int(ring.size());
	points.push_back(0.9 * mean(ring) + 0.1 * ring[0]);
	std::vector<int>                outline(n);
	std::vector<std::array<int, 3>> zones;
	for (int i = 0; i < n; ++i) {
		outline[i] = i;
		zones.push_back({ i, (i + 1) % n, n });
	}
	return a.addBlock(points, { outline }, zones, material);
}

/// A rectangle of nx x ny cells of two zones each. Node (i, j) is j (nx + 1) + i of the block.
inline int addGrid(BlockAssembly& a, Vec2 corner, Real width, Real height, int nx, int ny, int material = 0)
{
	std::vector<Vec2>               points;
	std::vector<std::array<int, 3>> zones;
	std::vector<int>                outline;
	auto                            id = [&](int i, int j) { return j * (nx + 1) + i; };
	for (int j = 0; j <= ny; ++j)
		for (int i = 0; i <= nx; ++i)
			points.push_back(corner + Vec2(width * i / nx, height * j / ny));
	for (int j = 0; j < ny; ++j)
		for (int i = 0; i < nx; ++i) {
			zones.push_back({ id(i, j), id(i + 1, j), id(i + 1, j + 1) });
			zones.push_back({ id(i, j), id(i + 1, j + 1), id(i, j + 1) });
		}
	for (int i = 0; i < nx; ++i)
		outline.push_back(id(i, 0));
	for (int j = 0; j < ny; ++j)
		outline.push_back(id(nx, j));
	for (int i = nx; i > 0; --i)
		outline.push_back(id(i, ny));
	for (int j = ny; j > 0; --j)
		outline.push_back(id(0, j));
	return a.addBlock(points, { outline }, zones, material);
}

inline void bondAll(BlockAssembly& a, const JointParams& joint)
{
	a.bond(detectSegments(a));
	a.setJoints(joint);
}

/// Two quadrilaterals of unequal size and mesh that share the skew edge (1, 0)-(1.3, 0.8); their zones are lopsided.
inline BlockAssembly twoBlocks(const JointParams& joint, Real thickness = 0.7)
{
	BlockAssembly a;
	a.thickness = thickness;
	a.addMaterial(stone());
	addFan(a, { { 0, 0.1 }, { 1, 0 }, { 1.3, 0.8 }, { 0.2, 0.9 } });
	addFan(a, { { 1, 0 }, { 2.1, -0.2 }, { 1.9, 0.4 }, { 1.8, 1.0 }, { 1.3, 0.8 } });
	bondAll(a, joint);
	return a;
}

/// n rectangles of w x h on top of each other (bottom at y = 0), each of nx x ny cells of two zones.
inline BlockAssembly column(int n, Real w, Real h, int nx, int ny, const Material& m, const JointParams& joint, Real thickness = 1)
{
	BlockAssembly a;
	a.thickness = thickness;
	a.addMaterial(m);
	for (int i = 0; i < n; ++i)
		addGrid(a, { 0, i * h }, w, h, nx, ny);
	bondAll(a, joint);
	return a;
}

/// All forces of free contacts on a block.
inline Vec2 contactForce(const BlockAssembly& a, int block)
{
	std::vector<Vec2> f(a.nodeCount(), Vec2::Zero());
	gatherContactForces(a, block, f.data());
	Vec2 sum = Vec2::Zero();
	for (const Vec2& v : f)
		sum += v;
	return sum;
}

inline Polygon rectangle(Real w, Real h) { return { { { 0, 0 }, { w, 0 }, { w, h }, { 0, h } }, {} }; }

/// `count` points in a rectangle, on a jittered grid so that none are close to each other.
inline std::vector<Vec2> jitteredSeeds(Real w, Real h, int nx, int ny, Real jitter, unsigned seed)
{
	std::mt19937                         random(seed);
	std::uniform_real_distribution<Real> shift(-jitter / 2, jitter / 2);
	std::vector<Vec2>                    seeds;
	for (int j = 0; j < ny; ++j)
		for (int i = 0; i < nx; ++i) {
			const Real dx = shift(random), dy = shift(random);
			seeds.push_back({ w * (i + 0.5 + dx) / nx, h * (j + 0.5 + dy) / ny });
		}
	return seeds;
}

/// Voronoi cells of a w x h rectangle, each a fan of zones. With `seedOf`, the seed of every block; nothing is merged then.
inline BlockAssembly
voronoi(Real w, Real h, int nx, int ny, const Material& m, const JointParams& joint, Real thickness, std::vector<Vec2>* seedOf = nullptr, unsigned seed = 7)
{
	TessellationOptions options;
	options.seeds         = jitteredSeeds(w, h, nx, ny, 0.7, seed);
	options.size          = std::sqrt(w * h / (nx * ny));
	options.lloyd         = 0;
	options.mergeFraction = seedOf ? 0 : 0.1;
	const Cells   cells   = tessellate(rectangle(w, h), options);
	BlockAssembly a;
	a.thickness = thickness;
	a.addMaterial(m);
	for (size_t i = 0; i < cells.cells.size(); ++i) {
		const Ring ring = ringOf(cells, i);
		addFan(a, ring);
		if (seedOf) { // a Voronoi cell holds the seed that is closest to any of its inner points
			auto closer = [x = mean(ring)](const Vec2& p, const Vec2& q) { return (p - x).squaredNorm() < (q - x).squaredNorm(); };
			seedOf->push_back(*std::min_element(options.seeds.begin(), options.seeds.end(), closer));
		}
	}
	bondAll(a, joint);
	return a;
}

/// Everything between positions and forces.
inline void computeForces(BlockAssembly& a, int threads = 1) { blocks::computeForces(a, Brittle {}, 0, false, threads); }

/// What a joint that is not released exerts on a1, b1, a2, b2, by the stresses in the state [N].
inline std::array<Vec2, 4> forcesOfJoint(const BlockAssembly& a, int joint)
{
	JointBatch b;
	gatherDisplacements(a, joint, 1, b);
	moveJoints(a.joints.columns, joint, 1, b);
	step::loadStresses(a, joint, 1, b);
	loadEdges(a.joints.columns, joint, 1, b);
	std::array<Vec2, 4> on;
	for (int k = 0; k < 4; ++k)
		on[k] = { b.force.x[k][0], b.force.y[k][0] };
	return on;
}

inline Real storedEnergy(const BlockAssembly& a) { return zoneEnergy(a) + jointEnergy(a); }

inline void rotateAbout(BlockAssembly& a, Vec2 centre, Real angle, Vec2 shift, int firstNode = 0, int lastNode = -1)
{
	Eigen::Matrix<Real, 2, 2> r;
	r << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
	for (int n = firstNode; n < (lastNode < 0 ? a.nodeCount() : lastNode); ++n)
		a.place(n, centre + r * (a.position(n) - centre) + shift);
}

inline Vec2 totalForce(const BlockAssembly& a)
{
	Vec2 sum = Vec2::Zero();
	for (const Vec2& f : a.forces.nodal)
		sum += f;
	return sum;
}

inline Real totalMoment(const BlockAssembly& a)
{
	Real sum = 0;
	for (int n = 0; n < a.nodeCount(); ++n)
		sum += cross(a.position(n), a.forces.nodal[n]);
	return sum;
}

inline Real largestForce(const BlockAssembly& a)
{
	Real largest = 0;
	for (const Vec2& f : a.forces.nodal)
		largest = std::max(largest, f.cwiseAbs().maxCoeff());
	return largest;
}

/// -df/dx by central differences of step d [m]. Exact but for rounding where forces are linear.
inline Eigen::MatrixXd stiffnessMatrix(BlockAssembly a, Real d)
{
	const int       n = 2 * a.nodeCount();
	Eigen::MatrixXd k(n, n);
	Real* const     x = a.state.displacement.data()->data();
	const auto      f = Eigen::Map<Eigen::VectorXd>(a.forces.nodal.data()->data(), n);
	for (int j = 0; j < n; ++j) {
		const Real at = x[j];
		x[j]          = at - d;
		computeForces(a);
		const Eigen::VectorXd before = f;
		x[j]                         = at + d;
		computeForces(a);
		k.col(j) = (before - f) / (2 * d);
		x[j]     = at;
	}
	return (k + k.transpose()) / 2;
}

/// Angular frequencies (ascending) and modes of the free degrees of freedom; `free` gets their numbers.
struct Modes {
	Eigen::VectorXd  omega;
	Eigen::MatrixXd  shape; ///< of the free degrees of freedom
	std::vector<int> free;
};

inline Modes modes(const BlockAssembly& a, Real d)
{
	Modes m;
	for (int i = 0; i < 2 * a.nodeCount(); ++i)
		if (a.supports.mobility[i / 2][i % 2] > 0) m.free.push_back(i);
	const Eigen::MatrixXd all = stiffnessMatrix(a, d);
	const int             n   = int(m.free.size());
	Eigen::MatrixXd       k(n, n), mass = Eigen::MatrixXd::Zero(n, n);
	for (int i = 0; i < n; ++i) {
		mass(i, i) = 1 / a.supports.mobility[m.free[i] / 2][m.free[i] % 2];
		for (int j = 0; j < n; ++j)
			k(i, j) = all(m.free[i], m.free[j]);
	}
	Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(k, mass);
	m.omega = solver.eigenvalues().cwiseMax(0).cwiseSqrt();
	m.shape = solver.eigenvectors();
	return m;
}

/// Newton's method to the equilibrium of the free degrees of freedom, with the stiffness at the start. Three of them are held
/// where nothing else holds the specimen, so loads must balance.
inline void solveStatics(BlockAssembly& a, Real d, bool holdThree, int iterations = 3)
{
	const Vec2       arm    = a.position(1) - a.position(0);
	const int        across = std::abs(arm.x()) > std::abs(arm.y()) ? 3 : 2; // of node 1, across the line from node 0
	std::vector<int> free;
	for (int i = 0; i < 2 * a.nodeCount(); ++i)
		if (a.supports.mobility[i / 2][i % 2] > 0 && !(holdThree && (i < 2 || i == across))) free.push_back(i);
	const Eigen::MatrixXd all = stiffnessMatrix(a, d);
	const int             n   = int(free.size());
	Eigen::MatrixXd       k(n, n);
	for (int i = 0; i < n; ++i)
		for (int j = 0; j < n; ++j)
			k(i, j) = all(free[i], free[j]);
	const Eigen::LDLT<Eigen::MatrixXd> solver(k);
	for (int iteration = 0; iteration < iterations; ++iteration) {
		computeForces(a);
		Eigen::VectorXd f(n);
		for (int i = 0; i < n; ++i)
			f[i] = a.forces.nodal[free[i] / 2][free[i] % 2];
		const Eigen::VectorXd u = solver.solve(f);
		for (int i = 0; i < n; ++i)
			a.state.displacement[free[i] / 2][free[i] % 2] += u[i];
	}
}

/// Stress of a zone in its own axes.
inline ZoneStress stressOfZone(const BlockAssembly& a, int zone)
{
	return zoneStress(moduliOf(a, a.blockOfNode(a.mesh.zoneNodes[zone][0])), strainOf(a, zone));
}

/// Boundary edges without a neighbour: on the outline of a w x h rectangle, with the outward normal.
template <class Visit> void forEachOuterEdge(const BlockAssembly& a, Real w, Real h, const Visit& visit)
{
	const Real near = 1e-9 * (w + h);
	for (int i = 0; i < int(a.mesh.edgeNodes.size()); ++i) {
		const Vec2 p = a.mesh.reference[a.mesh.edgeNodes[i][0]], q = a.mesh.reference[a.mesh.edgeNodes[i][1]];
		if (std::abs(p.x()) < near && std::abs(q.x()) < near) visit(i, Vec2(-1, 0));
		if (std::abs(p.x() - w) < near && std::abs(q.x() - w) < near) visit(i, Vec2(1, 0));
		if (std::abs(p.y()) < near && std::abs(q.y()) < near) visit(i, Vec2(0, -1));
		if (std::abs(p.y() - h) < near && std::abs(q.y() - h) < near) visit(i, Vec2(0, 1));
	}
}

/// The degrees of freedom of one axis of the nodes for which `here(reference position)` holds.
template <class Where> std::vector<int> dofs(const BlockAssembly& a, int axis, const Where& here)
{
	std::vector<int> list;
	for (int n = 0; n < a.nodeCount(); ++n)
		if (here(a.mesh.reference[n])) list.push_back(2 * n + axis);
	return list;
}

inline MotionGroup driven(const std::string& name, std::vector<int> dofs, Real velocity, Real rampTime = 0)
{
	MotionGroup g;
	g.name     = name;
	g.dofs     = std::move(dofs);
	g.target   = velocity;
	g.rampTime = rampTime;
	return g;
}

inline MotionGroup pushed(const std::string& name, std::vector<int> dofs, Real force, Real rampTime = 0)
{
	MotionGroup g = driven(name, std::move(dofs), force, rampTime);
	g.drive       = MotionGroup::Drive::force;
	return g;
}

/// A lopsided triangle in small strain, so that forces are linear to rounding.
inline BlockAssembly triangle()
{
	BlockAssembly a;
	a.strain    = Strain::small;
	a.thickness = 0.4;
	a.addMaterial({ 2000, 0.3, 5 });
	a.addBlock({ { 0.1, 0 }, { 1.2, 0.3 }, { 0.4, 0.9 } }, { { 0, 1, 2 } }, { { 0, 1, 2 } }, 0);
	return a;
}

/// One degree of freedom left free: y of node 2.
inline BlockAssembly oscillator()
{
	BlockAssembly a = triangle();
	a.addGroup(driven("rest", { 0, 1, 2, 3, 4 }, 0));
	return a;
}

inline Damping damped(Damping::Kind kind, Real alpha = 0.3)
{
	Damping d;
	d.kind  = kind;
	d.alpha = alpha;
	return d;
}

/// Damped steps until the unbalanced ratio is below `target`; the number of steps, or -1 if `most` did not do.
inline int relax(BlockAssembly& a, Damping damping, Real dt, Real target, int most)
{
	for (int i = 0; i < most; ++i) {
		computeForces(a);
		if (i % 10 == 0 && i > 0 && unbalancedRatio(a, 1e-300) < target) return i;
		move(a, damping, dt, i * dt);
	}
	return -1;
}

/// The call must be refused by a sentence that holds all of `parts`: what, the rule and the value.
inline void expectRefusal(const std::function<void()>& call, const std::vector<std::string>& parts)
{
	try {
		call();
	} catch (const std::invalid_argument& e) {
		for (const std::string& part : parts)
			EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << "\"" << part << "\" is not in: " << e.what();
		return;
	}
	ADD_FAILURE() << "not refused: " << (parts.empty() ? "" : parts[0]);
}

/// A point of an edge, as the segment's weights say.
inline Vec2 host(const BlockAssembly& a, const Segment& g, int side, int k)
{
	const Real s = side == 0 ? g.s1[k] : g.s2[k];
	return (1 - s) * a.position(g.node[2 * side]) + s * a.position(g.node[2 * side + 1]);
}

/// A stone in large deformation: every node somewhere else, both blocks turned, the joint open and sheared.
inline void disturb(BlockAssembly& a, Real amount, unsigned seed = 3)
{
	std::mt19937                         random(seed);
	std::uniform_real_distribution<Real> shift(-amount, amount);
	for (Vec2& x : a.state.displacement) {
		const Real dx = shift(random), dy = shift(random);
		x += Vec2(dx, dy);
	}
}

/// Joint forces alone on every node.
inline std::vector<Vec2> jointForces(BlockAssembly& a)
{
	computeForces(a);
	std::vector<Vec2> force(a.nodeCount(), Vec2::Zero());
	for (size_t i = 0; i < a.joints.segments.size(); ++i)
		for (int k = 0; k < 4; ++k)
			force[a.joints.segments[i].node[k]] += forcesOfJoint(a, int(i))[k];
	return force;
}

inline BlockAssembly emptyAssembly(Real thickness)
{
	BlockAssembly a;
	a.thickness = thickness;
	a.addMaterial(stone());
	return a;
}

} // namespace specimens
