#pragma once

#include <core/Body.hpp>
#include <core/Engine.hpp>

namespace yade {

class PartialEngine : public Engine {
public:
	std::vector<int> ids;

	PartialEngine() = default;
	virtual ~PartialEngine();
	YADE_API_IN_LIBRARY
};
YADE_API_SAVED_IN_LIBRARY(PartialEngine)

} // namespace yade
