// yade-blocks, GPL-2.0-or-later
#include <blocks/engines/BlockEngine.hpp>
#include <omp.h>

namespace yade {

BlockEngine::~BlockEngine() = default;

int threadsFor(const BlockModel& model, int ompThreads)
{
	constexpr int zonesPerThread = 3000; // below, starting a thread costs more than it saves
	const int     available      = ompThreads > 0 ? std::min(ompThreads, omp_get_max_threads()) : omp_get_max_threads();
	return std::max(1, std::min(available, model.assembly.zoneCount() / zonesPerThread));
}

void BlockEngine::action()
{
	onModel(scene, [&](BlockModel& model) { step(model); });
}

YADE_PLUGIN((BlockEngine));

} // namespace yade
