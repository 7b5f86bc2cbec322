// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/analysis/EventPath.hpp>
#include <functional>

/// Loading of an assembly from event to event (EventPath.hpp), from its present state to one from which time steps can go on.
namespace blocks {

/// When to stop; whichever comes first.
struct FollowUntil {
	bool peak         = false;                                 ///< go back to the largest force once it is passed
	Real drop         = 0.5;                                   ///< the force has fallen below this share of its largest value; 0: do not ask
	Real displacement = std::numeric_limits<Real>::infinity(); ///< of the group since the start [m]
	int  cracks       = std::numeric_limits<int>::max();       ///< so many contact points have broken
};

/// A sum of displacements: (2 grid point + axis, weight).
using Gauge = std::vector<std::pair<int, Real>>;

struct FollowReport {
	std::vector<PathPoint>         path;
	std::vector<std::vector<Real>> gauges; ///< of every gauge, its change since the start at every point of the path [m]
	std::vector<PathCrack>         cracks;
	PathPoint                      reached; ///< of the state that the assembly is in now
	PathEnergy                     energy;  ///< of the path, up to its end [J]
	std::string                    ended;   ///< why, in words
	std::vector<int>               looseBlocks;
	Real                           anchorForce = 0, residual = 0, inadmissible = 0, leastFriction = 0, leastExcess = 0, handOver = 0;
	long                           steps = 0;
};

/// What the load moves: a motion group, or a rigid block along its prescribed velocity.
struct Driver {
	int group = -1, rigid = -1; ///< an index into State::groups or ::rigid
};

/// Loads along one motion group or rigid block and leaves the assembly in the state that was reached; on errors it stays as it was.
/// Displacement and force count in the direction of the group's target or the block's velocity (of one that only turns: angle and moment). `look` is called at
/// every point of the path; false ends it. Errors: a group without a target or a rigid block without a prescribed velocity; what linearise() and EventPath()
/// refuse; a state to which the large displacements of time steps do not converge.
FollowReport
follow(BlockAssembly&,
       const Driver&,
       const FollowUntil&,
       Release                                             = Release::path,
       Real                                         time   = 0,
       const std::vector<Gauge>&                    gauges = {},
       const std::function<bool(const PathPoint&)>& look   = {});

/// Puts a state of a path into an assembly: places, memory of the joints, groups, velocities with which loading at full speed goes on. A few rounds
/// bring what small displacement left out into equilibrium. Returns the unbalanced force that is left by the largest force at a contact point.
Real handOver(BlockAssembly&, const LinearModel&, EventPath&, Real time);

} // namespace blocks
