// yade-blocks, GPL-2.0-or-later

// Random scenes through the step. Run by scripts/fuzz.sh part=scenes.
//   scene_fuzz COUNT SEED [FIRST [soften]]
// soften: joints have fracture energies (part=softening).
// Case i of a seed is the same whatever the count: random cells or polygons that fly, materials over 12 orders of magnitude, joints, damping, safety, loads,
// rigid blocks, contacts on and off. Every scene must be
//   - refused, by an exception whose sentence is counted; or
//   - stopped by the watch, which looks every 50 steps; or
//   - in balance at its end, with the step as drawn or, what is counted apart, with one 2 to 32 times as short, which at least halves what is off (stiff
//     springs that part and meet every few steps): energy within 1 % of what was turned over, friction not having given more than that, and, where
//     nothing acts from outside and nothing is damped, momentum within 1e-12 of the largest sum of |m v|, or within the rounding of the forces summed over the
//     steps, if this is more.
// Everything else is unexplained, is printed with its case, and makes the program fail.

#include <Eigen/Geometry>
#include <blocks/kernel/analysis/Energy.hpp>
#include <blocks/kernel/analysis/StabilityWatch.hpp>
#include <blocks/kernel/geometry/Tessellation.hpp>
#include <blocks/kernel/model/JointDetection.hpp>
#include <blocks/kernel/step/ContactResults.hpp>
#include <blocks/kernel/step/Loads.hpp>
#include <blocks/kernel/step/RigidBlocks.hpp>
#include <blocks/kernel/step/Step.hpp>
#include <blocks/kernel/step/TimeStep.hpp>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <map>
#include <random>

using namespace blocks;

namespace {

struct Dice {
	std::mt19937_64 source;
	Real            operator()(Real low, Real high) { return low + (high - low) * Real(source() >> 11) * 0x1p-53; }
	Real            decades(Real low, Real high) { return std::pow(10, (*this)(low, high)); }
	int             below(int n) { return int(source() % std::uint64_t(n)); }
	bool            chance(Real p) { return (*this)(0, 1) < p; }
};

struct Case {
	BlockAssembly a;
	Damping       damping;
	Real          safety = 0.7, dt = 0;
	bool          free = true, scaled = false; ///< nothing acts from outside; masses are scaled
	int           steps = 0;
	std::string   words;
};

/// A convex polygon as a fan of zones, or rigid.
void addPolygon(BlockAssembly& a, const Ring& ring, int material, bool rigid)
{
	const int        n      = int(ring.size());
	Ring             points = ring;
	std::vector<int> outline(n);
	for (int i = 0; i < n; ++i)
		outline[i] = i;
	std::vector<std::array<int, 3>> zones;
	if (!rigid) {
		Vec2 mean = Vec2::Zero();
		for (const Vec2& p : ring)
			mean += p / n;
		points.push_back(mean);
		for (int i = 0; i < n; ++i)
			zones.push_back({ i, (i + 1) % n, n });
	}
	a.addBlock(points, { outline }, zones, material);
}

Ring roundRing(Dice& dice, const Vec2& centre, Real radius)
{
	Ring       ring;
	const int  corners = 3 + dice.below(6);
	const Real turn    = dice(0, 2 * M_PI);
	for (int k = 0; k < corners; ++k) {
		const Real angle = turn + 2 * M_PI * (k + dice(-0.2, 0.2)) / corners;
		ring.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
	}
	return ring;
}

/// Cells of a tessellation that fill a rectangle, or polygons apart from each other.
void addBlocks(Dice& dice, Case& c, Real size, int materials)
{
	const bool rigid = dice.chance(0.25);
	if (dice.chance(0.5)) {
		TessellationOptions options;
		options.size  = size;
		options.seed  = dice.below(1000000);
		options.lloyd = dice.below(3);
		const Real  w = size * dice(1, 3.5), h = size * dice(1, 3.5);
		const Cells cells = tessellate({ { { 0, 0 }, { w, 0 }, { w, h }, { 0, h } }, {} }, options);
		for (const auto& cell : cells.cells) {
			Ring ring;
			for (int v : cell)
				ring.push_back(cells.vertices[v]);
			addPolygon(c.a, ring, dice.below(materials), rigid && dice.chance(0.3));
		}
		c.words += "cells ";
	} else {
		const int n = 1 + dice.below(3);
		for (int i = 0; i < n; ++i)
			for (int j = 0; j < n; ++j)
				addPolygon(
					c.a,
					roundRing(dice, size * 1.5 * Vec2(i + 1, j + 1), size * dice(0.2, 0.72)),
					dice.below(materials),
					rigid && dice.chance(0.5));
		c.words += "polygons ";
	}
	if (rigid) c.words += "rigid ";
}

JointParams drawnJoint(Dice& dice, Real young, Real size)
{
	JointParams p;
	p.kn               = young / size * dice.decades(-2, 3);
	p.ks               = p.kn * dice.decades(-1, 0.3);
	p.tension          = young * dice.decades(-7, -2);
	p.cohesion         = p.tension * dice.decades(-0.5, 1);
	p.tanPhi           = dice(0, 1.2);
	p.tanPhiResidual   = dice(0, p.tanPhi);
	p.cohesionResidual = dice.chance(0.3) ? dice(0, p.cohesion) : 0;
	if (dice.chance(0.2)) p.tanDilation = dice(0, p.tanPhiResidual);
	return p;
}

void setInMotion(Dice& dice, Case& c, Real speed)
{
	BlockAssembly& a = c.a;
	for (int b = 0; b < a.blockCount(); ++b) {
		const Vec2 v(dice(-speed, speed), dice(-speed, speed));
		const Real spin = dice(-speed, speed) * 0.3;
		if (a.isRigid(b)) continue; // at rest until something meets them
		for (int n = a.mesh.firstNode[b]; n < a.mesh.firstNode[b + 1]; ++n) {
			const Vec2 arm = (a.mesh.reference[n] - a.mesh.reference[a.mesh.firstNode[b]])
				/ (a.mesh.reference[a.mesh.firstNode[b] + 1] - a.mesh.reference[a.mesh.firstNode[b]]).norm();
			a.state.velocity[n] = v + spin * Vec2(-arm.y(), arm.x());
		}
	}
}

/// The same joints with fracture energies, up to a thousand times the least, half of them rising with pressure; a tenth stay brittle, lasting openings are
/// between none and all.
void soften(Dice& dice, Case& c)
{
	for (int i = 0; i < c.a.joints.count(); ++i) {
		const Joint status = c.a.state.status[2 * i];
		JointParams p      = c.a.joints.of(i);
		if (dice.chance(0.1) || !(p.tension > 0)) continue;
		p.cohesion            = std::max(p.cohesion, p.tension * p.tanPhi);
		const Real      least = 2 * std::max(p.tension * p.tension / p.kn, p.cohesion * p.cohesion / p.ks);
		SofteningParams s;
		s.energyI = least * dice.decades(0.01, 3), s.energyII = least * dice.decades(0.01, 3), s.lastingShare = dice(0, 1);
		if (dice.chance(0.5)) s.energyIIPressure = s.energyII / p.cohesion * dice.decades(-2, 1);
		c.a.setJoints(i, i + 1, p, status, s);
	}
}

Case drawn(Dice& dice, bool soft)
{
	Case           c;
	BlockAssembly& a     = c.a;
	const Real     young = dice.decades(3, 12), size = dice.decades(-3, 1);
	a.thickness         = dice.decades(-2, 1);
	a.plane             = dice.chance(0.3) ? Plane::stress : Plane::strain;
	const int materials = 1 + dice.below(2);
	Real      speed     = std::numeric_limits<Real>::infinity();
	for (int i = 0; i < materials; ++i) {
		const Material m { young * dice.decades(-2, 0), dice(-0.3, 0.48), dice.decades(2, 4) };
		a.addMaterial(m);
		speed = std::min(speed, std::sqrt(m.young / m.density));
	}
	addBlocks(dice, c, size, materials);
	a.bond(detectSegments(a));
	const JointParams joint = drawnJoint(dice, young, size);
	if (a.joints.count() > 0) a.setJoints(0, a.joints.count(), joint, dice.chance(0.8) ? Joint::intact : Joint::unbonded);
	a.joints.ofMaterials.assign(materials * materials, a.addKind(neverBonded(joint)));
	const bool contact = dice.chance(0.6);
	if (contact) setGeneralContact(a, true);
	setInMotion(dice, c, speed * dice.decades(-5, -1));
	if (dice.chance(0.3)) addGravity(a, { 0, -speed * speed / size * dice.decades(-6, -3) }), c.free = false, c.words += "gravity ";
	const int kind  = dice.below(5);
	c.damping.kind  = kind < 3 ? Damping::Kind::none : kind == 3 ? Damping::Kind::local : Damping::Kind::adaptive;
	c.damping.alpha = dice(0, 0.8);
	c.safety        = dice(0.1, 1) * largestSafety(c.damping);
	c.scaled        = dice.chance(0.3);
	c.steps         = 200 + dice.below(1500);
	c.words += (contact ? "contact " : "") + std::string(c.scaled ? "scaled " : "") + "damping " + std::to_string(int(c.damping.kind)) + " young "
		+ shown(young, 3) + " size " + shown(size, 3) + " safety " + shown(c.safety, 3) + " blocks " + std::to_string(a.blockCount()) + " steps "
		+ std::to_string(c.steps);
	if (soft) soften(dice, c);
	return c;
}

/// Leapfrog of the rigid blocks under their forces, as NewtonIntegrator does it without damping.
StepWork moveRigid(BlockAssembly& a, Real dt)
{
	gatherRigidForces(a);
	StepWork work;
	for (RigidBlock& r : a.state.rigid) {
		RigidMotion now { r.centre, r.halfTurn, r.velocity, r.force };
		for (int i = 0; i < 3; ++i)
			now.velocity[i] += dt * now.force[i] / (i < 2 ? r.inertia : r.rotaryInertia);
		now.centre += dt * now.velocity.head<2>();
		const Real half = std::atan2(r.halfTurn.y(), r.halfTurn.x()) + dt * now.velocity[2] / 2;
		now.halfTurn    = { std::cos(half), std::sin(half) };
		work += followRigidMotion(a, r, now, dt);
	}
	return work;
}

/// Masses and step for the contacts there are, as BlockMotion chooses them. The kinetic energy that masses bring.
Real adjustStep(Case& c, long& version)
{
	BlockAssembly& a = c.a;
	if (version == a.contacts.version && c.dt > 0) return 0;
	version              = a.contacts.version;
	const Real before    = gridPointsKineticEnergy(a); // what rigid blocks gain is booked as their work
	const auto stiffness = nodalStiffness(a);
	const auto touching  = touchStiffness(a, stiffness);
	const Real trueLimit = std::min(stableTimeStep(a, touching, a.mesh.mass), rigidTimeStep(a, touching, Masses::actual));
	a.contacts.mostAStep = c.scaled ? nearing::scaledMasses : nearing::trueMasses;
	if (c.scaled && c.dt > 0) {
		scaleInertia(a, stiffness, c.dt, c.safety);
		std::vector<Vec3> old;
		for (const RigidBlock& r : a.state.rigid)
			old.push_back({ r.inertia, r.inertia, r.rotaryInertia });
		scaleRigidInertia(a, stiffness, c.dt, c.safety);
		for (size_t i = 0; i < a.state.rigid.size(); ++i) {
			RigidBlock& r = a.state.rigid[i];
			changeInertia(r, old[i], r.velocity);
		}
	} else if (std::isfinite(trueLimit))
		c.dt = c.safety * trueLimit;
	else if (!(c.dt > 0))
		throw std::runtime_error("nothing limits the time step");
	a.updateMobility();
	return gridPointsKineticEnergy(a) - before;
}

struct Momentum {
	Vec2 sum { 0, 0 };
	Real size = 0;
};

Momentum momentumOf(const BlockAssembly& a)
{
	Momentum out;
	for (int n = 0; n < a.nodeCount(); ++n)
		out.sum += a.state.inertia[n] * a.state.velocity[n], out.size += a.state.inertia[n] * a.state.velocity[n].norm();
	for (const RigidBlock& r : a.state.rigid)
		out.sum += r.inertia * r.velocity.head<2>(), out.size += r.inertia * r.velocity.head<2>().norm();
	return out;
}

/// Energy that is none: what joints hold where positions are off by a thousand roundings of the scene's extent.
Real trifle(const BlockAssembly& a)
{
	Eigen::AlignedBox<Real, 2> box;
	for (const Vec2& x : a.mesh.reference)
		box.extend(x);
	const Real off = 1000 * std::numeric_limits<Real>::epsilon() * box.diagonal().norm();
	Real       sum = 0;
	for (int i = 0; i < a.joints.count(); ++i)
		sum += a.joints.of(i).kn * a.joints.segments[i].area * off * off;
	return sum;
}

constexpr int finest = 32; ///< steps as short as this explain what is off with longer ones

const char* const energyOff = "unexplained: energy is off by ";

const char* const strayed = "stopped: it acts on block";

const char* const byFriction = "which friction gave";

/// What became of a scene: empty if it is in balance, "stopped: ..." or "unexplained: ...". off: energy, as a share.
std::string outcome(Case& c, Real& off)
{
	BlockAssembly& a = c.a;
	StabilityWatch watch;
	long           version = -1;
	Real           damping = 0, pending = 0, brought = 0, first = 0, turnover = 0, last = 0, time = 0, rounding = 0, largest = 0;
	Momentum       begin, now;
	adjustStep(c, version);
	for (int step = 0; step < c.steps; ++step) {
		if (a.joints.softening.empty())
			computeForces(a, Brittle {}, c.dt, true);
		else
			computeForces(a, Softening {}, c.dt, true);
		const Real gained = adjustStep(c, version);
		brought += gained;
		if (step == 0) begin = momentumOf(a);
		if (step % 50 == 0) {
			const auto verdict = watch.look(a, step, time, c.dt);
			if (!verdict.stable) return "stopped: " + verdict.reason.substr(0, verdict.reason.find_first_of("0123456789"));
		}
		const Real stored = zoneEnergy(a) + jointEnergy(a), loads = loadWork(a);
		for (const Vec2& f : a.forces.nodal)
			rounding += 100 * std::numeric_limits<Real>::epsilon() * c.dt * f.norm();
		for (int p = 0; p < a.pointCount(); ++p)
			rounding += 10 * std::numeric_limits<Real>::epsilon() * c.dt * a.joints.segments[p / 2].area
				* (std::abs(a.state.sigma[p]) + std::abs(a.state.tau[p]));
		StepWork work = moveRigid(a, c.dt);
		work += move(a, c.damping, c.dt, time, true);
		damping += pending + work.dampingBefore;
		pending = work.dampingAfter;
		time += c.dt;
		const Real friction = a.state.accounts.friction + contactFriction(a),
			   fracture = a.state.accounts.fracture + a.state.softened.modeI + a.state.softened.modeII;
		last                = stored + work.kinetic + damping + friction + fracture - rigidWork(a) - loads - brought;
		if (step == 0) first = last;
		turnover = std::max(turnover, std::abs(stored) + std::abs(work.kinetic) + std::abs(damping) + friction + fracture + std::abs(loads));
		now      = momentumOf(a);
		largest  = std::max(largest, now.size);
	}
	const auto verdict = StabilityWatch::lookAtEnd(a);
	if (!verdict.stable) return "stopped: " + verdict.reason;
	const bool something = turnover > trifle(a);
	off                  = something ? std::abs(last - first) / turnover : 0;
	if (!(off <= 0.01)) return std::string(energyOff) + shown(off, 3) + " of what was turned over";
	const bool undisturbed = c.free && c.damping.kind == Damping::Kind::none && !c.scaled;
	if (undisturbed && !((now.sum - begin.sum).norm() <= std::max(1e-12 * largest, rounding)))
		return "unexplained: momentum is off by " + shown((now.sum - begin.sum).norm() / largest, 3) + " of the sum of |m v|";
	const Real given = something ? -(a.state.accounts.friction + contactFriction(a)) / turnover : 0;
	if (given > 0.01) return off = given, std::string(energyOff) + shown(off, 3) + " of what was turned over, " + byFriction;
	return "";
}

/// With a step so many times as short as drawn.
Case caseOf(long seed, long number, int finer, bool soft)
{
	Dice dice;
	dice.source.seed(std::uint64_t(seed) * 1000003 + std::uint64_t(number) * 7919);
	Case c = drawn(dice, soft);
	c.safety /= finer;
	c.steps *= finer;
	return c;
}

} // namespace

int main(int argc, char** argv)
{
	if (argc < 3) {
		std::cerr << "usage: scene_fuzz COUNT SEED [FIRST [soften]]\n";
		return 2;
	}
	const long                  count = std::atol(argv[1]), seed = std::atol(argv[2]), first = argc > 3 ? std::atol(argv[3]) : 0;
	const bool                  soft = argc > 4 && std::string(argv[4]) == "soften";
	std::map<std::string, long> outcomes;
	long                        unexplained = 0;
	for (long i = first; i < first + count; ++i) {
		std::string text, words;
		try {
			Case c   = caseOf(seed, i, 1, soft);
			words    = c.words;
			Real off = 0;
			text     = outcome(c, off);
			for (int finer = 2; text.rfind(energyOff, 0) == 0 && finer <= finest; finer *= 2) { // is it the step?
				Case        again = caseOf(seed, i, finer, soft);
				Real        less  = 0;
				std::string then  = outcome(again, less);
				if (then.empty() && less < off / 2) text = "in balance with steps " + std::to_string(finer) + " times as short";
				if (then.rfind(strayed, 0) == 0)
					text = then + ", seen with steps " + std::to_string(finer) + " times as short"; // between two looks
			}
		} catch (const std::exception& error) {
			const std::string sentence = error.what();
			text                       = "refused: " + sentence.substr(0, sentence.find_first_of("0123456789"));
		}
		++outcomes[text.empty() ? "in balance" : text.substr(0, text.find(" by ") == std::string::npos ? text.size() : text.find(" by "))];
		if (text.rfind("unexplained", 0) != 0) continue;
		++unexplained;
		std::cout << text << ", case " << i << ": " << words << std::endl;
	}
	std::cout << "scenes: " << count << " of seed " << seed << "\n";
	for (const auto& [text, n] : outcomes)
		std::cout << "  " << n << " " << text << "\n";
	std::cout << "unexplained " << unexplained << "\n";
	return unexplained ? 1 : 0;
}
