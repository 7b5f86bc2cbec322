// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/step/ContactResults.hpp>
#include <blocks/kernel/step/EdgeDetection.hpp>
#include <blocks/kernel/step/Paths.hpp>
#include <blocks/kernel/step/Release.hpp>
#include <limits>
#include <set>

namespace blocks {
namespace {

	/// A joint dilates until it has slid by its limit slip, or by this share of its length.
	constexpr Real dilatesFor = 0.25;

	/// When a joint's edges become a free contact: its law will tell (it has to break, or to move on), it has to be asked in every step, or now.
	enum class Release { whenTold, later, now };

	/// Whether a joint may stay one after it has broken. What was never bonded is contact from the start. With true masses a contact that closes keeps its
	/// energy only in steps as short as free contacts ask for (see touchStiffness).
	bool mayStay(const BlockAssembly& a, int joint)
	{
		const auto& status   = a.state.status;
		const bool  bonded   = status[2 * joint] != Joint::unbonded && status[2 * joint + 1] != Joint::unbonded;
		auto        isScaled = [&](int node) { return a.state.inertia[node] != a.mesh.mass[node]; };
		return bonded && isScaled(a.joints.node[joint][0]) && isScaled(a.joints.node[joint][2]);
	}

	std::array<Real, 2> openings(const BlockAssembly& a, int joint) { return { a.state.opening[2 * joint], a.state.opening[2 * joint + 1] }; }
	std::array<Real, 2> slips(const BlockAssembly& a, int joint) { return { a.state.slip[2 * joint], a.state.slip[2 * joint + 1] }; }

	Release releaseOf(const BlockAssembly& a, int joint)
	{
		const JointParams& p    = a.joints.of(joint);
		const int          ends = brokenEnds(a, joint);
		if (a.joints.softens(joint)) {
			if (ends == 0 || hasCap(a, joint)) return Release::whenTold;
			if (edgesPassed(a, joint)) return Release::now; // a fragment turns about an end that still holds, or has slid away from its edge
			if (ends < 2) return Release::later;
			const Softened& soft = a.state.softened;
			for (int i : { 2 * joint, 2 * joint + 1 })
				if (a.state.status[i] != Joint::unbonded && soft.k[i] < softeningEnd) return Release::later; // some bond is left
		}
		if (ends < 2) return Release::whenTold;
		for (int i : { 2 * joint, 2 * joint + 1 }) {
			if (a.state.sigma[i] > 0) return Release::later; // residual tension stays with the point law
			// a joint that goes on dilating stays, too, and one that rests on ends raised by different amounts, which a free contact would level
			if (a.state.sigma[i] < 0 && (p.tanDilation > 0 || a.state.uplift[2 * joint] != a.state.uplift[2 * joint + 1])
			    && std::abs(a.state.slipPlastic[i]) < std::min(p.dilationLimitSlip, dilatesFor * 2 * a.joints.segments[joint].area / a.thickness))
				return Release::later;
		}
		return mayStay(a, joint) && !hasMovedOn(a, joint, openings(a, joint), slips(a, joint)) ? Release::whenTold : Release::now;
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

	/// Lowers edge A of a pair until the two only touched a step ago. Any stiffness does; YADE's InteractionLoop brings that of the contact later.
	void lowerToTouch(const BlockAssembly& a, EdgePair& e, Real dt)
	{
		FreeContact any;
		any.joint.kn = 1;
		lower(a, any, e, 0, dt);
	}

	/// Looks for the edge pairs of a contact. Those that it did not have [sorted].
	std::vector<EdgePair*> detectMore(BlockAssembly& a, FreeContact& c)
	{
		std::vector<std::array<int, 2>> known;
		for (const EdgePair& e : c.edges)
			known.push_back(e.edge);
		detectEdges(a, c);
		std::vector<EdgePair*> more;
		for (EdgePair& e : c.edges)
			if (!std::binary_search(known.begin(), known.end(), e.edge)) more.push_back(&e);
		return more;
	}

	/// Turns a broken joint into a free edge pair, which takes over its slip. With the joint the other edges of the two blocks come to act, too. They may
	/// overlap by then, and a joint may have dilated more at one end than there is room for at the other: such pairs are lowered, so that no energy comes
	/// from nowhere. What the joint held and its successors do not hold is the return value [J].
	Real release(BlockAssembly& a, int joint, int contact, bool isNew, Real dt)
	{
		const Segment&    g = a.joints.segments[joint];
		const JointParams p = a.joints.of(joint);
		a.releaseJoint(joint); // from here on it carries nothing
		FreeContact& c = a.state.contacts[contact];
		if (isNew || !(c.joint.kn > 0)) c.joint = a.joints.of(joint); // not those of two materials that were never bonded
		const std::vector<EdgePair*> others = detectMore(a, c);
		EdgePair* const              own    = c.find(edgesOf(a, g)); // none where it has moved too far
		Real                         normal = 0, shear = 0;          // that the joint held [J]
		for (int i : { 2 * joint, 2 * joint + 1 }) {
			normal += g.area * a.state.sigma[i] * a.state.sigma[i] / (2 * p.kn);
			shear += g.area * a.state.tau[i] * a.state.tau[i] / (2 * p.ks);
		}
		if (own) {
			own->area   = g.area;
			own->uplift = (a.state.uplift[2 * joint] + a.state.uplift[2 * joint + 1]) / 2;
			if (const auto& start = a.joints.inSituOpening; !start.empty()) own->uplift -= (start[joint][0] + start[joint][1]) / 2;
		}
		for (int k : { 0, 1 }) {
			const int i = 2 * joint + k;
			if (own) own->slip[k] = a.state.tau[i] / c.joint.ks, own->sigma[k] = a.state.sigma[i], own->tau[k] = a.state.tau[i];
			a.state.sigma[i] = a.state.tau[i] = 0;
		}
		const Real atStrength = g.area * (p.tension * p.tension / p.kn + p.cohesion * p.cohesion / p.ks);
		const Real more       = mayGain * std::max(normal, atStrength);
		Real       left       = normal; // for its successors
		auto       pass       = [&](EdgePair& e) { left -= lower(a, c, e, std::max(Real(0), left) + more, dt); };
		if (own) pass(*own);
		for (EdgePair& e : c.edges) // where a joint has slid over the end of its edge, the next edges bear what it bore there
			if (&e != own && std::binary_search(others.begin(), others.end(), &e)) pass(e);
		return left + (own ? 0 : shear);
	}

} // namespace

void askWhether(BlockAssembly& a, int joint)
{
	if (!a.state.released[joint] && releaseOf(a, joint) != Release::whenTold) a.contacts.waiting.push_back(joint);
	if (!a.state.search.loosened[joint] && !isWhole(a, joint)) a.contacts.loosening.push_back(joint);
}

void noteBroken(BlockAssembly& a, std::vector<Joint>& known)
{
	const auto& status = a.state.status;
	const bool  first  = known.size() != status.size();
	known.resize(status.size());
	auto tells = [&](int joint) { return !a.state.released[joint] && goesFree(a, joint, openings(a, joint), slips(a, joint)); };
	for (size_t batch = 0; batch < a.forces.broke.size(); ++batch) {
		const size_t from = 2 * batch * Joints::batch, to = std::min(from + 2 * Joints::batch, status.size());
		if (first || !std::equal(status.begin() + from, status.begin() + to, known.begin() + from)) {
			a.forces.broke[batch] = true;
			std::copy(status.begin() + from, status.begin() + to, known.begin() + from);
		}
		for (size_t joint = from / 2; joint < to / 2 && !a.forces.broke[batch]; ++joint)
			a.forces.broke[batch] = tells(int(joint));
	}
}

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
	std::vector<std::array<int, 2>> without; // pairs with joints get a contact when one of these is released
	for (const auto& key : mayMeet)
		if (const int known = contactOf(a, key[0], key[1]); known >= 0)
			for (EdgePair* e : detectMore(a, a.state.contacts[known]))
				lowerToTouch(a, *e, dt);
		else if (pairOf(a, key) < 0)
			without.push_back(key);
	const std::vector<int> made = makeNeighbours(a, without);
	for (int contact : made)
		for (EdgePair& e : a.state.contacts[contact].edges)
			lowerToTouch(a, e, dt);
	placeForces(a);
	if (!made.empty()) ++f.version;
}

void releaseBroken(BlockAssembly& a, Real dt, bool account)
{
	FreeContacts&                   f    = a.contacts;
	size_t                          kept = 0;
	std::vector<int>                now;
	std::vector<std::array<int, 2>> blocks;
	std::vector<char>               isFirst; // whether these two blocks have no contact yet
	for (int joint : f.waiting) {
		const Release when = releaseOf(a, joint);
		if (when == Release::later) f.waiting[kept++] = joint;
		if (when != Release::now) continue;
		const auto& two = a.joints.segments[joint].block;
		isFirst.push_back(contactOf(a, two[0], two[1]) < 0 && (blocks.empty() || blocks.back() != two));
		now.push_back(joint);
		blocks.push_back(two);
	}
	f.waiting.resize(kept);
	if (now.empty()) return;
	followAll(a);
	makeContacts(a, blocks);
	Real lost = 0;
	for (size_t i = 0; i < now.size(); ++i)
		lost += release(a, now[i], contactOf(a, blocks[i][0], blocks[i][1]), isFirst[i], dt);
	if (account) a.state.accounts.friction += lost;
	placeForces(a);
	++f.version;
}

} // namespace blocks
