#pragma once

#include <core/Body.hpp>
#include <core/IGeom.hpp>
#include <core/IPhys.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class IGeomFunctor;
class IPhysFunctor;
class LawFunctor;
class Scene;

class Interaction : public Serializable {
public:
	bool isActive;
	struct {
		bool                     geomExists;
		shared_ptr<IGeomFunctor> geom;
		shared_ptr<IPhysFunctor> phys;
		shared_ptr<LawFunctor>   constLaw;
	} functorCache; ///< found by InteractionLoop
	Body::id_t        id1;
	Body::id_t        id2;
	long              iterMadeReal;
	long              iterLastSeen;
	shared_ptr<IGeom> geom;
	shared_ptr<IPhys> phys;
	Vector3i          cellDist;
	int               linIx;
	long              iterBorn;

	Interaction();
	Interaction(Body::id_t id1, Body::id_t id2);
	virtual ~Interaction();
	YADE_API_IN_LIBRARY
	py::dict pyDictCustom() const override;

	const Body::id_t& getId1() const { return id1; }
	const Body::id_t& getId2() const { return id2; }
	bool              isReal() const { return geom && phys; }
	bool              isFresh(Scene* scene); ///< made real in this step
	void              swapOrder();
	void              reset();
};
YADE_API_SAVED_IN_LIBRARY(Interaction)

} // namespace yade
