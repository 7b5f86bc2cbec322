#pragma once

#include <core/Body.hpp>
#include <lib/base/Math.hpp>
#include <mutex>

namespace yade {

/// Forces and torques on bodies: added by any thread, read after sync().
class ForceContainer {
	using vvector = std::vector<Vector3r>;
	std::vector<vvector>    _forceData;
	std::vector<vvector>    _torqueData;
	std::vector<Body::id_t> _maxId;
	std::vector<size_t>     sizeOfThreads;
	vvector                 _force, _torque, _permForce, _permTorque;
	size_t                  size;
	bool                    syncedSizes;
	int                     nThreads;
	bool                    permForceUsed, permForceSynced;
	std::mutex              globalMutex;
	const Vector3r          _zero;

public:
	bool          synced;
	unsigned long syncCount;
	long          lastReset;

	ForceContainer();
	void            addForce(Body::id_t id, const Vector3r& force);
	void            addTorque(Body::id_t id, const Vector3r& torque);
	void            addMaxId(Body::id_t id);
	void            sync();
	const Vector3r& getForce(Body::id_t id);
	const Vector3r& getTorque(Body::id_t id);
	const Vector3r  getForceSingle(Body::id_t id);
	const Vector3r  getTorqueSingle(Body::id_t id);
	void            setPermForce(Body::id_t id, const Vector3r& force);
	void            setPermTorque(Body::id_t id, const Vector3r& torque);
	const Vector3r& getPermForce(Body::id_t id);
	const Vector3r& getPermTorque(Body::id_t id);
	void            reset(long iter, bool resetAll = false);
};

} // namespace yade
