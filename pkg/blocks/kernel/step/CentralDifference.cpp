// yade-blocks, GPL-2.0-or-later
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
		Real *      x, *v;
		const Real *f, *w; ///< force and mobility
	};

	/// Degrees of freedom [first, last); sums are taken only where somebody reads them.
	template <Damping::Kind kind, bool account> Sums advanceRange(const Arrays& a, int first, int last, Real dt, const Damping& damping)
	{
		Sums        sums;
		const Real  alpha = damping.alpha, half = damping.c * dt / 2;
		const Real  keep = (1 - half) / (1 + half), push = dt / (1 + half);
		Real *const x = a.x, *const v = a.v;
		const Real *const f = a.f, *const w = a.w;
#pragma GCC ivdep
		for (int i = first; i < last; ++i) {
			const Real before = v[i];
			Real       after;
			if constexpr (kind == Damping::Kind::none) after = before + dt * w[i] * f[i];
			if constexpr (kind == Damping::Kind::local) { // the sign is that of the velocity the step would have without damping
				const Real ahead  = before + dt / 2 * w[i] * f[i];
				const Real damped = f[i] - alpha * std::copysign(std::abs(f[i]), ahead);
				after             = before + dt * w[i] * damped;
			}
			if constexpr (kind == Damping::Kind::adaptive) after = w[i] > 0 ? keep * before + push * w[i] * f[i] : before;
			v[i] = after;
			x[i] += dt * after;
			if constexpr (account || kind == Damping::Kind::adaptive) {
				if (!(w[i] > 0)) continue; // prescribed motion: its work is the group's
				const Real m = 1 / w[i];
				if constexpr (account) {
					const Real drag = f[i] - m * (after - before) / dt;
					sums.dampingBefore += drag * before / 2;
					sums.dampingAfter += drag * after / 2;
					sums.kinetic += m * after * before / 2;
				}
				if constexpr (kind == Damping::Kind::adaptive) {
					sums.viscousPower += m * after * after;
					sums.kineticTurn += std::abs(m * (after * after - before * before) / 2);
				}
			}
		}
		return sums;
	}

	/// Ranges of a fixed length, summed in their order: the result does not know how many threads there were.
	template <Damping::Kind kind, bool account> Sums advanceAll(const Arrays& a, int count, Real dt, const Damping& damping, [[maybe_unused]] int threads)
	{
		constexpr int range  = 4096;
		const int     ranges = (count + range - 1) / range;
		if constexpr (!account && kind != Damping::Kind::adaptive) {
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
			for (int r = 0; r < ranges; ++r)
				advanceRange<kind, account>(a, r * range, std::min(count, (r + 1) * range), dt, damping);
			return {};
		} else {
			std::vector<Sums> partial(ranges);
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
			for (int r = 0; r < ranges; ++r)
				partial[r] = advanceRange<kind, account>(a, r * range, std::min(count, (r + 1) * range), dt, damping);
			Sums total;
			for (const Sums& s : partial)
				total += s;
			return total;
		}
	}

	template <Damping::Kind kind> Sums advanceAll(const Arrays& a, int count, Real dt, const Damping& d, bool account, int threads)
	{
		return account ? advanceAll<kind, true>(a, count, dt, d, threads) : advanceAll<kind, false>(a, count, dt, d, threads);
	}

	/// The next velocity of a group's degrees of freedom.
	void moveGroup(MotionGroup& g, BlockAssembly& a, const Damping& damping, Real dt, Real time, StepWork& account)
	{
		Real force = 0, inertia = 0; // of the blocks on the group
		for (int dof : g.dofs) {
			force += a.force[dof / 2][dof % 2];
			inertia += a.inertia[dof / 2];
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
			const Real half = damping.kind == Damping::Kind::adaptive ? damping.c * dt / 2 : 0;
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
			a.velocity[dof / 2][dof % 2] = g.velocity;
	}

} // namespace

StepWork integrate(BlockAssembly& a, Damping& damping, Real dt, Real time, bool account, int threads)
{
	StepWork work;
	for (MotionGroup& g : a.groups)
		moveGroup(g, a, damping, dt, time, work);

	if (damping.kind == Damping::Kind::adaptive && damping.c == 0) damping.c = Damping::floorFraction / dt;
	const Arrays arrays { a.position.data()->data(), a.velocity.data()->data(), a.force.data()->data(), a.mobility.data()->data() };
	const int    count = 2 * a.nodeCount();
	Sums         sums;
	switch (damping.kind) {
	case Damping::Kind::none:
		sums = advanceAll<Damping::Kind::none>(arrays, count, dt, damping, account, threads);
		break;
	case Damping::Kind::local:
		sums = advanceAll<Damping::Kind::local>(arrays, count, dt, damping, account, threads);
		break;
	case Damping::Kind::adaptive:
		sums      = advanceAll<Damping::Kind::adaptive>(arrays, count, dt, damping, account, threads);
		damping.c = Damping::adapted(damping.c, damping.c * sums.viscousPower, sums.kineticTurn / dt, dt);
		break;
	}
	work.dampingBefore += sums.dampingBefore * dt;
	work.dampingAfter += sums.dampingAfter * dt;
	work.kinetic += sums.kinetic;
	return work;
}

} // namespace blocks
