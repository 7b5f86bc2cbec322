// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/step/ViscousBoundaries.hpp>

using namespace specimens;

namespace {

/// A column of n x 1 cells of side 1 in which waves go up and down: along == 1 pressure waves, along == 0 shear waves.
BlockAssembly waveColumn(int n, int along)
{
	BlockAssembly a;
	a.strain    = Strain::small;
	a.thickness = 0.3;
	a.addMaterial(stone());
	addGrid(a, { 0, 0 }, 1, n, 1, n);
	a.addGroup(driven("straight", dofs(a, 1 - along, [](const Vec2&) { return true; }), 0));
	return a;
}

std::vector<int> nodesAt(const BlockAssembly& a, Real y)
{
	std::vector<int> list;
	for (int n = 0; n < a.nodeCount(); ++n)
		if (std::abs(a.mesh.reference[n].y() - y) < 1e-9) list.push_back(n);
	return list;
}

Real speedOf(int along)
{
	const Impedance z = impedanceOf(stone(), Plane::strain);
	return (along == 1 ? z.normal : z.tangential) / stone().density;
}

Real fastest(const BlockAssembly& a, int along)
{
	Real most = 0;
	for (const Vec2& v : a.state.velocity)
		most = std::max(most, std::abs(v[along]));
	return most;
}

/// Three waves of a length within a smooth envelope, at 0 in the middle; its slope.
Real packetSlope(Real x, Real length)
{
	if (std::abs(x) > 1.5 * length) return 0;
	const Real k = 2 * M_PI / length, q = M_PI / (1.5 * length);
	return (1 + std::cos(q * x)) / 2 * k * std::cos(k * x) - q * std::sin(q * x) / 2 * std::sin(k * x);
}
Real packet(Real x, Real length)
{
	if (std::abs(x) > 1.5 * length) return 0;
	return (1 + std::cos(M_PI * x / (1.5 * length))) / 2 * std::sin(2 * M_PI * x / length);
}

/// What is left of a packet in a column of four wave lengths with viscous ends, when what came back is in the middle again: share of the largest velocity.
Real comesBack(int zones, int along)
{
	BlockAssembly a = waveColumn(4 * zones, along);
	addViscous(a, "ends", [&] {
		auto list = nodesAt(a, 0);
		for (int n : nodesAt(a, 4 * zones))
			list.push_back(n);
		return list;
	}());
	const Real dt = 0.7 * stableTimeStep(a, nodalStiffness(a), a.state.inertia), c = speedOf(along), middle = 2 * zones, amplitude = 1e-6;
	for (int n = 0; n < a.nodeCount(); ++n) {
		const Real y                   = a.mesh.reference[n].y() - middle;
		a.state.displacement[n][along] = amplitude * packet(y, zones);
		a.state.velocity[n][along]     = -c * amplitude * packetSlope(y + c * dt / 2, zones); // half a step ago
	}
	const Real start = fastest(a, along);
	Damping    none;
	none.kind = Damping::Kind::none;
	for (int i = 0; i * dt < 4 * zones / c; ++i) {
		computeForces(a);
		move(a, none, dt, i * dt);
	}
	return fastest(a, along) / start;
}

} // namespace

TEST(ViscousBoundaries, PlaneWavesGoOut)
{
	// A row of masses and springs with a dashpot at the half mass of its end sends (1 - cos(kh/2))/(1 + cos(kh/2)) back, about (kh)^2/16: 0.6 % at 20 zones
	// a wave length, a quarter of it at 40. The envelope's side frequencies, a third away, have up to 1.8 times that; steps near the limit of the
	// column take some away.
	for (int along : { 0, 1 }) {
		SCOPED_TRACE(along);
		const Real coarse = comesBack(20, along), fine = comesBack(40, along);
		EXPECT_LT(coarse, 0.01);
		EXPECT_GT(coarse, 1e-4); // there is something to measure
		EXPECT_LT(fine, 0.35 * coarse);
	}
}

TEST(ViscousBoundaries, AnIncomingWaveIsDoubledAtTheSurface)
{
	// The surface moves at twice the incoming wave's velocity; what it sends down goes out. Waves of 40 zones, whose numeric speed is within
	// (kh)^2/24 = 0.1 % of c: over 40 zones (one length) a phase of 2 pi x 1e-3. And the row's own impedance is off by (kh)^2/8 = 0.3 %.
	BlockAssembly a = waveColumn(40, 0);
	addViscous(a, "base", nodesAt(a, 0));
	const Real        c = speedOf(0), length = 40, span = 3 * length / c, dt = 0.7 * stableTimeStep(a, nodalStiffness(a), a.state.inertia);
	std::vector<Real> times;
	std::vector<Vec2> wave;
	for (int i = 0; i <= 600; ++i) {
		times.push_back(i * span / 600);
		wave.push_back({ 0.01 * packet(i * span / 600 * c - 1.5 * length, length), 0 });
	}
	setIncoming(a, viscousOf(a, "base"), times, wave);
	Damping   none  = damped(Damping::Kind::none);
	const int top   = nodesAt(a, 40).front();
	Real      worst = 0, most = 0, energy = 0;
	for (int i = 0; i * dt < span + 3 * length / c; ++i) {
		blocks::computeForces(a, Brittle {}, dt, true);
		const StepWork w = move(a, none, dt, i * dt, true);
		const Real     t = (i + 0.5) * dt, expected = 2 * 0.01 * packet((t - 40 / c) * c - 1.5 * length, length);
		worst  = std::max(worst, std::abs(a.state.velocity[top].x() - expected));
		most   = std::max(most, std::abs(expected));
		energy = w.kinetic + specimens::storedEnergy(a);
	}
	EXPECT_GT(most, 0.018);
	EXPECT_LT(worst, 0.02 * most);
	const FurtherAccounts& booked = a.state.further;
	// brought in: rho c w^2 per area and time; all of it has left
	Real brought = 0;
	for (size_t i = 0; i < wave.size(); ++i)
		brought += wave[i].squaredNorm() * span / 600 * 0.3 * impedanceOf(stone(), Plane::strain).tangential;
	EXPECT_NEAR(booked.incoming, brought, 1e-3 * brought); // steps of 1/50 wave
	EXPECT_NEAR(booked.viscous, brought, 1e-3 * brought);
	EXPECT_LT(energy, 1e-3 * brought);
}

TEST(ViscousBoundaries, AccountsBalance)
{
	// A lopsided brick in small strain, linear; skew boundaries that meet in a corner, held along x at one grid point, with an incoming wave, loads and
	// every kind of damping: the balance is exact to rounding, as in Energy.LinearSystemBalancesToRounding, and what left never falls by more than a half
	// step's.
	for (const auto kind : { Damping::Kind::none, Damping::Kind::local, Damping::Kind::adaptive }) {
		SCOPED_TRACE(int(kind));
		BlockAssembly a;
		a.strain    = Strain::small;
		a.thickness = 0.3;
		a.addMaterial(stone());
		addFan(a, { { 0, 0.1 }, { 1, 0 }, { 1.3, 0.8 }, { 0.2, 0.9 } });
		addGravity(a, { 2, -9.81 });
		addViscous(a, "base", { 0, 1 });
		addViscous(a, "side", { 1, 2 }, { 3e6, 2e6 });
		setIncoming(a, 0, { 0, 1e-4, 3e-4, 9e-4 }, { { 0, 0 }, { 0.2, 0.1 }, { -0.1, 0.3 }, { 0, 0.1 } });
		a.addGroup(driven("along", { 0 }, 0.01));
		const Real dt      = 0.6 * stableTimeStep(a, nodalStiffness(a), a.state.inertia);
		Damping    damping = damped(kind);
		Real       booked = 0, pending = 0, first = 0, worst = 0, turnover = 0;
		for (int i = 0; i < 400; ++i) {
			blocks::computeForces(a, Brittle {}, dt, true);
			const Real     stored = specimens::storedEnergy(a), loads = loadWork(a);
			const StepWork w = move(a, damping, dt, i * dt, true);
			booked += pending + w.dampingBefore;
			pending         = w.dampingAfter;
			const auto& f   = a.state.further;
			const Real  sum = stored + w.kinetic + booked + f.viscous - f.incoming - groupWork(a) - loads;
			if (i == 0) first = sum;
			worst    = std::max(worst, std::abs(sum - first));
			turnover = std::max({ turnover, stored, f.viscous, f.incoming });
		}
		EXPECT_GT(a.state.further.incoming, 0.01 * turnover);
		EXPECT_GT(a.state.further.viscous, 0.1 * turnover);
		EXPECT_LT(worst, 400 * 100 * eps * turnover + 400 * 20e9 * 0.3 * 1e-5 * eps);
	}
}

TEST(ViscousBoundaries, LimitOfTheStepStays)
{
	// Whatever the dashpots: below 2/omega of the free body all dies away, a little above the fastest mode grows by exp(2 acosh(1.01)) a step where they do
	// not reach it. Soft and hard ones.
	for (const Real factor : { 0.01, 1., 100. }) {
		SCOPED_TRACE(factor);
		BlockAssembly a;
		a.strain = Strain::small;
		a.addMaterial(stone());
		addGrid(a, { 0, 0 }, 1.5, 1, 3, 2);
		const Impedance z = impedanceOf(stone(), Plane::strain);
		addViscous(a, "base", nodesAt(a, 0), { factor * z.normal, factor * z.tangential });
		const Real limit = 2 / modes(a, 1e-3).omega.maxCoeff();
		EXPECT_LE(stableTimeStep(a, nodalStiffness(a), a.state.inertia), limit);
		auto run = [&](BlockAssembly b, Real share) {
			std::mt19937                         random(3);
			std::uniform_real_distribution<Real> v(-1e-3, 1e-3);
			for (Vec2& x : b.state.velocity)
				x = { v(random), v(random) };
			Damping none = damped(Damping::Kind::none);
			for (int i = 0; i < 1000; ++i) {
				computeForces(b);
				move(b, none, share * limit, i);
			}
			Real most = 0;
			for (const Vec2& x : b.state.velocity)
				most = std::max(most, x.norm());
			return most;
		};
		EXPECT_LT(run(a, 0.999), 0.05); // near the limit velocities swing by 1/sqrt(1 - 0.999^2) = 22
		if (factor < 0.1) {
			EXPECT_GT(run(a, 1.02), 1e3);
		}
	}
}

TEST(ViscousBoundaries, ResistanceOfASkewEdge)
{
	// An edge from (0, 0.1) to (1, 0): length sqrt(1.01), half of it for each end.
	BlockAssembly a = twoBlocks(elasticJoint(1e9, 1e9), 0.7);
	addViscous(a, "base", { 0, 1 }, { 5, 3 });
	const Vec2 along = Vec2(1, -0.1).normalized(), across(-along.y(), along.x());
	const Real half  = std::sqrt(1.01) * 0.7 / 2;
	ASSERT_EQ(a.supports.dashpots.size(), 2u);
	for (const Dashpot& d : a.supports.dashpots) {
		EXPECT_LT((d * along - 3 * half * along).norm(), 20 * eps);
		EXPECT_LT((d * across - 5 * half * across).norm(), 20 * eps);
	}
	const Impedance z = impedanceOf({ 20e9, 0.2, 2000 }, Plane::strain); // M = E (1 - nu)/((1 + nu)(1 - 2 nu)), G = E/(2 (1 + nu))
	EXPECT_NEAR(z.normal, std::sqrt(2000 * 20e9 * 0.8 / (1.2 * 0.6)), 1e-8);
	EXPECT_NEAR(z.tangential, std::sqrt(2000 * 20e9 / 2.4), 1e-8);
}

TEST(ViscousBoundaries, Refusals)
{
	BlockAssembly a = twoBlocks(elasticJoint(1e9, 1e9));
	expectRefusal([&] { addViscous(a, "b", {}); }, { "viscous boundary \"b\"", "at least one grid point" });
	expectRefusal([&] { addViscous(a, "b", { 99 }); }, { "viscous boundary \"b\"", "no such grid point", "99" });
	expectRefusal([&] { addViscous(a, "b", { 0, 2 }); }, { "no boundary edge", "grid point, got 0" });
	expectRefusal([&] { addViscous(a, "b", { 1, 2 }); }, { "without a joint" }); // the common edge of the two blocks
	expectRefusal([&] { addViscous(a, "b", { 0, 1 }, { -1, 2 }); }, { "impedances must be positive", "-1" });
	expectRefusal([&] { viscousOf(a, "b"); }, { "no viscous boundary \"b\"", "none" });
	addViscous(a, "b", { 0, 1 });
	expectRefusal([&] { addViscous(a, "b", { 0, 1 }); }, { "there is a viscous boundary \"b\" already" });
	expectRefusal([&] { setIncoming(a, 0, { 0, 0 }, { { 0, 0 }, { 0, 0 } }); }, { "must ascend" });
	expectRefusal([&] { setIncoming(a, 0, { 0, 1 }, { { 0, 0 } }); }, { "a velocity for each time" });
	expectRefusal([&] { a.addGroup(pushed("p", { 0 }, 5)); }, { "no group may push", "grid point, got 0" });
	expectRefusal([&] { a.addGroup(driven("d", { 0, 1 }, 5)); }, { "free along one axis" });
	EXPECT_TRUE(a.state.groups.empty());
	releaseViscous(a, 0);
	EXPECT_TRUE(a.supports.dashpots.empty());
	a.addGroup(driven("d", { 0, 1 }, 5));
	expectRefusal([&] { addViscous(a, "b", { 0, 1 }); }, { "free along one axis" });
	EXPECT_TRUE(a.supports.viscous.empty() && a.supports.dashpots.empty());
}
