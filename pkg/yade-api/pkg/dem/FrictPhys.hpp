#pragma once

#include <pkg/common/NormShearPhys.hpp>

namespace yade {

class FrictPhys : public NormShearPhys {
public:
	Real tangensOfFrictionAngle = NaN;

	FrictPhys() { createIndex(); }
	virtual ~FrictPhys();
	YADE_API_IN_LIBRARY
	YADE_API_INDEXED
};
YADE_API_SAVED_IN_LIBRARY(FrictPhys)

} // namespace yade
