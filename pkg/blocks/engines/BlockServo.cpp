// yade-blocks, GPL-2.0-or-later
#include <blocks/engines/BlockServo.hpp>
#include <blocks/kernel/analysis/Energy.hpp>

namespace yade {

BlockServo::~BlockServo() = default;

void BlockServo::postLoad(BlockServo&)
{
	const Settings wanted { target, floor, least, period };
	target = accepted.target, floor = accepted.floor, least = accepted.least, period = accepted.period; // what is refused must not stay
	blocks::require(wanted.target > 0 && std::isfinite(wanted.target), "BlockServo.target must be positive", wanted.target);
	blocks::require(wanted.floor >= 0 && std::isfinite(wanted.floor), "BlockServo.floor must not be negative [N]", wanted.floor);
	blocks::require(wanted.least > 0 && wanted.least <= 1, "BlockServo.least must lie in (0, 1]", wanted.least);
	blocks::require(wanted.period >= 1, "BlockServo.period must be at least 1", wanted.period);
	accepted = wanted;
	target = wanted.target, floor = wanted.floor, least = wanted.least, period = wanted.period;
}

void BlockServo::step(BlockModel& model)
{
	if (scene->iter % period) return;
	if (model.forcesAt != scene->iter) throw std::runtime_error("O.engines needs a BlockLoop (or BlockForces) before BlockServo");
	if (groups.empty()) throw std::runtime_error("BlockServo.groups must name the motion groups to slow, but is empty");
	throttle *= blocks::unbalancedRatio(model.assembly, floor) > target ? 0.8 : 1.1;
	throttle = std::min(Real(1), std::max(least, throttle));
	for (const string& name : groups) {
		blocks::MotionGroup& group = model.group(name);
		if (group.drive != blocks::MotionGroup::Drive::velocity)
			throw std::invalid_argument("BlockServo.groups must be driven by a velocity, but \"" + name + "\" is pushed by a force");
		group.throttle = throttle;
	}
}

YADE_PLUGIN((BlockServo));

} // namespace yade
