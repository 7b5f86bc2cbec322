#pragma once

#include <lib/base/Math.hpp>
#include <lib/base/Singleton.hpp>
#include <lib/factory/ClassFactory.hpp>
#include <map>
#include <set>

namespace yade {

class Scene;

struct DynlibDescriptor {
	std::set<string> baseClasses;
	bool             isSerializable;
};

/// The simulation's owner. Its data are not declared here: the only object is YADE's.
class Omega : public Singleton<Omega> {
	Omega();

public:
	const shared_ptr<Scene>&                  getScene() const;
	const std::map<string, DynlibDescriptor>& getDynlibsDescriptor() const; ///< registered classes by name
	void                                      saveSimulation(const string& file, bool quiet = false);
	void                                      pause();
	bool                                      isRunning();
	Real                                      getRealTime() const; ///< [s]
	string                                    tmpFilename();
};

} // namespace yade
