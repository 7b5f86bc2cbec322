// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>
#include <type_traits>

/// What a saved assembly consists of, field by field, stated once: archives, comparisons and fingerprints all walk through these lists.
/// What can be computed again (columns, sides, forces, neighbours) is not among them.
namespace blocks {

/// For functions of a T that is X or const X.
template <class T, class X> using Only = std::enable_if_t<std::is_same_v<std::remove_const_t<T>, X>, int>;

template <class T, class Visit, Only<T, Material> = 0> void forEachField(T& x, Visit&& visit)
{
	visit("young", x.young), visit("poisson", x.poisson), visit("density", x.density);
}

template <class T, class Visit, Only<T, Mesh> = 0> void forEachField(T& x, Visit&& visit)
{
	visit("materials", x.materials), visit("reference", x.reference), visit("mass", x.mass), visit("zoneNodes", x.zoneNodes);
	visit("edgeNodes", x.edgeNodes), visit("firstNode", x.firstNode), visit("firstZone", x.firstZone), visit("firstEdge", x.firstEdge);
	visit("blockMaterial", x.blockMaterial);
	visit("inSituXX", x.inSitu.xx), visit("inSituYY", x.inSitu.yy), visit("inSituXY", x.inSitu.xy), visit("removed", x.removed);
}

template <class T, class Visit, Only<T, Segment> = 0> void forEachField(T& x, Visit&& visit)
{
	visit("node", x.node), visit("block", x.block), visit("s1", x.s1), visit("s2", x.s2), visit("area", x.area);
}

template <class T, class Visit, Only<T, Pair> = 0> void forEachField(T& x, Visit&& visit)
{
	visit("block", x.block), visit("first", x.first), visit("last", x.last);
}

template <class T, class Visit, Only<T, JointParams> = 0> void forEachField(T& x, Visit&& visit)
{
	visit("kn", x.kn), visit("ks", x.ks), visit("cohesion", x.cohesion), visit("tanPhi", x.tanPhi), visit("tension", x.tension);
	visit("cohesionResidual", x.cohesionResidual), visit("tanPhiResidual", x.tanPhiResidual), visit("tensionResidual", x.tensionResidual);
	visit("tanDilation", x.tanDilation), visit("dilationLimitSlip", x.dilationLimitSlip);
}

template <class T, class Visit, Only<T, CapParams> = 0> void forEachField(T& x, Visit&& visit)
{
	visit("strength", x.strength), visit("first", x.first), visit("residual", x.residual), visit("peakClosure", x.peakClosure);
	visit("energy", x.energy), visit("shear", x.shear), visit("linear", x.linear);
}

template <class T, class Visit, Only<T, SofteningParams> = 0> void forEachField(T& x, Visit&& visit)
{
	visit("energyI", x.energyI), visit("energyII", x.energyII), visit("energyIIPressure", x.energyIIPressure), visit("lastingShare", x.lastingShare);
	visit("dilationDecay", x.dilationDecay), visit("dilationPressure", x.dilationPressure), visit("cap", x.cap);
}

template <class T, class Visit, Only<T, Joints> = 0> void forEachField(T& x, Visit&& visit)
{
	visit("segments", x.segments), visit("pairs", x.pairs), visit("kinds", x.kinds), visit("kind", x.kind), visit("ofMaterials", x.ofMaterials);
	visit("softening", x.softening), visit("inSituOpening", x.inSituOpening), visit("inSituSlip", x.inSituSlip);
	visit("names", x.names), visit("nameOf", x.nameOf);
}

template <class T, class Visit, Only<T, MotionGroup> = 0> void forEachField(T& x, Visit&& visit)
{
	visit("name", x.name), visit("drive", x.drive), visit("dofs", x.dofs), visit("target", x.target), visit("startTime", x.startTime);
	visit("rampTime", x.rampTime), visit("throttle", x.throttle), visit("velocity", x.velocity), visit("travelled", x.travelled), visit("force", x.force);
	visit("work", x.work), visit("workTurnover", x.workTurnover), visit("pendingWork", x.pendingWork);
}

template <class T, class Visit, Only<T, RigidBlock> = 0> void forEachField(T& x, Visit&& visit)
{
	visit("block", x.block), visit("origin", x.origin), visit("mass", x.mass), visit("moment", x.moment), visit("inertia", x.inertia);
	visit("rotaryInertia", x.rotaryInertia), visit("load", x.load), visit("free", x.free), visit("centre", x.centre), visit("halfTurn", x.halfTurn);
	visit("velocity", x.velocity), visit("force", x.force), visit("unbalanced", x.unbalanced);
	visit("work", x.work), visit("workTurnover", x.workTurnover), visit("pendingWork", x.pendingWork);
}

template <class T, class Visit, Only<T, EdgePair> = 0> void forEachField(T& x, Visit&& visit)
{
	visit("edge", x.edge), visit("slip", x.slip), visit("sigma", x.sigma), visit("tau", x.tau), visit("area", x.area), visit("uplift", x.uplift);
}

template <class T, class Visit, Only<T, FreeContact> = 0> void forEachField(T& x, Visit&& visit)
{
	visit("block", x.block), visit("edges", x.edges), visit("friction", x.friction), visit("joint", x.joint);
}

template <class T, class Visit, Only<T, ContactMemory> = 0> void forEachField(T& x, Visit&& visit)
{
	visit("detectedAt", x.detectedAt), visit("lookedAt", x.lookedAt), visit("mayGo", x.mayGo);
	visit("loosened", x.loosened);
}

template <class T, class Visit, Only<T, ReleasedWork> = 0> void forEachField(T& x, Visit&& visit) { visit("work", x.work), visit("turnover", x.turnover); }

template <class T, class Visit, Only<T, Accounts> = 0> void forEachField(T& x, Visit&& visit)
{
	visit("damping", x.damping), visit("pendingDamping", x.pendingDamping), visit("friction", x.friction), visit("fracture", x.fracture);
	visit("scaling", x.scaling), visit("released", x.released);
}

template <class T, class Visit, Only<T, FurtherAccounts> = 0> void forEachField(T& x, Visit&& visit)
{
	visit("viscous", x.viscous), visit("pendingViscous", x.pendingViscous), visit("incoming", x.incoming), visit("pendingIncoming", x.pendingIncoming);
	visit("stiffness", x.stiffness), visit("pendingStiffness", x.pendingStiffness), visit("removed", x.removed);
}

template <class T, class Visit, Only<T, Softened> = 0> void forEachField(T& x, Visit&& visit)
{
	visit("k", x.k), visit("opening", x.opening), visit("slipLargest", x.slipLargest), visit("crushing", x.crushing);
	visit("modeI", x.modeI), visit("modeII", x.modeII), visit("cap", x.cap), visit("snapped", x.snapped);
}

template <class T, class Visit, Only<T, LawColumns> = 0> void forEachField(T& x, Visit&& visit) { visit("names", x.names), visit("columns", x.columns); }

template <class T, class Visit, Only<T, State> = 0> void forEachField(T& x, Visit&& visit)
{
	visit("displacement", x.displacement), visit("velocity", x.velocity), visit("inertia", x.inertia);
	visit("opening", x.opening), visit("slip", x.slip), visit("sigma", x.sigma), visit("tau", x.tau);
	visit("slipPlastic", x.slipPlastic), visit("uplift", x.uplift), visit("status", x.status), visit("released", x.released);
	visit("groups", x.groups), visit("rigid", x.rigid), visit("contacts", x.contacts.all()), visit("search", x.search),
		visit("lostFriction", x.lostFriction);
	visit("viscosity", x.viscosity), visit("accounts", x.accounts), visit("softened", x.softened);
	visit("further", x.further), visit("lawColumns", x.lawColumns);
}

template <class T, class Visit, Only<T, Dashpot> = 0> void forEachField(T& x, Visit&& visit)
{
	visit("node", x.node), visit("boundary", x.boundary), visit("xx", x.xx), visit("xy", x.xy), visit("yy", x.yy);
}

template <class T, class Visit, Only<T, ViscousBoundary> = 0> void forEachField(T& x, Visit&& visit)
{
	visit("name", x.name), visit("times", x.times), visit("incoming", x.incoming);
}

template <class T, class Visit, Only<T, BlockAssembly> = 0> void forEachField(T& x, Visit&& visit)
{
	visit("thickness", x.thickness), visit("plane", x.plane), visit("strain", x.strain);
	visit("mesh", x.mesh), visit("joints", x.joints), visit("load", x.supports.load), visit("state", x.state), visit("nodalForces", x.forces.nodal);
	visit("viscous", x.supports.viscous), visit("dashpots", x.supports.dashpots), visit("stiffnessDamping", x.supports.stiffnessDamping);
}

} // namespace blocks
