/// The functors that draw in YADE's window.
#pragma once

#include <core/Body.hpp>
#include <core/Functor.hpp>
#include <core/IGeom.hpp>
#include <core/IPhys.hpp>
#include <core/Interaction.hpp>
#include <core/Shape.hpp>
#include <core/State.hpp>
#include <lib/base/Math.hpp>

namespace yade {

struct GLViewInfo {
	Vector3r sceneCenter = Vector3r::Zero();
	Real     sceneRadius = 1;
};

class GlShapeFunctor : public Functor1D<Shape, void, boost::mpl::vector<const shared_ptr<Shape>&, const shared_ptr<State>&, bool, const GLViewInfo&>> {
public:
	GlShapeFunctor() = default;
	virtual ~GlShapeFunctor();
	virtual string renders() const;
	virtual void   initgl(); ///< called on another object than go
	YADE_API_IN_LIBRARY
};
YADE_API_SAVED_IN_LIBRARY(GlShapeFunctor)

class GlIGeomFunctor
	: public Functor1D<
		  IGeom,
		  void,
		  boost::mpl::vector<const shared_ptr<IGeom>&, const shared_ptr<Interaction>&, const shared_ptr<Body>&, const shared_ptr<Body>&, bool>> {
public:
	GlIGeomFunctor() = default;
	virtual ~GlIGeomFunctor();
	virtual string renders() const;
	virtual void   initgl();
	YADE_API_IN_LIBRARY
};
YADE_API_SAVED_IN_LIBRARY(GlIGeomFunctor)

class GlIPhysFunctor
	: public Functor1D<
		  IPhys,
		  void,
		  boost::mpl::vector<const shared_ptr<IPhys>&, const shared_ptr<Interaction>&, const shared_ptr<Body>&, const shared_ptr<Body>&, bool>> {
public:
	GlIPhysFunctor() = default;
	virtual ~GlIPhysFunctor();
	virtual string renders() const;
	virtual void   initgl();
	YADE_API_IN_LIBRARY
};
YADE_API_SAVED_IN_LIBRARY(GlIPhysFunctor)

} // namespace yade

#define RENDERS(Class)                                                                                                                                         \
public:                                                                                                                                                        \
	std::string renders() const override { return #Class; }                                                                                                \
	FUNCTOR1D(Class);
