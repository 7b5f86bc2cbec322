// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/Wide.hpp>
#include <blocks/kernel/step/ContactSearch.hpp>
#include <blocks/kernel/step/Contacts.hpp>
#include <limits>

namespace blocks {
namespace {

	/// Paths are sums over up to 1e9 steps: what is derived from them keeps this much away from rounding.
	constexpr Real roundingShare = 1 - 1e-6;

	/// Of so many looks at a contact one measures how far its pairs are from touching. No result depends on it.
	constexpr int measuredLook = 8;

	/// Asks the memory for what the next step of a contact reads.
	void fetch(const FreeContact& c)
	{
		for (int i : c.active) {
			const char* edge = reinterpret_cast<const char*>(&c.edges[i]);
			for (size_t line = 0; line < sizeof(EdgePair); line += 64)
				__builtin_prefetch(edge + line);
		}
	}

	/// The two blocks of a contact together [m].
	Real pathOf(const BlockAssembly& a, const FreeContact& c) { return a.contacts.odometer.path[c.block[0]] + a.contacts.odometer.path[c.block[1]]; }

	/// Relative to where a0 was without stress, so that they are exact far from the origin too [m].
	FourPoints corners(const BlockAssembly& a, const EdgePair& e)
	{
		const auto& X = a.mesh.reference;
		const auto& u = a.state.displacement;
		const Vec2& o = X[e.node[0]];
		return { u[e.node[0]], X[e.node[1]] - o + u[e.node[1]], X[e.node[2]] - o + u[e.node[2]], X[e.node[3]] - o + u[e.node[3]] };
	}

	/// The corners of what touches.
	FourPoints raisedCorners(const BlockAssembly& a, const EdgePair& e)
	{
		const FourPoints x = corners(a, e);
		return e.uplift > 0 ? raised(x, e.uplift) : x;
	}

	Real shearEnergy(const FreeContact& c, const EdgePair& e) { return c.joint.ks / 2 * e.area * (e.slip[0] * e.slip[0] + e.slip[1] * e.slip[1]); }

} // namespace

void setContactJoint(BlockAssembly& a, int contact, const JointParams& joint)
{
	validate(joint);
	a.state.contacts[contact].joint = joint;
#pragma omp atomic
	++a.contacts.version;
}

WIDE void updateContact(BlockAssembly& a, int contact)
{
	FreeContact& c    = a.state.contacts[contact];
	const Real   path = pathOf(a, c);
	// Pairs at one corner have no distance that they could rest for: asking for it costs more than looking again.
	const bool measures = c.looks++ % measuredLook == 0;

	/// Whether a pair touches, and what it is like if it does.
	auto look = [&](int i, EdgeGeometry& g) {
		EdgePair&        e = c.edges[i];
		const FourPoints x = raisedCorners(a, e);
		edgeGeometry(x, e.shape, g);
		if (!g.active) {
			if (e.touching || e.area > 0) { // they have parted
				c.friction += shearEnergy(c, e);
				e.slip = e.sigma = e.tau = { 0, 0 };
				e.area                   = 0;
			}
			c.restsUntil[i] = path;
			if (measures) {
				const Real lever = 1 + 2 * e.uplift / (x[1] - x[0]).norm(); // what is raised moves more where the edge turns
				c.restsUntil[i] += roundingShare * freeDistance(x, e.shape) / lever;
			}
			c.allRestUntil = std::min(c.allRestUntil, c.restsUntil[i]);
		}
		return e.touching = g.active;
	};

	if (path < c.allRestUntil) { // only those that touch may have changed
		int kept = 0;
		for (int i : c.active)
			if (look(i, c.geometry[kept])) c.active[kept++] = i;
		c.active.resize(kept);
		return;
	}
	c.active.clear();
	c.allRestUntil = std::numeric_limits<Real>::infinity();
	for (int i = 0; i < int(c.edges.size()); ++i)
		if (path < c.restsUntil[i])
			c.allRestUntil = std::min(c.allRestUntil, c.restsUntil[i]);
		else if (look(i, c.geometry[c.active.size()]))
			c.active.push_back(i);
}

WIDE void advanceContact(BlockAssembly& a, int contact, Real dt)
{
	FreeContact&       c     = a.state.contacts[contact];
	const JointParams& joint = c.joint;
	for (int i = 0; i < int(c.active.size()); ++i) {
		EdgePair&           e = c.edges[c.active[i]];
		const EdgeGeometry& g = c.geometry[i];
		const FourPoints    x = raisedCorners(a, e);
		FourPoints          v { a.state.velocity[e.node[0]], a.state.velocity[e.node[1]], a.state.velocity[e.node[2]], a.state.velocity[e.node[3]] };
		if (e.uplift > 0) v = raisedVelocity(x, e.uplift, v);
		const Real area = a.thickness * g.area;
		e.force.fill(Vec2::Zero());
		addNormalForces(x, e.shape, g, joint.kn * a.thickness, e.force);
		// where the area changes the springs keep their energy, so that a contact which grows and shrinks neither makes nor wears any
		const Real regrown = area > 0 ? std::sqrt(e.area / area) : 0;
		for (int k : { 0, 1 }) {
			const Real pressure = joint.kn * g.depth[k], before = joint.ks * e.area * e.slip[k] * e.slip[k] / 2;
			Real       work = 0;
			if (pressure > 0 && area > 0) {
				const EdgeEnd end = edgeEnd(x, g, k);
				Real          ds  = 0;
				for (int corner = 0; corner < 4; ++corner)
					ds += dt * end.slipGradient[corner].dot(v[corner]);
				const Real old = e.slip[k] * regrown, limit = (joint.cohesionResidual + pressure * joint.tanPhiResidual) / joint.ks;
				e.slip[k]       = std::clamp(old + ds, -limit, limit);
				const Real drag = joint.ks * area * e.slip[k];
				work            = (joint.ks * area * old + drag) / 2 * ds;
				for (int corner = 0; corner < 4; ++corner)
					e.force[corner] -= drag * end.slipGradient[corner];
			} else
				e.slip[k] = 0;
			c.friction += work + before - joint.ks * area * e.slip[k] * e.slip[k] / 2;
			e.sigma[k] = -pressure;
			e.tau[k]   = joint.ks * e.slip[k];
		}
		e.area = area;
		if (e.uplift > 0) lowerForces(x, e.uplift, e.force);
	}
}

void advanceContacts(BlockAssembly& a, Real dt, [[maybe_unused]] int threads)
{
	const std::vector<int>& order       = a.contacts.order;
	Real* const             sleepsUntil = a.contacts.sleepsUntil.data();
	const int               count       = int(order.size());
	constexpr int           ahead       = 4; // contacts lie all over the memory: what comes soon is fetched early
#pragma omp parallel for schedule(dynamic, 64) num_threads(threads) if (threads > 1)
	for (int i = 0; i < count; ++i) {
		if (i + 2 * ahead < count) __builtin_prefetch(&a.state.contacts[order[i + 2 * ahead]]);
		if (i + ahead < count) fetch(a.state.contacts[order[i + ahead]]);
		const int          contact = order[i];
		const FreeContact& c       = a.state.contacts[contact];
		if (sleepsUntil[contact] > 0 && pathOf(a, c) < sleepsUntil[contact]) continue;
		updateContact(a, contact);
		advanceContact(a, contact, dt);
		sleepsUntil[contact] = c.active.empty() ? c.allRestUntil : 0;
	}
}

void gatherContactForces(const BlockAssembly& a, int block, Vec2* force)
{
	const FreeContacts& f = a.contacts;
	if (block + 1 >= int(f.firstOfBlock.size())) return; // it came after the last look for contacts
	for (int i = f.firstOfBlock[block]; i < f.firstOfBlock[block + 1]; ++i) {
		const FreeContact& c     = a.state.contacts[f.ofBlock[i]];
		const int          first = c.block[0] == block ? 0 : 2;
		for (int index : c.active) {
			const EdgePair& e = c.edges[index];
			force[e.node[first]] += e.force[first];
			force[e.node[first + 1]] += e.force[first + 1];
		}
	}
}

std::vector<Real> contactStiffness(const BlockAssembly& a)
{
	// Overlaps do not overlap: the areas on one edge add up to its own, however many blocks there are. So its two vertices
	// get at most as much as from point contacts with all of T L on either vertex: 2 k (T L / 2) from each edge.
	std::vector<Real> stiffest(a.blockCount(), 0);
	auto              include = [&](int block, const JointParams& joint) { stiffest[block] = std::max({ stiffest[block], joint.kn, joint.ks }); };
	for (int i : a.contacts.order)
		for (int block : a.state.contacts[i].block)
			include(block, a.state.contacts[i].joint);
	for (size_t pair = 0; pair < a.joints.pairs.size(); ++pair)
		for (int block : a.joints.pairs[pair].block)
			if (stiffest[block] > 0) include(block, a.joints.of(a.joints.pairs[pair].first));

	std::vector<Real> stiffness(a.nodeCount(), 0);
	for (int b = 0; b < a.blockCount(); ++b)
		for (int e = a.mesh.firstEdge[b]; e < a.mesh.firstEdge[b + 1]; ++e) {
			const auto& node  = a.mesh.edgeNodes[e];
			const Real  share = stiffest[b] * a.thickness * (a.mesh.reference[node[1]] - a.mesh.reference[node[0]]).norm();
			stiffness[node[0]] += share;
			stiffness[node[1]] += share;
		}
	return stiffness;
}

Real contactEnergy(const BlockAssembly& a)
{
	Real sum = 0;
	for (int i : a.contacts.order) {
		const FreeContact& c = a.state.contacts[i];
		for (int k = 0; k < int(c.active.size()); ++k)
			sum += c.joint.kn * a.thickness * edgePotential(c.geometry[k]) + shearEnergy(c, c.edges[c.active[k]]);
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
	const EdgePair&     e   = c.edges[c.active[active]];
	const EdgeGeometry& g   = c.geometry[active];
	const EdgeEnd       end = edgeEnd(raisedCorners(a, e), g, k);
	return { a.mesh.reference[e.node[0]] + (end.onA + end.onB) / 2, { g.t.y(), -g.t.x() }, g.depth[k], e.sigma[k], e.tau[k], e.area };
}

PointStresses pointStresses(const BlockAssembly& a, int first, int last)
{
	auto          part = [&](const std::vector<Real>& all) { return std::vector<Real>(all.begin() + 2 * first, all.begin() + 2 * last); };
	PointStresses out { part(a.state.sigma), part(a.state.tau) };
	for (int i = first; i < last; ++i) {
		if (!a.state.released[i]) continue;
		const Segment&           g       = a.joints.segments[i];
		const int                contact = contactOf(a, g.block[0], g.block[1]);
		const std::array<int, 2> key { a.contacts.edgeFrom[g.node[0]], a.contacts.edgeFrom[g.node[2]] };
		if (contact < 0) continue;
		const auto& edges = a.state.contacts[contact].edges;
		const auto  at = std::lower_bound(edges.begin(), edges.end(), key, [](const EdgePair& e, const std::array<int, 2>& k) { return e.edge < k; });
		if (at == edges.end() || at->edge != key || !at->touching) continue;
		for (int k : { 0, 1 })
			out.sigma[2 * (i - first) + k] = at->sigma[k], out.tau[2 * (i - first) + k] = at->tau[k];
	}
	return out;
}

} // namespace blocks
