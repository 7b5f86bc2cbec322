// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/model/BlockAssembly.hpp>
#include <numeric>
#include <utility>

/// AVX2 has shorter code for the same arithmetic; without fused operations the bits are the same.
#define WIDER __attribute__((target_clones("avx2", "default")))

namespace blocks {
namespace {

	/// rho of a vertex, as a fraction of the shorter of its two edges.
	constexpr Real roundingFraction = 0.02;
	/// Edges from how far out of the facing half-circle are kept as candidates: -e_A.e_B above this. The turn that a block can
	/// make while its vertices move by mayMove is smaller unless it has edges much shorter than its mean one; those see each other late.
	constexpr Real turnedAway = -0.2;
	/// Paths are sums over up to 1e9 steps: what is derived from them keeps this much away from rounding.
	constexpr Real roundingShare = 1 - 1e-6;

	struct Box {
		Vec2 low, high;

		void include(const Vec2& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); }
		bool meets(const Box& o, Real margin) const { return ((low - o.high).array() <= margin).all() && ((o.low - high).array() <= margin).all(); }
	};

	Box boxOf(const Vec2& p, const Vec2& q) { return { p.cwiseMin(q), p.cwiseMax(q) }; }

	Box boxOf(const BlockAssembly& a, int block)
	{
		Box box { a.position[a.firstNode[block]], a.position[a.firstNode[block]] };
		for (int e = a.firstEdge[block]; e < a.firstEdge[block + 1]; ++e)
			box.include(a.position[a.edgeNodes[e][0]]);
		return box;
	}

	std::array<int, 2> ordered(int block1, int block2) { return { std::min(block1, block2), std::max(block1, block2) }; }

	/// Corners and sizes in the reference positions, so that they never change.
	void computeShapes(BlockAssembly& a)
	{
		FreeContacts& f     = a.contacts;
		const int     edges = int(a.edgeNodes.size());
		f.sharpness.assign(a.nodeCount(), 0);
		f.rounding.assign(a.nodeCount(), 0);
		f.edgeFrom.assign(a.nodeCount(), -1);
		for (int e = 0; e < edges; ++e)
			f.edgeFrom[a.edgeNodes[e][0]] = e;
		for (const auto& [from, to] : a.edgeNodes) {
			const int  next = a.edgeNodes[f.edgeFrom[to]][1];
			const Vec2 in = a.reference[to] - a.reference[from], out = a.reference[next] - a.reference[to];
			const Real lengths = in.norm() * out.norm(), sine = cross(in, out) / lengths, cosine = in.dot(out) / lengths;
			// the outline turns left by the angle of (cosine, sine) = pi - beta, so 1/tan(beta/2) = tan(turn/2)
			const Real tangent  = sine / std::max(1 + cosine, std::numeric_limits<Real>::epsilon()); // negative where it bends inward
			const Real straight = 1e-9; // an outline that turns by less than this [rad] goes straight on
			f.sharpness[to]     = tangent > straight ? tangent * tangent : 0;
			f.rounding[to]      = roundingFraction * std::min(in.norm(), out.norm());
		}
		f.depthLimit.resize(a.blockCount());
		f.meanEdge.resize(a.blockCount());
		for (int b = 0; b < a.blockCount(); ++b) {
			const Vec2 origin = a.reference[a.firstNode[b]];
			Real       area = 0, outline = 0;
			for (int e = a.firstEdge[b]; e < a.firstEdge[b + 1]; ++e) {
				const Vec2 p = a.reference[a.edgeNodes[e][0]] - origin, q = a.reference[a.edgeNodes[e][1]] - origin;
				area += cross(p, q) / 2;
				outline += (q - p).norm();
			}
			f.depthLimit[b] = area / outline; // between half the inradius (compact blocks) and all of it (thin ones)
			f.meanEdge[b]   = outline / (a.firstEdge[b + 1] - a.firstEdge[b]);
		}
	}

	void sortContacts(BlockAssembly& a)
	{
		FreeContacts& f = a.contacts;
		f.order.clear();
		for (int i = 0; i < int(f.all.size()); ++i)
			if (f.all[i].block[0] >= 0) f.order.push_back(i);
		std::sort(f.order.begin(), f.order.end(), [&](int i, int j) { return f.all[i].block < f.all[j].block; });
		f.ofBlock.assign(2 * f.order.size(), 0);
		f.firstOfBlock.assign(f.order.empty() ? 0 : a.blockCount() + 1, 0);
		for (int i : f.order)
			for (int block : f.all[i].block)
				++f.firstOfBlock[block + 1];
		std::partial_sum(f.firstOfBlock.begin(), f.firstOfBlock.end(), f.firstOfBlock.begin());
		std::vector<int> next = f.firstOfBlock;
		for (int i : f.order) // sorted by both blocks: every block meets the others in their order
			for (int block : f.all[i].block)
				f.ofBlock[next[block]++] = i;
	}

	void nameEdges(const BlockAssembly& a, EdgePair& e)
	{
		const FreeContacts& f = a.contacts;
		const auto &        A = a.edgeNodes[e.edge[0]], &B = a.edgeNodes[e.edge[1]];
		e.node = { A[0], A[1], B[0], B[1] };
		for (int i = 0; i < 4; ++i)
			e.shape.sharpness[i] = f.sharpness[e.node[i]];
		auto rho            = [&](int i, int j) { return std::min(f.rounding[i], f.rounding[j]); };
		e.shape.rounding    = { rho(A[0], B[1]), rho(A[1], B[0]) };
		e.shape.farRounding = { rho(A[1], B[1]), rho(A[0], B[0]) };
		e.shape.depthLimit  = std::min(f.depthLimit[a.blockOfNode(A[0])], f.depthLimit[a.blockOfNode(B[0])]);
	}

	/// The two blocks of a contact together [m].
	Real pathOf(const BlockAssembly& a, const FreeContact& c) { return a.odometer.path[c.block[0]] + a.odometer.path[c.block[1]]; }

	FourPoints corners(const BlockAssembly& a, const EdgePair& e)
	{
		return { a.position[e.node[0]], a.position[e.node[1]], a.position[e.node[2]], a.position[e.node[3]] };
	}

	/// The corners of what touches.
	FourPoints raisedCorners(const BlockAssembly& a, const EdgePair& e)
	{
		const FourPoints x = corners(a, e);
		return e.uplift > 0 ? raised(x, e.uplift) : x;
	}

	/// Whether two edges touch, or can do so when their four vertices move by `margin` together.
	bool mayTouch(const Vec2& a0, const Vec2& a1, const Vec2& b0, const Vec2& b1, Real margin)
	{
		const Vec2 eA = (a1 - a0).normalized(), eB = (b1 - b0).normalized();
		const Real c = -eA.dot(eB);
		if (c < turnedAway) return false;
		const Real deepest = std::max({ cross(b0 - a0, eB), cross(b0 - a1, eB), cross(a0 - b1, eA), cross(a0 - b0, eA) });
		if (deepest < -margin) return false;
		if (c < 0.1) return true; // too far turned for a common direction to tell
		const Vec2 t    = (eA - eB).normalized();
		const Real side = std::min({ (a1 - a0).dot(t), (b0 - b1).dot(t), (a1 - b1).dot(t), (b0 - a0).dot(t) });
		// where an edge turns about its far end, the overlap changes by more than its vertices move; c >= 0.1 bounds it
		return side > -2 * margin - 0.05 * std::min((a1 - a0).norm(), (b1 - b0).norm());
	}

	/// A segment between bonded blocks as a pair of edges.
	std::array<int, 2> edgesOf(const BlockAssembly& a, const Segment& g) { return { a.contacts.edgeFrom[g.node[0]], a.contacts.edgeFrom[g.node[2]] }; }

	/// Edge pairs [sorted] that unreleased segments of two blocks occupy.
	std::vector<std::array<int, 2>> bondedEdges(const BlockAssembly& a, const std::array<int, 2>& blocks)
	{
		std::vector<std::array<int, 2>> list;
		const auto                      pair
			= std::lower_bound(a.pairs.begin(), a.pairs.end(), blocks, [](const Pair& p, const std::array<int, 2>& key) { return p.block < key; });
		if (pair == a.pairs.end() || pair->block != blocks) return list;
		for (int s = pair->first; s < pair->last; ++s)
			if (!a.segments[s].released()) list.push_back(edgesOf(a, a.segments[s]));
		std::sort(list.begin(), list.end());
		return list;
	}

	/// Until the next updateContact, which shall look at all pairs.
	void forgetActive(FreeContact& contact)
	{
		contact.allRestUntil = 0;
		contact.restsUntil.assign(contact.edges.size(), 0);
		contact.active.clear();
		contact.active.reserve(contact.edges.size()); // nothing is allocated inside a step
		contact.geometry.resize(contact.edges.size());
	}

	/// Looks for the edge pairs of a contact; those that it had keep their slip.
	void detect(BlockAssembly& a, FreeContact& contact)
	{
		const FreeContacts& f      = a.contacts;
		const auto          bonded = bondedEdges(a, contact.block);
		// each block's vertices may have moved by mayMove since they were last looked at, and will again
		const Real margin = 2 * FreeContacts::mayMove * (f.meanEdge[contact.block[0]] + f.meanEdge[contact.block[1]]);
		const Real reach  = margin + 2 * std::min(f.depthLimit[contact.block[0]], f.depthLimit[contact.block[1]]); // a vertex may be this deep
		const Box  other  = boxOf(a, contact.block[1]);

		std::vector<EdgePair> found;
		auto                  old = contact.edges.begin();
		for (int i = a.firstEdge[contact.block[0]]; i < a.firstEdge[contact.block[0] + 1]; ++i) {
			const Vec2 &a0 = a.position[a.edgeNodes[i][0]], &a1 = a.position[a.edgeNodes[i][1]];
			const Box   box = boxOf(a0, a1);
			if (!box.meets(other, reach)) continue;
			for (int j = a.firstEdge[contact.block[1]]; j < a.firstEdge[contact.block[1] + 1]; ++j) {
				const Vec2 &             b0 = a.position[a.edgeNodes[j][0]], &b1 = a.position[a.edgeNodes[j][1]];
				const std::array<int, 2> key { i, j };
				while (old != contact.edges.end() && old->edge < key)
					++old;
				const bool known = old != contact.edges.end() && old->edge == key;
				if (!box.meets(boxOf(b0, b1), reach) || !mayTouch(a0, a1, b0, b1, margin + (known ? old->uplift : 0))) continue;
				if (std::binary_search(bonded.begin(), bonded.end(), key)) continue;
				if (known) {
					found.push_back(*old);
					continue;
				}
				EdgePair e {};
				e.edge = key;
				nameEdges(a, e);
				found.push_back(e);
			}
		}
		contact.edges = std::move(found);
		forgetActive(contact);
	}

	/// The contact of two blocks, made if there is none.
	int makeContact(BlockAssembly& a, const std::array<int, 2>& blocks)
	{
		FreeContacts& f  = a.contacts;
		const int     is = contactOf(a, blocks[0], blocks[1]);
		if (is >= 0) return is;
		int slot = 0;
		while (slot < int(f.all.size()) && f.all[slot].block[0] >= 0)
			++slot;
		if (slot == int(f.all.size())) f.all.emplace_back();
		f.all[slot]       = {};
		f.all[slot].block = blocks;
		sortContacts(a);
		return slot;
	}

	/// A joint dilates until it has slid by its limit slip, or by this share of its length.
	constexpr Real dilatesFor = 0.25;

	/// A segment whose points are both broken, and that has no force which a free pair could not carry.
	bool mayRelease(const BlockAssembly& a, const JointParams& joint, int segment)
	{
		for (int i : { 2 * segment, 2 * segment + 1 }) {
			const ContactPoint& p = a.points[i];
			if (p.joint.status == Joint::intact || p.sigma > 0) return false; // residual tension stays with the point law
			if (joint.tanDilation > 0 && p.sigma < 0                          // so does a joint that goes on dilating
			    && std::abs(p.joint.slipPlastic) < std::min(joint.dilationLimitSlip, dilatesFor * 2 * a.segments[segment].area / a.thickness))
				return false;
		}
		return true;
	}

	/// Turns the broken segments of a pair of blocks into free edge pairs; their slip goes with them.
	bool release(BlockAssembly& a, int pair)
	{
		FreeContacts&    f = a.contacts;
		std::vector<int> broken;
		for (int s = a.pairs[pair].first; s < a.pairs[pair].last; ++s)
			if (!a.segments[s].released() && mayRelease(a, a.joints[pair], s)) broken.push_back(s);
		if (broken.empty()) return false;

		FreeContact& contact = f.all[makeContact(a, a.pairs[pair].block)];
		if (!(contact.joint.kn > 0)) contact.joint = a.joints[pair];
		std::vector<Real> area;
		for (int s : broken)
			area.push_back(std::exchange(a.segments[s].area, 0)); // from here on they carry nothing
		detect(a, contact);
		for (size_t i = 0; i < broken.size(); ++i) {
			const int  s   = broken[i];
			const auto key = edgesOf(a, a.segments[s]);
			auto       at  = std::lower_bound(
                                contact.edges.begin(), contact.edges.end(), key, [](const EdgePair& e, const std::array<int, 2>& k) { return e.edge < k; });
			const bool near = at != contact.edges.end() && at->edge == key;
			if (near) {
				at->area   = area[i];
				at->uplift = (a.points[2 * s].joint.uplift + a.points[2 * s + 1].joint.uplift) / 2;
			}
			for (int k : { 0, 1 }) {
				ContactPoint& p = a.points[2 * s + k];
				if (near) at->slip[k] = p.tau / contact.joint.ks, at->sigma[k] = p.sigma, at->tau[k] = p.tau;
				p.sigma = p.tau = 0;
			}
		}
		a.listSides();
		return true;
	}

	Real shearEnergy(const FreeContact& c, const EdgePair& e) { return c.joint.ks / 2 * e.area * (e.slip[0] * e.slip[0] + e.slip[1] * e.slip[1]); }

} // namespace

Real contactMargin(const BlockAssembly& a, int block)
{
	Real outline = 0;
	for (int e = a.firstEdge[block]; e < a.firstEdge[block + 1]; ++e)
		outline += (a.reference[a.edgeNodes[e][1]] - a.reference[a.edgeNodes[e][0]]).norm();
	return 2 * FreeContacts::mayMove * outline / (a.firstEdge[block + 1] - a.firstEdge[block]);
}

int contactOf(const BlockAssembly& a, int block1, int block2, int hint)
{
	const FreeContacts& f   = a.contacts;
	const auto          key = ordered(block1, block2);
	if (hint >= 0 && hint < int(f.all.size()) && f.all[hint].block == key) return hint;
	if (key[0] + 1 >= int(f.firstOfBlock.size())) return -1;
	for (int i = f.firstOfBlock[key[0]]; i < f.firstOfBlock[key[0] + 1]; ++i)
		if (f.all[f.ofBlock[i]].block == key) return f.ofBlock[i];
	return -1;
}

void requestContact(BlockAssembly& a, int block1, int block2)
{
	require(block1 != block2, "a contact needs two different blocks; block", block1);
	for (int block : { block1, block2 })
		require(block >= 0 && block < a.blockCount(), "a contact needs the indices of two blocks", block);
#pragma omp critical(blocksRequestContact)
	a.contacts.requests.push_back(ordered(block1, block2));
}

void enableRelease(BlockAssembly& a) { a.contacts.releasable.assign(a.pairs.size(), true); }

void watchForRelease(BlockAssembly& a, int pair)
{
	for (int s = a.pairs[pair].first; s < a.pairs[pair].last; ++s)
		if (!a.segments[s].released() && mayRelease(a, a.joints[pair], s)) {
			a.contacts.releasable[pair] = true;
			return;
		}
}

WIDER void followMotion(BlockAssembly& a)
{
	std::vector<Vec2>& seenAt = a.odometer.seenAt;
	const size_t       known  = std::min(seenAt.size(), a.position.size());
	seenAt.resize(a.nodeCount());
	std::copy(a.position.begin() + known, a.position.end(), seenAt.begin() + known);
	a.odometer.path.resize(a.blockCount(), 0);
	for (int b = 0; b < a.blockCount(); ++b) {
		Real farthest = 0;
		for (int n = a.firstNode[b]; n < a.firstNode[b + 1]; ++n) {
			farthest  = std::max(farthest, (a.position[n] - seenAt[n]).squaredNorm());
			seenAt[n] = a.position[n];
		}
		a.odometer.path[b] += std::sqrt(farthest);
	}
}

void prepareContacts(BlockAssembly& a)
{
	followMotion(a);
	FreeContacts& f        = a.contacts;
	const auto    anything = std::find(f.releasable.begin(), f.releasable.end(), char(true));
	if (f.order.empty() && f.requests.empty() && anything == f.releasable.end()) return;

	if (int(f.rounding.size()) != a.nodeCount()) computeShapes(a);
	if (int(f.detectedAt.size()) != a.nodeCount()) {
		const size_t known = f.detectedAt.size();
		f.detectedAt.resize(a.nodeCount());
		std::copy(a.position.begin() + known, a.position.end(), f.detectedAt.begin() + known);
	}

	f.nearUntil.resize(a.blockCount(), 0);

	// blocks with a vertex that has moved too far
	std::vector<char> moved(a.blockCount(), false);
	bool              any = false;
	if (!f.order.empty())
		for (int b = 0; b < int(f.firstOfBlock.size()) - 1; ++b) {
			if (f.firstOfBlock[b] == f.firstOfBlock[b + 1]) continue;
			if (a.odometer.path[b] < f.nearUntil[b]) continue;
			const Real limit  = FreeContacts::mayMove * f.meanEdge[b];
			Real       square = 0;
			for (int e = a.firstEdge[b]; e < a.firstEdge[b + 1]; ++e) {
				const int n = a.edgeNodes[e][0];
				square      = std::max(square, (a.position[n] - f.detectedAt[n]).squaredNorm());
			}
			if (square <= limit * limit)
				f.nearUntil[b] = a.odometer.path[b] + roundingShare * (limit - std::sqrt(square));
			else
				moved[b] = any = true;
		}

	// contacts that were asked for; a block that had none starts being watched here
	bool created = false;
	auto watch   = [&](int block) {
                const bool watched = !f.firstOfBlock.empty() && block + 1 < int(f.firstOfBlock.size()) && f.firstOfBlock[block] != f.firstOfBlock[block + 1];
                if (!watched)
                        for (int n = a.firstNode[block]; n < a.firstNode[block + 1]; ++n)
                                f.detectedAt[n] = a.position[n];
	};
	std::sort(f.requests.begin(), f.requests.end());
	f.requests.erase(std::unique(f.requests.begin(), f.requests.end()), f.requests.end());
	for (const auto& key : f.requests) {
		const Real margin = 2 * FreeContacts::mayMove * (f.meanEdge[key[0]] + f.meanEdge[key[1]]);
		if (contactOf(a, key[0], key[1]) >= 0 || !boxOf(a, key[0]).meets(boxOf(a, key[1]), margin)) continue;
		watch(key[0]), watch(key[1]);
		detect(a, f.all[makeContact(a, key)]);
		created = true;
	}
	f.requests.clear();

	for (int pair = 0; pair < int(f.releasable.size()); ++pair) {
		if (!f.releasable[pair]) continue;
		f.releasable[pair] = false;
		watch(a.pairs[pair].block[0]), watch(a.pairs[pair].block[1]);
		if (release(a, pair)) created = true;
	}

	if (any) {
		bool erased = false;
		for (int i : f.order) {
			FreeContact& contact = f.all[i];
			const int    b0 = contact.block[0], b1 = contact.block[1];
			if (!moved[b0] && !moved[b1]) continue;
			detect(a, contact);
			if (!contact.edges.empty() || boxOf(a, b0).meets(boxOf(a, b1), 4 * FreeContacts::mayMove * (f.meanEdge[b0] + f.meanEdge[b1]))) continue;
			f.lostFriction += contact.friction;
			contact = {};
			erased  = true;
		}
		for (int b = 0; b < a.blockCount(); ++b)
			if (moved[b])
				for (int n = a.firstNode[b]; n < a.firstNode[b + 1]; ++n)
					f.detectedAt[n] = a.position[n];
		if (erased) sortContacts(a), ++f.version;
	}
	if (created) ++f.version;
}

void setContactJoint(BlockAssembly& a, int contact, const JointParams& joint)
{
	validate(joint);
	a.contacts.all[contact].joint = joint;
#pragma omp atomic
	++a.contacts.version;
}

WIDER void updateContact(BlockAssembly& a, int contact)
{
	FreeContact& c    = a.contacts.all[contact];
	const Real   path = pathOf(a, c);

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
			const Real lever = 1 + 2 * e.uplift / (x[1] - x[0]).norm(); // what is raised moves more where the edge turns
			c.restsUntil[i]  = path + roundingShare * freeDistance(x, e.shape) / lever;
			c.allRestUntil   = std::min(c.allRestUntil, c.restsUntil[i]);
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

WIDER void advanceContact(BlockAssembly& a, int contact, Real dt)
{
	FreeContact&       c     = a.contacts.all[contact];
	const JointParams& joint = c.joint;
	for (int i = 0; i < int(c.active.size()); ++i) {
		EdgePair&           e = c.edges[c.active[i]];
		const EdgeGeometry& g = c.geometry[i];
		const FourPoints    x = raisedCorners(a, e);
		FourPoints          v { a.velocity[e.node[0]], a.velocity[e.node[1]], a.velocity[e.node[2]], a.velocity[e.node[3]] };
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
				for (int i = 0; i < 4; ++i)
					ds += dt * end.slipGradient[i].dot(v[i]);
				const Real old = e.slip[k] * regrown, limit = (joint.cohesionResidual + pressure * joint.tanPhiResidual) / joint.ks;
				e.slip[k]       = std::clamp(old + ds, -limit, limit);
				const Real drag = joint.ks * area * e.slip[k];
				work            = (joint.ks * area * old + drag) / 2 * ds;
				for (int i = 0; i < 4; ++i)
					e.force[i] -= drag * end.slipGradient[i];
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
	const std::vector<int>& order = a.contacts.order;
#pragma omp parallel for schedule(dynamic, 16) num_threads(threads) if (threads > 1)
	for (int i = 0; i < int(order.size()); ++i) {
		updateContact(a, order[i]);
		advanceContact(a, order[i], dt);
	}
}

void gatherContactForces(const BlockAssembly& a, int block, Vec2* force)
{
	const FreeContacts& f = a.contacts;
	if (block + 1 >= int(f.firstOfBlock.size())) return; // it came after the last look for contacts
	for (int i = f.firstOfBlock[block]; i < f.firstOfBlock[block + 1]; ++i) {
		const FreeContact& c     = f.all[f.ofBlock[i]];
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
		for (int block : a.contacts.all[i].block)
			include(block, a.contacts.all[i].joint);
	for (size_t pair = 0; pair < a.pairs.size(); ++pair)
		for (int block : a.pairs[pair].block)
			if (stiffest[block] > 0) include(block, a.joints[pair]);

	std::vector<Real> stiffness(a.nodeCount(), 0);
	for (int b = 0; b < a.blockCount(); ++b)
		for (int e = a.firstEdge[b]; e < a.firstEdge[b + 1]; ++e) {
			const auto& node  = a.edgeNodes[e];
			const Real  share = stiffest[b] * a.thickness * (a.reference[node[1]] - a.reference[node[0]]).norm();
			stiffness[node[0]] += share;
			stiffness[node[1]] += share;
		}
	return stiffness;
}

Real contactEnergy(const BlockAssembly& a)
{
	Real sum = 0;
	for (int i : a.contacts.order) {
		const FreeContact& c = a.contacts.all[i];
		for (int k = 0; k < int(c.active.size()); ++k)
			sum += c.joint.kn * a.thickness * edgePotential(c.geometry[k]) + shearEnergy(c, c.edges[c.active[k]]);
	}
	return sum;
}

Real contactFriction(const BlockAssembly& a)
{
	Real sum = a.contacts.lostFriction;
	for (int i : a.contacts.order)
		sum += a.contacts.all[i].friction;
	return sum;
}

ContactEnd contactEnd(const BlockAssembly& a, const FreeContact& c, int active, int k)
{
	const EdgePair&     e   = c.edges[c.active[active]];
	const EdgeGeometry& g   = c.geometry[active];
	const EdgeEnd       end = edgeEnd(raisedCorners(a, e), g, k);
	return { (end.onA + end.onB) / 2, { g.t.y(), -g.t.x() }, g.depth[k], e.sigma[k], e.tau[k], e.area };
}

void rebuildContacts(BlockAssembly& a)
{
	FreeContacts& f = a.contacts;
	if (f.all.empty()) return;
	f.wanted = true;
	followMotion(a);
	computeShapes(a);
	sortContacts(a);
	for (FreeContact& c : f.all) {
		for (EdgePair& e : c.edges)
			nameEdges(a, e);
		forgetActive(c);
	}
}

} // namespace blocks
