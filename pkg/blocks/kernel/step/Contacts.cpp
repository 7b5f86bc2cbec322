// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/Two.hpp>
#include <blocks/kernel/step/ContactResults.hpp>
#include <blocks/kernel/step/Contacts.hpp>
#include <blocks/kernel/step/EdgeBatch.hpp>
#include <blocks/kernel/step/Rests.hpp>
#include <cassert>
#include <limits>

namespace blocks {
namespace {

	/// Pairs in work that do not touch are asked every so many steps whether they can rest. No result depends on it.
	constexpr int stepsUnasked = 16;

	/// A run of contacts on its way through a step.
	class Work {
	public:
		Work(BlockAssembly& assembly, Real stepLength)
			: a(assembly)
			, dt(stepLength)
		{
		}

		/// The contacts of a run.
		void advance(int run)
		{
			EdgesInWork& work = a.contacts.inWork[run];
			if (work.anew || work.steps >= stepsUnasked || !(a.contacts.odometer.most() < work.until)) ask(run, work);
			work.apart = false;
			for (EdgeColumns& c : work.batches) {
				if (c.count == 0) break;
				work.apart |= advance(c);
			}
			if (work.apart) ++work.steps;
		}

		/// One contact, whether it sleeps or not.
		void advanceOne(int contact)
		{
			FreeContact& c = a.state.contacts[contact]; // columns of the whole scene are not of this edition any more
			EdgeColumns  some;
			for (size_t k = 0; k < c.edges.size(); ++k)
				if (c.rests[k].until == inWork && !c.edges[k].touching) c.rests[k].until = inWorkButAsked;
			askRests(a, c, c.rests.data(), int(c.rests.size()), pathsOf(a, c.block));
			beginRanges(contact);
			for (int k = 0; k < int(c.edges.size()); ++k) {
				if (c.rests[k].until == inWork) add(contact, -1, k, some);
				if (some.count == EdgeColumns::size) advance(some), some.count = 0;
			}
			if (some.count > 0) advance(some);
		}

	private:
		static constexpr int farAhead = 8, ahead = 4; ///< contacts

		BlockAssembly& a;
		const Real     dt;
		EdgeBatch      batch;

		/// Asks those whose rest is over, and now and then those in work that do not touch. Where some begin or end their rest, columns are filled
		/// anew.
		void ask(int run, EdgesInWork& work)
		{
			FreeContacts& f     = a.contacts;
			const int     first = run * FreeContacts::run, last = std::min(int(f.order.size()), first + FreeContacts::run);
			if (work.steps >= stepsUnasked && !work.anew) askApart(work);
			std::array<int, FreeContacts::run> asked; // places
			int                                count   = 0;
			Real                               free    = std::numeric_limits<Real>::infinity(); // so far paths may go until somebody is asked again
			bool                               changed = work.anew;
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
				if (askRests(a, a.state.contacts.keepingEdition(f.order[asked[i]]), s.rests, s.pairs, paths))
					changed = true, s.inWork = 1; // they are counted below
				s.until = inWork;
				for (int k = 0; k < s.pairs; ++k)
					s.until = std::min(s.until, s.rests[k].until);
				free = std::min(free, s.until - paths.most);
			}
			const Real now = f.odometer.most();
			work.until     = std::isfinite(now) ? now + roundingShare * free : 0; // infinite where displacements were put somewhere
			if (!changed) return;
			for (EdgeColumns& c : work.batches)
				c.count = 0;
			for (int place = first; place < last; ++place)
				if (work.anew || f.sleep[place].inWork > 0) f.sleep[place].inWork = fill(place, work);
			work.anew = false;
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
		void askApart(EdgesInWork& work)
		{
			work.steps = 0;
			for (const EdgeColumns& c : work.batches)
				for (int i = 0; i < c.count; ++i) {
					if (c.touched[i] != 0) continue;
					c.contact[i]->rests[c.pair[i] - c.contact[i]->edges.data()].until = inWorkButAsked;
					a.contacts.sleep[c.place[i]].until                                = inWorkButAsked;
				}
		}

		/// Puts those pairs of a contact that are in work into columns. How many they are.
		int fill(int place, EdgesInWork& work) const
		{
			const int          contact = a.contacts.order[place];
			const FreeContact& c       = a.state.contacts.keepingEdition(contact);
			int                count   = 0;
			beginRanges(contact);
			for (int k = 0; k < int(c.edges.size()); ++k)
				if (c.rests[k].until == inWork) add(contact, place, k, roomIn(work)), ++count;
			return count;
		}

		/// The first columns that are not full. They are filled one after another.
		static EdgeColumns& roomIn(EdgesInWork& work)
		{
			const auto at
				= std::find_if(work.batches.begin(), work.batches.end(), [](const EdgeColumns& c) { return c.count < EdgeColumns::size; });
			if (at != work.batches.end()) return *at;
			assert(work.batches.size() < work.batches.capacity()); // see EdgesInWork::startAnew
			return work.batches.emplace_back();
		}

		/// Nothing of a contact is in columns yet.
		void beginRanges(int contact) const
		{
			for (int side : { 0, 1 }) {
				ForceRange& range = a.contacts.rangeOn(side, contact);
				range.last        = range.first;
			}
		}

		/// place: of the contact, in FreeContacts::order.
		void add(int contact, int place, int pair, EdgeColumns& b) const
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

		/// A step of some columns. Whether there are pairs that do not touch.
		bool advance(EdgeColumns& c)
		{
			gather(c);
			advanceEdges(c, batch, a.thickness, dt);
			return tell(c);
		}

		/// Where the corners are and how fast they move.
		void gather(const EdgeColumns& c)
		{
			const Vec2 *u = a.state.displacement.data(), *v = a.state.velocity.data();
			for (int i = 0; i < c.count; i += 2) { // an odd last one is taken twice; the columns have room for it
				const auto &node = c.node[i], &next = c.node[std::min(i + 1, c.count - 1)];
				for (int n = 0; n < 4; ++n) {
					const Two one = loadTwo(u[node[n]]), other = loadTwo(u[next[n]]), v1 = loadTwo(v[node[n]]), v2 = loadTwo(v[next[n]]);
					const Two x = firsts(one, other), y = seconds(one, other);
					store(batch.px[n] + i, n == 0 ? x : x + loadTwo(c.fromX[n - 1] + i));
					store(batch.py[n] + i, n == 0 ? y : y + loadTwo(c.fromY[n - 1] + i));
					store(batch.vx[n] + i, firsts(v1, v2)), store(batch.vy[n] + i, seconds(v1, v2));
				}
			}
			for (int i = 0; i < c.count; ++i)
				__builtin_prefetch(c.contact[i], 1), __builtin_prefetch(c.pair[i], 1);
		}

		/// What came out, to the pairs and to where their blocks look for their forces. Whether there are pairs that do not touch.
		bool tell(EdgeColumns& b)
		{
			bool apart = false;
			for (int i = 0; i < b.count; ++i) {
				const bool touches = batch.touches[i] > 0;
				if (b.touched[i] != touches) meetOrPart(b, i, touches);
				SideForce &first = a.contacts.forces[b.side[i][0]], &second = a.contacts.forces[b.side[i][1]];
				if (!touches) {
					apart     = true;
					b.area[i] = b.slip[0][i] = b.slip[1][i] = 0;
					first.force = second.force = { Vec2::Zero(), Vec2::Zero() };
					continue;
				}
				EdgePair& e = *b.pair[i];
				for (int k : { 0, 1 }) {
					e.slip[k] = b.slip[k][i], e.sigma[k] = batch.sigma[k][i], e.tau[k] = batch.tau[k][i];
					first.force[k]  = { batch.fx[k][i], batch.fy[k][i] };
					second.force[k] = { batch.fx[k + 2][i], batch.fy[k + 2][i] };
				}
				e.area = b.area[i], e.potential = batch.potential[i];
				b.contact[i]->friction += batch.friction[i];
			}
			return apart;
		}

		/// Two edges have met or parted, or nobody has looked yet whether they did.
		static void meetOrPart(EdgeColumns& b, int lane, bool touches)
		{
			FreeContact& c = *b.contact[lane];
			EdgePair&    e = *b.pair[lane];
			if (!touches && (e.touching || e.area > 0)) {
				c.friction += shearEnergy(c, e);
				e.slip = e.sigma = e.tau = { 0, 0 };
				e.area                   = 0;
			}
			e.touching      = touches;
			b.touched[lane] = touches;
			c.active.clear(); // its capacity is that of all pairs
			for (int k = 0; k < int(c.edges.size()); ++k)
				if (c.edges[k].touching) c.active.push_back(k);
		}
	};

} // namespace

void setContactJoint(BlockAssembly& a, int contact, const JointParams& joint)
{
	validate(joint);
	a.state.contacts[contact].joint = joint;
#pragma omp atomic
	++a.contacts.version;
}

void advanceContacts(BlockAssembly& a, Real dt, [[maybe_unused]] int threads)
{
	if (a.contacts.order.empty()) return;
	followEdition(a);
	const int runs = int(a.contacts.inWork.size());
#pragma omp parallel num_threads(threads) if (threads > 1)
	{
		Work work(a, dt);
#pragma omp for schedule(dynamic, 4)
		for (int run = 0; run < runs; ++run)
			work.advance(run);
	}
}

void advanceContact(BlockAssembly& a, int contact, Real dt) { Work(a, dt).advanceOne(contact); }

void gatherContactForces(const BlockAssembly& a, int block, Vec2* force)
{
	const FreeContacts& f = a.contacts;
	if (block + 1 >= int(f.firstOfBlock.size())) return; // it came after the last look for contacts
	for (int i = f.firstOfBlock[block]; i < f.firstOfBlock[block + 1]; ++i)
		for (int k = f.range[i].first; k < f.range[i].last; ++k) {
			const SideForce& on = f.forces[k];
			force[on.node[0]] += on.force[0];
			force[on.node[1]] += on.force[1];
		}
}

} // namespace blocks
