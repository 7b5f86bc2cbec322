/// A Python module that looks at YADE's objects through the declarations in pkg/yade-api.
#include "toys.hpp"
#include <algorithm>
#include <pkg/common/Sphere.hpp>
#include <pkg/dem/DemXDofGeom.hpp>
#include <typeinfo>

using namespace yade;

#define PROBE_MEMBER(r, pointer, member) seen[BOOST_PP_STRINGIZE(member)] = pointer->member;
#define PROBE(Class, members)                                                                                                                                  \
	if (const auto* c = dynamic_cast<const Class*>(&object)) {                                                                                             \
		BOOST_PP_SEQ_FOR_EACH(PROBE_MEMBER, c, members)                                                                                                \
	}

/// Every attribute that the classes of `object` declare.
static py::dict attributes(const Serializable& object)
{
	py::dict seen;
	PROBE(Engine, (dead)(ompThreads)(label))
	PROBE(PartialEngine, (ids))
	PROBE(PeriodicEngine, (virtPeriod)(realPeriod)(iterPeriod)(nDo)(initRun)(firstIterRun)(virtLast)(realLast)(iterLast)(nDone))
	PROBE(TimeStepper, (active)(timeStepUpdateInterval))
	PROBE(Functor, (label))
	PROBE(Shape, (color)(wire)(highlight))
	PROBE(Sphere, (radius))
	PROBE(Bound, (lastUpdateIter)(refPos)(sweepLength)(color)(min)(max))
	PROBE(State, (pos)(ori)(vel)(mass)(angVel)(angMom)(inertia)(refPos)(refOri)(isDamped)(densityScaling))
	PROBE(Material, (id)(label)(density))
	PROBE(ElastMat, (young)(poisson))
	PROBE(FrictMat, (frictionAngle))
	PROBE(NormPhys, (kn)(normalForce))
	PROBE(NormShearPhys, (ks)(shearForce))
	PROBE(FrictPhys, (tangensOfFrictionAngle))
	PROBE(GenericSpheresContact, (normal)(contactPoint)(refR1)(refR2))
	PROBE(Body, (id)(groupMask)(flags)(subdomain)(material)(state)(shape)(bound)(clumpId)(iterBorn)(timeBorn))
	PROBE(Interaction, (isActive)(id1)(id2)(iterMadeReal)(geom)(phys)(cellDist)(iterBorn))
	PROBE(Cell, (trsf)(refHSize)(hSize)(prevHSize)(velGrad)(nextVelGrad)(prevVelGrad)(homoDeform)(velGradChanged)(flipFlippable))
	return seen;
}

static Scene& scene() { return *Omega::instance().getScene(); }

static py::dict sceneValues()
{
	const Scene* s = &scene();
	py::dict     seen;
	BOOST_PP_SEQ_FOR_EACH(
		PROBE_MEMBER, s, (dt)(iter)(subStepping)(subStep)(time)(speed)(stopAtIter)(stopAtTime)(isPeriodic)(trackEnergy)(selectedBody)(subdomain)(cell))
	py::list tags, engines, materials;
	for (const auto& tag : s->tags)
		tags.append(tag);
	for (const auto& engine : s->engines)
		engines.append(engine->getClassName());
	for (const auto& material : s->materials)
		materials.append(material->label);
	seen["tags"]      = tags;
	seen["engines"]   = engines;
	seen["materials"] = materials;
	return seen;
}

/// (id, position by reference, position in se3, names of shape and state, ids of partners), skipping erased bodies.
static py::list bodies()
{
	py::list result;
	for (const auto& b : *scene().bodies) {
		py::list partners;
		for (const auto& [id, interaction] : b->intrs)
			partners.append(id);
		const bool same = &b->state->pos == &b->state->se3.position && &b->state->ori == &b->state->se3.orientation;
		result.append(py::make_tuple(b->getId(), b->state->pos, same, b->shape->getClassName(), b->state->getClassName(), partners));
	}
	return result;
}

static py::list interactions()
{
	py::list result;
	for (const auto& i : *scene().interactions) {
		const auto& cache = i->functorCache;
		py::list    functors;
		if (cache.geom) functors.append(cache.geom->getClassName());
		if (cache.phys) functors.append(cache.phys->getClassName());
		if (cache.constLaw) functors.append(cache.constLaw->getClassName());
		result.append(py::make_tuple(i->getId1(), i->getId2(), i->isReal(), cache.geomExists, functors, i->linIx));
	}
	return result;
}

static void move(int id, const Vector3r& x, const Vector3r& v)
{
	State& state = *Body::byId(id, &scene())->state;
	state.pos    = x;
	state.vel    = v;
}

static py::object addedForce(int id, const Vector3r& f)
{
	scene().forces.addForce(id, f);
	scene().forces.sync();
	return py::object(Vector3r(scene().forces.getForce(id)));
}

static py::object addedTorque(int id, const Vector3r& t)
{
	scene().forces.addTorque(id, t);
	scene().forces.sync();
	return py::object(Vector3r(scene().forces.getTorque(id)));
}

/// (step of the last reset, whether all additions are summed up)
static py::tuple forceState() { return py::make_tuple(scene().forces.lastReset, scene().forces.synced); }

/// An attribute that our headers do not declare, by name.
static py::object attributeOfEngine(int index, const string& name) { return scene().engines.at(index)->pyDict()[name]; }

/// Adds in parallel, `n` times per name.
static Real addedEnergy(const string& name, Real energy, int n)
{
	int id = -1;
	scene().energy->findId(name, id);
#pragma omp parallel for
	for (int i = 0; i < n; i++)
		scene().energy->add(energy, name, id);
	return scene().energy->total();
}

static void setEnergy(const string& name, Real energy)
{
	int id = -1;
	scene().energy->set(energy, name, id);
}

static bool insertInteraction(int id1, int id2) { return scene().interactions->insert(id1, id2); }
static bool hasInteraction(int id1, int id2) { return bool(scene().interactions->find(id1, id2)); }
static void requestErase(int id1, int id2) { scene().interactions->requestErase(id1, id2); }
static bool eraseInteraction(int id1, int id2)
{
	InteractionContainer& all = *scene().interactions;
	return all.erase(id1, id2, all.find(id1, id2)->linIx);
}

static int newBody(const Vector3r& x)
{
	shared_ptr<Body> b(new Body);
	b->shape      = shared_ptr<Shape>(new ToyShape);
	b->material   = scene().materials.at(0);
	b->state->pos = x;
	return scene().bodies->insert(b);
}

static int baseIndex(const Shape& shape, int depth) { return shape.getBaseClassIndex(depth); }

static bool knowsPluginClass(const string& name)
{
	const auto& all = ClassFactory::instance().pluginClasses;
	return std::find(all.begin(), all.end(), name) != all.end();
}

static bool timingEnabled() { return TimingInfo::enabled; }

/// Does a type information of ours equal YADE's, across libraries?
static string dynamicType(const Shape& shape) { return typeid(shape).name(); }

BOOST_PYTHON_MODULE(abiprobe)
{
	py::def("attributes", attributes);
	py::def("sceneValues", sceneValues);
	py::def("bodies", bodies);
	py::def("interactions", interactions);
	py::def("move", move);
	py::def("addedForce", addedForce);
	py::def("addedTorque", addedTorque);
	py::def("forceState", forceState);
	py::def("attributeOfEngine", attributeOfEngine);
	py::def("addedEnergy", addedEnergy);
	py::def("setEnergy", setEnergy);
	py::def("insertInteraction", insertInteraction);
	py::def("hasInteraction", hasInteraction);
	py::def("requestErase", requestErase);
	py::def("eraseInteraction", eraseInteraction);
	py::def("newBody", newBody);
	py::def("baseIndex", baseIndex);
	py::def("knowsPluginClass", knowsPluginClass);
	py::def("timingEnabled", timingEnabled);
	py::def("dynamicType", dynamicType);
}
