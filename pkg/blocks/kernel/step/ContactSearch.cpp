// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/model/Outline.hpp>
#include <blocks/kernel/step/ContactSearch.hpp>
#include <blocks/kernel/step/EdgeDetection.hpp>
#include <blocks/kernel/step/Largest.hpp>
#include <blocks/kernel/step/Paths.hpp>
#include <blocks/kernel/step/Release.hpp>
#include <blocks/kernel/step/Tunnelling.hpp>
#include <limits>

namespace blocks {
namespace {

	/// A block that has gone this share of its limit is looked at, when anybody is.
	constexpr Real lookAgain = 0.5;

	/// How far a block's grid points may move until its neighbours are looked for anew [m].
	Real limitOf(const FreeContacts& f, int block) { return FreeContacts::mayMove * f.meanEdge[block]; }

	/// Largest square of a distance that a grid point of a block has moved since `from` [m2].
	Real farthestMove(const BlockAssembly& a, int block, const std::vector<Vec2>& from)
	{
		Real square = 0;
		for (int n = a.mesh.firstNode[block]; n < a.mesh.firstNode[block + 1]; ++n)
			square = std::max(square, (a.state.displacement[n] - from[n]).squaredNorm());
		return square;
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
		const std::vector<int> every = a.presentBlocks();
		const auto             boxes = [&](const std::vector<int>& blocks) {
                        std::vector<Box> list;
                        list.reserve(blocks.size());
                        for (int block : blocks)
                                list.push_back(grown(boxOf(a, block), 2 * limitOf(a.contacts, block)));
                        return list;
		};
		std::vector<std::array<int, 2>> found;
		forEachMeeting(boxes(moved), boxes(every), [&](int i, int j) {
			if (moved[i] == every[j]) return;
			const auto key = ordered(moved[i], every[j]);
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
		for (int b : a.presentBlocks()) {
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
			detectEdges(a, c);
			const Real far = 4 * (limitOf(f, c.block[0]) + limitOf(f, c.block[1]));
			if (!c.edges.empty() || meet(boxOf(a, c.block[0]), boxOf(a, c.block[1]), far)) continue;
			a.state.lostFriction += c.friction;
			c       = {};
			changed = true;
		}
		if (changed) sortContacts(a);
		changed |= !makeNeighbours(a, newNeighbours(a, moved)).empty();
		placeForces(a);
		if (changed) ++f.version;
	}

} // namespace

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
