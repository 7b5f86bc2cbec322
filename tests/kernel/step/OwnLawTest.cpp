// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>

/// How to write a joint law of one's own: a function of the joint's parameters, its state, opening and slip. Nothing else is needed:
/// blocks::computeForces(assembly, law, dt) calls it at every contact point of every joint.

using namespace specimens;

namespace {

/// Mode I with linear softening: sigma = kn un up to the strength f = tension, then down a straight line to zero at un = w, and back
/// and forth along the secant from the origin: sigma = (1 - D) kn un in opening, D = max over time of w (un - e) / (un (w - e)), e = f / kn.
/// Closed, it is elastic. The damage is kept in JointState::uplift, which a law without dilation may use as it likes [-].
struct LinearSoftening {
	Real w; ///< opening beyond which nothing is carried [m]

	JointStep operator()(const JointParams& p, JointState state, Real un, Real us) const
	{
		const Real e = p.tension / p.kn;
		if (un > e) {
			state.uplift = std::max(state.uplift, std::min(Real(1), w * (un - e) / (un * (w - e))));
			state.status = Joint::brokenInTension;
		}
		const Real whole = 1 - state.uplift;
		return { (un > 0 ? whole : 1) * p.kn * un, whole * p.ks * us, state };
	}
};

constexpr Real kn = 50e9, strength = 1e6, w = 1e-4, thickness = 0.5, width = 0.8, height = 0.6;

/// Two bricks, one upon the other, nu = 0.
BlockAssembly twoBlocks()
{
	BlockAssembly a;
	a.thickness                = thickness;
	const int stoneOfNoPoisson = a.addMaterial({ 20e9, 0, 2000 });
	addGrid(a, { 0, 0 }, width, height, 2, 1, stoneOfNoPoisson);
	addGrid(a, { 0, height }, width, height, 2, 1, stoneOfNoPoisson);
	JointParams joint = elasticJoint(kn, kn / 2);
	joint.tension     = strength;
	bondAll(a, joint);
	return a;
}

void lift(BlockAssembly& a, Real opening)
{
	for (int n = a.mesh.firstNode[1]; n < a.mesh.firstNode[2]; ++n)
		a.place(n, a.mesh.reference[n] + Vec2(0, opening));
	blocks::computeForces(a, LinearSoftening { w }, 0);
}

/// The joint's pull on the lower block [N].
Real pull(const BlockAssembly& a)
{
	Real sum = 0;
	for (int n = a.mesh.firstNode[0]; n < a.mesh.firstNode[1]; ++n)
		sum += a.forces.nodal[n].y();
	return sum;
}

} // namespace

// Up, down along the secant, up again, closed: against the closed curve. Openings are differences of positions of order 1, known to
// 2 eps; times the steepest slope kn and the area, and as much for the few roundings of the sum.
TEST(OwnLaw, LinearSofteningOfTwoRigidlyMovedBlocks)
{
	const Real    area = width * thickness, tolerance = 4 * eps * kn * area + 20 * eps * strength * area, e = strength / kn;
	BlockAssembly a     = twoBlocks();
	const auto    curve = [&](Real un) { return un < e ? kn * un : un < w ? strength * (w - un) / (w - e) : 0; };
	Real          work = 0, last = 0;
	const int     steps = 240; // a multiple of w/e = 5: a step ends at the peak
	for (int i = 1; i <= steps; ++i) {
		const Real un = 1.2 * w * i / steps;
		lift(a, un);
		ASSERT_NEAR(pull(a), area * curve(un), tolerance) << "un = " << un;
		work += (last + pull(a)) / 2 * 1.2 * w / steps;
		last = pull(a);
		if (i == 80) { // un = 0.4 w: unloads to 0.25 w and to zero along the secant, closes, returns
			for (Real back : { 0.25 * w, 0.0, 0.25 * w }) {
				lift(a, back);
				EXPECT_NEAR(pull(a), area * curve(un) * back / un, tolerance);
			}
			lift(a, -0.1 * w);
			EXPECT_NEAR(pull(a), -area * kn * 0.1 * w, tolerance);
		}
	}
	// the fracture energy is the area below: f w / 2; the trapezoidal rule is exact on straight lines whose ends are steps (e and w are)
	EXPECT_NEAR(work, area * strength * w / 2, steps * tolerance * w);
	for (Joint status : a.state.status)
		EXPECT_EQ(status, Joint::brokenInTension);
}

// The same law in the loop of a time step, with deformable blocks in a row with the joint: force F = sigma A everywhere, elongation
// u = un + 2 h sigma / E. Softening is stable here: w - e = 8e-5 m against 2 h f / E = 6e-5 m. Slow enough, the run follows the curve.
TEST(OwnLaw, SofteningBarOfDeformableBlocks)
{
	const Real    area = width * thickness, e = strength / kn, flexibility = 2 * height / 20e9;
	BlockAssembly a   = twoBlocks();
	const int     top = a.mesh.firstNode[2] - 3; // three grid points on the upper side, as on the lower
	a.addGroup({ "bottom", MotionGroup::Drive::velocity, { 1, 3, 5 } });
	const Real  dt = 1, total = 1.4e-4, steps = 20000;
	MotionGroup driven { "top", MotionGroup::Drive::velocity, { 2 * top + 1, 2 * top + 3, 2 * top + 5 } };
	driven.target = total / (steps * dt);
	a.addGroup(driven);
	a.addGroup({ "sides", MotionGroup::Drive::velocity, [&] {
			    std::vector<int> dofs;
			    for (int n = 0; n < a.nodeCount(); ++n)
				    dofs.push_back(2 * n);
			    return dofs;
		    }() });
	scaleInertia(a, nodalStiffness(a), dt, 0.7);
	Damping damping;
	damping.alpha = 0.5;
	Real peak     = 0;
	for (int i = 0; i < int(steps); ++i) {
		blocks::computeForces(a, LinearSoftening { w }, dt);
		move(a, damping, dt, i * dt);
		const Real u = a.state.groups[1].travelled - a.state.groups[1].velocity * dt, force = a.state.groups[1].force; // both of this step's forces
		peak              = std::max(peak, force);
		const Real atPeak = e + strength * flexibility;
		// after the peak: u = un + flexibility sigma with sigma = f (w - un) / (w - e), solved for sigma
		const Real sigma = u < atPeak ? u / (1 / kn + flexibility) : std::max(Real(0), (w - u) / ((w - e) / strength - flexibility));
		// Inertia and damping: the scaled mass is K dt^2/(4 x 0.49) a grid point, so waves take some 10 steps and damping 10 more to pass
		// a row of five grid points; meanwhile u moves by 20 total/steps, and the force by that times the steepest slope, which is after
		// the peak: 1/((w - e)/f - flexibility) = 5e10 Pa/m.
		const Real slope = 1 / ((w - e) / strength - flexibility);
		ASSERT_NEAR(force, area * sigma, 20 * total / steps * slope * area + 0.01 * area * strength) << "step " << i << ", u = " << u;
	}
	EXPECT_NEAR(peak, area * strength, 0.005 * area * strength);
	EXPECT_NEAR(a.state.groups[1].force, 0, 0.01 * area * strength); // u = 1.4e-4 > w: parted
}
