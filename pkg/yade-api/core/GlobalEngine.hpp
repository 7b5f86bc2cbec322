#pragma once

#include <core/Engine.hpp>

namespace yade {

class GlobalEngine : public Engine {
public:
	GlobalEngine() = default;
	virtual ~GlobalEngine();
	YADE_API_IN_LIBRARY
};
YADE_API_SAVED_IN_LIBRARY(GlobalEngine)

} // namespace yade
