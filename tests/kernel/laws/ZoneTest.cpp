// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>

using namespace specimens;

namespace {

/// A lopsided triangle, counter-clockwise, about half a square metre.
const Vec2 corner[3] = { { 0.2, -0.1 }, { 1.4, 0.3 }, { 0.5, 0.9 } };
const Real thickness = 0.3;

using Matrix = Eigen::Matrix<Real, 2, 2>;

Matrix rotation(Real angle) { return (Matrix() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)).finished(); }

template <Strain kind> ZoneStrain strainAt(const Vec2 (&x)[3])
{
	const Vec2 p = x[1] - x[0] - (corner[1] - corner[0]), q = x[2] - x[0] - (corner[2] - corner[0]); // of displacements
	return zoneStrain<kind>(zoneGradients(corner[0], corner[1], corner[2]), p.x(), p.y(), q.x(), q.y());
}

template <Strain kind> ZoneStrain strainUnder(const Matrix& F)
{
	const Vec2 x[3] = { F * corner[0], F * corner[1], F * corner[2] };
	return strainAt<kind>(x);
}

Real volume() { return thickness * cross(corner[1] - corner[0], corner[2] - corner[0]) / 2; }

template <Strain kind> Real energyAt(const Moduli& m, const Vec2 (&x)[3]) { return volume() * zoneEnergyDensity(m, strainAt<kind>(x)); }

template <Strain kind> std::array<Vec2, 3> forcesAt(const Moduli& m, const Vec2 (&x)[3])
{
	const ZoneStrain e = strainAt<kind>(x);
	const ZoneForces f = zoneForces<kind>(zoneGradients(corner[0], corner[1], corner[2]), volume(), zoneStress(m, e), e);
	return { Vec2(-f.f1x - f.f2x, -f.f1y - f.f2y), Vec2(f.f1x, f.f1y), Vec2(f.f2x, f.f2y) };
}

/// Strained by some 10 % and turned by 2 radians: no entry of F equals another.
const Matrix stretch  = (Matrix() << 1.11, 0.07, 0.07, 0.94).finished();
const Matrix deformed = rotation(2.0) * stretch;

} // namespace

TEST(Zone, ModuliInClosedForm)
{
	// E = 20, nu = 0.25. Plane strain: uniaxial strain has E (1-nu)/((1+nu)(1-2nu)) = 24, lateral share nu/(1-nu) of it = 8, mu = 8.
	// Plane stress: E/(1-nu^2) = 64/3, lateral nu of it = 16/3. Two or three roundings of numbers below 24.
	const Moduli strain = planeModuli(20, 0.25, Plane::strain), stress = planeModuli(20, 0.25, Plane::stress);
	EXPECT_NEAR(strain.lambda + 2 * strain.mu, 24, 24 * 4 * eps);
	EXPECT_NEAR(strain.lambda, 8, 8 * 4 * eps);
	EXPECT_NEAR(stress.lambda + 2 * stress.mu, 64. / 3, 24 * 4 * eps);
	EXPECT_NEAR(stress.lambda, 16. / 3, 8 * 4 * eps);
	EXPECT_NEAR(strain.mu, 8, 8 * 4 * eps);
	EXPECT_NEAR(stress.mu, 8, 8 * 4 * eps);
}

TEST(Zone, UniaxialTensionContractsByPoisson)
{
	// Plane stress: eyy = -nu exx frees the sides. Plane strain: eyy = -nu/(1-nu) exx, and sxx = E/(1-nu^2) exx.
	const Real e = 0.01;
	struct Case {
		Plane plane;
		Real  contraction, modulus;
	};
	for (const Case& c : { Case { Plane::stress, 0.25, 20 }, Case { Plane::strain, 0.25 / 0.75, 20 / (1 - 0.0625) } }) {
		const Matrix     F = (Matrix() << 1 + e, 0, 0, 1 - c.contraction * e).finished();
		const ZoneStress s = zoneStress(planeModuli(20, 0.25, c.plane), strainUnder<Strain::large>(F));
		// F is made from coordinates of order 1 and gradients of order 1.5 in some 10 roundings; times moduli of 24 twice
		const Real rounding = 10 * 1.5 * eps * 2 * 24;
		EXPECT_NEAR(s.sxx, c.modulus * e, rounding);
		EXPECT_NEAR(s.syy, 0, rounding);
		EXPECT_NEAR(s.sxy, 0, rounding);
	}
}

TEST(Zone, StrainIsTheStretchWhateverTheRotation)
{
	// 10 roundings of terms of order 1.5 x 1.2 make F, another few take out R.
	const Real rounding = 20 * eps * 2;
	for (Real angle : { 0., 0.3, 1.5707963, 2.0, 3.1, -2.5 }) {
		SCOPED_TRACE(angle);
		const ZoneStrain e = strainUnder<Strain::large>(rotation(angle) * stretch);
		EXPECT_NEAR(e.exx, 0.11, rounding);
		EXPECT_NEAR(e.eyy, -0.06, rounding);
		EXPECT_NEAR(e.exy, 0.07, rounding);
		EXPECT_NEAR(e.c, std::cos(angle), rounding);
		EXPECT_NEAR(e.s, std::sin(angle), rounding);
	}
}

TEST(Zone, ThousandTurnsLeaveNoStress)
{
	// Turned in steps of a tenth of a turn: positions gather 10,000 x 2 roundings of order 1 at random, at worst all one way:
	// strain < 2e4 eps x 1.5 (gradient) x sqrt(2); the law itself starts from the present positions and adds 20 eps.
	Vec2         x[3] = { corner[0], corner[1], corner[2] };
	const Matrix R    = rotation(2 * M_PI / 10);
	for (int i = 0; i < 10000; ++i)
		for (Vec2& p : x)
			p = R * p;
	const ZoneStrain e     = strainAt<Strain::large>(x);
	const Real       bound = 2e4 * eps * 3 + 20 * eps;
	EXPECT_NEAR(e.exx, 0, bound);
	EXPECT_NEAR(e.eyy, 0, bound);
	EXPECT_NEAR(e.exy, 0, bound);
	EXPECT_NEAR(e.c, 1, bound); // a whole number of turns
	EXPECT_NEAR(e.s, 0, bound);
}

TEST(Zone, SmallStrainIsTheSymmetricPart)
{
	const Matrix     F = (Matrix() << 1.003, 0.004, -0.001, 0.998).finished();
	const ZoneStrain e = strainUnder<Strain::small>(F);
	EXPECT_NEAR(e.exx, 0.003, 40 * eps); // 10 roundings of order 1.5, as above
	EXPECT_NEAR(e.eyy, -0.002, 40 * eps);
	EXPECT_NEAR(e.exy, 0.0015, 40 * eps);
	EXPECT_EQ(e.c, 1);
	EXPECT_EQ(e.s, 0);

	// Both measures agree to second order: |U - 1 - sym| <= |H|^2 with |H| = 0.0055.
	const ZoneStrain large = strainUnder<Strain::large>(F);
	EXPECT_NEAR(large.exx, e.exx, 0.0055 * 0.0055);
	EXPECT_NEAR(large.eyy, e.eyy, 0.0055 * 0.0055);
	EXPECT_NEAR(large.exy, e.exy, 0.0055 * 0.0055);
	EXPECT_GT(std::abs(large.exy - e.exy) + std::abs(large.exx - e.exx), 1e-7); // and are not the same thing
}

template <Strain kind> void forcesAreTheGradient()
{
	const Moduli m    = planeModuli(20, 0.3, Plane::strain);
	Vec2         x[3] = { deformed * corner[0], deformed * corner[1], deformed * corner[2] };
	const auto   f    = forcesAt<kind>(m, x);
	// Central differences of step d: truncation d^2/6 U''' with U''' < V x 50 x 1.5^3 = 18; rounding eps U / d with U < 10 (small
	// strain measures the rotation as strain of order 1). d = 1e-5: 3e-10 + 2e-10.
	const Real d = 1e-5;
	for (int node = 0; node < 3; ++node)
		for (int axis = 0; axis < 2; ++axis) {
			const Real at     = x[node][axis];
			x[node][axis]     = at + d;
			const Real ahead  = energyAt<kind>(m, x);
			x[node][axis]     = at - d;
			const Real behind = energyAt<kind>(m, x);
			x[node][axis]     = at;
			EXPECT_NEAR(f[node][axis], -(ahead - behind) / (2 * d), 5e-10 * 4) << "node " << node << " axis " << axis;
		}
}

TEST(Zone, ForcesAreTheGradientOfTheEnergyLargeStrain) { forcesAreTheGradient<Strain::large>(); }
TEST(Zone, ForcesAreTheGradientOfTheEnergySmallStrain) { forcesAreTheGradient<Strain::small>(); }

TEST(Zone, ForcesBalance)
{
	const Vec2 x[3]   = { deformed * corner[0], deformed * corner[1], deformed * corner[2] };
	const auto f      = forcesAt<Strain::large>(planeModuli(20, 0.3, Plane::stress), x);
	Real       moment = 0;
	for (int i = 0; i < 3; ++i)
		moment += cross(x[i], f[i]);
	const Vec2 sum = f[0] + f[1] + f[2];
	// Forces of order V sigma g < 0.15 x 4 x 1.5 = 1 at arms below 2: a dozen roundings each.
	EXPECT_NEAR(sum.x(), 0, 4 * eps);
	EXPECT_NEAR(sum.y(), 0, 4 * eps);
	EXPECT_NEAR(moment, 0, 40 * eps * 2);
}

TEST(Zone, EnergyIsTheWorkOfTheForces)
{
	// Along x(s) = X + s (x - X) in small strain, forces grow with s: work = -sum f(1).u / 2. Terms of order 1, 20 roundings.
	const Moduli m    = planeModuli(20, 0.3, Plane::strain);
	const Matrix F    = (Matrix() << 1.06, 0.11, -0.02, 0.93).finished();
	const Vec2   x[3] = { F * corner[0], F * corner[1], F * corner[2] };
	const auto   f    = forcesAt<Strain::small>(m, x);
	Real         work = 0;
	for (int i = 0; i < 3; ++i)
		work -= f[i].dot(x[i] - corner[i]) / 2;
	EXPECT_NEAR(energyAt<Strain::small>(m, x), work, 20 * eps);

	// By hand: e = (0.06, -0.07, 0.045), lambda = 150/13, mu = 100/13:
	// U/V = 75/13 x 0.01^2 + 100/13 (0.0036 + 0.0049 + 2 x 0.002025) = (0.0075 + 1.255)/13
	EXPECT_NEAR(energyAt<Strain::small>(m, x), volume() * 1.2625 / 13, 40 * eps);
}

TEST(Zone, EdgeCarriesTheStressVector)
{
	// The forces of a uniformly stressed triangle on its nodes are those of the traction P N on its outline, with a sign:
	// f_i = -(half the sum of the two edges at i) of P (dy, -dx) t. P = sigma in small strain; shear alone tells a transpose apart
	// only together with unequal sxx, syy and a lopsided outline.
	const Moduli     m     = planeModuli(20, 0.3, Plane::stress);
	const Matrix     F     = (Matrix() << 1.06, 0.11, -0.02, 0.93).finished();
	const ZoneStress s     = zoneStress(m, strainUnder<Strain::small>(F));
	const Matrix     sigma = (Matrix() << s.sxx, s.sxy, s.sxy, s.syy).finished();
	const Vec2       x[3]  = { F * corner[0], F * corner[1], F * corner[2] };
	const auto       f     = forcesAt<Strain::small>(m, x);
	for (int i = 0; i < 3; ++i) {
		const Vec2 chord = corner[(i + 1) % 3] - corner[(i + 2) % 3]; // both edges at i, run through from i+2 to i+1
		const Vec2 by    = sigma * Vec2(chord.y(), -chord.x()) * thickness / 2;
		// edges (i+2 -> i) and (i -> i+1) together make the chord from i+2 to i+1
		EXPECT_NEAR(f[i].x(), -by.x(), 20 * eps);
		EXPECT_NEAR(f[i].y(), -by.y(), 20 * eps);
	}
}
