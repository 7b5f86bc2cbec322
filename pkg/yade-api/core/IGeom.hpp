#pragma once

#include <core/Dispatcher.hpp>
#include <lib/base/Math.hpp>
#include <lib/multimethods/Indexable.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class IGeom : public Serializable, public Indexable {
public:
	IGeom() = default;
	virtual ~IGeom();
	YADE_API_IN_LIBRARY
	YADE_API_INDEXED_ROOT
};
YADE_API_SAVED_IN_LIBRARY(IGeom)

} // namespace yade
