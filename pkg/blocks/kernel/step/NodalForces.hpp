// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// From joint stresses and zone strains to the unbalanced force of every grid point.
namespace blocks {

/// Scenes without free contacts do not ask which segments are released.
enum class Which { all, unreleased, released };

/// Opening and slip of segments [first, last). No step needs those of released ones.
void updateKinematics(BlockAssembly&, int first, int last, Which = Which::all);

/// Joint stresses and states of one pair by a law: `law(params, state, opening, slip)` returns a JointStep.
template <class Law> inline void advanceJoints(BlockAssembly& a, int pair, const Law& law, Which which = Which::all)
{
	const JointParams& params = a.joints[pair];
	for (int i = 2 * a.pairs[pair].first; i < 2 * a.pairs[pair].last; ++i) {
		if (which == Which::unreleased && a.segments[i / 2].released()) continue;
		ContactPoint&   p   = a.points[i];
		const JointStep now = law(params, p.joint, p.opening, p.slip);
		p.sigma             = now.sigma;
		p.tau               = now.tau;
		p.joint             = now.state;
	}
}

/// Nodal forces of all joints, from the stresses at their contact points. No order matters: every segment writes its own.
void computeJointForces(BlockAssembly&, int threads = 1);

/// force = load + joints + zones, block by block in a fixed order: the same bits on any number of threads.
void gatherForces(BlockAssembly&, int threads = 1);

/// Stress of a zone in the axes of the plane, per present area [Pa].
ZoneStress cauchyStress(const BlockAssembly&, int block, int zone);

/// Adds a uniform acceleration to the dead loads: true masses times g [m/s2].
void addGravity(BlockAssembly&, const Vec2& g);

/// Adds a traction [Pa] on a boundary edge (an index into edgeNodes) to the dead loads, half on each of its nodes.
void addTraction(BlockAssembly&, int edge, const Vec2& traction);

} // namespace blocks
