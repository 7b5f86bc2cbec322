#pragma once

#include <core/Dispatcher.hpp>
#include <lib/base/Logging.hpp>
#include <lib/multimethods/Indexable.hpp>
#include <lib/serialization/Serializable.hpp>
#include <mutex>

namespace yade {

class State : public Serializable, public Indexable {
public:
	Vector3r&    pos; ///< se3.position
	Quaternionr& ori; ///< se3.orientation
	std::mutex   updateMutex;
	Se3r         se3;
	Vector3r     vel;
	Real         mass;
	Vector3r     angVel;
	Vector3r     angMom;
	Vector3r     inertia;
	Vector3r     refPos;
	Quaternionr  refOri;
	unsigned     blockedDOFs; ///< bits below
	bool         isDamped;
	Real         densityScaling;

	enum { DOF_NONE = 0, DOF_X = 1, DOF_Y = 2, DOF_Z = 4, DOF_RX = 8, DOF_RY = 16, DOF_RZ = 32 };
	static const unsigned DOF_XYZ    = DOF_X | DOF_Y | DOF_Z;
	static const unsigned DOF_RXRYRZ = DOF_RX | DOF_RY | DOF_RZ;
	static const unsigned DOF_ALL    = DOF_XYZ | DOF_RXRYRZ;

	State();
	virtual ~State();
	YADE_API_IN_LIBRARY
	YADE_API_INDEXED_ROOT
};
YADE_API_SAVED_IN_LIBRARY(State)

} // namespace yade
