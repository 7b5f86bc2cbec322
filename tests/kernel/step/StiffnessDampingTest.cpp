// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/step/StiffnessDamping.hpp>

using namespace specimens;

namespace {

BlockAssembly jointedBar(Real beta)
{
	BlockAssembly a = column(4, 1, 2, 1, 2, stone(), elasticJoint(2e10, 1e10), 0.5);
	a.strain        = Strain::small;
	a.addGroup(driven("foot", dofs(a, 1, [](const Vec2& x) { return x.y() == 0; }), 0));
	a.addGroup(driven("foot x", dofs(a, 0, [](const Vec2& x) { return x.y() == 0; }), 0));
	setStiffnessDamping(a, beta);
	return a;
}

} // namespace

TEST(StiffnessDamping, FirstModeDecaysAsBetaOmegaHalf)
{
	// Zones and joints alike, so that the mode stays a mode: u = e^(-xi omega t) cos(omega t sqrt(1 - xi^2)), xi = beta omega / 2. Steps of 1e-3/omega or
	// less: the late velocity changes xi by omega dt/2 of itself.
	const Modes m = modes(jointedBar(0), 1e-6);
	for (int mode : { 0, 1, 2 }) { // bending and stretching of joints and zones
		SCOPED_TRACE(mode);
		const Real    omega = m.omega[mode], xi = 0.03, beta = 2 * xi / omega;
		BlockAssembly a  = jointedBar(beta);
		const Real    dt = std::min(1e-2 / omega, 0.5 * stableTimeStep(a, nodalStiffness(a), a.state.inertia));
		for (size_t i = 0; i < m.free.size(); ++i)
			a.state.displacement[m.free[i] / 2][m.free[i] % 2] = 1e-6 * m.shape(i, mode);
		auto amplitude = [&] { // along the mode
			Real sum = 0;
			for (size_t i = 0; i < m.free.size(); ++i)
				sum += m.shape(i, mode) * a.state.displacement[m.free[i] / 2][m.free[i] % 2]
					/ a.supports.mobility[m.free[i] / 2][m.free[i] % 2];
			return sum;
		};
		const Real start = amplitude(), periods = 3;
		Damping    none  = damped(Damping::Kind::none);
		const int  steps = int(std::lround(periods * 2 * M_PI / (omega * std::sqrt(1 - xi * xi)) / dt));
		for (int i = 0; i < steps; ++i) {
			computeForces(a);
			move(a, none, dt, i * dt);
		}
		const Real decay = std::log(start / amplitude());
		EXPECT_NEAR(decay, xi / std::sqrt(1 - xi * xi) * 2 * M_PI * periods, 0.01 * xi * 2 * M_PI * periods);
	}
}

TEST(StiffnessDamping, BoundsTheStep)
{
	// dt^2 + 2 beta dt < limit^2, exactly so where all stiffness is damped alike.
	const Real limit = 2 / modes(jointedBar(0), 1e-6).omega.maxCoeff();
	for (const Real share : { 0.1, 1., 5. }) {
		SCOPED_TRACE(share);
		const Real    beta = share * limit, most = limit * limit / (std::sqrt(beta * beta + limit * limit) + beta);
		BlockAssembly a = jointedBar(beta);
		EXPECT_LE(stableTimeStep(a, nodalStiffness(a), a.state.inertia), most);
		EXPECT_GT(stableTimeStep(a, nodalStiffness(a), a.state.inertia), 0.4 * most);
		auto run = [&](Real dt) {
			BlockAssembly                        b = a;
			std::mt19937                         random(3);
			std::uniform_real_distribution<Real> v(-1e-3, 1e-3);
			for (int n = 0; n < b.nodeCount(); ++n)
				if (b.mesh.reference[n].y() > 0) b.state.velocity[n] = { v(random), v(random) };
			Damping none = damped(Damping::Kind::none);
			for (int i = 0; i < 600; ++i) {
				computeForces(b);
				move(b, none, dt, i);
			}
			Real sum = 0;
			for (const Vec2& x : b.state.velocity)
				sum = std::max(sum, x.norm());
			return sum;
		};
		EXPECT_LT(run(0.99 * most), 0.02);
		EXPECT_GT(run(1.02 * most), 1);
	}
}

TEST(StiffnessDamping, AccountsBalance)
{
	// Linear: exact to rounding, see Energy.LinearSystemBalancesToRounding. A group that moves takes part.
	BlockAssembly a          = jointedBar(1e-5);
	a.state.groups[0].target = 0.02, a.state.groups[0].rampTime = 1e-3;
	addGravity(a, { 3, -9.81 });
	const Real dt    = 0.6 * stableTimeStep(a, nodalStiffness(a), a.state.inertia);
	Damping    none  = damped(Damping::Kind::none);
	Real       first = 0, worst = 0, turnover = 0;
	for (int i = 0; i < 600; ++i) {
		blocks::computeForces(a, Brittle {}, dt, true);
		const Real     stored = specimens::storedEnergy(a), loads = loadWork(a);
		const StepWork w   = move(a, none, dt, i * dt, true);
		const Real     sum = stored + w.kinetic + a.state.further.stiffness - groupWork(a) - loads;
		if (i == 0) first = sum;
		worst    = std::max(worst, std::abs(sum - first));
		turnover = std::max(turnover, stored);
	}
	EXPECT_GT(a.state.further.stiffness, 0.02 * turnover);
	EXPECT_LT(worst, 1e-6 * turnover); // frames of joints turn: second order in slip by edge, 1e-6
}

TEST(StiffnessDamping, RigidMotionIsFree)
{
	// Two bonded blocks, strained by 1e-3 and with an open joint, that turn about any point: no force but rounding.
	BlockAssembly                        a = twoBlocks(elasticJoint(1e11, 4e10));
	std::mt19937                         random(1);
	std::uniform_real_distribution<Real> shift(-1e-3, 1e-3);
	rotateAbout(a, { 0.3, 0.2 }, 1.1, { 2, -1 });
	for (int n = 0; n < a.nodeCount(); ++n)
		a.state.displacement[n] += Vec2(shift(random), shift(random));
	for (int n = 0; n < a.nodeCount(); ++n) {
		const Vec2 arm      = a.position(n) - Vec2(0.7, 3);
		a.state.velocity[n] = 2 * Vec2(-arm.y(), arm.x()) + Vec2(0.5, 0.1);
	}
	setStiffnessDamping(a, 1e-3);
	computeForces(a);
	const Real scale = 1e-3 * 20e9 * 0.7; // beta E t times a strain rate of 1/s
	for (const Vec2& f : a.forces.rate)
		EXPECT_LT(f.norm(), 1e4 * eps * scale);
	// of any other motion neither resultant nor moment is left, and it only dissipates
	for (Vec2& v : a.state.velocity)
		v += 100 * Vec2(shift(random), shift(random));
	computeForces(a);
	Vec2 sum    = Vec2::Zero();
	Real moment = 0, most = 0;
	for (int n = 0; n < a.nodeCount(); ++n)
		sum += a.forces.rate[n], moment += cross(a.position(n), a.forces.rate[n]), most = std::max(most, a.forces.rate[n].norm());
	EXPECT_GT(most, 1e-3 * scale);
	EXPECT_LT(sum.norm(), 1e4 * eps * most);
	EXPECT_LT(std::abs(moment), 1e5 * eps * most);
	EXPECT_LT(stiffnessDampingPower(a), 0);
}
