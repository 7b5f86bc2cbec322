// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/laws/JointLaw.hpp>

namespace blocks {

void validate(const JointParams& p)
{
	auto positive = [](Real v, const char* name, const char* unit) {
		require(v > 0 && std::isfinite(v), std::string("joint parameter ") + name + " must be positive and finite " + unit, v);
	};
	auto notNegative = [](Real v, const char* name, const char* unit) {
		require(v >= 0, std::string("joint parameter ") + name + " must not be negative " + unit, v);
	};
	positive(p.kn, "kn", "[Pa/m]");
	positive(p.ks, "ks", "[Pa/m]");
	notNegative(p.cohesion, "cohesion", "[Pa]");
	notNegative(p.tension, "tension", "[Pa]");
	notNegative(p.cohesionResidual, "cohesionResidual", "[Pa]");
	notNegative(p.tensionResidual, "tensionResidual", "[Pa]");
	notNegative(p.dilationLimitSlip, "dilationLimitSlip", "[m]");
	for (Real tangent : { p.tanPhi, p.tanPhiResidual, p.tanDilation })
		require(tangent >= 0 && std::isfinite(tangent), "a joint's friction and dilation angles must lie in [0, 90) degrees; tangent", tangent);
	if (p.tanDilation > p.tanPhiResidual) // the work of the uplift against the pressure would exceed that of friction
		throw std::invalid_argument(
			"joint parameter dilationAngle must not exceed frictionAngleResidual (energy would come from nowhere), got "
			+ shown(std::atan(p.tanDilation)) + " and " + shown(std::atan(p.tanPhiResidual)) + " rad");
	require(p.cohesionResidual <= p.cohesion, "joint parameter cohesionResidual must not exceed cohesion [Pa]", p.cohesionResidual);
	require(p.tensionResidual <= p.tension, "joint parameter tensionResidual must not exceed tension [Pa]", p.tensionResidual);
}

} // namespace blocks
