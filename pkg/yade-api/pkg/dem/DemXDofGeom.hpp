#pragma once

#include <core/IGeom.hpp>

namespace yade {

class GenericSpheresContact : public IGeom {
public:
	Vector3r normal;
	Vector3r contactPoint; ///< [m]
	Real     refR1 = 0;    ///< [m]
	Real     refR2 = 0;    ///< [m]

	GenericSpheresContact() { createIndex(); }
	virtual ~GenericSpheresContact();
	YADE_API_IN_LIBRARY
	YADE_API_INDEXED
};
YADE_API_SAVED_IN_LIBRARY(GenericSpheresContact)

} // namespace yade
