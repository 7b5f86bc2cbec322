// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/Types.hpp>

/// Degrees of freedom whose motion is not free.
namespace blocks {

/// A set of degrees of freedom that move together: held, driven at a velocity, or pushed by a common force as a platen is.
struct MotionGroup {
	enum class Drive { velocity, force };

	std::string      name;
	Drive            drive = Drive::velocity;
	std::vector<int> dofs;             ///< 2 node + axis
	Real             target       = 0; ///< velocity [m/s] or total force [N] in the direction of the axis
	Real             startTime    = 0; ///< [s]
	Real             rampTime     = 0; ///< the target is reached smoothly within this time [s]
	Real             throttle     = 1; ///< factor on a velocity, for a servo
	Real             velocity     = 0; ///< present common velocity [m/s]
	Real             travelled    = 0; ///< displacement so far [m]
	Real             force        = 0; ///< that the group puts on the blocks, at the last time of forces [N]
	Real             work         = 0; ///< done on the blocks up to then [J]
	Real             workTurnover = 0; ///< sum of |work| of the single steps [J]
	Real             pendingWork  = 0; ///< of the half step since [J]

	/// 0 before startTime, 1 after the ramp, with zero slope at both ends.
	Real ramp(Real time) const
	{
		if (rampTime <= 0) return time >= startTime ? 1 : 0;
		const Real x = std::min(Real(1), std::max(Real(0), (time - startTime) / rampTime));
		return x * x * (3 - 2 * x);
	}
};

/// What groups had done on the blocks by the time they were released [J].
struct ReleasedWork {
	Real work     = 0;
	Real turnover = 0; ///< sum of |work| of the single steps
};

} // namespace blocks
