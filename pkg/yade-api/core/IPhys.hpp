#pragma once

#include <core/Dispatcher.hpp>
#include <lib/base/Math.hpp>
#include <lib/multimethods/Indexable.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class IPhys : public Serializable, public Indexable {
public:
	IPhys() = default;
	virtual ~IPhys();
	YADE_API_IN_LIBRARY
	YADE_API_INDEXED_ROOT
};
YADE_API_SAVED_IN_LIBRARY(IPhys)

} // namespace yade
