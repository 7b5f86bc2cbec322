// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/Two.hpp>
#include <blocks/kernel/step/ContactResults.hpp>
#include <blocks/kernel/step/Contacts.hpp>
#include <blocks/kernel/step/EdgeBatch.hpp>
#include <blocks/kernel/step/Waking.hpp>

namespace blocks {
namespace {

	/// Two edges have met or parted, or nobody has looked yet whether they did.
	void meetOrPart(EdgeColumns& b, int lane, bool touches)
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

	/// Contacts on their way through a step.
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
			wake(a, run, dt);
			EdgesInWork& work = a.contacts.inWork[run];
			work.apart        = false;
			for (EdgeColumns& c : work.batches) {
				if (c.count == 0) break;
				work.apart |= advance(c);
			}
			if (work.apart) ++work.steps;
		}

		/// One contact, whether it sleeps or not.
		void advanceOne(int contact)
		{
			const FreeContact& c = a.state.contacts[contact]; // columns of the whole scene are not of this edition any more
			wakeContact(a, contact);
			beginColumns(a, contact);
			EdgeColumns some;
			for (int k = 0; k < int(c.edges.size()); ++k) {
				if (c.rests[k].until == inWork) putInColumns(a, contact, -1, k, some);
				if (some.count == EdgeColumns::size) advance(some), some.count = 0;
			}
			if (some.count > 0) advance(some);
		}

	private:
		BlockAssembly& a;
		const Real     dt;
		EdgeBatch      batch;

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
