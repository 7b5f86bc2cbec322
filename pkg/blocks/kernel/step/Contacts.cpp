// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/laws/EdgeContactLaw.hpp>
#include <blocks/kernel/step/ContactSearch.hpp>
#include <blocks/kernel/step/Contacts.hpp>
#include <blocks/kernel/step/EdgeBatch.hpp>
#include <cassert>
#include <limits>

namespace blocks {
namespace {

	/// Paths are sums over up to 1e9 steps: what is derived from them keeps this much away from rounding.
	constexpr Real roundingShare = 1 - 1e-6;

	/// Whether edges touch follows from so many roundings of the corners' coordinates, at most.
	constexpr Real roundings = 64 * std::numeric_limits<Real>::epsilon();

	/// Pairs in work that do not touch are asked every so many steps whether they can rest. No result depends on it.
	constexpr int stepsUnasked = 16;

	/// What the paths of two blocks add up to, at least and at most: they may have gone on since they were brought up to date [m].
	struct Paths {
		Real least, most;
	};
	Paths pathsOf(const BlockAssembly& a, const std::array<int, 2>& block)
	{
		const Odometer& o    = a.contacts.odometer;
		const Real      path = o.path[block[0]] + o.path[block[1]];
		return { path - o.unseenOfTwo(), path + o.unseenOfTwo() };
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

	Real shearEnergy(const FreeContact& c, const EdgePair& e) { return c.joint.ks / 2 * e.area * (e.slip[0] * e.slip[0] + e.slip[1] * e.slip[1]); }

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
			advance(work);
		}

		/// One contact, whether it sleeps or not.
		void advanceOne(int contact)
		{
			FreeContact& c = a.state.contacts[contact]; // columns of the whole scene are not of this edition any more
			EdgeColumns  some;
			ask(c, pathsOf(a, c.block), true);
			told = -1;
			for (int k = 0; k < int(c.edges.size()); ++k) {
				if (c.restUntil[k] == inWork) add(contact, k, some);
				if (some.count == EdgeColumns::size) advance(some);
			}
			if (some.count > 0) advance(some);
			leave();
		}

	private:
		static constexpr int farAhead = 8, ahead = 4; ///< contacts

		BlockAssembly& a;
		const Real     dt;
		EdgeBatch      batch;

		template <class T> static void fetch(const T& what)
		{
			for (size_t line = 0; line < sizeof(T); line += 64)
				__builtin_prefetch(reinterpret_cast<const char*>(&what) + line);
		}

		/// Asks those whose rest is over, and now and then those in work that do not touch. Where some begin or end their rest, columns are filled
		/// anew.
		void ask(int run, EdgesInWork& work)
		{
			FreeContacts&                      f     = a.contacts;
			const int                          first = run * FreeContacts::run, last = std::min(int(f.order.size()), first + FreeContacts::run);
			const bool                         all = work.steps >= stepsUnasked;
			std::array<int, FreeContacts::run> asked; // places
			int                                count = 0;
			for (int place = first; place < last; ++place)
				if (const Sleep& s = f.sleep[place]; work.anew || !(pathsOf(a, s.block).most < s.until) || (all && s.inWork > 0))
					asked[count++] = place;
			bool changed = work.anew;
			for (int i = -farAhead; i < count; ++i) { // contacts lie all over the memory: what comes soon is fetched early
				if (i + farAhead < count) fetch(a.state.contacts.keepingEdition(f.order[asked[i + farAhead]]));
				if (i + ahead >= 0 && i + ahead < count)
					__builtin_prefetch(a.state.contacts.keepingEdition(f.order[asked[i + ahead]]).restUntil.data());
				if (i < 0) continue;
				FreeContact& c = a.state.contacts.keepingEdition(f.order[asked[i]]);
				Sleep&       s = f.sleep[asked[i]];
				if (ask(c, pathsOf(a, s.block), all)) changed = true, s.inWork = 1; // they are counted below
				s.until = c.restUntil.empty() ? inWork : *std::min_element(c.restUntil.begin(), c.restUntil.end());
			}
			Real free = std::numeric_limits<Real>::infinity();
			for (int place = first; place < last; ++place)
				free = std::min(free, f.sleep[place].until - pathsOf(a, f.sleep[place].block).most);
			const Real now = f.odometer.most();
			work.until     = std::isfinite(now) ? now + roundingShare * free : 0; // infinite where displacements were put somewhere
			if (all) work.steps = 0;
			if (!changed) return;
			for (EdgeColumns& c : work.batches)
				c.count = 0;
			for (int place = first; place < last; ++place)
				if (work.anew || f.sleep[place].inWork > 0) f.sleep[place].inWork = fill(f.order[place], work);
			work.anew = false;
		}

		/// Those pairs of a contact whose rest is over, and if wanted those in work that do not touch. Whether some begin or end their rest.
		bool ask(FreeContact& c, const Paths& path, bool all) const
		{
			bool changed = false;
			for (int k = 0; k < int(c.edges.size()); ++k) {
				Real& until = c.restUntil[k];
				if (path.most < until && !(all && until == inWork && !c.edges[k].touching)) continue;
				const bool rested = until != inWork;
				until             = restOf(c, k, path);
				changed |= rested != (until != inWork);
			}
			return changed;
		}

		/// Puts those pairs of a contact that are in work into columns. How many they are.
		int fill(int contact, EdgesInWork& work) const
		{
			const FreeContact& c     = a.state.contacts.keepingEdition(contact);
			int                count = 0;
			for (int k = 0; k < int(c.edges.size()); ++k)
				if (c.restUntil[k] == inWork) add(contact, k, roomIn(work)), ++count;
			return count;
		}

		/// Until where a pair surely does not touch, or inWork.
		Real restOf(FreeContact& c, int pair, const Paths& path) const
		{
			Rest&           r = c.rests[pair];
			const EdgePair& e = c.edges[pair];
			if (r.free > 0)
				if (const Real left = leftOf(a, r, e); left > 0) return path.least + left;
			r.free = 0;
			if (e.touching || e.area > 0) return inWork;
			const Corners x = raisedCorners(a, e);
			if (edgeDepths(x).touch() > 0 && edgeGeometry(points(x), e.shape).active()) return inWork;
			r.free = distanceOf(points(x), e);
			if (!(r.free > 0)) return inWork;
			r.from = movesOf(a, e);
			return path.least + r.free;
		}

		/// How far the corners of a pair that does not touch may move until it does; 0 if that is not known [m].
		static Real distanceOf(const FourPoints& p, const EdgePair& e)
		{
			const Real lever  = 1 + 2 * std::abs(e.uplift) / (p[1] - p[0]).norm(); // what is raised moves more where the edge turns
			const Real extent = p[0].norm() + p[1].norm() + p[2].norm() + p[3].norm();
			return roundingShare * freeDistance(p, e.shape) / lever - roundings * extent;
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

		void add(int contact, int pair, EdgeColumns& b) const
		{
			const int          lane = b.count++;
			const FreeContact& c    = a.state.contacts.keepingEdition(contact);
			const EdgePair&    e    = c.edges[pair];
			const Vec2*        X    = a.mesh.reference.data();
			if (lane == 0) b.raised = false;
			b.contact[lane] = contact, b.pair[lane] = pair, b.node[lane] = e.node;
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

		/// A step of all that is in work.
		void advance(EdgesInWork& work)
		{
			work.apart = false;
			told       = -1;
			for (EdgeColumns& c : work.batches) {
				if (c.count == 0) break;
				gather(c);
				advanceEdges(c, batch, a.thickness, dt);
				work.apart |= tell(c);
			}
			leave();
			if (work.apart) ++work.steps;
		}
		/// ... of some columns, which are empty after it.
		void advance(EdgeColumns& some)
		{
			gather(some);
			advanceEdges(some, batch, a.thickness, dt);
			tell(some);
			some.count = 0;
		}

		/// Where the corners are and how fast they move.
		void gather(const EdgeColumns& c)
		{
			const Vec2 *u = a.state.displacement.data(), *v = a.state.velocity.data();
			for (int i = 0; i < c.count; ++i) {
				const auto& node = c.node[i];
				batch.px[0][i] = u[node[0]].x(), batch.py[0][i] = u[node[0]].y();
				for (int k : { 0, 1, 2 })
					batch.px[k + 1][i] = c.fromX[k][i] + u[node[k + 1]].x(), batch.py[k + 1][i] = c.fromY[k][i] + u[node[k + 1]].y();
				for (int n = 0; n < 4; ++n)
					batch.vx[n][i] = v[node[n]].x(), batch.vy[n][i] = v[node[n]].y();
				__builtin_prefetch(&a.state.contacts.keepingEdition(c.contact[i]), 1);
			}
			if (c.raised) raise(c);
			for (int i = 0; i < c.count; ++i)
				fetch(a.state.contacts.keepingEdition(c.contact[i]).edges[c.pair[i]]);
		}

		FourPoints cornersOf(int lane) const
		{
			FourPoints p;
			for (int n = 0; n < 4; ++n)
				p[n] = { batch.px[n][lane], batch.py[n][lane] };
			return p;
		}
		void raise(const EdgeColumns& c)
		{
			for (int i = 0; i < c.count; ++i) {
				if (c.uplift[i] == 0) continue;
				const FourPoints p = raised(cornersOf(i), c.uplift[i]);
				FourPoints       v;
				for (int n = 0; n < 4; ++n)
					v[n] = { batch.vx[n][i], batch.vy[n][i] };
				v = raisedVelocity(p, c.uplift[i], v);
				for (int n : { 0, 1 })
					batch.px[n][i] = p[n].x(), batch.py[n][i] = p[n].y(), batch.vx[n][i] = v[n].x(), batch.vy[n][i] = v[n].y();
			}
		}

		// ---- telling the pairs, contact by contact
		int  told = -1, touching = 0; ///< contact that is being told, and how many of its pairs touch so far
		bool othersTouch = false;     ///< whether others of its pairs touch than did

		void leave()
		{
			if (told < 0) return;
			const ForceRange was = a.contacts.forcesOf(told);
			if (was.last != was.first + touching) a.contacts.setForcesOf(told, { was.first, was.first + touching });
			FreeContact& c = a.state.contacts.keepingEdition(told);
			if (!othersTouch && int(c.active.size()) == touching) return;
			c.active.clear(); // its capacity is that of all pairs
			for (int k = 0; k < int(c.edges.size()); ++k)
				if (c.edges[k].touching) c.active.push_back(k);
		}

		/// Whether there are pairs that do not touch.
		bool tell(EdgeColumns& b)
		{
			bool apart = false;
			for (int i = 0; i < b.count; ++i) {
				FreeContact& c = a.state.contacts.keepingEdition(b.contact[i]);
				EdgePair&    e = c.edges[b.pair[i]];
				if (b.contact[i] != told) leave(), told = b.contact[i], touching = 0, othersTouch = false;
				if (!(batch.touches[i] > 0)) {
					apart     = true;
					b.area[i] = b.slip[0][i] = b.slip[1][i] = 0;
					if (e.touching || e.area > 0) { // they have parted
						c.friction += shearEnergy(c, e);
						e.slip = e.sigma = e.tau = { 0, 0 };
						e.area                   = 0;
						e.touching               = false;
						othersTouch              = true;
					}
					continue;
				}
				if (!e.touching) e.touching = othersTouch = true;
				for (int k : { 0, 1 })
					e.slip[k] = b.slip[k][i], e.sigma[k] = batch.sigma[k][i], e.tau[k] = batch.tau[k][i];
				e.area = b.area[i], e.potential = batch.potential[i];
				c.friction += batch.friction[i];
				PairForce& on = a.contacts.forces[a.contacts.forcesOf(told).first + touching++];
				on.node       = b.node[i];
				for (int n = 0; n < 4; ++n)
					on.force[n] = { batch.fx[n][i], batch.fy[n][i] };
				if (b.uplift[i] != 0) lowerForces(cornersOf(i), b.uplift[i], on.force);
			}
			return apart;
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
			const PairForce& on    = f.forces[k];
			const int        first = on.node[0] >= a.mesh.firstNode[block] && on.node[0] < a.mesh.firstNode[block + 1] ? 0 : 2;
			force[on.node[first]] += on.force[first];
			force[on.node[first + 1]] += on.force[first + 1];
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
