// yade-blocks, GPL-2.0-or-later
#include <blocks/engines/BlockTimeStepper.hpp>

namespace yade {

BlockTimeStepper::~BlockTimeStepper() = default;

void BlockTimeStepper::computeTimeStep(Scene* ofStep)
{
	onModel(ofStep, [&](BlockModel& model) { stableStep = length.adjust(ofStep, model, safety, quasiStatic, "BlockTimeStepper"); });
}

YADE_PLUGIN((BlockTimeStepper));

} // namespace yade
