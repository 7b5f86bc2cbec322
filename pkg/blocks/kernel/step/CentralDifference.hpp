// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/laws/Damping.hpp>
#include <blocks/kernel/model/BlockAssembly.hpp>

/// The paper's Eqs. (4)-(9): velocities at half steps, positions at whole ones.
namespace blocks {

/// What one step turned over, for those who keep accounts [J]. Work of a force at time n counts half over the step before
/// and half over the step after; so, for a linear system, stored + kinetic + dissipated - work is constant to rounding.
struct StepWork {
	Real kinetic       = 0; ///< kinetic energy at the time of the forces, m v_before v_after / 2
	Real dampingBefore = 0; ///< dissipated by damping up to the time of the forces since the middle of the step before
	Real dampingAfter  = 0; ///< dissipated by damping from there to the middle of the step after

	StepWork& operator+=(const StepWork& o)
	{
		kinetic += o.kinetic, dampingBefore += o.dampingBefore, dampingAfter += o.dampingAfter;
		return *this;
	}
};

/// One step: moves the groups, then every free degree of freedom. The returned work is complete only if `account` says so.
/// Bits do not depend on the number of threads.
StepWork integrate(BlockAssembly&, const Damping&, Real dt, Real time, bool account = false, int threads = 1);

} // namespace blocks
