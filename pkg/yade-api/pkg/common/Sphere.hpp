#pragma once

#include <core/Shape.hpp>

namespace yade {

class Sphere : public Shape {
public:
	Real radius = NaN; ///< [m]

	Sphere() { createIndex(); }
	virtual ~Sphere();
	YADE_API_IN_LIBRARY
	YADE_API_INDEXED
};
YADE_API_SAVED_IN_LIBRARY(Sphere)

} // namespace yade
