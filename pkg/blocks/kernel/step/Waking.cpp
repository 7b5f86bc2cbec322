// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/step/CloseRests.hpp>
#include <blocks/kernel/step/Rests.hpp>
#include <blocks/kernel/step/Waking.hpp>
#include <cassert>
#include <limits>
#include <utility>

namespace blocks {
namespace {

	/// Pairs in work that do not touch are asked every so many steps whether they can rest. No result depends on it.
	constexpr int stepsUnasked = 16;

	/// Pairs whose rest may be over in so many steps are asked in every step, side by side. 4 and 64 cost the same within 3 %. No result depends on it.
	constexpr int stepsClose = 16;

	/// Pairs that rested close are to be asked like any other.
	void forgetClose(Rest* rests, int pairs)
	{
		for (int k = 0; k < pairs; ++k)
			if (rests[k].until == restsClose) rests[k].until = 0;
	}

	/// A run of contacts on which somebody may have to wake.
	class Run {
	public:
		Run(BlockAssembly& assembly, int index, Real stepLength)
			: a(assembly)
			, f(assembly.contacts)
			, work(assembly.contacts.inWork[index])
			, first(index * FreeContacts::run)
			, last(std::min(int(assembly.contacts.order.size()), first + FreeContacts::run))
			, dt(stepLength)
		{
		}

		void wake()
		{
			const bool met = !work.anew && askClose();
			if (met || work.anew || work.steps >= stepsUnasked || !(f.odometer.most() < work.until)) ask(met);
		}

	private:
		static constexpr int farAhead = 8, ahead = 4; ///< contacts

		BlockAssembly& a;
		FreeContacts&  f;
		EdgesInWork&   work;
		const int      first, last; ///< places in FreeContacts::order
		const Real     dt;

		/// Asks those whose rest is over, and now and then those in work that do not touch. Where some begin or end their rest, columns are filled
		/// anew. met: whether that has happened already.
		void ask(bool met)
		{
			if (work.steps >= stepsUnasked && !work.anew) askApart();
			if (work.anew) work.close.clear();
			std::array<int, FreeContacts::run> asked; // places
			int                                count   = 0;
			Real                               free    = std::numeric_limits<Real>::infinity(); // so far paths may go until somebody is asked again
			bool                               changed = work.anew || met;
			const Real close = stepsClose * 2 * std::sqrt(Real(2)) * f.odometer.fastest * dt; // by so much paths grow until then, at most
			for (int place = first; place < last; ++place) {
				const Sleep& s    = f.sleep[place];
				const Real   most = pathsOf(a, s.block).most;
				if (work.anew || !(most < s.until))
					asked[count++] = place;
				else
					free = std::min(free, s.until - most);
			}
			for (int i = -farAhead; i < count; ++i) { // rests lie all over the memory: what comes soon is fetched early
				if (i + farAhead < count) fetch(f.sleep[asked[i + farAhead]]);
				if (i + ahead >= 0 && i + ahead < count) fetchCorners(f.sleep[asked[i + ahead]]);
				if (i < 0) continue;
				Sleep&      s     = f.sleep[asked[i]];
				const Paths paths = pathsOf(a, s.block);
				if (work.anew) forgetClose(s.rests, s.pairs);
				if (askRests(a, a.state.contacts.keepingEdition(f.order[asked[i]]), s.rests, s.pairs, paths))
					changed = true, s.inWork = 1; // they are counted below
				s.until = inWork;
				for (int k = 0; k < s.pairs; ++k) {
					Rest& r = s.rests[k];
					if (r.until < paths.most + close) restClose(asked[i], k, r);
					s.until = std::min(s.until, r.until);
				}
				free = std::min(free, s.until - paths.most);
			}
			if (changed) free = std::min(free, thinClose(close));
			const Real now = f.odometer.most();
			work.until     = std::isfinite(now) ? now + roundingShare * free : 0; // infinite where displacements were put somewhere
			if (!changed) return;
			for (EdgeColumns& c : work.batches)
				c.count = 0;
			for (int place = first; place < last; ++place)
				if (work.anew || f.sleep[place].inWork > 0) f.sleep[place].inWork = fill(place);
			work.anew = false;
		}

		/// Asks those that rest close. Whether one of them has to be worked on.
		bool askClose()
		{
			bool met = false;
			for (RestColumns& c : work.close) {
				std::uint32_t stirs = stirring(a, c);
				for (int lane = 0; stirs != 0; ++lane, stirs >>= 1) {
					if ((stirs & 1) == 0) continue;
					Sleep& s = f.sleep[c.place[lane]];
					Rest&  r = s.rests[c.pair[lane]];
					if (isResting(restOf(a, std::as_const(a.state.contacts)[f.order[c.place[lane]]], c.pair[lane], r, pathsOf(a, s.block))))
						c.set(lane, c.place[lane], c.pair[lane], r);
					else
						met = true, r.until = inWork, s.inWork = 1; // they are counted below
				}
			}
			return met;
		}

		/// This pair of the contact at a place rests close from now on.
		void restClose(int place, int pair, Rest& r)
		{
			if (work.close.empty() || work.close.back().count == RestColumns::size) {
				assert(work.close.size() < work.close.capacity()); // see EdgesInWork::startAnew
				work.close.emplace_back();
			}
			RestColumns& c = work.close.back();
			c.set(c.count++, place, pair, r);
			r.until = restsClose;
		}

		/// Those that have been met and those that will rest for long leave the columns. How far paths may go until the latter are asked again [m].
		Real thinClose(Real close)
		{
			Real free = std::numeric_limits<Real>::infinity();
			int  kept = 0;
			for (const RestColumns& c : work.close)
				for (int lane = 0; lane < c.count; ++lane) {
					const int place = c.place[lane], pair = c.pair[lane];
					Sleep&    s = f.sleep[place];
					Rest&     r = s.rests[pair];
					if (r.until != restsClose) continue;
					const Paths paths = pathsOf(a, s.block);
					const Real  until = paths.least + leftOf(a, r);
					if (until < paths.most + close) {
						work.close[kept / RestColumns::size].set(kept % RestColumns::size, place, pair, r);
						++kept;
						continue;
					}
					r.until = until, s.until = std::min(s.until, until);
					free = std::min(free, until - paths.most);
				}
			work.close.resize((kept + RestColumns::size - 1) / RestColumns::size);
			for (int i = 0; i < int(work.close.size()); ++i)
				work.close[i].count = std::min(RestColumns::size, kept - i * RestColumns::size);
			return free;
		}

		static void fetch(const Sleep& s)
		{
			for (int k = 0; k < s.pairs; ++k)
				__builtin_prefetch(&s.rests[k]), __builtin_prefetch(&s.rests[k].from[2]);
		}
		void fetchCorners(const Sleep& s) const
		{
			for (int k = 0; k < s.pairs; ++k)
				for (int node : s.rests[k].node)
					__builtin_prefetch(&a.state.displacement[node]);
		}

		/// Those in work that do not touch are to be asked.
		void askApart()
		{
			work.steps = 0;
			for (const EdgeColumns& c : work.batches)
				for (int i = 0; i < c.count; ++i) {
					if (c.touched[i] != 0) continue;
					c.contact[i]->rests[c.pair[i] - c.contact[i]->edges.data()].until = inWorkButAsked;
					f.sleep[c.place[i]].until                                         = inWorkButAsked;
				}
		}

		/// Puts those pairs of a contact that are in work into columns. How many they are.
		int fill(int place)
		{
			const int          contact = f.order[place];
			const FreeContact& c       = a.state.contacts.keepingEdition(contact);
			int                count   = 0;
			beginColumns(a, contact);
			for (int k = 0; k < int(c.edges.size()); ++k)
				if (c.rests[k].until == inWork) putInColumns(a, contact, place, k, roomInWork()), ++count;
			return count;
		}

		/// The first columns that are not full. They are filled one after another.
		EdgeColumns& roomInWork()
		{
			const auto at
				= std::find_if(work.batches.begin(), work.batches.end(), [](const EdgeColumns& c) { return c.count < EdgeColumns::size; });
			if (at != work.batches.end()) return *at;
			assert(work.batches.size() < work.batches.capacity()); // see EdgesInWork::startAnew
			return work.batches.emplace_back();
		}
	};

} // namespace

void wake(BlockAssembly& a, int run, Real dt) { Run(a, run, dt).wake(); }

void wakeContact(BlockAssembly& a, int contact)
{
	FreeContact& c = a.state.contacts.keepingEdition(contact);
	for (size_t k = 0; k < c.edges.size(); ++k)
		if (c.rests[k].until == inWork && !c.edges[k].touching) c.rests[k].until = inWorkButAsked;
	forgetClose(c.rests.data(), int(c.rests.size()));
	askRests(a, c, c.rests.data(), int(c.rests.size()), pathsOf(a, c.block));
}

void beginColumns(BlockAssembly& a, int contact)
{
	for (int side : { 0, 1 }) {
		ForceRange& range = a.contacts.rangeOn(side, contact);
		range.last        = range.first;
	}
}

void putInColumns(BlockAssembly& a, int contact, int place, int pair, EdgeColumns& b)
{
	const int    lane = b.count++;
	FreeContact& c    = a.state.contacts.keepingEdition(contact);
	EdgePair&    e    = c.edges[pair];
	const Vec2*  X    = a.mesh.reference.data();
	if (lane == 0) b.raised = false;
	b.place[lane] = place, b.contact[lane] = &c, b.pair[lane] = &e, b.node[lane] = e.node, b.touched[lane] = -1;
	for (int side : { 0, 1 }) {
		b.side[lane][side]                         = a.contacts.rangeOn(side, contact).last++;
		a.contacts.forces[b.side[lane][side]].node = { e.node[2 * side], e.node[2 * side + 1] };
	}
	for (int k : { 0, 1, 2 }) {
		b.fromX[k][lane] = X[e.node[k + 1]].x() - X[e.node[0]].x();
		b.fromY[k][lane] = X[e.node[k + 1]].y() - X[e.node[0]].y();
	}
	for (int n = 0; n < 4; ++n)
		b.sharpness[n][lane] = e.shape.sharpness[n];
	for (int k : { 0, 1 }) {
		b.rounding[k][lane] = e.shape.rounding[k], b.farRounding[k][lane] = e.shape.farRounding[k];
		b.slip[k][lane] = e.slip[k];
	}
	b.depthLimit[lane] = e.shape.depthLimit, b.area[lane] = e.area;
	b.kn[lane] = c.joint.kn, b.ks[lane] = c.joint.ks;
	b.cohesion[lane] = c.joint.cohesionResidual, b.tanPhi[lane] = c.joint.tanPhiResidual;
	b.uplift[lane] = e.uplift;
	b.raised       = b.raised || e.uplift != 0;
}

} // namespace blocks
