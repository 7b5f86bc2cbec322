#pragma once

#include <core/GlobalEngine.hpp>
#include <core/Interaction.hpp>
#include <core/Scene.hpp>

namespace yade {

class TimeStepper : public GlobalEngine {
public:
	bool         active                 = true;
	unsigned int timeStepUpdateInterval = 1; ///< [steps]

	TimeStepper() = default;
	virtual ~TimeStepper();
	virtual void computeTimeStep(Scene*);
	bool         isActivated() override;
	void         action() override; ///< calls computeTimeStep(scene)
	YADE_API_IN_LIBRARY
};
YADE_API_SAVED_IN_LIBRARY(TimeStepper)

} // namespace yade
