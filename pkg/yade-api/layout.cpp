/// Part of every plugin: compares what the headers in this folder declare with the layout of YADE 2023.02a in Debian 12
/// (double precision, with its features OpenMP, OpenGL, MPI and FEM). A difference stops the build.
/// Compiled with -fno-access-control, because members are as private as in YADE.
#include <core/Dispatching.hpp>
#include <core/PartialEngine.hpp>
#include <core/TimeStepper.hpp>
#include <cstddef>
#include <pkg/common/ElastMat.hpp>
#include <pkg/common/GLDrawFunctors.hpp>
#include <pkg/common/NormShearPhys.hpp>
#include <pkg/common/PeriodicEngines.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/dem/DemXDofGeom.hpp>
#include <pkg/dem/FrictPhys.hpp>

#define CHECK_MEMBER(r, Class, pair)                                                                                                                           \
	static_assert(offsetof(Class, BOOST_PP_TUPLE_ELEM(2, 0, pair)) == BOOST_PP_TUPLE_ELEM(2, 1, pair), "layout of YADE's " #Class);
#define CHECK_LAYOUT(Class, size, members)                                                                                                                     \
	static_assert(sizeof(Class) == size, "size of YADE's " #Class);                                                                                        \
	BOOST_PP_SEQ_FOR_EACH(CHECK_MEMBER, Class, members)

namespace yade {

using EnergySums = OpenMPArrayAccumulator<Real>;

// class, its size, its members and their offsets [bytes]; references (State::pos and ori) have no offset in C++
// clang-format off
CHECK_LAYOUT(Factorable, 24, )
CHECK_LAYOUT(Indexable, 8, )
CHECK_LAYOUT(Serializable, 24, )
CHECK_LAYOUT(Engine, 104, ((scene, 24))((timingInfo, 32))((timingDeltas, 48))((dead, 64))((ompThreads, 68))((label, 72)))
CHECK_LAYOUT(GlobalEngine, 104, )
CHECK_LAYOUT(PartialEngine, 128, ((ids, 104)))
CHECK_LAYOUT(PeriodicEngine, 184, ((virtPeriod, 104))((realPeriod, 112))((iterPeriod, 120))((nDo, 128))((initRun, 136))((firstIterRun, 144))
	((virtLast, 152))((realLast, 160))((iterLast, 168))((nDone, 176)))
CHECK_LAYOUT(Functor, 80, ((timingDeltas, 24))((scene, 40))((label, 48)))
CHECK_LAYOUT(BoundFunctor, 88, )
CHECK_LAYOUT(IGeomFunctor, 88, )
CHECK_LAYOUT(IPhysFunctor, 88, )
CHECK_LAYOUT(LawFunctor, 88, )
CHECK_LAYOUT(GlShapeFunctor, 88, )
CHECK_LAYOUT(GlIGeomFunctor, 88, )
CHECK_LAYOUT(GlIPhysFunctor, 88, )
CHECK_LAYOUT(Shape, 96, ((boundFunctor, 32))((internalforcefunctor, 48))((color, 64))((wire, 88))((highlight, 89)))
CHECK_LAYOUT(Bound, 144, ((lastUpdateIter, 32))((refPos, 40))((sweepLength, 64))((color, 72))((min, 96))((max, 120)))
CHECK_LAYOUT(Aabb, 144, )
CHECK_LAYOUT(State, 320, ((updateMutex, 48))((se3, 88))((vel, 144))((mass, 168))((angVel, 176))((angMom, 200))((inertia, 224))((refPos, 248))
	((refOri, 272))((blockedDOFs, 304))((isDamped, 308))((densityScaling, 312)))
CHECK_LAYOUT(Material, 80, ((id, 32))((label, 40))((density, 72)))
CHECK_LAYOUT(IGeom, 32, )
CHECK_LAYOUT(IPhys, 32, )
CHECK_LAYOUT(Body, 176, ((id, 24))((groupMask, 28))((flags, 32))((subdomain, 36))((material, 40))((state, 56))((shape, 72))((bound, 88))((intrs, 104))
	((clumpId, 152))((iterBorn, 160))((timeBorn, 168)))
CHECK_LAYOUT(BodyContainer, 200, ((body, 24))((dirty, 48))((checkedByCollider, 49))((insertedBodies, 56))((erasedBodies, 80))((realBodies, 104))
	((useRedirection, 128))((enableRedirection, 129))((subdomainBodies, 136))((drawloopmutex, 160)))
CHECK_LAYOUT(Interaction, 168, ((isActive, 24))((functorCache, 32))((id1, 88))((id2, 92))((iterMadeReal, 96))((iterLastSeen, 104))((geom, 112))
	((phys, 128))((cellDist, 144))((linIx, 156))((iterBorn, 160)))
CHECK_LAYOUT(InteractionContainer, 192, ((linIntrs, 24))((sortedIntrs, 48))((bodies, 72))((currSize, 80))((empty, 88))((interaction, 104))
	((dirty, 128))((drawloopmutex, 136))((serializeSorted, 176))((iterColliderLastRun, 184)))
CHECK_LAYOUT(Scene, 752, ((hostNameMax, 24))((forces, 32))((SpeedElements, 336))((renderer, 416))((prevTime, 432))((dt, 440))((iter, 448))
	((subStepping, 456))((subStep, 460))((time, 464))((speed, 472))((stopAtIter, 480))((stopAtTime, 488))((isPeriodic, 496))((trackEnergy, 497))
	((doSort, 498))((runInternalConsistencyChecks, 499))((selectedBody, 500))((subdomain, 504))((subD, 512))((tags, 528))((engines, 552))
	((_nextEngines, 576))((bodies, 600))((interactions, 616))((energy, 632))((materials, 648))((bound, 672))((cell, 688))((miscParams, 704))
	((dispParams, 728)))
CHECK_LAYOUT(Cell, 1104, ((_invTrsf, 24))((_trsfInc, 96))((_vGradTimesPrevH, 168))((_size, 240))((_cos, 264))((_refSize, 288))((_hasShear, 312))
	((_shearTrsf, 320))((_unshearTrsf, 392))((_glShearTrsfMatrix, 464))((trsf, 592))((refHSize, 664))((hSize, 736))((prevHSize, 808))((velGrad, 880))
	((nextVelGrad, 952))((prevVelGrad, 1024))((homoDeform, 1096))((velGradChanged, 1100))((flipFlippable, 1101)))
CHECK_LAYOUT(EnergyTracker, 176, ((energies, 24))((names, 88))((resetStep, 136)))
CHECK_LAYOUT(ForceContainer, 304, ((_forceData, 0))((_torqueData, 24))((_maxId, 48))((sizeOfThreads, 72))((_force, 96))((_torque, 120))
	((_permForce, 144))((_permTorque, 168))((size, 192))((syncedSizes, 200))((nThreads, 204))((permForceUsed, 208))((permForceSynced, 209))
	((globalMutex, 216))((_zero, 256))((synced, 280))((syncCount, 288))((lastReset, 296)))
CHECK_LAYOUT(TimingInfo, 16, ((nExec, 0))((nsec, 8)))
CHECK_LAYOUT(EnergySums, 64, ((CLS, 0))((nThreads, 8))((perCL, 16))((chunks, 24))((sz, 48))((nCL, 56)))
CHECK_LAYOUT(Se3r, 56, ((position, 0))((orientation, 24)))
CHECK_LAYOUT(ElastMat, 96, ((young, 80))((poisson, 88)))
CHECK_LAYOUT(FrictMat, 104, ((frictionAngle, 96)))
CHECK_LAYOUT(NormPhys, 64, ((kn, 32))((normalForce, 40)))
CHECK_LAYOUT(NormShearPhys, 96, ((ks, 64))((shearForce, 72)))
CHECK_LAYOUT(FrictPhys, 104, ((tangensOfFrictionAngle, 96)))
CHECK_LAYOUT(Sphere, 104, ((radius, 96)))
CHECK_LAYOUT(GenericSpheresContact, 96, ((normal, 32))((contactPoint, 56))((refR1, 80))((refR2, 88)))
CHECK_LAYOUT(TimeStepper, 112, ((active, 104))((timeStepUpdateInterval, 108)))
// clang-format on

} // namespace yade
