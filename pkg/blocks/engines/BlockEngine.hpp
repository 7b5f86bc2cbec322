// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/engines/OnBlocks.hpp>
#include <core/GlobalEngine.hpp>

namespace yade {

/// Threads worth starting for so many zones.
int threadsFor(const BlockModel&, int ompThreads);

/// The base of those engines that are nothing else.
class BlockEngine : public OnBlocks<GlobalEngine> {
public:
	virtual ~BlockEngine();
	void action() override;

	/// The work of a step.
	virtual void step(BlockModel&) { }
	/// The scene is left: what is large and belongs to it goes.
	virtual void leaveScene() { }

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(BlockEngine, GlobalEngine, "Base of the engines that work on the scene's :yref:`BlockModel`; not to be used itself.",
		,
		/*ctor*/,
		/*py*/
		.def("_leaveScene", &BlockEngine::leaveScene, "Frees what belongs to a scene that is left; yadeblocks.saving does this.")
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(BlockEngine);

} // namespace yade
