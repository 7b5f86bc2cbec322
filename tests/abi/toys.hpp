#pragma once

#include <core/Dispatching.hpp>
#include <core/GlobalEngine.hpp>
#include <core/PartialEngine.hpp>
#include <core/Scene.hpp>
#include <core/TimeStepper.hpp>
#include <pkg/common/ElastMat.hpp>
#include <pkg/common/PeriodicEngines.hpp>
#include <pkg/dem/FrictPhys.hpp>

namespace yade {

// clang-format off
class ToyHolder : public Serializable { // shared between shapes, as an assembly of blocks will be
public:
	virtual ~ToyHolder();
	YADE_CLASS_BASE_DOC_ATTRS(ToyHolder, Serializable, "Something shared.",
		((vector<Real>, numbers, , , "Numbers."))
	);
};
REGISTER_SERIALIZABLE(ToyHolder);

class ToyShape : public Shape {
public:
	virtual ~ToyShape();
	void postLoad(ToyShape&) { loads++; }
	Real twice() const { return 2 * edge; }
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(ToyShape, Shape, "A cube.",
		((Real, edge, 1, Attr::triggerPostLoad, "Edge [m]."))
		((Vector3r, axis, Vector3r(0, 0, 1), , "Seen by reference."))
		((Vector3r, watched, Vector3r::Zero(), Attr::triggerPostLoad, "By reference, with postLoad after assignment."))
		((Matrix3r, matrix, Matrix3r::Identity(), , "A matrix."))
		((vector<Vector3r>, corners, , , "Copied."))
		((string, name, "cube", , "Text."))
		((shared_ptr<Material>, material, , , "Shared."))
		((shared_ptr<ToyHolder>, holder, , , "Shared."))
		((int, loads, 0, (Attr::readonly | Attr::noSave), "How often postLoad ran."))
		((vector<shared_ptr<Shape>>, parts, , Attr::hidden, "Not for Python."))
		((int, memory, 7, Attr::noSave, "Forgotten by files."))
		,
		createIndex();
		,
		.def("twice", &ToyShape::twice, "Twice the edge [m].")
		.def("addPart", +[](ToyShape& s) { s.parts.push_back(shared_ptr<Shape>(new ToyShape)); }, "Adds a hidden part.")
		.add_property("parts", +[](const ToyShape& s) { return s.parts.size(); }, "Number of hidden parts.")
	);
	REGISTER_CLASS_INDEX(ToyShape, Shape);
};
REGISTER_SERIALIZABLE(ToyShape);

class ToyState : public State {
public:
	virtual ~ToyState();
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(ToyState, State, "A state.", ((Real, heat, 0, , "Heat [J].")), createIndex(););
	REGISTER_CLASS_INDEX(ToyState, State);
};
REGISTER_SERIALIZABLE(ToyState);

class ToyMat : public FrictMat {
public:
	virtual ~ToyMat();
	shared_ptr<State> newAssocState() const override;
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(ToyMat, FrictMat, "A material.", ((Real, cohesion, 5e6, , "Cohesion [Pa].")), createIndex(););
	REGISTER_CLASS_INDEX(ToyMat, FrictMat);
};
REGISTER_SERIALIZABLE(ToyMat);

class ToyGeom : public IGeom {
public:
	virtual ~ToyGeom();
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(ToyGeom, IGeom, "A distance.", ((Real, gap, NaN, , "Gap [m].")), createIndex(););
	REGISTER_CLASS_INDEX(ToyGeom, IGeom);
};
REGISTER_SERIALIZABLE(ToyGeom);

class ToyPhys : public FrictPhys {
public:
	virtual ~ToyPhys();
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(ToyPhys, FrictPhys, "A spring.", , createIndex(););
	REGISTER_CLASS_INDEX(ToyPhys, FrictPhys);
};
REGISTER_SERIALIZABLE(ToyPhys);

class Bo1_ToyShape_Aabb : public BoundFunctor {
public:
	void go(const shared_ptr<Shape>&, shared_ptr<Bound>&, const Se3r&, const Body*) override;
	FUNCTOR1D(ToyShape);
	YADE_CLASS_BASE_DOC(Bo1_ToyShape_Aabb, BoundFunctor, "A bound.");
};
REGISTER_SERIALIZABLE(Bo1_ToyShape_Aabb);

class Ig2_ToyShape_ToyShape_ToyGeom : public IGeomFunctor {
public:
	bool go(const shared_ptr<Shape>&, const shared_ptr<Shape>&, const State&, const State&, const Vector3r&, const bool&, const shared_ptr<Interaction>&) override;
	FUNCTOR2D(ToyShape, ToyShape);
	DEFINE_FUNCTOR_ORDER_2D(ToyShape, ToyShape);
	YADE_CLASS_BASE_DOC_ATTRS(Ig2_ToyShape_ToyShape_ToyGeom, IGeomFunctor, "Measures.", ((Real, margin, 0, , "Margin [m].")));
};
REGISTER_SERIALIZABLE(Ig2_ToyShape_ToyShape_ToyGeom);

class Ip2_ToyMat_ToyMat_ToyPhys : public IPhysFunctor {
public:
	void go(const shared_ptr<Material>&, const shared_ptr<Material>&, const shared_ptr<Interaction>&) override;
	FUNCTOR2D(ToyMat, ToyMat);
	YADE_CLASS_BASE_DOC(Ip2_ToyMat_ToyMat_ToyPhys, IPhysFunctor, "Makes springs.");
};
REGISTER_SERIALIZABLE(Ip2_ToyMat_ToyMat_ToyPhys);

class Law2_ToyGeom_ToyPhys_Toy : public LawFunctor {
public:
	bool go(shared_ptr<IGeom>&, shared_ptr<IPhys>&, Interaction*) override;
	FUNCTOR2D(ToyGeom, ToyPhys);
	YADE_CLASS_BASE_DOC(Law2_ToyGeom_ToyPhys_Toy, LawFunctor, "Pulls.");
};
REGISTER_SERIALIZABLE(Law2_ToyGeom_ToyPhys_Toy);

class ToyEngine : public GlobalEngine {
public:
	void action() override;
	DECLARE_LOGGER;
	YADE_CLASS_BASE_DOC_ATTRS(ToyEngine, GlobalEngine, "Counts.",
		((int, bodies, 0, , "Bodies with a shape."))
		((int, energyId, -1, (Attr::noSave | Attr::hidden), "Place of its energy."))
	);
};
REGISTER_SERIALIZABLE(ToyEngine);

class ToyPartialEngine : public PartialEngine {
public:
	void action() override { sum = 0; for (int id : ids) sum += id; }
	YADE_CLASS_BASE_DOC_ATTRS(ToyPartialEngine, PartialEngine, "Adds ids.", ((int, sum, 0, , "Sum of the ids.")));
};
REGISTER_SERIALIZABLE(ToyPartialEngine);

class ToyPeriodicEngine : public PeriodicEngine {
public:
	void action() override { steps.push_back(scene->iter); }
	YADE_CLASS_BASE_DOC_ATTRS(ToyPeriodicEngine, PeriodicEngine, "Notes steps.", ((vector<int>, steps, , , "Steps.")));
};
REGISTER_SERIALIZABLE(ToyPeriodicEngine);

class ToyTimeStepper : public TimeStepper {
public:
	void computeTimeStep(Scene* s) override { s->dt = 1e-3 * (1 + s->iter); }
	YADE_CLASS_BASE_DOC(ToyTimeStepper, TimeStepper, "Sets the time step.");
};
REGISTER_SERIALIZABLE(ToyTimeStepper);
// clang-format on

} // namespace yade
