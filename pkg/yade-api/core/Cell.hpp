#pragma once

#include <lib/base/Math.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

/// The periodic cell; used only if Scene::isPeriodic.
class Cell : public Serializable {
	Matrix3r _invTrsf;
	Matrix3r _trsfInc;
	Matrix3r _vGradTimesPrevH;
	Vector3r _size, _cos;
	Vector3r _refSize;
	bool     _hasShear;
	Matrix3r _shearTrsf, _unshearTrsf;
	double   _glShearTrsfMatrix[16];

public:
	Matrix3r trsf;
	Matrix3r refHSize;
	Matrix3r hSize;
	Matrix3r prevHSize;
	Matrix3r velGrad;
	Matrix3r nextVelGrad;
	Matrix3r prevVelGrad;
	int      homoDeform;
	bool     velGradChanged;
	bool     flipFlippable;

	virtual ~Cell();
	YADE_API_IN_LIBRARY
};
YADE_API_SAVED_IN_LIBRARY(Cell)

} // namespace yade
