#pragma once

#include <core/Bound.hpp>
#include <core/Material.hpp>
#include <core/Shape.hpp>
#include <core/State.hpp>
#include <lib/base/Math.hpp>
#include <lib/multimethods/Indexable.hpp>
#include <lib/serialization/Serializable.hpp>
#include <map>

namespace yade {

class Scene;
class Interaction;

class Body : public Serializable {
public:
	using id_t        = int;
	using MapId2IntrT = std::map<id_t, shared_ptr<Interaction>>;
	enum { FLAG_BOUNDED = 1, FLAG_ASPHERICAL = 2, FLAG_SUBDOMAIN = 4, FLAG_FLUIDDOMAINBBOX = 8 };

	static const id_t ID_NONE;

	id_t                 id;
	mask_t               groupMask;
	int                  flags;
	int                  subdomain;
	shared_ptr<Material> material;
	shared_ptr<State>    state;
	shared_ptr<Shape>    shape;
	shared_ptr<Bound>    bound;
	MapId2IntrT          intrs; ///< by the other body's id; kept by InteractionContainer
	id_t                 clumpId;
	long                 iterBorn;
	Real                 timeBorn; ///< [s]

	Body();
	virtual ~Body();
	YADE_API_IN_LIBRARY
	virtual void userForcedDisplacementRedrawHook();

	static const shared_ptr<Body>& byId(id_t id, Scene* scene = nullptr);

	id_t   getId() const { return id; }
	mask_t getGroupMask() const { return groupMask; }
	bool   isDynamic() const { return state->blockedDOFs != State::DOF_ALL; }
	bool   isBounded() const { return flags & FLAG_BOUNDED; }
};
YADE_API_SAVED_IN_LIBRARY(Body)

} // namespace yade
