// yade-blocks, GPL-2.0-or-later
#include <blocks/engines/BlockTimeStepper.hpp>

namespace yade {

BlockTimeStepper::~BlockTimeStepper() = default;

void BlockTimeStepper::computeTimeStep(Scene* ofStep)
{
	visibly([&] {
		auto [model, changed] = modelOf(ofStep);
		model.throwComplaint();
		if (changed) length.newScene();
		stableStep = length.adjust(ofStep, model, safety, quasiStatic, "BlockTimeStepper");
	});
}

YADE_PLUGIN((BlockTimeStepper));

} // namespace yade
