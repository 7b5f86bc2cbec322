// yade-blocks, GPL-2.0-or-later
#include <Specimens.hpp>
#include <blocks/kernel/model/StrengthField.hpp>

using namespace specimens;

namespace {

std::vector<Vec2> grid(int n, Real spacing)
{
	std::vector<Vec2> places;
	for (int i = 0; i < n; ++i)
		for (int j = 0; j < n; ++j)
			places.push_back({ spacing * i, spacing * j });
	return places;
}

struct Moments {
	Real mean = 0, deviation = 0;
	explicit Moments(const std::vector<Real>& v)
	{
		for (Real x : v)
			mean += x / Real(v.size());
		for (Real x : v)
			deviation += (x - mean) * (x - mean) / Real(v.size());
		deviation = std::sqrt(deviation);
	}
};

} // namespace

// m = 1 is the exponential distribution, cov 1; m = 2 Rayleigh's, cov sqrt(4/pi - 1).
TEST(StrengthField, WeibullModulusInClosedForm)
{
	EXPECT_NEAR(weibullModulus(1), 1, 1e-12);
	EXPECT_NEAR(weibullModulus(std::sqrt(4 / M_PI - 1)), 2, 1e-12);
}

// 40,000 independent draws: the mean is known to cov/200, the deviation to about as much; five of these.
TEST(StrengthField, MeanAndScatterAreThoseAskedFor)
{
	for (auto kind : { StrengthScatter::Kind::weibull, StrengthScatter::Kind::lognormal })
		for (Real cov : { 0.1, 0.3 }) {
			const Moments m(strengthFactors(grid(200, 1), { kind, cov, 0, 3 }));
			EXPECT_NEAR(m.mean, 1, 5 * cov / 200);
			EXPECT_NEAR(m.deviation, cov, 5 * cov / 200);
		}
}

// The tail that matters: the share below x of a Weibull distribution, 1 - e^-(x Gamma(1 + 1/m))^m; counts scatter by their root.
TEST(StrengthField, WeakOnesAreAsFrequentAsWeibullSays)
{
	const Real m = weibullModulus(0.25), scale = std::tgamma(1 + 1 / m);
	const auto factors = strengthFactors(grid(200, 1), { StrengthScatter::Kind::weibull, 0.25, 0, 5 });
	for (Real x : { 0.3, 0.6, 1.0 }) {
		const Real expected = 40000 * (1 - std::exp(-std::pow(x * scale, m)));
		EXPECT_NEAR(Real(std::count_if(factors.begin(), factors.end(), [&](Real f) { return f < x; })), expected, 5 * std::sqrt(expected));
	}
}

// Mean over 400 fields of the product of two places' normals, e^-(r/length)^2: known to 1/20 each.
TEST(StrengthField, NeighboursAreAlikeWithinTheCorrelationLength)
{
	const std::vector<Vec2> places { { 0.3, 0.2 }, { 0.3, 0.25 }, { 0.38, 0.26 }, { 0.9, 0.8 } };
	std::array<Real, 4>     sum {};
	constexpr int           seeds = 1600;
	for (int seed = 0; seed < seeds; ++seed) {
		const auto          f = strengthFactors(places, { StrengthScatter::Kind::lognormal, 0.2, 0.1, std::uint64_t(seed) });
		const Real          s = std::sqrt(std::log1p(0.04));
		std::array<Real, 4> g;
		for (int i = 0; i < 4; ++i)
			g[i] = (std::log(f[i]) + s * s / 2) / s;
		for (int i = 0; i < 4; ++i)
			sum[i] += g[0] * g[i] / seeds;
	}
	for (int i = 0; i < 4; ++i)
		EXPECT_NEAR(sum[i], std::exp(-(places[i] - places[0]).squaredNorm() / 0.01), 4 * std::sqrt(2.0 / seeds))
			<< i; // a product has a variance of 2 at most
}

TEST(StrengthField, SeedsRepeatAndOffIsOne)
{
	const auto            places = grid(5, 0.01);
	const StrengthScatter s { StrengthScatter::Kind::weibull, 0.2, 0.02, 7 };
	EXPECT_EQ(strengthFactors(places, s), strengthFactors(places, s));
	StrengthScatter other = s;
	other.seed            = 8;
	EXPECT_NE(strengthFactors(places, s), strengthFactors(places, other));
	EXPECT_EQ(strengthFactors(places, {}), std::vector<Real>(25, 1));
	for (Real f : strengthFactors(places, s))
		EXPECT_GT(f, 0);
}

TEST(StrengthField, RefusesWhatIsNoDistribution)
{
	const auto places = grid(2, 1);
	expectRefusal([&] { strengthFactors(places, { StrengthScatter::Kind::weibull, -0.1, 0, 1 }); }, { "coefficient of variation", "[0, 1]", "-0.1" });
	expectRefusal([&] { strengthFactors(places, { StrengthScatter::Kind::weibull, 1.5, 0, 1 }); }, { "coefficient of variation", "1.5" });
	expectRefusal([&] { strengthFactors(places, { StrengthScatter::Kind::lognormal, 0.1, std::nan(""), 1 }); }, { "correlation length", "nan" });
}
