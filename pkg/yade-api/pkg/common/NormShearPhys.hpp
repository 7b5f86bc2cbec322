#pragma once

#include <core/IPhys.hpp>

namespace yade {

class NormPhys : public IPhys {
public:
	Real     kn          = 0;                ///< [N/m]
	Vector3r normalForce = Vector3r::Zero(); ///< [N]

	NormPhys() { createIndex(); }
	virtual ~NormPhys();
	YADE_API_IN_LIBRARY
	YADE_API_INDEXED
};
YADE_API_SAVED_IN_LIBRARY(NormPhys)

class NormShearPhys : public NormPhys {
public:
	Real     ks         = 0;                ///< [N/m]
	Vector3r shearForce = Vector3r::Zero(); ///< [N]

	NormShearPhys() { createIndex(); }
	virtual ~NormShearPhys();
	YADE_API_IN_LIBRARY
	YADE_API_INDEXED
};
YADE_API_SAVED_IN_LIBRARY(NormShearPhys)

} // namespace yade
