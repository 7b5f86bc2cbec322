// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// Up to the first failure a bonded specimen is linear: its answer needs one sparse factorisation and no time steps.
///
/// u0 is the answer to dead loads and to the full forces of force-driven groups, u1 that to one second of the velocity-driven ones
/// at their full speed. The first contact point fails in tension or by Mohr-Coulomb at u0 + lambda u1; the jump goes to
/// u0 + fraction lambda u1 with velocities u1, so that loading goes on from there without a start.
namespace blocks {

struct ElasticJump {
	Real time;  ///< of loading at full speed that was leapt over [s]
	int  point; ///< the contact point that fails first
};

/// Leaps from the present state, which must be intact and whose blocks must not have turned; from there all ramps are over.
/// Works of the groups are booked as of a slow loading. Errors: joints that are not intact, free contacts, blocks that nothing
/// holds, nothing driven, joints that the dead loads break, a fraction outside (0, 1).
ElasticJump elasticJump(BlockAssembly&, Real fraction, Real time);

} // namespace blocks
