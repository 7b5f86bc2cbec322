// yade-blocks, GPL-2.0-or-later
#include <blocks/engines/BlockTimeStepper.hpp>

namespace yade {

BlockTimeStepper::~BlockTimeStepper() = default;

void BlockTimeStepper::computeTimeStep(Scene* scene)
{
	visibly([&] {
		auto [model, changed] = modelOf(scene);
		model.throwComplaint();
		if (changed) length.newScene();
		stableStep = length.adjust(scene, model, safety, quasiStatic, "BlockTimeStepper");
	});
}

YADE_PLUGIN((BlockTimeStepper));

} // namespace yade
