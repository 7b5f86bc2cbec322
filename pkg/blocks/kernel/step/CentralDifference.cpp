// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/Wide.hpp>
#include <blocks/kernel/step/CentralDifference.hpp>
#include <blocks/kernel/step/Largest.hpp>
#include <blocks/kernel/step/StiffnessDamping.hpp>
#include <blocks/kernel/step/ViscousBoundaries.hpp>
#include <cmath>

namespace blocks {
namespace {

	struct Sums {
		Real dampingBefore = 0, dampingAfter = 0; ///< power, of half a step each [W]
		Real kinetic      = 0;                    ///< [J]
		Real viscousPower = 0;                    ///< sum of m v^2 [J], times c a power
		Real kineticTurn  = 0;                    ///< sum over degrees of freedom of |change of kinetic energy| [J]
		Real fastest      = 0;                    ///< largest velocity, where contacts ask for it [m/s]

		Sums& operator+=(const Sums& o)
		{
			dampingBefore += o.dampingBefore, dampingAfter += o.dampingAfter, kinetic += o.kinetic, viscousPower += o.viscousPower,
				kineticTurn += o.kineticTurn;
			if (!(o.fastest <= fastest)) fastest = o.fastest; // what is no number stays
			return *this;
		}
	};

	struct Arrays {
		Real *      u, *v;
		const Real *f, *w; ///< force and mobility
	};

	/// What the step length and the damping come to.
	struct Rates {
		Real dt, alpha;
		Real keep, push; ///< of the adaptive damping: factor on the velocity, and on the acceleration [s]
	};

	constexpr int lanes = 8; ///< sums are taken in so many parts, whatever the width of the processor

	struct Terms {
		static constexpr int piece = 64; ///< so many degrees of freedom at a time: first their terms side by side, then the sums

		alignas(64) Real dampingBefore[piece], dampingAfter[piece], kinetic[piece], viscousPower[piece], kineticTurn[piece];
	};

	struct LaneSum {
		Real lane[lanes] = {};

		inline __attribute__((always_inline)) void add(const Real* terms, int count)
		{
			int i = 0;
			for (; i + lanes <= count; i += lanes)
				for (int k = 0; k < lanes; ++k)
					lane[k] += terms[i + k];
			for (int k = 0; i < count; ++i, ++k)
				lane[k] += terms[i];
		}
		Real total() const
		{
			Real sum = 0;
			for (Real part : lane)
				sum += part;
			return sum;
		}
	};

	/// Degrees of freedom [first, last); sums are taken only where somebody reads them.
	template <Damping::Kind kind, bool account>
	inline __attribute__((always_inline)) Sums advanceRange(const Arrays& a, int first, int last, const Rates& r)
	{
		constexpr bool adaptive  = kind == Damping::Kind::adaptive;
		Real* const __restrict u = a.u, * const __restrict v = a.v;
		const Real* const __restrict f = a.f, * const __restrict w = a.w;
		const Real dt = r.dt, halfStep = r.dt / 2, perStep = 1 / r.dt, alpha = r.alpha, keep = r.keep,
			   push          = r.push; // copies, which no store can change
		const auto velocityAfter = [=](Real before, Real force, Real mobility) {
			if constexpr (kind == Damping::Kind::none) return before + dt * mobility * force;
			if constexpr (kind == Damping::Kind::local) { // the sign is that of the velocity the step would have without damping
				const Real ahead  = before + halfStep * mobility * force;
				const Real damped = force - alpha * std::copysign(std::abs(force), ahead);
				return before + dt * mobility * damped;
			}
			if constexpr (adaptive) {
				const Real after = keep * before + push * mobility * force;
				return mobility > 0 ? after : before;
			}
		};
		if constexpr (!account && !adaptive) {
#pragma GCC ivdep
			for (int i = first; i < last; ++i) {
				const Real after = velocityAfter(v[i], f[i], w[i]);
				v[i]             = after;
				u[i] += dt * after;
			}
			return {};
		} else {
			LaneSum dampingBefore, dampingAfter, kinetic, viscousPower, kineticTurn;
			Terms   terms;
			for (int begin = first; begin < last; begin += Terms::piece) {
				const int count = std::min(Terms::piece, last - begin);
#pragma GCC ivdep
				for (int k = 0; k < count; ++k) {
					const Real before = v[begin + k], force = f[begin + k], mobility = w[begin + k];
					const Real after = velocityAfter(before, force, mobility);
					v[begin + k]     = after;
					u[begin + k] += dt * after;
					const Real inverse = 1 / mobility; // infinite where motion is prescribed, whose work is the group's
					const Real m       = mobility > 0 ? inverse : 0;
					if constexpr (account) {
						const Real free        = mobility > 0 ? force : 0;
						const Real drag        = free - m * (after - before) * perStep;
						terms.dampingBefore[k] = drag * before / 2;
						terms.dampingAfter[k]  = drag * after / 2;
						terms.kinetic[k]       = m * after * before / 2;
					}
					if constexpr (adaptive) {
						terms.viscousPower[k] = m * after * after;
						terms.kineticTurn[k]  = std::abs(m * (after * after - before * before) / 2);
					}
				}
				if constexpr (account)
					dampingBefore.add(terms.dampingBefore, count), dampingAfter.add(terms.dampingAfter, count),
						kinetic.add(terms.kinetic, count);
				if constexpr (adaptive) viscousPower.add(terms.viscousPower, count), kineticTurn.add(terms.kineticTurn, count);
			}
			return { dampingBefore.total(), dampingAfter.total(), kinetic.total(), viscousPower.total(), kineticTurn.total() };
		}
	}

	using Kind = Damping::Kind;
	WIDE Sums undamped(const Arrays& a, int first, int last, const Rates& r) { return advanceRange<Kind::none, false>(a, first, last, r); }
	WIDE Sums undampedBooked(const Arrays& a, int first, int last, const Rates& r) { return advanceRange<Kind::none, true>(a, first, last, r); }
	WIDE Sums local(const Arrays& a, int first, int last, const Rates& r) { return advanceRange<Kind::local, false>(a, first, last, r); }
	WIDE Sums localBooked(const Arrays& a, int first, int last, const Rates& r) { return advanceRange<Kind::local, true>(a, first, last, r); }
	WIDE Sums adaptive(const Arrays& a, int first, int last, const Rates& r) { return advanceRange<Kind::adaptive, false>(a, first, last, r); }
	WIDE Sums adaptiveBooked(const Arrays& a, int first, int last, const Rates& r) { return advanceRange<Kind::adaptive, true>(a, first, last, r); }

	using Advance = Sums (*)(const Arrays&, int, int, const Rates&);
	Advance advanceOf(Kind kind, bool account)
	{
		if (kind == Kind::none) return account ? undampedBooked : undamped;
		if (kind == Kind::local) return account ? localBooked : local;
		return account ? adaptiveBooked : adaptive;
	}

	constexpr int range = 4096; ///< degrees of freedom whose sums are taken together: the result does not know how many threads there were

	/// The first range of a thread: close to where its blocks begin, whose grid points are in the cache of its processor since the forces.
	int firstRange(const BlockAssembly& a, int part, int threads)
	{
		const int    ranges = (2 * a.nodeCount() + range - 1) / range;
		const Parts& parts  = a.forces.parts;
		if (part == 0 || part == threads) return part == 0 ? 0 : ranges;
		if (parts.threads != threads || parts.blocks != a.blockCount()) return int(long(ranges) * part / threads); // forces came from elsewhere
		return (2 * a.mesh.firstNode[parts.all[part].firstBlock] + range / 2) / range;
	}

	/// Range by range, summed in their order.
	Sums advanceAll(const BlockAssembly& a, Advance advance, const Arrays& arrays, const Rates& r, bool follow, [[maybe_unused]] int threads)
	{
		const int                             count = 2 * a.nodeCount();
		static thread_local std::vector<Sums> partial; // grows once
		partial.resize((count + range - 1) / range);
		Sums* const sums = partial.data();
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
		for (int part = 0; part < threads; ++part)
			for (int i = firstRange(a, part, threads), end = firstRange(a, part + 1, threads); i < end; ++i) {
				const int first = i * range, last = std::min(count, first + range);
				sums[i] = advance(arrays, first, last, r);
				if (follow) sums[i].fastest = largest(arrays.v + first, last - first);
			}
		Sums total;
		for (const Sums& s : partial)
			total += s;
		return total;
	}

	/// The next velocity of a group's degrees of freedom.
	void moveGroup(MotionGroup& g, BlockAssembly& a, const Damping& damping, Real dt, Real time, StepWork& account)
	{
		Real force = 0, inertia = 0; // of the blocks on the group
		for (int dof : g.dofs) {
			force += a.forces.nodal[dof / 2][dof % 2];
			inertia += a.state.inertia[dof / 2];
		}
		const Real before = g.velocity;
		Real       applied;
		if (g.drive == MotionGroup::Drive::velocity) {
			g.velocity = g.target * g.throttle * g.ramp(time + dt / 2);
			applied    = inertia * (g.velocity - before) / dt - force;
		} else {
			applied               = g.target * g.ramp(time);
			const Real unbalanced = force + applied;
			Real       damped     = unbalanced;
			if (damping.kind == Damping::Kind::local)
				damped -= damping.alpha * std::copysign(std::abs(unbalanced), before + dt / 2 * unbalanced / inertia);
			const Real half = damping.kind == Damping::Kind::adaptive ? a.state.viscosity * dt / 2 : 0;
			g.velocity      = ((1 - half) * before + damped / inertia * dt) / (1 + half);
			const Real drag = unbalanced - inertia * (g.velocity - before) / dt;
			account.dampingBefore += drag * before * dt / 2;
			account.dampingAfter += drag * g.velocity * dt / 2;
		}
		g.force           = applied;
		const Real booked = g.pendingWork + applied * before * dt / 2;
		g.work += booked;
		g.workTurnover += std::abs(booked);
		g.pendingWork = applied * g.velocity * dt / 2;
		account.kinetic += inertia * g.velocity * before / 2;
		g.travelled += g.velocity * dt;
		for (int dof : g.dofs)
			a.state.velocity[dof / 2][dof % 2] = g.velocity;
	}

	/// What damping proportional to stiffness has dissipated up to the time of the forces.
	void bookStiffnessDamping(BlockAssembly& a, Real dt)
	{
		FurtherAccounts& booked = a.state.further;
		booked.stiffness += booked.pendingStiffness - stiffnessDampingPower(a) * dt / 2;
		booked.pendingStiffness = 0;
	}

} // namespace

StepWork integrate(BlockAssembly& a, const Damping& damping, Real dt, Real time, bool account, int threads)
{
	Real& c = a.state.viscosity;
	if (damping.kind == Damping::Kind::adaptive && c == 0) c = Damping::floorFraction / dt;
	StepWork    work;
	ViscousStep viscous;
	viscous.begin(a);
	const bool strains = account && a.supports.stiffnessDamping > 0;
	if (strains) bookStiffnessDamping(a, dt);
	for (MotionGroup& g : a.state.groups)
		moveGroup(g, a, damping, dt, time, work);

	const Real   half = damping.kind == Damping::Kind::adaptive ? c * dt / 2 : 0;
	const Rates  rates { dt, damping.alpha, (1 - half) / (1 + half), dt / (1 + half) };
	const Arrays arrays {
		a.state.displacement.data()->data(), a.state.velocity.data()->data(), a.forces.nodal.data()->data(), a.supports.mobility.data()->data()
	};
	Odometer&  odometer = a.contacts.odometer;
	const bool follow   = a.contacts.started && !a.contacts.strangers;
	Sums       sums     = advanceAll(a, advanceOf(damping.kind, account), arrays, rates, follow, threads);
	if (!a.supports.dashpots.empty()) sums.fastest = std::max(sums.fastest, viscous.end(a, dt, time, work));
	if (strains) a.state.further.pendingStiffness = -stiffnessDampingPower(a) * dt / 2;
	if (follow) odometer.fastest = sums.fastest, odometer.unseen += sums.fastest * dt, odometer.sinceLook += sums.fastest * dt;
	if (damping.kind == Damping::Kind::adaptive) c = Damping::adapted(c, c * sums.viscousPower, sums.kineticTurn / dt, dt);
	work.dampingBefore += sums.dampingBefore * dt;
	work.dampingAfter += sums.dampingAfter * dt;
	work.kinetic += sums.kinetic;
	return work;
}

} // namespace blocks
