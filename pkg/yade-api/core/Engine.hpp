#pragma once

#include <core/Omega.hpp>
#include <core/Timing.hpp>
#include <lib/base/Logging.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class Body;

class Engine : public Serializable {
public:
	Scene*                   scene = Omega::instance().getScene().get();
	TimingInfo               timingInfo;
	shared_ptr<TimingDeltas> timingDeltas;
	bool                     dead       = false;
	int                      ompThreads = -1;
	string                   label;

	Engine() = default;
	virtual ~Engine();
	YADE_API_IN_LIBRARY
	virtual bool isActivated();
	virtual void action();
};
YADE_API_SAVED_IN_LIBRARY(Engine)

} // namespace yade
