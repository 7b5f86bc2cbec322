// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/Wide.hpp>
#include <blocks/kernel/step/CentralDifference.hpp>
#include <cmath>

namespace blocks {
namespace {

	struct Sums {
		Real dampingBefore = 0, dampingAfter = 0; ///< power, of half a step each [W]
		Real kinetic      = 0;                    ///< [J]
		Real viscousPower = 0;                    ///< sum of m v^2 [J], times c a power
		Real kineticTurn  = 0;                    ///< sum over degrees of freedom of |change of kinetic energy| [J]

		Sums& operator+=(const Sums& o)
		{
			dampingBefore += o.dampingBefore, dampingAfter += o.dampingAfter, kinetic += o.kinetic, viscousPower += o.viscousPower,
				kineticTurn += o.kineticTurn;
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

	/// Degrees of freedom [first, last); sums are taken only where somebody reads them.
	template <Damping::Kind kind, bool account>
	inline __attribute__((always_inline)) Sums advanceRange(const Arrays& a, int first, int last, const Rates& r)
	{
		constexpr bool sums      = account || kind == Damping::Kind::adaptive;
		Real* const __restrict u = a.u, * const __restrict v = a.v;
		const Real* const __restrict f = a.f, * const __restrict w = a.w;
		const auto velocityAfter = [&](int i) {
			const Real before = v[i];
			if constexpr (kind == Damping::Kind::none) return before + r.dt * w[i] * f[i];
			if constexpr (kind == Damping::Kind::local) { // the sign is that of the velocity the step would have without damping
				const Real ahead  = before + r.dt / 2 * w[i] * f[i];
				const Real damped = f[i] - r.alpha * std::copysign(std::abs(f[i]), ahead);
				return before + r.dt * w[i] * damped;
			}
			if constexpr (kind == Damping::Kind::adaptive) return w[i] > 0 ? r.keep * before + r.push * w[i] * f[i] : before;
		};
		if constexpr (!sums) {
#pragma GCC ivdep
			for (int i = first; i < last; ++i) {
				const Real after = velocityAfter(i);
				v[i]             = after;
				u[i] += r.dt * after;
			}
			return {};
		} else {
			Real       dampingBefore[lanes] = {}, dampingAfter[lanes] = {}, kinetic[lanes] = {}, viscousPower[lanes] = {}, kineticTurn[lanes] = {};
			const auto advance = [&](int i, int lane) {
				const Real before = v[i], after = velocityAfter(i);
				v[i] = after;
				u[i] += r.dt * after;
				const Real m = w[i] > 0 ? 1 / w[i] : 0; // prescribed motion: its work is the group's
				if constexpr (account) {
					const Real drag = (w[i] > 0 ? f[i] : 0) - m * (after - before) / r.dt;
					dampingBefore[lane] += drag * before / 2;
					dampingAfter[lane] += drag * after / 2;
					kinetic[lane] += m * after * before / 2;
				}
				if constexpr (kind == Damping::Kind::adaptive) {
					viscousPower[lane] += m * after * after;
					kineticTurn[lane] += std::abs(m * (after * after - before * before) / 2);
				}
			};
			int i = first;
			for (; i + lanes <= last; i += lanes)
				for (int lane = 0; lane < lanes; ++lane)
					advance(i + lane, lane);
			for (; i < last; ++i)
				advance(i, i - first - (i - first) / lanes * lanes);
			Sums sum;
			for (int lane = 0; lane < lanes; ++lane)
				sum += { dampingBefore[lane], dampingAfter[lane], kinetic[lane], viscousPower[lane], kineticTurn[lane] };
			return sum;
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

	/// Ranges of a fixed length, summed in their order: the result does not know how many threads there were.
	Sums advanceAll(Advance advance, const Arrays& a, int count, const Rates& r, [[maybe_unused]] int threads)
	{
		constexpr int                         range  = 4096;
		const int                             ranges = (count + range - 1) / range;
		static thread_local std::vector<Sums> partial; // grows once
		partial.resize(ranges);
		Sums* const part = partial.data();
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
		for (int i = 0; i < ranges; ++i)
			part[i] = advance(a, i * range, std::min(count, (i + 1) * range), r);
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

} // namespace

StepWork integrate(BlockAssembly& a, const Damping& damping, Real dt, Real time, bool account, int threads)
{
	Real& c = a.state.viscosity;
	if (damping.kind == Damping::Kind::adaptive && c == 0) c = Damping::floorFraction / dt;
	StepWork work;
	for (MotionGroup& g : a.state.groups)
		moveGroup(g, a, damping, dt, time, work);

	const Real   half = damping.kind == Damping::Kind::adaptive ? c * dt / 2 : 0;
	const Rates  rates { dt, damping.alpha, (1 - half) / (1 + half), dt / (1 + half) };
	const Arrays arrays {
		a.state.displacement.data()->data(), a.state.velocity.data()->data(), a.forces.nodal.data()->data(), a.supports.mobility.data()->data()
	};
	const Sums sums = advanceAll(advanceOf(damping.kind, account), arrays, 2 * a.nodeCount(), rates, threads);
	if (damping.kind == Damping::Kind::adaptive) c = Damping::adapted(c, c * sums.viscousPower, sums.kineticTurn / dt, dt);
	work.dampingBefore += sums.dampingBefore * dt;
	work.dampingAfter += sums.dampingAfter * dt;
	work.kinetic += sums.kinetic;
	return work;
}

} // namespace blocks
