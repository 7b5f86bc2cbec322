// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/BlockModel.hpp>
#include <core/GlobalEngine.hpp>

namespace yade {

/// The scene's model; engines outlive scenes and are given to new ones, so each step asks again.
class ModelOfScene {
public:
	/// The model, and whether it is another one than in the last step: then what the engine remembers belongs to an earlier scene.
	/// (An engine that was just loaded has had no model yet; what it remembers is the loaded one's.)
	std::pair<BlockModel&, bool> operator()(const Scene*);

private:
	boost::weak_ptr<BlockModel> model; // YADE never lets go of an engine that was in O.engines: it must not keep a scene's memory
	bool                        known = false;
};

/// Runs an engine's step; what it throws is held back for a moment, because O.run(n, wait=True) sees only the errors of a run
/// that is still alive when it begins to wait.
template <class Step> void visibly(const Step& step)
{
	try {
		step();
	} catch (...) {
		void holdBack();
		holdBack();
		throw;
	}
}

/// Threads worth starting for so many zones.
int threadsFor(const BlockModel&, int ompThreads);

/// What all engines of blocks have in common.
class BlockEngine : public GlobalEngine {
public:
	virtual ~BlockEngine();
	void action() override;

	/// The work of a step.
	virtual void step(BlockModel&) { }
	/// The engine is in another scene than in its last step.
	virtual void newScene() { }
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

private:
	ModelOfScene modelOf;
};
REGISTER_SERIALIZABLE(BlockEngine);

} // namespace yade
