// yade-blocks, GPL-2.0-or-later
#include <blocks/engines/BlockMotion.hpp>

namespace yade {

BlockMotion::~BlockMotion() = default;

void BlockMotion::newScene()
{
	BlockIntegrator::newScene();
	length.newScene();
}

void BlockMotion::prepareStep(BlockModel& model) { stableStep = length.adjust(scene, model, safety, quasiStatic, "BlockMotion"); }

YADE_PLUGIN((BlockMotion));

} // namespace yade
