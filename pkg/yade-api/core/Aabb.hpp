#pragma once

#include <core/Bound.hpp>

namespace yade {

class Aabb : public Bound {
public:
	Aabb() { createIndex(); }
	virtual ~Aabb();
	YADE_API_IN_LIBRARY
	YADE_API_INDEXED
};
YADE_API_SAVED_IN_LIBRARY(Aabb)

} // namespace yade
