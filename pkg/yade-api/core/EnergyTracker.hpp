#pragma once

#include <lib/base/AliasNamespaces.hpp>
#include <lib/base/openmp-accu.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class EnergyTracker : public Serializable {
public:
	OpenMPArrayAccumulator<Real> energies; ///< [J]
	std::map<std::string, int>   names;
	vector<bool>                 resetStep;

	~EnergyTracker();
	YADE_API_IN_LIBRARY
	Real total() const;
	void findId(const std::string& name, int& id, bool reset = false, bool newIfNotFound = true);

	/// `id` is the caller's memory of the place of `name`, -1 at first. Not from parallel code.
	void set(const Real& energy, const std::string& name, int& id)
	{
		if (id < 0) findId(name, id);
		energies.set(id, energy);
	}
	/// The same, also from parallel code; `reset` makes the energy start from zero in every step.
	void add(const Real& energy, const std::string& name, int& id, bool reset = false)
	{
		if (id < 0) findId(name, id, reset);
		energies.add(id, energy);
	}
};
YADE_API_SAVED_IN_LIBRARY(EnergyTracker)

} // namespace yade
