// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/step/Loads.hpp>

namespace blocks {
namespace {

	Vec2* loads(BlockAssembly& a)
	{
		if (a.supports.load.empty()) a.supports.load.assign(a.nodeCount(), Vec2::Zero());
		return a.supports.load.data();
	}

} // namespace

void addGravity(BlockAssembly& a, const Vec2& g)
{
	require(g.allFinite(), "gravity must be finite [m/s2]", g.allFinite() ? 0 : std::nan(""));
	Vec2* load = loads(a);
	for (int n = 0; n < a.nodeCount(); ++n)
		load[n] += a.mesh.mass[n] * g;
	for (RigidBlock& r : a.state.rigid)
		r.load += r.mass * g;
}

void addLoad(BlockAssembly& a, int node, const Vec2& force) { loads(a)[node] += force; }

void addTraction(BlockAssembly& a, int edge, const Vec2& traction)
{
	require(edge >= 0 && edge < int(a.mesh.edgeNodes.size()), "a traction needs the index of a boundary edge", edge);
	require(traction.allFinite(), "a traction must be finite [Pa]", traction.allFinite() ? 0 : std::nan(""));
	Vec2*      load = loads(a);
	const auto n    = a.mesh.edgeNodes[edge];
	const Vec2 half = traction * ((a.mesh.reference[n[1]] - a.mesh.reference[n[0]]).norm() * a.thickness / 2);
	load[n[0]] += half;
	load[n[1]] += half;
}

} // namespace blocks
