// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/model/StrengthField.hpp>
#include <random>

namespace blocks {
namespace {
	constexpr Real pi    = 3.14159265358979323846;
	constexpr int  waves = 512;

	/// Uniform in (0, 1) and standard normal numbers; the library's distributions differ from one library to the next.
	class Random {
	public:
		explicit Random(std::uint64_t seed)
			: generator(seed)
		{
		}
		Real uniform() { return (Real(generator() >> 11) + 0.5) / 9007199254740992.0; } // 2^53
		Vec2 normals()                                                                  // Box and Muller
		{
			const Real radius = std::sqrt(-2 * std::log(uniform())), angle = 2 * pi * uniform();
			return { radius * std::cos(angle), radius * std::sin(angle) };
		}

	private:
		std::mt19937_64 generator;
	};

	std::vector<Real> normalField(const std::vector<Vec2>& places, Real length, Random& random)
	{
		std::vector<Real> field(places.size(), 0);
		if (length == 0) {
			for (Real& g : field)
				g = random.normals().x();
			return field;
		}
		for (int w = 0; w < waves; ++w) { // the spectrum of e^-(r/length)^2 is normal
			const Vec2 k     = random.normals() * std::sqrt(Real(2)) / length;
			const Real phase = 2 * pi * random.uniform();
			for (size_t i = 0; i < places.size(); ++i)
				field[i] += std::sqrt(Real(2) / waves) * std::cos(k.dot(places[i]) + phase);
		}
		return field;
	}
} // namespace

Real weibullModulus(Real cov)
{
	require(cov > 0 && cov <= 1, "a Weibull distribution's coefficient of variation must lie in (0, 1]", cov);
	const auto squared = [](Real m) { return std::expm1(std::lgamma(1 + 2 / m) - 2 * std::lgamma(1 + 1 / m)); };
	Real       low = 0.5, high = 1;
	while (squared(high) > cov * cov)
		high *= 2;
	for (int i = 0; i < 60; ++i) {
		const Real middle                          = (low + high) / 2;
		(squared(middle) > cov * cov ? low : high) = middle;
	}
	return (low + high) / 2;
}

std::vector<Real> strengthFactors(const std::vector<Vec2>& places, const StrengthScatter& s)
{
	require(s.cov >= 0 && s.cov <= 1, "the strengths' coefficient of variation must lie in [0, 1]", s.cov);
	require(s.correlationLength >= 0 && std::isfinite(s.correlationLength),
	        "the strengths' correlation length must not be negative and must be finite [m]",
	        s.correlationLength);
	if (s.cov == 0) return std::vector<Real>(places.size(), 1);
	Random            random(s.seed);
	std::vector<Real> factor = normalField(places, s.correlationLength, random);
	if (s.kind == StrengthScatter::Kind::lognormal) {
		const Real variance = std::log1p(s.cov * s.cov);
		for (Real& g : factor)
			g = std::exp(std::sqrt(variance) * g - variance / 2);
	} else {
		const Real m = weibullModulus(s.cov), mean = std::tgamma(1 + 1 / m);
		for (Real& g : factor)
			g = std::pow(-std::log(std::erfc(g / std::sqrt(Real(2))) / 2), 1 / m) / mean; // 1 - Phi(g) = erfc(g/sqrt 2)/2
	}
	return factor;
}

} // namespace blocks
