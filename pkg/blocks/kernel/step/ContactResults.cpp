// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/step/ContactResults.hpp>
#include <blocks/kernel/step/EdgeDetection.hpp>
#include <blocks/kernel/step/RaisedCorners.hpp>

namespace blocks {

Real shearEnergy(const FreeContact& c, const EdgePair& e) { return c.joint.ks / 2 * e.area * (e.slip[0] * e.slip[0] + e.slip[1] * e.slip[1]); }

Real normalEnergyBefore(const BlockAssembly& a, const FreeContact& c, const EdgePair& e, Real dt)
{
	EdgePair flat = e;
	flat.uplift   = 0;
	FourPoints x  = points(raisedCorners(a, flat));
	for (int i = 0; i < 4; ++i)
		x[i] -= dt * a.state.velocity[e.node[i]];
	const EdgeGeometry g = edgeGeometry(e.uplift != 0 ? raised(x, e.uplift) : x, e.shape);
	return g.active() ? c.joint.kn * a.thickness * edgePotential(g) : 0;
}

Real contactEnergy(const BlockAssembly& a)
{
	Real sum = 0;
	for (int i : a.contacts.order) {
		const FreeContact& c = a.state.contacts[i];
		for (int pair : c.active)
			sum += c.joint.kn * a.thickness * c.edges[pair].potential + shearEnergy(c, c.edges[pair]);
	}
	return sum;
}

Real contactFriction(const BlockAssembly& a)
{
	Real sum = a.state.lostFriction;
	for (int i : a.contacts.order)
		sum += a.state.contacts[i].friction;
	return sum;
}

ContactEnd contactEnd(const BlockAssembly& a, const FreeContact& c, int active, int k)
{
	const EdgePair&    e   = c.edges[c.active[active]];
	const FourPoints   x   = points(raisedCorners(a, e));
	const EdgeGeometry g   = edgeGeometry(x, e.shape);
	const EdgeEnd      end = edgeEnd(x, g, k);
	return { a.mesh.reference[e.node[0]] + (Vec2(end.onA) + Vec2(end.onB)) / 2, { g.t.y, -g.t.x }, -e.sigma[k] / c.joint.kn, e.sigma[k], e.tau[k], e.area };
}

PointStresses pointStresses(const BlockAssembly& a, int first, int last)
{
	auto          part = [&](const std::vector<Real>& all) { return std::vector<Real>(all.begin() + 2 * first, all.begin() + 2 * last); };
	PointStresses out { part(a.state.sigma), part(a.state.tau) };
	for (int i = first; i < last; ++i) {
		if (!a.state.released[i]) continue;
		const Segment& g       = a.joints.segments[i];
		const int      contact = contactOf(a, g.block[0], g.block[1]);
		if (contact < 0) continue; // also of removed blocks, maybe without any contact in the scene
		const EdgePair* pair = a.state.contacts[contact].find(edgesOf(a, g));
		if (!pair || !pair->touching) continue;
		for (int k : { 0, 1 })
			out.sigma[2 * (i - first) + k] = pair->sigma[k], out.tau[2 * (i - first) + k] = pair->tau[k];
	}
	return out;
}

} // namespace blocks
