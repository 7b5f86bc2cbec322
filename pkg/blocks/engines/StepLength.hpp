// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/BlockModel.hpp>

namespace yade {

/// Makes the time step stable, by masses or by its length; works only when stiffness, step or wishes have changed.
class StepLength {
public:
	/// Sets masses, or O.dt. The limit of the time step with the true masses [s].
	Real adjust(Scene*, BlockModel&, Real safety, bool quasiStatic, const char* engine);

	void newScene() { *this = {}; }

private:
	long doneVersion = 0;
	Real doneDt = 0, doneSafety = 0, limit = 0;
	bool doneQuasiStatic = false;
	int  scalingId       = -1;
	Real toldDt          = -1; ///< O.dt that nothing limited when it was said last [s]
};

} // namespace yade
