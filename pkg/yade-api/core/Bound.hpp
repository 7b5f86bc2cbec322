#pragma once

#include <core/Dispatcher.hpp>
#include <lib/base/Math.hpp>
#include <lib/multimethods/Indexable.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class Bound : public Serializable, public Indexable {
public:
	int      lastUpdateIter = 0;
	Vector3r refPos         = Vector3r(NaN, NaN, NaN);
	Real     sweepLength    = 0;
	Vector3r color          = Vector3r(1, 1, 1);
	Vector3r min            = Vector3r(NaN, NaN, NaN);
	Vector3r max            = Vector3r(NaN, NaN, NaN);

	Bound() = default;
	virtual ~Bound();
	YADE_API_IN_LIBRARY
	YADE_API_INDEXED_ROOT
};
YADE_API_SAVED_IN_LIBRARY(Bound)

} // namespace yade
