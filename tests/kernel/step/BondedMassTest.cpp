// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/analysis/ElasticJump.hpp>

using namespace specimens;

/// Many bonded blocks act as one body: a beam that bends and shears, a bar that rings, a fragment that flies.

namespace {

/// Square blocks of nx x ny, each of 2 x 2 cells, bonded by `joint`.
BlockAssembly masonry(Real w, Real h, int nx, int ny, const Material& m, const JointParams& joint, Real thickness)
{
	BlockAssembly a;
	a.thickness = thickness;
	a.addMaterial(m);
	for (int j = 0; j < ny; ++j)
		for (int i = 0; i < nx; ++i)
			addGrid(a, { w * i / nx, h * j / ny }, w / nx, h / ny, 2, 2);
	bondAll(a, joint);
	return a;
}

std::vector<int> bothAxes(const BlockAssembly& a, const std::function<bool(const Vec2&)>& where)
{
	std::vector<int> list = dofs(a, 0, where);
	for (int dof : dofs(a, 1, where))
		list.push_back(dof);
	return list;
}

Real momentOfInertia(const BlockAssembly& a)
{
	Real sum = 0;
	for (int n = 0; n < a.nodeCount(); ++n)
		sum += a.mesh.mass[n] * a.position(n).squaredNorm();
	return sum;
}

/// Takes the drift of a free body away.
void toCentre(BlockAssembly& a)
{
	Vec2 moment { 0, 0 };
	Real mass = 0;
	for (int n = 0; n < a.nodeCount(); ++n)
		moment += a.mesh.mass[n] * a.position(n), mass += a.mesh.mass[n];
	for (Vec2& u : a.state.displacement)
		u -= moment / mass;
	std::fill(a.state.velocity.begin(), a.state.velocity.end(), Vec2::Zero());
}

Real meanPressure(const BlockAssembly& a) // trace of the stress, by volume
{
	Real sum = 0;
	for (int block = 0; block < a.blockCount(); ++block)
		for (int z = a.mesh.firstZone[block]; z < a.mesh.firstZone[block + 1]; ++z) {
			const ZoneStress s = cauchyStress(a, block, z);
			sum += a.mesh.zoneVolume[z] * (s.sxx + s.syy);
		}
	return sum;
}

} // namespace

TEST(BondedMass, CantileverConvergesToTheBeamWithSecondOrder)
{
	// Length L, height H, blocks of s = H/n. With kn s and ks s fixed the joints' share in the compliance is the same for every n:
	// 1/E_eff = 1/E + 1/(kn s), 1/G_eff = 1/G + 1/(ks s). Timoshenko: 1/k = L^3/(3 E I) + L/(5/6 G A); the clamped end, which he
	// lets warp, and poisson = 0 leave some (H/L)^2 = 1.6 %. Zones of constant strain and point contacts: error of order s^2.
	const Real L = 0.8, H = 0.1, t = 0.3, E = 20e9, area = H * t, inertia = t * H * H * H / 12;
	auto       stiffness = [&](int n) {
                const Real  s     = H / n;
                JointParams joint = elasticJoint(10 * E / s, 5 * E / s);
                joint.tension = joint.cohesion = 1e6;
                BlockAssembly a                = masonry(L, H, 8 * n, n, { E, 0, 2000 }, joint, t);
                a.addGroup(driven("clamp", bothAxes(a, [](const Vec2& x) { return x.x() < 1e-9; }), 0));
                a.addGroup(driven("tip", dofs(a, 1, [&](const Vec2& x) { return x.x() > L - 1e-9; }), 1e-3));
                elasticJump(a, 0.5, 0);
                return a.state.groups[1].force / a.state.groups[1].travelled;
	};
	const Real k[4] = { stiffness(2), stiffness(4), stiffness(8), stiffness(16) };
	const Real Eeff = E / 1.1, Geff = E / 2 / (1 + 0.5 / 5);
	const Real beam = 1 / (L * L * L / (3 * Eeff * inertia) + L / (5. / 6 * Geff * area));
	EXPECT_NEAR(std::log2((k[0] - k[1]) / (k[1] - k[2])), 2, 0.3);
	EXPECT_NEAR(std::log2((k[1] - k[2]) / (k[2] - k[3])), 2, 0.15);
	const Real limit = k[3] + (k[3] - k[2]) / 3;
	EXPECT_NEAR(limit, beam, 0.016 * beam);
	std::printf("cantilever: %.4f %.4f %.4f %.4f -> %.4f of the beam\n", k[0] / beam, k[1] / beam, k[2] / beam, k[3] / beam, limit / beam);
}

TEST(BondedMass, PWaveRunsThroughABarOfBlocks)
{
	// A bar of n blocks, held sideways; its left end starts smoothly (r = smoothstep over T) to the velocity v. The front runs with
	// c^2 = M_eff/rho, 1/M_eff = 1/E + 1/(kn s): a block at x has the velocity v r((t - x/c)/T). Lumped masses and joints disperse
	// with the second order of s/(cT), and so does the scheme, dt being in proportion to s: an error of s^2 times the third derivative. The
	// start has a jump in its second one, so that it is in H^(5/2) and the order of the mean square is 2/3 of that, 5/3. The end is not driven through half
	// a joint, as a cell of that medium would be: the front is ahead by rho c/(2 kn) = 0.1 s/c.
	const Real L = 1, E = 20e9, rho = 2000, v = 0.01, height = 0.1;
	auto       error = [&](int n) {
                const Real    s = L / n;
                BlockAssembly a;
                a.addMaterial({ E, 0, rho });
                for (int i = 0; i < n; ++i)
                        addGrid(a, { i * s, 0 }, s, height, 2, 1);
                bondAll(a, elasticJoint(4 * E / s, 2 * E / s));
                const Real c = std::sqrt(E / 1.25 / rho), start = 0.4 * L / c, until = 0.9 * L / c;
                a.addGroup(driven("y", dofs(a, 1, [](const Vec2&) { return true; }), 0));
                a.addGroup(driven("end", dofs(a, 0, [](const Vec2& x) { return x.x() < 1e-9; }), v, start));
                const int  steps = int(until / (0.5 * stableTimeStep(a, nodalStiffness(a), a.mesh.mass))) + 1;
                const Real dt    = until / steps;
                Damping    none;
                none.kind = Damping::Kind::none;
                for (int i = 0; i < steps; ++i) {
                        computeForces(a);
                        move(a, none, dt, i * dt);
                }
                Real squares = 0;
                for (int block = 0; block < n; ++block) {
                        Real momentum = 0, mass = 0;
                        for (int i = a.mesh.firstNode[block]; i < a.mesh.firstNode[block + 1]; ++i)
                                momentum += a.mesh.mass[i] * a.state.velocity[i].x(), mass += a.mesh.mass[i];
                        const Real phase = (until - dt / 2 - (block + 0.4) * s / c) / start, r = std::clamp(phase, Real(0), Real(1));
                        squares += std::pow(momentum / mass / v - r * r * (3 - 2 * r), 2) / n;
                }
                return std::sqrt(squares);
	};
	const Real coarse = error(20), middle = error(40), fine = error(80);
	std::printf("P wave: velocities off by %.1e, %.1e, %.1e with 20, 40, 80 blocks\n", coarse, middle, fine);
	EXPECT_NEAR(std::log2(coarse / middle), 5. / 3, 0.1);
	EXPECT_NEAR(std::log2(middle / fine), 5. / 3, 0.1);
}

TEST(BondedMass, FragmentSpinsAThousandTurns)
{
	// 50 bonded blocks, expanded by the centrifugal load to begin with, so that the motion is steady: the trace of the stress is that
	// of the virial theorem, sum V tr(sigma) = w^2 sum m r^2, up to the strain (0.58 GPa / 20 GPa = 3 %: V is that of before), after a thousand turns as
	// before; no energy is made; stopped and at rest, no stress is left.
	JointParams   joint = elasticJoint(0.5e12, 0.25e12);
	BlockAssembly a     = voronoi(1, 0.5, 10, 5, { 20e9, 0.2, 2000 }, joint, 0.4);
	toCentre(a);
	const Real limit = stableTimeStep(a, nodalStiffness(a), a.mesh.mass), dt = 0.5 * limit;
	const int  perTurn = 1500;
	const Real w       = 2 * M_PI / (perTurn * dt);
	Damping    damping;
	damping.alpha = 0.3;
	for (int round = 0; round < 6; ++round) { // the load follows the expansion
		a.supports.load.resize(a.nodeCount());
		for (int n = 0; n < a.nodeCount(); ++n)
			a.supports.load[n] = a.mesh.mass[n] * w * w * a.position(n);
		ASSERT_GE(relax(a, damping, dt, 1e-8, 200000), 0);
		toCentre(a);
	}
	a.supports.load.clear();
	const Real expanded = meanPressure(a), virial = w * w * momentOfInertia(a);
	EXPECT_NEAR(expanded / virial, 1, 0.04);

	for (int n = 0; n < a.nodeCount(); ++n) // half a step back
		a.state.velocity[n] = w * Vec2(-a.position(n).y(), a.position(n).x()) + dt / 2 * w * w * a.position(n);
	damping.kind = Damping::Kind::none;
	auto energy  = [&] { return storedEnergy(a) + kineticEnergy(a); };
	computeForces(a);
	const Real before = energy();
	Real       most   = before;
	for (long i = 0; i < 1000L * perTurn; ++i) {
		computeForces(a);
		if (i % (10 * perTurn) == 0) {
			most = std::max(most, energy());
			ASSERT_NEAR(meanPressure(a) / expanded, 1, 0.01) << "turn " << i / perTurn;
		}
		move(a, damping, dt, i * dt);
	}
	EXPECT_LT(most / before - 1, 1e-3); // of half steps: w dt/2 = 0.2 %

	computeForces(a);
	Real spin = 0;
	for (int n = 0; n < a.nodeCount(); ++n)
		spin += a.mesh.mass[n] * cross(a.position(n), a.state.velocity[n]);
	const Real rate = spin / momentOfInertia(a);
	for (int n = 0; n < a.nodeCount(); ++n)
		a.state.velocity[n] -= rate * Vec2(-a.position(n).y(), a.position(n).x());
	damping.kind = Damping::Kind::local;
	for (int i = 0; i < 20000; ++i) {
		computeForces(a);
		move(a, damping, dt, i * dt);
	}
	computeForces(a);
	Real left = 0;
	for (int block = 0; block < a.blockCount(); ++block)
		for (int z = a.mesh.firstZone[block]; z < a.mesh.firstZone[block + 1]; ++z) {
			const ZoneStress s = cauchyStress(a, block, z);
			left               = std::max({ left, std::abs(s.sxx), std::abs(s.syy), std::abs(s.sxy) });
		}
	const Real meanStress = expanded / (1 * 0.5 * 0.4);
	std::printf(
		"spin: %.0f MPa of centrifugal stress, %.1e of it left when stopped; energy %+.1e\n", meanStress / 1e6, left / meanStress, most / before - 1);
	EXPECT_LT(left, 1e-6 * meanStress);
}
