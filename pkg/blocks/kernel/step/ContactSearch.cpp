// yade-blocks, GPL-2.0-or-later
#include <CGAL/box_intersection_d.h>
#include <algorithm>
#include <blocks/kernel/step/ContactSearch.hpp>
#include <blocks/kernel/step/Contacts.hpp>
#include <blocks/kernel/step/Largest.hpp>
#include <limits>
#include <set>

namespace blocks {
namespace {

	/// Edges from how far out of the facing half-circle are kept as candidates: -e_A.e_B above this. The turn that a block can
	/// make while its vertices move by mayMove is smaller unless it has edges much shorter than its mean one; those see each other late.
	constexpr Real turnedAway = -0.2;
	struct Box {
		Vec2 low, high;

		void include(const Vec2& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); }
		bool meets(const Box& o, Real margin) const { return ((low - o.high).array() <= margin).all() && ((o.low - high).array() <= margin).all(); }
	};

	Box boxOf(const Vec2& p, const Vec2& q) { return { p.cwiseMin(q), p.cwiseMax(q) }; }

	Box boxOf(const BlockAssembly& a, int block)
	{
		Box box { a.position(a.mesh.firstNode[block]), a.position(a.mesh.firstNode[block]) };
		for (int e = a.mesh.firstEdge[block]; e < a.mesh.firstEdge[block + 1]; ++e)
			box.include(a.position(a.mesh.edgeNodes[e][0]));
		return box;
	}

	std::array<int, 2> ordered(int block1, int block2) { return { std::min(block1, block2), std::max(block1, block2) }; }

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

	/// Edge pairs [sorted] that segments of two blocks occupy: those that are not released, or all.
	std::vector<std::array<int, 2>> edgesOfJoints(const BlockAssembly& a, const std::array<int, 2>& blocks, bool releasedToo)
	{
		std::vector<std::array<int, 2>> list;
		const auto                      pair = std::lower_bound(
                        a.joints.pairs.begin(), a.joints.pairs.end(), blocks, [](const Pair& p, const std::array<int, 2>& key) { return p.block < key; });
		if (pair == a.joints.pairs.end() || pair->block != blocks) return list;
		for (int s = pair->first; s < pair->last; ++s)
			if (releasedToo || !a.state.released[s]) list.push_back(edgesOf(a, a.joints.segments[s]));
		std::sort(list.begin(), list.end());
		return list;
	}

	/// Looks for the edge pairs of a contact; those that it had keep their slip.
	void detect(BlockAssembly& a, FreeContact& contact)
	{
		const FreeContacts& f      = a.contacts;
		const auto          bonded = edgesOfJoints(a, contact.block, false), joined = edgesOfJoints(a, contact.block, true);
		// each block's vertices may have moved by mayMove since they were last looked at, and will again
		const Real margin = 2 * FreeContacts::mayMove * (f.meanEdge[contact.block[0]] + f.meanEdge[contact.block[1]]);
		const Real reach  = margin + 2 * std::min(f.depthLimit[contact.block[0]], f.depthLimit[contact.block[1]]); // a vertex may be this deep
		const Box  other  = boxOf(a, contact.block[1]);

		std::vector<EdgePair> found;
		auto                  old = contact.edges.begin();
		for (int i = a.mesh.firstEdge[contact.block[0]]; i < a.mesh.firstEdge[contact.block[0] + 1]; ++i) {
			const Vec2 a0 = a.position(a.mesh.edgeNodes[i][0]), a1 = a.position(a.mesh.edgeNodes[i][1]);
			const Box  box = boxOf(a0, a1);
			if (!box.meets(other, reach)) continue;
			for (int j = a.mesh.firstEdge[contact.block[1]]; j < a.mesh.firstEdge[contact.block[1] + 1]; ++j) {
				const Vec2               b0 = a.position(a.mesh.edgeNodes[j][0]), b1 = a.position(a.mesh.edgeNodes[j][1]);
				const std::array<int, 2> key { i, j };
				while (old != contact.edges.end() && old->edge < key)
					++old;
				const bool known = old != contact.edges.end() && old->edge == key;
				if (!box.meets(boxOf(b0, b1), reach) || !mayTouch(a0, a1, b0, b1, margin + (known ? old->uplift : 0))) continue;
				if (std::binary_search(bonded.begin(), bonded.end(), key)) continue;
				if (!std::binary_search(joined.begin(), joined.end(), key) && heldTogether(a, contact.block, key)) continue;
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

	/// Contacts of those pairs of blocks [sorted] that have none. Their properties are those of the two materials, if they are known.
	void makeContacts(BlockAssembly& a, const std::vector<std::array<int, 2>>& wanted)
	{
		std::vector<FreeContact>& all  = a.state.contacts.all();
		size_t                    slot = 0, made = 0;
		for (size_t i = 0; i < wanted.size(); ++i) {
			const auto& blocks = wanted[i];
			if ((i > 0 && wanted[i - 1] == blocks) || contactOf(a, blocks[0], blocks[1]) >= 0) continue;
			while (slot < all.size() && all[slot].block[0] >= 0)
				++slot;
			if (slot == all.size()) all.emplace_back();
			all[slot]       = {};
			all[slot].block = blocks;
			const int kind  = a.joints.kindOfMaterials(a.mesh.blockMaterial[blocks[0]], a.mesh.blockMaterial[blocks[1]]);
			if (kind > 0) all[slot].joint = a.joints.kinds[kind];
			++made;
		}
		if (made > 0) sortContacts(a);
	}

	/// A joint dilates until it has slid by its limit slip, or by this share of its length.
	constexpr Real dilatesFor = 0.25;

	/// What a broken joint waits for before its edges become a free contact.
	enum class Release { never, later, now };

	Release releaseOf(const BlockAssembly& a, int joint)
	{
		const JointParams& p      = a.joints.of(joint);
		auto               broken = [&](int i) { return a.state.status[i] != Joint::intact && a.state.status[i] != Joint::softening; };
		const int          ends   = broken(2 * joint) + broken(2 * joint + 1);
		if (a.joints.softens(joint)) {
			if (ends == 0 || a.joints.softeningOf(joint).cap.strength > 0) return Release::never; // free contacts have no cap
			if (edgesPassed(a, joint)) return Release::now; // a fragment turns about an end that still holds, or has slid away from its edge
			if (ends < 2) return Release::later;
			const Softened& soft = a.state.softened;
			for (int i : { 2 * joint, 2 * joint + 1 })
				if (a.state.status[i] != Joint::unbonded && soft.k[i] < softeningEnd) return Release::later; // some bond is left
		}
		if (ends < 2) return Release::never; // until it breaks, which will be noticed
		for (int i : { 2 * joint, 2 * joint + 1 }) {
			if (a.state.sigma[i] > 0) return Release::later; // residual tension stays with the point law
			// so does a joint that goes on dilating, and one that rests on ends raised by different amounts, which a free contact would level
			if (a.state.sigma[i] < 0 && (p.tanDilation > 0 || a.state.uplift[2 * joint] != a.state.uplift[2 * joint + 1])
			    && std::abs(a.state.slipPlastic[i]) < std::min(p.dilationLimitSlip, dilatesFor * 2 * a.joints.segments[joint].area / a.thickness))
				return Release::later;
		}
		return Release::now;
	}

	/// A pair of edges that takes a joint's place may hold so much more than the joint did, by what the joint holds or held when it broke. It is the
	/// 1 % by which energy may be out of balance.
	constexpr Real mayGain = 0.01;

	/// Lowers edge A of a pair until the two held no more than this a step ago. What the pair holds [J].
	Real lower(const BlockAssembly& a, const FreeContact& c, EdgePair& e, Real most, Real dt)
	{
		Real energy = normalEnergyBefore(a, c, e, dt);
		if (energy <= most) return energy;
		auto tooHigh = [&](Real uplift) {
			EdgePair at = e;
			at.uplift   = uplift;
			energy      = normalEnergyBefore(a, c, at, dt);
			return energy > most;
		};
		Real       high = e.uplift, far = std::numeric_limits<Real>::epsilon() * e.shape.depthLimit;
		const Real from = e.uplift;
		while (tooHigh(from - far))
			high = from - far, far *= 2;
		Real low = from - far;
		for (int i = 0; i < 30; ++i) { // to 1e-9 of what it is lowered by
			const Real middle              = (low + high) / 2;
			(tooHigh(middle) ? high : low) = middle;
		}
		e.uplift = low;
		return normalEnergyBefore(a, c, e, dt);
	}

	/// Looks for the edge pairs of a contact. Those that it did not have are lowered until they only touch.
	void detectMore(BlockAssembly& a, FreeContact& c, Real dt)
	{
		std::vector<std::array<int, 2>> known;
		for (const EdgePair& e : c.edges)
			known.push_back(e.edge);
		detect(a, c);
		for (EdgePair& e : c.edges)
			if (!std::binary_search(known.begin(), known.end(), e.edge)) lower(a, c, e, 0, dt);
	}

	/// Turns a broken joint into a free edge pair, which takes over its slip. With the joint the other edges of the two blocks come to act, too. They may
	/// overlap by then, and a joint may have dilated more at one end than there is room for at the other: such pairs are lowered, so that no energy comes
	/// from nowhere. What the joint held and its successors do not hold is the return value [J].
	Real release(BlockAssembly& a, int joint, int contact, bool isNew, Real dt)
	{
		const Segment&    g   = a.joints.segments[joint];
		const JointParams own = a.joints.of(joint);
		a.releaseJoint(joint); // from here on it carries nothing
		FreeContact& c = a.state.contacts[contact];
		if (isNew || !(c.joint.kn > 0)) c.joint = a.joints.of(joint); // not those of two materials that were never bonded
		std::vector<std::array<int, 2>> known;
		for (const EdgePair& e : c.edges)
			known.push_back(e.edge);
		detect(a, c);
		const auto key = edgesOf(a, g);
		const auto at
			= std::lower_bound(c.edges.begin(), c.edges.end(), key, [](const EdgePair& e, const std::array<int, 2>& k) { return e.edge < k; });
		const bool near   = at != c.edges.end() && at->edge == key;
		Real       normal = 0, shear = 0; // that the joint held [J]
		for (int p : { 2 * joint, 2 * joint + 1 }) {
			normal += g.area * a.state.sigma[p] * a.state.sigma[p] / (2 * own.kn);
			shear += g.area * a.state.tau[p] * a.state.tau[p] / (2 * own.ks);
		}
		if (near) {
			at->area   = g.area;
			at->uplift = (a.state.uplift[2 * joint] + a.state.uplift[2 * joint + 1]) / 2;
			if (const auto& start = a.joints.inSituOpening; !start.empty()) at->uplift -= (start[joint][0] + start[joint][1]) / 2;
		}
		for (int k : { 0, 1 }) {
			const int p = 2 * joint + k;
			if (near) at->slip[k] = a.state.tau[p] / c.joint.ks, at->sigma[k] = a.state.sigma[p], at->tau[k] = a.state.tau[p];
			a.state.sigma[p] = a.state.tau[p] = 0;
		}
		const Real atStrength = g.area * (own.tension * own.tension / own.kn + own.cohesion * own.cohesion / own.ks);
		const Real more       = mayGain * std::max(normal, atStrength);
		Real       lost       = normal + (near ? 0 : shear);
		for (EdgePair& e : c.edges)
			if (e.edge == key)
				lost -= lower(a, c, e, normal + more, dt);
			else if (!std::binary_search(known.begin(), known.end(), e.edge))
				lost -= lower(a, c, e, more, dt);
		return lost;
	}

	/// Largest square of a distance that a grid point of a block has moved since `from` [m2].
	Real farthestMove(const BlockAssembly& a, int block, const std::vector<Vec2>& from)
	{
		Real square = 0;
		for (int n = a.mesh.firstNode[block]; n < a.mesh.firstNode[block + 1]; ++n)
			square = std::max(square, (a.state.displacement[n] - from[n]).squaredNorm());
		return square;
	}

	/// Mean velocity of a block's grid points, and the most by which one of them differs from another block's mean [m/s].
	Vec2 meanVelocity(const BlockAssembly& a, int block)
	{
		Vec2 sum = Vec2::Zero();
		for (int n = a.mesh.firstNode[block]; n < a.mesh.firstNode[block + 1]; ++n)
			sum += a.state.velocity[n];
		return sum / (a.mesh.firstNode[block + 1] - a.mesh.firstNode[block]);
	}
	Real fastest(const BlockAssembly& a, int block, const Vec2& against)
	{
		Real square = 0;
		for (int n = a.mesh.firstNode[block]; n < a.mesh.firstNode[block + 1]; ++n)
			square = std::max(square, (a.state.velocity[n] - against).squaredNorm());
		return std::sqrt(square);
	}

	/// Where a block was a step ago, is, and will be a step on, as seen from one that moves.
	Box sweptBox(const BlockAssembly& a, int block, const Vec2& against, Real dt)
	{
		Box box = boxOf(a, block);
		for (int e = a.mesh.firstEdge[block]; e < a.mesh.firstEdge[block + 1]; ++e) {
			const int  n    = a.mesh.edgeNodes[e][0];
			const Vec2 step = dt * (a.state.velocity[n] - against);
			box.include(a.position(n) - step);
			box.include(a.position(n) + step);
		}
		return box;
	}

	/// Blocks that have not been taken out.
	std::vector<int> presentBlocks(const BlockAssembly& a)
	{
		std::vector<int> list;
		for (int b = 0; b < a.blockCount(); ++b)
			if (!a.isRemoved(b)) list.push_back(b);
		return list;
	}

	using BoxOf = CGAL::Box_intersection_d::Box_with_handle_d<Real, 2, const int*, CGAL::Box_intersection_d::ID_EXPLICIT>;

	/// Which of `some` blocks may come near which other one within a step, in order. mean: velocities of all blocks [m/s].
	std::vector<std::array<int, 2>> onTheWay(const BlockAssembly& a, const std::vector<int>& some, const std::vector<Vec2>& mean, Real dt)
	{
		const std::vector<int> every = presentBlocks(a);
		auto                   boxes = [&](const std::vector<int>& blocks, bool ofPoints) {
                        std::vector<BoxOf> list;
                        list.reserve(blocks.size());
                        for (const int& block : blocks) {
                                Box box = ofPoints ? sweptBox(a, block, Vec2::Zero(), dt) : boxOf(a, block);
                                if (!ofPoints) {
                                        const Vec2 way = dt * mean[block].cwiseAbs();
                                        box            = { box.low - way, box.high + way };
                                }
                                if (!box.low.allFinite() || !box.high.allFinite()) continue; // the watch will tell
                                Real low[] = { box.low.x(), box.low.y() }, high[] = { box.high.x(), box.high.y() };
                                list.emplace_back(low, high, &block);
                        }
                        return list;
		};
		std::vector<BoxOf>              fast = boxes(some, true), all = boxes(every, false);
		std::vector<std::array<int, 2>> found;
		CGAL::box_intersection_d(fast.begin(), fast.end(), all.begin(), all.end(), [&](const BoxOf& p, const BoxOf& q) {
			if (*p.handle() != *q.handle()) found.push_back({ *p.handle(), *q.handle() });
		});
		std::sort(found.begin(), found.end());
		found.erase(std::unique(found.begin(), found.end()), found.end());
		return found;
	}

	/// Refuses blocks that come too fast for their contact with another one: they would be deep in it, or past it, before it acts.
	void refuseTunnelling(const BlockAssembly& a, Real dt)
	{
		const FreeContacts& f = a.contacts;
		std::vector<Vec2>   mean;
		std::vector<int>    fast;
		for (int b = 0; b < a.blockCount(); ++b) {
			mean.push_back(meanVelocity(a, b));
			if (fastest(a, b, Vec2::Zero()) * dt > f.mostAStep * f.leastDepth) fast.push_back(b);
		}
		for (const auto& [b, other] : onTheWay(a, fast, mean, dt)) {
			const Vec2& with  = mean[other];
			const Real  limit = f.mostAStep * std::min(f.depthLimit[b], f.depthLimit[other]);
			if (((mean[b] - with).norm() + fastest(a, b, mean[b])) * dt <= limit)
				continue; // they move along together: most do, and need no closer look
			const Real speed = fastest(a, b, with);
			if (speed * dt <= limit || !sweptBox(a, b, with, dt).meets(boxOf(a, other), 0)) continue;
			if (pairOf(a, ordered(b, other)) >= 0 && !edgesOfJoints(a, ordered(b, other), false).empty()) continue;
			throw std::runtime_error(
				"block " + std::to_string(b) + " nears block " + std::to_string(other) + " at " + shown(speed, 6) + " m/s, "
				+ shown(speed * dt, 3) + " m a step, and might pass through it: contacts need steps of at most " + shown(limit, 3)
				+ " m, so O.dt must not exceed " + shown(limit / speed, 3) + " s at this speed");
		}
	}

	/// Lengths of the paths of those blocks that have contacts.
	void followMotion(BlockAssembly& a)
	{
		FreeContacts& f       = a.contacts;
		Real          longest = 0;
		for (int b : f.blocksInContact) {
			Real farthest = 0;
			for (int n = a.mesh.firstNode[b]; n < a.mesh.firstNode[b + 1]; ++n) {
				farthest             = std::max(farthest, (a.state.displacement[n] - f.odometer.seenAt[n]).squaredNorm());
				f.odometer.seenAt[n] = a.state.displacement[n];
			}
			f.odometer.path[b] += std::sqrt(farthest);
			longest = std::max(longest, std::sqrt(farthest));
		}
		f.odometer.longest += longest;
		f.odometer.unseen = 0, f.odometer.steps = 0;
	}

	/// Paths are brought up to date every so many steps. In between, only the fastest grid point counts.
	constexpr int stepsUnseen = 8;

	/// Before blocks get contacts that had none: their paths count from here.
	void followAll(BlockAssembly& a)
	{
		followMotion(a);
		a.contacts.odometer.seenAt = a.state.displacement;
	}

	void followContacts(BlockAssembly& a)
	{
		FreeContacts& f = a.contacts;
		if (f.strangers || ++f.odometer.steps >= stepsUnseen) followMotion(a);
	}

	/// A block that has gone this share of its limit is looked at, when anybody is.
	constexpr Real lookAgain = 0.5;

	/// How far a block's grid points may move until its neighbours are looked for anew [m].
	Real limitOf(const FreeContacts& f, int block) { return FreeContacts::mayMove * f.meanEdge[block]; }

	/// Takes note of a joint that is to be released, or lets go of the corners at its ends.
	void askWhether(BlockAssembly& a, int joint)
	{
		if (!a.state.released[joint] && releaseOf(a, joint) != Release::never) a.contacts.waiting.push_back(joint);
		if (!a.state.search.loosened[joint] && !isWhole(a, joint)) a.contacts.loosening.push_back(joint);
	}

	/// The first step of a scene, or the first after its state was put back. Whether neighbours are known.
	bool start(BlockAssembly& a)
	{
		FreeContacts& f     = a.contacts;
		const bool    known = int(a.state.search.lookedAt.size()) == a.nodeCount();
		rebuildContacts(a);
		f.odometer.path.assign(a.blockCount(), 0);
		f.odometer.seenAt = a.state.displacement;
		f.odometer.unseen = 0, f.odometer.sinceLook = std::numeric_limits<Real>::infinity();
		if (!known) a.state.search.detectedAt = a.state.search.lookedAt = a.state.displacement;
		f.waiting.clear(), f.loosening.clear();
		auto& loosened = a.state.search.loosened;
		if (!known || int(loosened.size()) != a.joints.count()) {
			loosened.resize(a.joints.count());
			for (int i = 0; i < a.joints.count(); ++i)
				loosened[i] = !isWhole(a, i);
		}
		for (int i = 0; i < a.joints.count(); ++i)
			askWhether(a, i);
		f.started = true;
		return known;
	}

	/// Pairs of blocks, not bonded, of which one has moved, and whose boxes are close enough for a contact before the next look.
	std::vector<std::array<int, 2>> newNeighbours(const BlockAssembly& a, const std::vector<int>& moved)
	{
		const std::vector<int> every = presentBlocks(a);
		auto                   boxes = [&](const std::vector<int>& blocks) {
                        std::vector<BoxOf> list;
                        list.reserve(blocks.size());
                        for (const int& block : blocks) {
                                const Box  box    = boxOf(a, block);
                                const Real margin = 2 * limitOf(a.contacts, block);
                                Real       low[] = { box.low.x() - margin, box.low.y() - margin }, high[] = { box.high.x() + margin, box.high.y() + margin };
                                list.emplace_back(low, high, &block);
                        }
                        return list;
		};
		std::vector<BoxOf>              some = boxes(moved), all = boxes(every);
		std::vector<std::array<int, 2>> found;
		CGAL::box_intersection_d(some.begin(), some.end(), all.begin(), all.end(), [&](const BoxOf& p, const BoxOf& q) {
			if (*p.handle() == *q.handle()) return;
			const auto key = ordered(*p.handle(), *q.handle());
			if (pairOf(a, key) < 0 && contactOf(a, key[0], key[1]) < 0) found.push_back(key);
		});
		std::sort(found.begin(), found.end());
		found.erase(std::unique(found.begin(), found.end()), found.end());
		return found;
	}

	/// Looks at every block: edge pairs of those that have moved too far, new neighbours, contacts that are no more. Until some
	/// grid point has moved by a.state.search.mayGo from here, nothing of this can change.
	void look(BlockAssembly& a, bool everything)
	{
		FreeContacts&    f = a.contacts;
		std::vector<int> moved;
		a.state.search.mayGo = std::numeric_limits<Real>::infinity();
		for (int b : presentBlocks(a)) {
			const Real limit = limitOf(f, b), went = std::sqrt(farthestMove(a, b, a.state.search.detectedAt));
			if (everything || !(went <= lookAgain * limit)) {
				moved.push_back(b);
				for (int n = a.mesh.firstNode[b]; n < a.mesh.firstNode[b + 1]; ++n)
					a.state.search.detectedAt[n] = a.state.displacement[n];
				a.state.search.mayGo = std::min(a.state.search.mayGo, limit);
			} else
				a.state.search.mayGo = std::min(a.state.search.mayGo, limit - went);
		}
		a.state.search.lookedAt = a.state.displacement;
		f.odometer.sinceLook    = 0;
		++f.looks;
		if (moved.empty()) return;
		followAll(a);

		std::vector<char> hasMoved(a.blockCount(), false);
		for (int b : moved)
			hasMoved[b] = true;
		bool changed = false;
		for (FreeContact& c : a.state.contacts) {
			if (c.block[0] < 0 || !(hasMoved[c.block[0]] || hasMoved[c.block[1]])) continue;
			detect(a, c);
			const Real far = 4 * (limitOf(f, c.block[0]) + limitOf(f, c.block[1]));
			if (!c.edges.empty() || boxOf(a, c.block[0]).meets(boxOf(a, c.block[1]), far)) continue;
			a.state.lostFriction += c.friction;
			c       = {};
			changed = true;
		}
		if (changed) sortContacts(a);
		std::vector<std::array<int, 2>>    keys;
		std::vector<std::vector<EdgePair>> edges;
		for (const auto& key : newNeighbours(a, moved)) {
			FreeContact candidate;
			candidate.block = key;
			detect(a, candidate);
			if (candidate.edges.empty()) continue; // near, but no edges that could touch
			keys.push_back(key);
			edges.push_back(std::move(candidate.edges));
			changed = true;
		}
		makeContacts(a, keys);
		for (size_t i = 0; i < keys.size(); ++i) {
			FreeContact& made = a.state.contacts[contactOf(a, keys[i][0], keys[i][1])];
			made.edges        = std::move(edges[i]);
			forgetActive(made);
		}
		placeForces(a);
		if (changed) ++f.version;
	}

	/// Joints of which a point broke in the last step wait for their release.
	void collectBroken(BlockAssembly& a)
	{
		FreeContacts& f      = a.contacts;
		const auto    before = f.waiting.size();
		for (size_t batch = 0; batch < a.forces.broke.size(); ++batch) {
			if (!a.forces.broke[batch]) continue;
			a.forces.broke[batch] = false;
			const int last        = std::min(a.joints.count(), int(batch + 1) * Joints::batch);
			for (int i = int(batch) * Joints::batch; i < last; ++i)
				askWhether(a, i);
		}
		if (f.waiting.size() == before) return;
		std::sort(f.waiting.begin(), f.waiting.end());
		f.waiting.erase(std::unique(f.waiting.begin(), f.waiting.end()), f.waiting.end());
	}

	/// Joints have ceased to be whole: the blocks that they held together at their ends may meet there. Where they overlap already, by what joints yielded,
	/// they are lowered until they only touch: what was there before is no contact.
	void loosen(BlockAssembly& a, Real dt)
	{
		FreeContacts&                f = a.contacts;
		std::set<std::array<int, 2>> mayMeet;
		for (int joint : f.loosening) {
			a.state.search.loosened[joint] = true;
			for (int corner : f.corners.ofJoint[joint]) {
				std::set<int> blocks;
				for (int i = f.corners.first[corner]; i < f.corners.first[corner + 1]; ++i)
					for (int block : a.joints.segments[f.corners.joints[i]].block)
						if (!a.isRemoved(block)) blocks.insert(block);
				for (auto first = blocks.begin(); first != blocks.end(); ++first)
					for (auto second = std::next(first); second != blocks.end(); ++second)
						mayMeet.insert({ *first, *second });
			}
		}
		f.loosening.clear();
		followAll(a);
		std::vector<std::array<int, 2>>    keys;
		std::vector<std::vector<EdgePair>> edges;
		for (const auto& key : mayMeet) {
			if (const int known = contactOf(a, key[0], key[1]); known >= 0)
				detectMore(a, a.state.contacts[known], dt);
			else if (pairOf(a, key) < 0) { // pairs with joints get a contact when one of these is released
				FreeContact candidate;
				candidate.block = key;
				detect(a, candidate);
				if (candidate.edges.empty()) continue;
				keys.push_back(key);
				edges.push_back(std::move(candidate.edges));
			}
		}
		makeContacts(a, keys);
		for (size_t i = 0; i < keys.size(); ++i) {
			FreeContact& made = a.state.contacts[contactOf(a, keys[i][0], keys[i][1])];
			made.edges        = std::move(edges[i]);
			for (EdgePair& e : made.edges)
				lower(a, made, e, 0, dt);
			forgetActive(made);
		}
		placeForces(a);
		if (!keys.empty()) ++f.version;
	}

	void releaseBroken(BlockAssembly& a, Real dt, bool account)
	{
		FreeContacts&                   f    = a.contacts;
		size_t                          kept = 0;
		std::vector<int>                now;
		std::vector<std::array<int, 2>> blocks;
		std::vector<char>               isFirst; // whether these two blocks have no contact yet
		for (int joint : f.waiting)
			if (releaseOf(a, joint) == Release::now) {
				const auto& two = a.joints.segments[joint].block;
				isFirst.push_back(contactOf(a, two[0], two[1]) < 0 && (blocks.empty() || blocks.back() != two));
				now.push_back(joint);
				blocks.push_back(two);
			} else
				f.waiting[kept++] = joint;
		if (now.empty()) return;
		followAll(a);
		f.waiting.resize(kept);
		makeContacts(a, blocks);
		Real lost = 0;
		for (size_t i = 0; i < now.size(); ++i)
			lost += release(a, now[i], contactOf(a, blocks[i][0], blocks[i][1]), isFirst[i], dt);
		if (account) a.state.accounts.friction += lost;
		placeForces(a);
		++f.version;
	}

} // namespace

int pairOf(const BlockAssembly& a, const std::array<int, 2>& blocks)
{
	const auto& pairs = a.joints.pairs;
	const auto  at    = std::lower_bound(pairs.begin(), pairs.end(), blocks, [](const Pair& p, const std::array<int, 2>& key) { return p.block < key; });
	return at == pairs.end() || at->block != blocks ? -1 : int(at - pairs.begin());
}

int contactOf(const BlockAssembly& a, int block1, int block2)
{
	const FreeContacts& f   = a.contacts;
	const auto          key = ordered(block1, block2);
	if (key[0] + 1 >= int(f.firstOfBlock.size())) return -1;
	for (int i = f.firstOfBlock[key[0]]; i < f.firstOfBlock[key[0] + 1]; ++i)
		if (a.state.contacts[f.ofBlock[i]].block == key) return f.ofBlock[i];
	return -1;
}

void setGeneralContact(BlockAssembly& a, bool wanted)
{
	if (wanted == a.contacts.wanted) return;
	for (const FreeContact& c : a.state.contacts)
		if (!wanted && c.block[0] >= 0)
			throw std::runtime_error("general contact cannot be switched off any more: blocks are in contact without a bond");
	a.contacts.wanted = wanted;
	a.state.search    = {};
	rebuildContacts(a);
}

void prepareContacts(BlockAssembly& a, Real dt, bool account)
{
	FreeContacts& f     = a.contacts;
	const bool    first = !f.started; // the step may not have its length yet
	if (!f.started && !start(a))
		look(a, true);
	else {
		followContacts(a);
		const Real perAxis = a.state.search.mayGo * std::sqrt(Real(0.5)); // two axes, each by this much
		if (f.strangers || !(f.odometer.sinceLook <= perAxis))
			f.odometer.sinceLook = farthest(a.state.displacement.data()->data(), a.state.search.lookedAt.data()->data(), 2 * a.nodeCount());
		if (!(f.odometer.sinceLook <= perAxis)) look(a, false);
	}
	collectBroken(a);
	if (!f.loosening.empty()) loosen(a, dt);
	if (!f.waiting.empty()) releaseBroken(a, dt, account);
	if (f.strangers) f.odometer.fastest = largest(a.state.velocity.data()->data(), 2 * a.nodeCount());
	if (!first && dt > 0 && !(f.odometer.fastest * dt <= f.mostAStep * f.leastDepth * std::sqrt(Real(0.5)))) refuseTunnelling(a, dt);
}

} // namespace blocks
