#pragma once

#include <core/Dispatcher.hpp>
#include <core/State.hpp>
#include <lib/multimethods/Indexable.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class Material : public Serializable, public Indexable {
public:
	int    id = -1;
	string label;
	Real   density = 1000; ///< [kg/m^3]

	Material() = default;
	virtual ~Material();
	YADE_API_IN_LIBRARY
	virtual shared_ptr<State> newAssocState() const;
	virtual bool              stateTypeOk(State*) const;
	YADE_API_INDEXED_ROOT

	static const shared_ptr<Material> byId(int id, Scene* scene = nullptr);
	static const shared_ptr<Material> byLabel(const string& label, Scene* scene = nullptr);
};
YADE_API_SAVED_IN_LIBRARY(Material)

} // namespace yade
