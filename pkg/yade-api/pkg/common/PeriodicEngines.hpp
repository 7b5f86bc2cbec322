#pragma once

#include <core/GlobalEngine.hpp>
#include <core/Omega.hpp>
#include <core/Scene.hpp>
#include <sys/time.h>

namespace yade {

class PeriodicEngine : public GlobalEngine {
public:
	static Real getClock() ///< [s]
	{
		timeval now;
		gettimeofday(&now, nullptr);
		return now.tv_sec + now.tv_usec * 1e-6;
	}

	Real virtPeriod   = 0;
	Real realPeriod   = 0;
	long iterPeriod   = 0;
	long nDo          = -1;
	bool initRun      = false;
	long firstIterRun = 0;
	Real virtLast     = 0;
	Real realLast     = getClock();
	long iterLast     = 0;
	long nDone        = 0;

	PeriodicEngine() = default;
	virtual ~PeriodicEngine();
	bool isActivated() override;
	YADE_API_IN_LIBRARY
};
YADE_API_SAVED_IN_LIBRARY(PeriodicEngine)

} // namespace yade
