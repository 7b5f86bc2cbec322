// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/laws/Exponential.hpp>
#include <blocks/kernel/laws/SofteningLaw.hpp>

using namespace specimens;

namespace {

constexpr Real inf = std::numeric_limits<Real>::infinity();

// f ends at 1e-5 of the exponential: strengths differ from e^-k by at most that share, the area below by 1.15e-4 of it.
constexpr Real tail = 1e-5, tailArea = 1.2e-4;

/// The mortar's own numbers: Van der Pluijm 1992, 1993; no residual cohesion, no dilation.
JointParams mortar()
{
	JointParams p;
	p.kn             = 400e9;
	p.ks             = 200e9;
	p.cohesion       = 0.87e6;
	p.tanPhi         = 1.01;
	p.tension        = 0.35e6;
	p.tanPhiResidual = 0.73;
	return p;
}

SofteningParams softening(Real lasting = 0)
{
	SofteningParams s;
	s.energyI      = 12;
	s.energyII     = 60;
	s.lastingShare = lasting;
	return s;
}

/// A point that is moved about, and its accounts.
struct Driven {
	JointParams     p;
	SofteningParams s;
	SofteningStep   now;
	Real            un = 0, us = 0;
	SofteningWork   sum;
	Real            work = 0, least = 0, snaps = 0; ///< least: dissipated in one step [J/m2]

	void to(Real newUn, Real newUs)
	{
		const SofteningStep next = advanceSoftening(p, s, now.joint, now.soft, newUn, newUs);
		const SofteningWork d    = dissipated(p, s, now, un, us, next, newUn, newUs);
		sum.opening += d.opening, sum.slip += d.slip, sum.friction += d.friction, sum.cap += d.cap;
		least = std::min(least, d.opening + d.slip + d.friction + d.cap);
		work += (now.sigma + next.sigma) / 2 * (newUn - un) + (now.tau + next.tau) / 2 * (newUs - us);
		snaps += next.snappedBack;
		now = next, un = newUn, us = newUs;
	}

	/// In a straight line, in n steps.
	void to(Real newUn, Real newUs, int n)
	{
		const Real fromN = un, fromS = us;
		for (int i = 1; i <= n; ++i)
			to(fromN + (newUn - fromN) * i / n, fromS + (newUs - fromS) * i / n);
	}

	/// Slips at constant normal stress, whatever the uplift.
	void slide(Real sigma, Real newUs, int n)
	{
		const Real from = us;
		for (int i = 1; i <= n; ++i)
			to(sigma / p.kn + now.joint.uplift, from + (newUs - from) * i / n);
	}

	Real stored() const { return storedEnergy(p, s, now.soft, now.sigma, now.tau); }
	Real total() const { return sum.opening + sum.slip + sum.friction + sum.cap; }
};

Driven point(const JointParams& p = mortar(), const SofteningParams& s = softening())
{
	validate(p);
	validate(p, s);
	return { p, s, {}, 0, 0, {}, 0, 0, 0 };
}

} // namespace

TEST(Exponential, TwoUnitsInTheLastPlace)
{
	EXPECT_EQ(decay(0), 1);
	EXPECT_EQ(decay(701), 0);
	EXPECT_EQ(decay(inf), 0);
	EXPECT_EQ(decay(std::nan("")), 0);
	std::mt19937                         random(1);
	std::uniform_real_distribution<Real> exponent(-12, 2.84);
	Real                                 worst = 0;
	for (int i = 0; i < 200000; ++i) {
		const Real k = std::pow(10, exponent(random)), e = std::exp(-k); // to half a unit and a little
		worst = std::max(worst, std::abs(decay(k) - e) / (std::nextafter(e, 2.0) - e));
	}
	EXPECT_LE(worst, 2);
}

// What the same source gives on any processor and with any compiler that keeps to IEEE 754.
TEST(Exponential, GoldenBits)
{
	std::uint64_t hash = 1469598103934665603u; // FNV-1a over the bits
	for (int i = 0; i < 10000; ++i) {
		const Real    value = decay(i * 0.0071);
		std::uint64_t bits;
		std::memcpy(&bits, &value, sizeof bits);
		hash = (hash ^ bits) * 1099511628211u;
	}
	EXPECT_EQ(hash, 11883685602406303132u);
}

// sigma = ft exp(-ft w/GfI), w = un - sigma/kn, whatever share of w lasts.
TEST(SofteningLaw, TensionCurve)
{
	for (Real lasting : { 0.0, 0.3, 1.0 }) {
		Driven     d  = point(mortar(), softening(lasting));
		const Real ft = d.p.tension, e = ft / d.p.kn;
		d.to(e * (1 - 4 * eps), 0, 7);
		EXPECT_EQ(int(d.now.joint.status), int(Joint::intact));
		EXPECT_NEAR(d.now.sigma, ft, 10 * eps * ft);
		for (int i = 1; i < 400; ++i) {
			const Real un = e + i * 1e-6;
			d.to(un, 0);
			const Real w = un - d.now.sigma / d.p.kn;
			if (d.now.sigma == 0) break;
			ASSERT_NEAR(d.now.sigma, ft * std::exp(-ft * w / 12), 1.1 * tail * ft) << un;
			ASSERT_NEAR(d.now.joint.uplift, lasting * w, 1e-15);
		}
		EXPECT_EQ(d.now.sigma, 0);
		EXPECT_NEAR(d.un, 11.5129 * 12 / ft, 1e-6); // the curve's end
		EXPECT_EQ(int(d.now.joint.status), int(Joint::brokenInTension));
	}
}

TEST(SofteningLaw, WorkToSeparationIsTheFractureEnergy)
{
	// The trapezoidal rule over steps of h = 1e-7 m: h^2/12 times the change of slope, ft^2/GfI = 1e10, and kn ft h / 2 at the peak's kink.
	const Real rule = 1e-14 / 12 * 1e10 + 400e9 * 1e-14 / 8;
	for (Real lasting : { 0.0, 0.5, 1.0 }) {
		Driven d = point(mortar(), softening(lasting));
		d.to(4e-4, 0, 4000);
		EXPECT_EQ(d.now.sigma, 0);
		EXPECT_NEAR(d.work, 12, 12 * tailArea + rule);
		EXPECT_NEAR(d.sum.opening, d.work, 1e-8); // roundings of thousands of sums
		EXPECT_EQ(d.sum.slip + d.sum.friction + d.sum.cap, 0);
		EXPECT_EQ(d.stored(), 0);
	}
	Driven d = point(); // pure slip under no pressure: the cohesion's energy
	d.slide(0, 9e-4, 9000);
	EXPECT_EQ(d.now.tau, 0);
	EXPECT_EQ(int(d.now.joint.status), int(Joint::brokenInShear));
	EXPECT_NEAR(d.work, 60, 60 * tailArea + 1e-14 / 12 * 9000 * 0.87e6 * 0.87e6 / 60 + 200e9 * 1e-14 / 8);
	EXPECT_NEAR(d.sum.slip, d.work, 1e-8);
	EXPECT_NEAR(d.sum.opening + d.sum.friction + d.sum.cap, 0, 1e-8);
}

// c 0.8, tan(phi) 1.0 -> 0.75, GfII 50: peak and residual of the design's table; the whole curve against tau = c f + p tan(f), f = exp(-c s/GfII).
TEST(SofteningLaw, ShearAtConstantStress)
{
	JointParams p     = mortar();
	p.cohesion        = 0.8e6;
	p.tanPhi          = 1;
	p.tanPhiResidual  = 0.75;
	SofteningParams s = softening();
	s.energyII        = 50;
	struct Case {
		Real pressure, peak, residual;
	};
	for (const Case& c : { Case { 0.1e6, 0.9e6, 0.075e6 }, Case { 0.5e6, 1.3e6, 0.375e6 }, Case { 1e6, 1.8e6, 0.75e6 } })
		for (Real way : { 1.0, -1.0 }) {
			Driven     d    = point(p, s);
			const Real step = 1e-7;
			Real       peak = 0;
			d.to(-c.pressure / p.kn, 0);
			for (int i = 1; i <= 8000; ++i) {
				d.to(d.un, way * i * step);
				const Real slip = std::abs(d.us) - std::abs(d.now.tau) / p.ks, f = std::exp(-p.cohesion * slip / 50);
				peak = std::max(peak, way * d.now.tau);
				if (d.now.soft.k > 0) {
					ASSERT_NEAR(way * d.now.tau, p.cohesion * f + c.pressure * (0.75 + 0.25 * f), 1.1 * tail * c.peak);
				}
			}
			EXPECT_LE(peak, c.peak * (1 + 4 * eps));
			EXPECT_GE(peak, c.peak - p.ks * step);
			EXPECT_NEAR(way * d.now.tau, c.residual, 4 * eps * c.residual);
			EXPECT_NEAR(d.now.sigma, -c.pressure, 4 * eps * c.pressure);
			EXPECT_EQ(d.snaps, 0);
			// accounts: cohesion's own GfII; friction p (0.75 s + 0.25 x 50/c), the last term since int f ds = GfII/c
			const Real slip = std::abs(d.now.joint.slipPlastic);
			EXPECT_NEAR(d.sum.slip, 50, 50 * tailArea + step / 2 * c.peak); // the share is that at the end of each step
			EXPECT_NEAR(d.sum.friction, c.pressure * (0.75 * slip + 0.25 * 50 / p.cohesion), 50 * tailArea + step / 2 * c.peak);
			EXPECT_NEAR(d.total() + d.stored() - c.pressure * c.pressure / p.kn / 2, d.work - c.pressure * c.pressure / p.kn / 2, 1e-9);
		}
}

// GfII + a p: what slip dissipates of the cohesion rises in proportion to the pressure, and the curve is as long as for that energy alone.
TEST(SofteningLaw, FractureEnergyOfSlipRisesWithPressure)
{
	JointParams     p = mortar();
	SofteningParams s = softening(), fixed = softening();
	s.energyIIPressure = 0.13e-3;
	for (Real pressure : { 0.0, 0.1e6, 0.5e6, 1e6 }) {
		fixed.energyII = 60 + 0.13e-3 * pressure;
		Driven rising = point(p, s), other = point(p, fixed);
		for (Driven* d : { &rising, &other }) {
			d->to(-pressure / p.kn, 0);
			d->to(d->un, 4e-3, 40000);
			EXPECT_EQ(d->snaps, 0);
		}
		EXPECT_NEAR(rising.sum.slip, fixed.energyII, fixed.energyII * tailArea + 0.5e-7 * (p.cohesion + pressure));
		EXPECT_EQ(rising.sum.slip, other.sum.slip);
		EXPECT_EQ(rising.sum.friction, other.sum.friction);
	}
	// open, or pressed only afterwards, nothing is added: softening done is done
	Driven open = point(p, s), plain = point(p, softening());
	for (Driven* d : { &open, &plain })
		d->to(1e-6, 2e-5, 100);
	EXPECT_GT(open.now.soft.k, 0.1);
	EXPECT_EQ(open.now.soft.k, plain.now.soft.k);
	const Real before = open.now.soft.k;
	open.to(-1e6 / p.kn, open.us);
	EXPECT_GE(open.now.soft.k, before);
}

// Pure paths give the same whatever the step. On mixed ones chords stand for arcs: halving the step changes less than 0.1 % of the peak.
TEST(SofteningLaw, TheStepDoesNotMatter)
{
	for (Real lasting : { 0.0, 0.5 })
		for (int path = 0; path < 4; ++path) {
			const auto ends = [&](int n, std::vector<Vec2>& out) {
				Driven d = point(mortar(), softening(lasting));
				for (int i = 1; i <= n; ++i) {
					const Real x = Real(i) / n;
					switch (path) {
					case 0:
						d.to(2e-4 * x, 0);
						break;
					case 1:
						d.to(-1e6 / d.p.kn, 5e-4 * x);
						break;
					case 2:
						d.to(1e-4 * x, 2e-4 * x);
						break;
					case 3:
						d.to(1e-4 * (x < 0.3 ? x : 0.6 - x), 4e-4 * x);
						break; // opens, then closes while it slips
					}
					if (i % (n / 50) == 0) out.push_back({ d.now.sigma, d.now.tau });
				}
			};
			const Real        peak = path == 1 ? 1.88e6 : path == 0 ? 0.35e6 : 0.87e6;
			std::vector<Vec2> coarse, fine;
			ends(200, coarse), ends(400, fine);
			Real change = 0;
			for (size_t i = 0; i < fine.size(); ++i)
				change = std::max(change, (coarse[i] - fine[i]).lpNorm<Eigen::Infinity>());
			EXPECT_LT(change, path < 2 ? 1e-11 * peak : 1e-3 * peak) << "path " << path;
		}
}

// Opened by w in tension, it unloads along the secant to what lasts, is whole below, and comes back to where it left.
TEST(SofteningLaw, ReclosureIsWholeAndStiffnessFallsWithDamage)
{
	Real last = inf;
	for (Real lasting : { 0.0, 0.4, 1.0 })
		for (Real un : { 1e-5, 4e-5, 1e-4 }) {
			Driven d = point(mortar(), softening(lasting));
			d.to(un, 0, 2000);
			const Real top = d.now.sigma, w = un - top / d.p.kn, closes = lasting * w;
			const Real secant = top / (un - closes);
			EXPECT_NEAR(d.now.joint.uplift, closes, 1e-18);
			const SofteningState before = d.now.soft;
			for (Real share : { 0.75, 0.5, 0.1 }) {
				d.to(closes + share * (un - closes), 0);
				EXPECT_NEAR(d.now.sigma, share * top, 1e-9 * top);
				EXPECT_EQ(d.now.soft.k, before.k);
			}
			EXPECT_LE(secant, d.p.kn * (1 + 1e-9));
			if (lasting == 1) {
				EXPECT_NEAR(secant, d.p.kn, 1e-5 * d.p.kn);
			} // 1e-18 m x kn against top
			if (lasting == 0) {
				EXPECT_LT(secant, last); // a row of growing damage
				last = secant;
			}
			d.to(closes, 0); // a step ends at the kink, so that the trapezoidal rule stays exact
			d.to(closes - 2e-6, 0);
			EXPECT_NEAR(d.now.sigma, -2e-6 * d.p.kn, 1e-7 * d.p.kn * 2e-6);
			d.to(closes, 0);
			d.to(un, 0, 3);
			EXPECT_NEAR(d.now.sigma, top, 1e-9 * top);
			EXPECT_NEAR(d.now.soft.k, before.k, 1e-9);
			d.to(4e-4, 0, 4000); // cycles cost nothing: what it dissipates to the end is GfI
			EXPECT_NEAR(d.sum.opening, 12, 12 * 1e-3);
		}
}

// Random walks of many sizes through tension, pressure and slip. Each step dissipates; the trapezoidal rule is wrong by at most
// the largest stiffness times the square of the step, where a step has a kink.
TEST(SofteningLaw, CyclesNeverCreateEnergy)
{
	std::mt19937                         random(3);
	std::uniform_real_distribution<Real> unit(0, 1);
	for (int kind = 0; kind < 3; ++kind) // tension, shear, mixed
		for (Real lasting : { 0.0, 0.5, 1.0 })
			for (int walk = 0; walk < 8; ++walk) {
				JointParams p      = mortar();
				p.cohesionResidual = walk % 2 ? 0.1e6 : 0;
				p.tensionResidual  = walk % 3 == 1 ? 0.02e6 : 0;
				p.tanDilation      = walk % 4 == 3 ? 0.3 : 0;
				SofteningParams s  = softening(lasting);
				s.dilationDecay    = 1e4;
				s.dilationPressure = 2e6;
				s.energyIIPressure = 0.13e-3;
				Driven     d       = point(p, s);
				const Real step    = 2e-8;
				for (int leg = 0; leg < 12; ++leg) {
					const Real un = kind == 1 ? -unit(random) * 3e-6 : (unit(random) - 0.2) * 1e-4,
						   us = kind == 0 ? 0 : (unit(random) - 0.5) * 4e-4;
					d.to(un, us, 1 + int(std::max(std::abs(un - d.un), std::abs(us - d.us)) / step));
					// the loop closed here: straight down the springs nothing is left but what was dissipated
					ASSERT_GE(d.work - d.stored(), -1e-9);
					ASSERT_LE(d.now.soft.k, softeningEnd);
				}
				// what dilation raises presses from the next step on: its work is booked there
				EXPECT_GE(d.least, -p.kn * step * step - p.tanDilation * p.kn * 3e-6 * step)
					<< "kind " << kind << ", lasting " << lasting << ", walk " << walk;
				EXPECT_NEAR(d.total(), d.work - d.stored(), 1e-9 * (1 + d.work));
				EXPECT_GE(std::min({ d.sum.opening, d.sum.slip, d.sum.friction }), -1e-3);
				if (p.tensionResidual == 0 && kind == 0) {
					EXPECT_LE(d.sum.opening, 12 * (1 + 1e-3));
				}
			}
}

// Slip spends the tensile strength too, and opening the cohesion: both have the same k.
TEST(SofteningLaw, TensionAndShearShareOneScalar)
{
	Driven d = point();
	d.slide(-0.5e6, 6e-5, 600);
	const Real k = d.now.soft.k, f = std::exp(-k);
	EXPECT_NEAR(k, 0.87e6 * d.now.joint.slipPlastic / 60, 1e-9);
	EXPECT_GT(k, 0.3);
	d.to(0.999 * f * 0.35e6 / d.p.kn, d.now.joint.slipPlastic);
	EXPECT_EQ(d.now.soft.k, k);
	EXPECT_NEAR(d.now.sigma, 0.999 * f * 0.35e6, 1e-6);
	d.to(1.2 * f * 0.35e6 / d.p.kn, d.now.joint.slipPlastic);
	EXPECT_GT(d.now.soft.k, k);

	Driven o = point();
	o.to(4e-5, 0, 100);
	const Real g = std::exp(-o.now.soft.k);
	o.to(0, 0);
	o.slide(-0.2e6, 3e-5, 30000); // the peak of what is left
	Real peak = 0;
	for (int i = 0; i < 30000; ++i)
		o.to(-0.2e6 / o.p.kn, 3e-5 * i / 30000), peak = std::max(peak, std::abs(o.now.tau));
	EXPECT_NEAR(g * 0.87e6 + 0.2e6 * (0.73 + 0.28 * g), 0.61e6, 0.2e6); // (a sensible number)
	EXPECT_LE(peak, g * 0.87e6 + 0.2e6 * (0.73 + 0.28 * g));
}

// Every step obeys dk = sqrt((ft l1/GfI)^2 + (c l2/GfII)^2), to the roundings of openings of 1e-5 m, times ft/GfI and c/GfII.
TEST(SofteningLaw, OpeningAndSlipAddAsSquares)
{
	Driven d    = point();
	int    both = 0;
	for (int i = 1; i <= 1000; ++i) {
		const SofteningStep before = d.now;
		d.to(5e-8 * i, 1.2e-7 * i);
		const Real l1 = d.now.soft.opening - before.soft.opening, l2 = d.now.joint.slipPlastic - before.joint.slipPlastic;
		const Real a = 0.35e6 * l1 / 12, b = 0.87e6 * l2 / 60, dk = d.now.soft.k - before.soft.k;
		if (d.now.soft.k >= softeningEnd) break;
		ASSERT_NEAR(dk, std::sqrt(a * a + b * b), 1e-12);
		both += a > 1e-4 && b > 1e-4;
	}
	EXPECT_GT(both, 100);
}

// tan(psi) = tan(psi0) <1 - p/sigma_u> e^(-delta s), so uplift = tan(psi0) <1 - p/sigma_u> (1 - e^(-delta s))/delta.
TEST(SofteningLaw, DilatancyDecaysWithSlipAndPressure)
{
	JointParams p      = mortar();
	p.tanDilation      = 0.4;
	SofteningParams s  = softening();
	s.dilationDecay    = 8e3;
	s.dilationPressure = 2e6;
	for (Real pressure : { 0.2e6, 1e6, 3e6 }) {
		Driven     d     = point(p, s);
		const Real share = std::max(0.0, 1 - pressure / 2e6);
		d.slide(-pressure, 3e-4, 300);
		const auto raised = [&](Real slip) { return 0.4 * share * (1 - std::exp(-8e3 * slip)) / 8e3; };
		const Real slip   = d.now.joint.slipPlastic;
		EXPECT_NEAR(d.now.joint.uplift, raised(slip), 1e-12 * 3e-4 * 300);
		d.slide(-pressure, -2e-4, 500); // reversal: nothing more, nothing back
		EXPECT_NEAR(d.now.joint.uplift, raised(slip), 1e-12 * 3e-4 * 300);
		d.slide(-pressure, 6e-4, 800); // farther than ever: goes on
		EXPECT_NEAR(d.now.joint.uplift, raised(d.now.joint.slipPlastic), 1e-12 * 3e-4 * 300);
		EXPECT_NEAR(d.now.sigma, -pressure, 1e-3 * pressure + p.kn * 0.4 * 1e-6);
		EXPECT_GE(d.least, -p.tanDilation * pressure * 1e-6); // uplift presses one step late
		EXPECT_GT(d.total(), 0);
	}
	Driven open = point(p, s);
	open.to(5e-6, 0, 50);
	open.to(5e-6, 1e-4, 1000); // slip without pressure raises nothing
	EXPECT_GT(open.now.joint.slipPlastic, 5e-5);
	EXPECT_EQ(open.now.joint.uplift, 0);
	p.dilationLimitSlip = 1e-4;
	s.dilationDecay     = 0;
	Driven d            = point(p, s);
	d.slide(-1e6, 5e-4, 500);
	EXPECT_NEAR(d.now.joint.uplift, 0.4 * 0.5 * 1e-4, 1e-15);
}

// Beyond ks = c (c + p (tan phi - tan phi_res))/GfII the curve turns back under a point: its stress drops to the curve in one step, and the energy
// that sets free is dissipated. The k is the smallest for which the strength suffices.
TEST(SofteningLaw, SnapBackUnderHighPressure)
{
	const Real critical = (200e9 * 60 / 0.87e6 - 0.87e6) / 0.28; // 46 MPa
	for (Real ratio : { 0.98, 1.02, 2.0, 20.0 }) {
		Driven     d        = point();
		const Real pressure = ratio * critical, peak = 0.87e6 + 1.01 * pressure;
		d.to(-pressure / d.p.kn, 0);
		const Real start = peak / d.p.ks;
		d.to(d.un, start * (1 - 1e-12));
		EXPECT_EQ(d.now.soft.k, 0);
		for (int i = 1; i <= 2000; ++i)
			d.to(d.un, start + i * 1e-8);
		EXPECT_EQ(d.snaps > 0, ratio > 1);
		// where GfII rises with the pressure as fast as what the curve has to fall by, no pressure is too high
		SofteningParams rising  = softening();
		rising.energyIIPressure = 0.28 * 0.87e6 / 200e9;
		Driven follows          = point(mortar(), rising);
		follows.to(-pressure / follows.p.kn, 0);
		follows.to(follows.un, start + 2e-5, 4000);
		EXPECT_EQ(follows.snaps, 0);
		EXPECT_GE(d.least, -1e-9 * d.work);
		const Real f = (std::exp(-d.now.soft.k) - tail) / (1 - tail);
		EXPECT_NEAR(d.now.tau, 0.87e6 * f + pressure * (0.73 + 0.28 * f), 1e-9 * peak);
		if (ratio > 1) { // just past the peak the drop solves k = c (T - tau(k))/(ks GfII), and no smaller k does
			Driven once = point();
			once.to(-pressure / once.p.kn, 0);
			once.to(once.un, start * (1 + 1e-9));
			const Real k       = once.now.soft.k;
			const auto missing = [&](Real x) {
				const Real g = (std::exp(-x) - tail) / (1 - tail);
				return 0.87e6 * (start * (1 + 1e-9) * 200e9 - (0.87e6 * g + pressure * (0.73 + 0.28 * g))) / (200e9 * 60) - x;
			};
			if (k < softeningEnd) {
				EXPECT_NEAR(missing(k), 0, 1e-9);
			}
			for (int i = 0; i < 100; ++i)
				EXPECT_GT(missing(k * i / 100), 0);
			EXPECT_TRUE(once.now.snappedBack);
		}
	}
}

// While nothing yields, the test, the law and the brittle law agree to the bit, at the very limits too.
TEST(SofteningLaw, ElasticMeansWhatItMeansForTheBrittleLaw)
{
	std::mt19937                         random(5);
	std::uniform_real_distribution<Real> unit(-1, 1);
	JointParams                          p = mortar();
	p.cohesionResidual = 0.1e6, p.tensionResidual = 0.03e6;
	const SofteningParams s        = softening(0.3);
	int                   elastics = 0;
	for (int i = 0; i < 200000; ++i) {
		JointState joint { unit(random) * 1e-6, std::abs(unit(random)) * 1e-7, Joint::intact };
		Real       un = joint.uplift + unit(random) * 1.5e-6, us = unit(random) * 1e-5;
		if (i % 4 == 0) un = joint.uplift + p.tension / p.kn * (1 + (i % 7 - 3) * eps);
		if (i % 4 == 1) us = joint.slipPlastic + (p.cohesion - p.kn * (un - joint.uplift) * p.tanPhi) / p.ks * (1 + (i % 7 - 3) * eps);
		const JointStep     brittle = blocks::advance(p, joint, un, us);
		const SofteningStep soft = advanceSoftening(p, s, joint, {}, un, us), whole = blocks::soften(p, s, joint, {}, un, us);
		const bool          is = blocks::elastic(p, s, joint.status, p.kn * (un - joint.uplift), p.ks * (us - joint.slipPlastic));
		ASSERT_EQ(is, brittle.state.status == Joint::intact);
		ASSERT_EQ(soft.sigma, whole.sigma);
		ASSERT_EQ(soft.tau, whole.tau);
		ASSERT_EQ(soft.soft.k, whole.soft.k);
		if (!is) continue;
		++elastics;
		ASSERT_EQ(soft.sigma, brittle.sigma);
		ASSERT_EQ(soft.tau, brittle.tau);
		ASSERT_EQ(int(soft.joint.status), int(Joint::intact));
		ASSERT_EQ(soft.joint.slipPlastic, joint.slipPlastic);
	}
	EXPECT_GT(elastics, 20000);
}

// Nothing but residual strength left, a point is the brittle law's broken one, to the bit; so is one that was never bonded.
TEST(SofteningLaw, PartedIsBrokenOrDry)
{
	std::mt19937                         random(7);
	std::uniform_real_distribution<Real> unit(-1, 1);
	JointParams                          p = mortar();
	p.cohesionResidual                     = 0.1e6;
	const SofteningParams s                = softening(0.5);
	for (Joint status : { Joint::brokenInTension, Joint::brokenInShear, Joint::unbonded })
		for (int i = 0; i < 20000; ++i) {
			const JointState     old { unit(random) * 1e-6, unit(random) > 0 ? 1e-6 : 0, status };
			const SofteningState soft { status == Joint::unbonded ? 0 : softeningEnd, status == Joint::unbonded ? 0 : 2e-6, 0, 0 };
			const Real           un = unit(random) * 3e-6, us = unit(random) * 1e-5;
			const JointStep      brittle = blocks::advance(p, old, un, us);
			const SofteningStep  now     = advanceSoftening(p, s, old, soft, un, us);
			ASSERT_EQ(now.sigma, brittle.sigma);
			ASSERT_EQ(now.tau, brittle.tau);
			ASSERT_EQ(now.joint.slipPlastic, brittle.state.slipPlastic);
			ASSERT_EQ(now.joint.uplift, brittle.state.uplift);
			ASSERT_EQ(int(now.joint.status), int(status));
		}
}

TEST(SofteningLaw, CracksAtTheStatedDamage)
{
	Driven d = point();
	d.to(1e-6, 0);
	EXPECT_EQ(int(d.now.joint.status), int(Joint::softening));
	const Real k = -std::log(1 - crackedFrom), w = k * 12 / 0.35e6, sigma = 0.35e6 * (1 - crackedFrom);
	d.to((w + sigma / d.p.kn) * 0.999, 0, 10);
	EXPECT_EQ(int(d.now.joint.status), int(Joint::softening));
	EXPECT_LT(damage(d.now.soft), crackedFrom);
	d.to((w + sigma / d.p.kn) * 1.001, 0);
	EXPECT_EQ(int(d.now.joint.status), int(Joint::brokenInTension));
	EXPECT_GE(damage(d.now.soft), crackedFrom);
	Driven s = point();
	s.slide(-1e6, 4e-4, 400);
	EXPECT_EQ(int(s.now.joint.status), int(Joint::brokenInShear));
}

TEST(SofteningLaw, ResidualStrengths)
{
	JointParams p      = mortar();
	p.cohesionResidual = 0.1e6, p.tensionResidual = 0.05e6;
	Driven d = point(p, softening());
	d.to(1e-3, 0, 1000);
	EXPECT_NEAR(d.now.sigma, 0.05e6, 1e-9); // for ever
	p.tensionResidual = 0;
	Driven open       = point(p, softening());
	open.to(2e-5, 0, 100);
	open.to(2e-5, 3e-4, 3000);
	EXPECT_LE(open.now.tau, 0.87e6 * (1 - damage(open.now.soft))); // the residual cohesion needs contact
	Driven shut = point(p, softening());
	shut.slide(-0.5e6, 1.2e-3, 1200);
	EXPECT_NEAR(shut.now.tau, 0.1e6 + 0.73 * 0.5e6, 1e-9);
}

namespace {
SofteningParams capped()
{
	SofteningParams s = softening();
	s.cap             = { 8e6, 3e6, 1e6, 2e-5, 3000, 9, 0.4e6 };
	return s;
}
} // namespace

// Closed, without slip: sigma = -F(kappa), kappa = -(un - sigma/kn).
TEST(SofteningLaw, CapInClosedForm)
{
	for (Real h : { 1e-7, 5e-8 }) {
		Driven d    = point(mortar(), capped());
		Real   peak = 0, afterPeak = 0, before = 0;
		for (int i = 1; i < 1.2e-2 / h / 8; ++i) {
			const Real lastKappa = d.now.soft.crushing, last = d.now.sigma;
			d.to(-i * h, 0);
			const Real kappa = -(d.un - d.now.sigma / d.p.kn), x = std::min(1.0, kappa / 2e-5);
			const Real F = x < 1 ? 3e6 + 5e6 * std::sqrt(x * (2 - x)) : 1e6 + 7e6 * std::exp(-(kappa - 2e-5) * 7e6 / 3000);
			if (d.now.sigma < -3e6 && kappa > 1e-9) {
				ASSERT_NEAR(d.now.sigma, -F, 1e-7 * 8e6) << kappa;
			}
			peak = std::min(peak, d.now.sigma);
			if (lastKappa > 2e-5)
				afterPeak += -(last + d.now.sigma) / 2 * (d.now.soft.crushing - lastKappa) - 1e6 * (d.now.soft.crushing - lastKappa);
			before = d.now.sigma;
		}
		EXPECT_NEAR(peak, -8e6, 1e-3 * 8e6);
		EXPECT_NEAR(before, -1e6 - 7e6 * std::exp(-(1.5e-3 - 2e-5) * 7e6 / 3000), 1e-2 * 8e6);
		// the energy above the residual up to here, less the step in which the peak was passed
		const Real expected = 3000 * (1 - std::exp(-(d.now.soft.crushing - 2e-5) * 7e6 / 3000));
		EXPECT_NEAR(afterPeak, expected, 7e6 * 2 * h + 1e-4 * 3000);
		EXPECT_NEAR(d.sum.cap, d.work - d.stored(), 1e-9 * d.work);
		EXPECT_EQ(d.now.soft.k, 0);
		d.to(d.un + 1e-6, 0); // unloads with kn
		EXPECT_NEAR(d.now.sigma - before, 1e-6 * d.p.kn, 1e-3);
	}
}

// Every stress lies within the ellipse, also where the shear strength cuts it; halving the step changes little.
TEST(SofteningLaw, CapWithSlip)
{
	const auto run = [](int n, bool weak, std::vector<Vec2>& out, Real& outside, Driven& d) {
		JointParams p = mortar();
		if (!weak) p.cohesion = 20e6, p.ks = 2e12;
		if (weak) p.cohesion = 0.3e6, p.tanPhi = 0.2, p.tanPhiResidual = 0.1;
		SofteningParams s = capped();
		if (!weak) s.energyII = 6000;
		d = point(p, s);
		for (int i = 1; i <= n; ++i) {
			d.to(-1e-4 * i / n, 8e-5 * i / n);
			const Real x     = std::min(1.0, d.now.soft.crushing / 2e-5);
			const Real F     = x < 1 ? 3e6 + 5e6 * std::sqrt(x * (2 - x)) : 1e6 + 7e6 * std::exp(-(d.now.soft.crushing - 2e-5) * 7e6 / 3000);
			const Real sigma = d.now.sigma, tau = d.now.tau;
			outside = std::max(outside, (sigma * sigma + 9 * tau * tau + 0.4e6 * sigma) / (F * (F - 0.4e6)) - 1);
			if (i % (n / 50) == 0) out.push_back({ sigma, tau });
		}
	};
	for (bool weak : { false, true }) {
		std::vector<Vec2> coarse, fine;
		Real              outside = 0, change = 0;
		Driven            d = point(mortar(), capped());
		run(500, weak, coarse, outside, d), run(1000, weak, fine, outside, d);
		EXPECT_LE(outside, 1e-9);
		for (size_t i = 0; i < fine.size(); ++i)
			change = std::max(change, (coarse[i] - fine[i]).lpNorm<Eigen::Infinity>());
		EXPECT_LT(change, 0.01 * 8e6); // first order in the step where chords stand for arcs
		EXPECT_GE(d.least, -d.p.kn * 1e-7 * 1e-7 * 10);
		EXPECT_GT(d.sum.cap, 0);
		EXPECT_EQ(d.sum.friction > 1, weak);
		EXPECT_NEAR(d.total(), d.work - d.stored(), 1e-9 * d.work);
	}
}

TEST(SofteningLaw, RefusesImpossibleParameters)
{
	struct Case {
		std::function<void(JointParams&, SofteningParams&)> change;
		std::vector<std::string>                            words;
	};
	for (const Case& c : std::vector<Case> {
		     { [](auto&, auto&s) { s.energyI = -1; }, { "GfI", "not be negative", "-1" } },
		     { [](auto&, auto&s) { s.energyII = std::nan(""); }, { "GfII", "not be negative", "nan" } },
		     { [](auto&, auto&s) { s.energyI = 0; }, { "GfI", "must be positive where GfII is" } },
		     { [](auto&, auto&s) { s.energyII = 0; }, { "GfII", "must be positive where GfI is" } },
		     { [](auto&, auto&s) { s.energyIIPressure = -1e-4; }, { "GfIIPressure", "not be negative", "-0.0001" } },
		     { [](auto&, auto&s) { s = {}, s.energyIIPressure = 1e-4; }, { "GfIIPressure", "needs softening", "0.0001" } },
		     { [](auto&, auto&s) { s.lastingShare = 1.5; }, { "lastingShare", "[0, 1]", "1.5" } },
		     { [](auto&, auto&s) { s.dilationDecay = -2; }, { "dilationDecay", "not be negative", "-2" } },
		     { [](auto&, auto&s) { s.dilationPressure = 0; }, { "dilationPressure", "positive" } },
		     { [](auto&, auto&s) { s.energyI = s.energyII = 0, s.lastingShare = 0.5; }, { "lastingShare", "needs softening", "0.5" } },
		     { [](auto&, auto&s) { s = capped(), s.energyI = s.energyII = 0; }, { "capStrength", "needs softening" } },
		     { [](auto&p, auto&) { p.tension = 0; }, { "tension", "positive where joints soften" } },
		     { [](auto&p, auto&) { p.cohesion = 0.3e6; }, { "cohesion", "below tension tan(frictionAngle)", "353500", "300000" } },
		     { [](auto&p, auto&) { p.tanPhiResidual = 1.2; }, { "frictionAngleResidual", "not exceed", "1.2" } },
		     { [](auto&, auto&s) { s.energyI = 0.35e6 * 0.35e6 / 400e9; }, { "snaps back", "tension 350000", "kn 400000000000", "GfI" } },
		     { [](auto&, auto&s) { s.energyII = 0.87e6 * 0.87e6 / 200e9; }, { "snaps back", "cohesion 870000", "ks 200000000000", "GfII" } },
		     { [](auto&, auto&s) { s.energyI = 0.4, s.energyII = 5; }, { "snaps back" } }, // 0.77^2 + 0.76^2: neither alone
		     { [](auto&, auto&s) { s.cap.first = 1e6; }, { "capStrength", "positive where other parameters of the cap" } },
		     { [](auto&, auto&s) { s = capped(), s.cap.energy = 0; }, { "capEnergy", "positive with a cap" } },
		     { [](auto&, auto&s) { s = capped(), s.cap.shear = -9; }, { "cap", "not be negative", "-9" } },
		     { [](auto&, auto&s) { s = capped(), s.cap.first = 9e6; }, { "capFirst", "not exceed capStrength", "9000000" } },
		     { [](auto&, auto&s) { s = capped(), s.cap.residual = 9e6; }, { "capResidual", "not exceed capStrength" } },
		     { [](auto&, auto&s) { s = capped(), s.cap.linear = 2e6; }, { "capLinear", "below twice", "2000000" } },
		     { [](auto&, auto&s) { s = capped(), s.cap.energy = 200; }, { "snaps back in compression", "capEnergy", "245000000000" } },
	     }) {
		JointParams     p = mortar();
		SofteningParams s = softening();
		c.change(p, s);
		SCOPED_TRACE(c.words[0]);
		validate(p);
		expectRefusal([&] { validate(p, s); }, c.words);
	}
	EXPECT_NO_THROW(validate(mortar(), SofteningParams()));
	EXPECT_NO_THROW(validate(mortar(), capped()));
	SofteningParams within = softening();
	within.energyI = 0.5, within.energyII = 6; // 0.61^2 + 0.63^2 = 0.77
	EXPECT_NO_THROW(validate(mortar(), within));
	SofteningParams just = softening(1);
	just.energyI         = 1.01 * 0.35e6 * 0.35e6 / 400e9;
	just.energyII        = 1e6 * 60;
	EXPECT_NO_THROW(validate(mortar(), just));
}
