// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/laws/EdgeContactLaw.hpp>
#include <blocks/kernel/step/ContactSearch.hpp>
#include <blocks/kernel/step/Contacts.hpp>
#include <blocks/kernel/step/EdgeBatch.hpp>
#include <limits>

namespace blocks {
namespace {

	/// Paths are sums over up to 1e9 steps: what is derived from them keeps this much away from rounding.
	constexpr Real roundingShare = 1 - 1e-6;

	/// Whether edges touch follows from so many roundings of the corners' coordinates, at most.
	constexpr Real roundings = 64 * std::numeric_limits<Real>::epsilon();

	/// Of so many looks at a contact one measures how far its pairs are from touching. No result depends on it.
	constexpr int measuredLook = 4;

	/// What the paths of two blocks add up to, at least and at most: they may have gone on since they were brought up to date [m].
	struct Paths {
		Real least, most;
	};
	Paths pathsOf(const BlockAssembly& a, const std::array<int, 2>& block)
	{
		const Odometer& o    = a.contacts.odometer;
		const Real      path = o.path[block[0]] + o.path[block[1]], unseen = 2 * std::sqrt(Real(2)) * o.unseen; // two blocks, two axes
		return { path - unseen, path + unseen };
	}

	/// Where corners a1, b0, b1 have gone, as seen from a0 [m].
	std::array<Vec2, 3> movesOf(const BlockAssembly& a, const EdgePair& e)
	{
		const Vec2* u = a.state.displacement.data();
		const Vec2& o = u[e.node[0]];
		return { u[e.node[1]] - o, u[e.node[2]] - o, u[e.node[3]] - o };
	}

	/// What is left of the distance in which a pair surely does not touch [m].
	Real leftOf(const BlockAssembly& a, const Rest& rest, const EdgePair& e)
	{
		const std::array<Vec2, 3> now = movesOf(a, e);
		const Real                ofB = std::max((now[1] - rest.from[1]).squaredNorm(), (now[2] - rest.from[2]).squaredNorm());
		return rest.free - (now[0] - rest.from[0]).norm() - std::sqrt(ofB);
	}

	FourPoints points(const Corners& c) { return { c[0], c[1], c[2], c[3] }; }
	Corners corners(const FourPoints& p) { return { { { p[0].x(), p[0].y() }, { p[1].x(), p[1].y() }, { p[2].x(), p[2].y() }, { p[3].x(), p[3].y() } } }; }

	/// The corners of what touches, relative to where a0 was without stress, so that they are exact far from the origin too [m].
	ALWAYS Corners raisedCorners(const BlockAssembly& a, const EdgePair& e)
	{
		const Vec2 *X = a.mesh.reference.data(), *u = a.state.displacement.data();
		const Vec2& o = X[e.node[0]];
		Corners     c;
		c[0] = { u[e.node[0]].x(), u[e.node[0]].y() };
		eachOf<3>([&](auto k) INLINE {
			const int n = e.node[k + 1];
			c[k + 1]    = { X[n].x() - o.x() + u[n].x(), X[n].y() - o.y() + u[n].y() };
		});
		return e.uplift != 0 ? corners(raised(points(c), e.uplift)) : c;
	}

	/// ... and how fast they move, for these corners [m/s].
	ALWAYS Corners raisedVelocities(const BlockAssembly& a, const EdgePair& e, const Corners& x)
	{
		const Vec2* v = a.state.velocity.data();
		Corners     c;
		eachOf<4>([&](auto k) INLINE { c[k] = { v[e.node[k]].x(), v[e.node[k]].y() }; });
		return e.uplift != 0 ? corners(raisedVelocity(points(x), e.uplift, points(c))) : c;
	}

	Real shearEnergy(const FreeContact& c, const EdgePair& e) { return c.joint.ks / 2 * e.area * (e.slip[0] * e.slip[0] + e.slip[1] * e.slip[1]); }

	/// So many contacts are in work together, whatever the number of threads.
	constexpr int atOnce = 256;

	/// A few contacts on their way through a step. Pairs that may touch are collected, worked on side by side, and told what came out.
	class Work {
	public:
		Work(BlockAssembly& assembly, Real stepLength)
			: a(assembly)
			, dt(stepLength)
		{
		}

		/// Contacts at places [first, last) of the order, at most atOnce of them.
		void run(int first, int last)
		{
			const FreeContacts& f = a.contacts;
			for (int place = first; place < last; ++place)
				if (const Sleep& s = f.sleep[place]; !(pathsOf(a, s.block).most < s.until)) awake[awakeCount++] = { f.order[place], place, 0 };
			for (int i = -farAhead; i < awakeCount; ++i) {
				if (i + farAhead < awakeCount) fetchContact(awake[i + farAhead].contact);
				if (i + ahead >= 0 && i + ahead < awakeCount) fetchPairs(awake[i + ahead].contact);
				if (i + near >= 0 && i + near < awakeCount) fetchCorners(awake[i + near].contact);
				if (i >= 0) enter(i);
			}
			leave();
		}

		/// One contact, whether it sleeps or not.
		void runOne(int contact)
		{
			awake[awakeCount++] = { contact, -1, 0 };
			enter(0);
			leave();
		}

	private:
		// contacts lie all over the memory: what comes soon is fetched early, so many contacts ahead
		static constexpr int farAhead = 12, ahead = 7, near = 3;

		struct Awake {
			int contact, place, touching; ///< place: in the order; touching: pairs, so far
		};

		BlockAssembly&            a;
		const Real                dt;
		std::array<Awake, atOnce> awake;
		int                       awakeCount = 0;
		EdgeBatch                 batch;

		template <class T> static void fetch(const T& what)
		{
			for (size_t line = 0; line < sizeof(T); line += 64)
				__builtin_prefetch(reinterpret_cast<const char*>(&what) + line);
		}
		void fetchContact(int contact) const { fetch(a.state.contacts[contact]); }
		void fetchPairs(int contact) const
		{
			const FreeContact& c = a.state.contacts[contact];
			for (int pair : c.active)
				fetch(c.edges[pair]);
		}
		void fetchCorners(int contact) const
		{
			const FreeContact& c = a.state.contacts[contact];
			for (int pair : c.active)
				for (int corner : { 0, 2 }) {
					const int n = c.edges[pair].node[corner]; // the other end of the edge is next to it more often than not
					fetch(a.state.displacement[n]), fetch(a.state.velocity[n]), fetch(a.mesh.reference[n]);
				}
		}

		/// What all of them come to.
		void leave()
		{
			flush();
			for (int i = 0; i < awakeCount; ++i) {
				FreeContact& c = a.state.contacts[awake[i].contact];
				c.active.resize(awake[i].touching);
				ForceRange& range = a.contacts.range[awake[i].contact];
				range.last        = range.first + awake[i].touching;
				if (awake[i].place >= 0) a.contacts.sleep[awake[i].place].until = c.active.empty() ? c.allRestUntil : 0;
			}
			awakeCount = 0;
		}

		/// Looks at those pairs of a contact that may touch: those that do, and those whose rest is over.
		void enter(int i)
		{
			FreeContact& c    = a.state.contacts[awake[i].contact];
			const Paths  path = pathsOf(a, c.block);
			++c.looks;
			if (path.most < c.allRestUntil) { // only those that touch may have changed
				for (size_t k = 0; k < c.active.size(); ++k)
					look(i, c, c.active[k]);
				return;
			}
			c.active.resize(c.edges.size()); // its capacity; the first ones are overwritten by those that touch
			c.allRestUntil = std::numeric_limits<Real>::infinity();
			for (int k = 0; k < int(c.edges.size()); ++k)
				if (path.most < c.rests[k].until || goesOnResting(c, k, path))
					c.allRestUntil = std::min(c.allRestUntil, c.rests[k].until);
				else
					look(i, c, k);
		}

		/// Whether the corners of a pair are still close to where they were.
		bool goesOnResting(FreeContact& c, int pair, const Paths& path) const
		{
			Rest& r = c.rests[pair];
			if (!(r.free > 0)) return false;
			const Real left = leftOf(a, r, c.edges[pair]);
			r.until         = path.least + left;
			return left > 0;
		}

		/// Puts a pair into the batch unless it plainly does not touch, and did not.
		void look(int i, FreeContact& c, int pair)
		{
			const EdgePair& e = c.edges[pair];
			const Corners   x = raisedCorners(a, e);
			if (!e.touching && !(e.area > 0) && !(edgeDepths(x).touch() > 0)) return rest(c, pair, x);

			const int lane      = batch.count++;
			batch.contact[lane] = i, batch.pair[lane] = pair;
			const Corners v = raisedVelocities(a, e, x);
			eachOf<4>([&](auto n) INLINE {
				batch.px[n][lane] = x[n].x, batch.py[n][lane] = x[n].y;
				batch.vx[n][lane] = v[n].x, batch.vy[n][lane] = v[n].y;
				batch.sharpness[n][lane] = e.shape.sharpness[n];
			});
			eachOf<2>([&](auto k) INLINE {
				batch.rounding[k][lane] = e.shape.rounding[k], batch.farRounding[k][lane] = e.shape.farRounding[k];
				batch.slip[k][lane] = e.slip[k];
			});
			batch.depthLimit[lane] = e.shape.depthLimit, batch.area[lane] = e.area;
			batch.kn[lane] = c.joint.kn, batch.ks[lane] = c.joint.ks;
			batch.cohesion[lane] = c.joint.cohesionResidual, batch.tanPhi[lane] = c.joint.tanPhiResidual;
			if (batch.count == EdgeBatch::size) flush();
		}

		/// A pair that does not touch: until where it need not be looked at.
		void rest(FreeContact& c, int pair, const Corners& x)
		{
			EdgePair& e = c.edges[pair];
			if (e.touching || e.area > 0) { // they have parted
				c.friction += shearEnergy(c, e);
				e.slip = e.sigma = e.tau = { 0, 0 };
				e.area                   = 0;
			}
			e.touching = false;
			Rest& r    = c.rests[pair];
			r.until    = pathsOf(a, c.block).least;
			if (c.looks % measuredLook == 1) { // pairs that come and go have no such distance: asking for it costs more than looking again
				const FourPoints p      = points(x);
				const Real       lever  = 1 + 2 * std::abs(e.uplift) / (p[1] - p[0]).norm(); // what is raised moves more where the edge turns
				const Real       extent = p[0].norm() + p[1].norm() + p[2].norm() + p[3].norm();
				r.free                  = roundingShare * freeDistance(p, e.shape) / lever - roundings * extent;
				if (r.free > 0) r.from = movesOf(a, e), r.until += r.free;
			}
			c.allRestUntil = std::min(c.allRestUntil, r.until);
		}

		/// Works on what is in the batch and tells the pairs.
		void flush()
		{
			if (batch.count == 0) return;
			advanceEdges(batch, a.thickness, dt);
			for (int lane = 0; lane < batch.count; ++lane) {
				Awake&       of = awake[batch.contact[lane]];
				FreeContact& c  = a.state.contacts[of.contact];
				const int    i  = batch.pair[lane];
				EdgePair&    e  = c.edges[i];
				if (!(batch.touches[lane] > 0)) {
					rest(c, i, raisedCorners(a, e));
					continue;
				}
				if (!e.touching) c.rests[i] = {};
				for (int k : { 0, 1 })
					e.slip[k] = batch.slip[k][lane], e.sigma[k] = batch.sigma[k][lane], e.tau[k] = batch.tau[k][lane];
				e.area = batch.area[lane], e.potential = batch.potential[lane], e.touching = true;
				c.friction += batch.friction[lane];
				PairForce& on = a.contacts.forces[a.contacts.range[of.contact].first + of.touching];
				on.node       = e.node;
				for (int n = 0; n < 4; ++n)
					on.force[n] = { batch.fx[n][lane], batch.fy[n][lane] };
				if (e.uplift != 0) lowerForces(points(raisedCorners(a, e)), e.uplift, on.force);
				c.active[of.touching++] = i;
			}
			batch.count = 0;
		}
	};

} // namespace

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

void setContactJoint(BlockAssembly& a, int contact, const JointParams& joint)
{
	validate(joint);
	a.state.contacts[contact].joint = joint;
#pragma omp atomic
	++a.contacts.version;
}

void advanceContacts(BlockAssembly& a, Real dt, [[maybe_unused]] int threads)
{
	const int count = int(a.contacts.order.size()), parts = (count + atOnce - 1) / atOnce;
	if (count == 0) return;
#pragma omp parallel num_threads(threads) if (threads > 1)
	{
		Work work(a, dt);
#pragma omp for schedule(dynamic)
		for (int part = 0; part < parts; ++part)
			work.run(part * atOnce, std::min(count, (part + 1) * atOnce));
	}
}

void advanceContact(BlockAssembly& a, int contact, Real dt) { Work(a, dt).runOne(contact); }

void gatherContactForces(const BlockAssembly& a, int block, Vec2* force)
{
	const FreeContacts& f = a.contacts;
	if (block + 1 >= int(f.firstOfBlock.size())) return; // it came after the last look for contacts
	for (int i = f.firstOfBlock[block]; i < f.firstOfBlock[block + 1]; ++i) {
		const int        contact = f.ofBlock[i];
		const ForceRange range   = f.range[contact];
		for (int k = range.first; k < range.last; ++k) {
			const PairForce& on    = f.forces[k];
			const int        first = on.node[0] >= a.mesh.firstNode[block] && on.node[0] < a.mesh.firstNode[block + 1] ? 0 : 2;
			force[on.node[first]] += on.force[first];
			force[on.node[first + 1]] += on.force[first + 1];
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
		const std::array<int, 2> key { a.contacts.edgeFrom[g.node[0]], a.contacts.edgeFrom[g.node[2]] };
		const auto&              edges = a.state.contacts[contact].edges;
		const auto at = std::lower_bound(edges.begin(), edges.end(), key, [](const EdgePair& e, const std::array<int, 2>& k) { return e.edge < k; });
		if (at == edges.end() || at->edge != key || !at->touching) continue;
		for (int k : { 0, 1 })
			out.sigma[2 * (i - first) + k] = at->sigma[k], out.tau[2 * (i - first) + k] = at->tau[k];
	}
	return out;
}

} // namespace blocks
