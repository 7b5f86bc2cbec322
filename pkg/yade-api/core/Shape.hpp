#pragma once

#include <core/Dispatcher.hpp>
#include <lib/multimethods/Indexable.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class BoundFunctor;
class InternalForceFunctor;

class Shape : public Serializable, public Indexable {
public:
	shared_ptr<BoundFunctor>         boundFunctor;
	shared_ptr<InternalForceFunctor> internalforcefunctor;
	Vector3r                         color     = Vector3r(1, 1, 1);
	bool                             wire      = false;
	bool                             highlight = false;

	Shape() = default;
	virtual ~Shape();
	YADE_API_IN_LIBRARY
	YADE_API_INDEXED_ROOT
};
YADE_API_SAVED_IN_LIBRARY(Shape)

} // namespace yade
