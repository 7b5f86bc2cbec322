#pragma once

#include <core/Material.hpp>

namespace yade {

class ElastMat : public Material {
public:
	Real young   = 1e9; ///< [Pa]
	Real poisson = .25;

	ElastMat() { createIndex(); }
	virtual ~ElastMat();
	YADE_API_IN_LIBRARY
	YADE_API_INDEXED
};
YADE_API_SAVED_IN_LIBRARY(ElastMat)

class FrictMat : public ElastMat {
public:
	Real frictionAngle = .5; ///< [rad]

	FrictMat() { createIndex(); }
	virtual ~FrictMat();
	YADE_API_IN_LIBRARY
	YADE_API_INDEXED
};
YADE_API_SAVED_IN_LIBRARY(FrictMat)

} // namespace yade
