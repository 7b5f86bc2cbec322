/// The four families of functors.
#pragma once

#include <core/Aabb.hpp>
#include <core/Dispatcher.hpp>
#include <core/Functor.hpp>
#include <core/IGeom.hpp>
#include <core/IPhys.hpp>
#include <core/Interaction.hpp>
#include <core/Scene.hpp>
#include <core/Shape.hpp>
#include <core/State.hpp>
#include <lib/base/Math.hpp>

namespace yade {

class BoundFunctor : public Functor1D<Shape, void, boost::mpl::vector<const shared_ptr<Shape>&, shared_ptr<Bound>&, const Se3r&, const Body*>> {
public:
	BoundFunctor() = default;
	virtual ~BoundFunctor();
	YADE_API_IN_LIBRARY
};
YADE_API_SAVED_IN_LIBRARY(BoundFunctor)

class IGeomFunctor : public Functor2D<
			     Shape,
			     Shape,
			     bool,
			     boost::mpl::vector<
				     const shared_ptr<Shape>&,
				     const shared_ptr<Shape>&,
				     const State&,
				     const State&,
				     const Vector3r&,
				     const bool&,
				     const shared_ptr<Interaction>&>> {
public:
	IGeomFunctor() = default;
	virtual ~IGeomFunctor();
	YADE_API_IN_LIBRARY
	virtual void preStep(); ///< called once before each run of InteractionLoop
};
YADE_API_SAVED_IN_LIBRARY(IGeomFunctor)

class IPhysFunctor : public Functor2D<
			     Material,
			     Material,
			     void,
			     boost::mpl::vector<const shared_ptr<Material>&, const shared_ptr<Material>&, const shared_ptr<Interaction>&>> {
public:
	IPhysFunctor() = default;
	virtual ~IPhysFunctor();
	YADE_API_IN_LIBRARY
};
YADE_API_SAVED_IN_LIBRARY(IPhysFunctor)

class LawFunctor : public Functor2D<IGeom, IPhys, bool, boost::mpl::vector<shared_ptr<IGeom>&, shared_ptr<IPhys>&, Interaction*>> {
public:
	LawFunctor() = default;
	virtual ~LawFunctor();
	YADE_API_IN_LIBRARY
};
YADE_API_SAVED_IN_LIBRARY(LawFunctor)

} // namespace yade
