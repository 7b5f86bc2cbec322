// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/BlockModel.hpp>

namespace yade {

/// What an engine throws is held back for a moment: O.run(n, wait=True) sees only the errors of a run that is still alive when it begins to wait.
void holdBack();

/// What engines of blocks have in common, whatever kind of YADE's engines they are. They outlive scenes and are given to new ones, so each step asks for the
/// scene's model again.
template <class Base> class OnBlocks : public Base {
public:
	/// The engine is in another scene than in its last step: what it remembers belongs to an earlier one.
	virtual void newScene() { }

protected:
	/// work(model) with the scene's model.
	template <class Work> void onModel(const Scene* ofStep, const Work& work)
	{
		try {
			shared_ptr<BlockModel> now = lastModel.lock();
			if (!now || !now->isIn(ofStep)) {
				const auto& found = BlockModel::of(ofStep);
				if (hadModel && found != now) newScene(); // an engine that was just loaded has had no model yet: it remembers the loaded one's
				lastModel = now = found, hadModel = true;
			}
			now->throwComplaint();
			work(*now);
		} catch (...) {
			holdBack();
			throw;
		}
	}

private:
	boost::weak_ptr<BlockModel> lastModel; // YADE never lets go of an engine that was in O.engines: it must not keep a scene's memory
	bool                        hadModel = false;
};

} // namespace yade
