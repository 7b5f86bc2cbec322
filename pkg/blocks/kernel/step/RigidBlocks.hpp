// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/step/CentralDifference.hpp>

/// Blocks without zones: what their grid points feel, summed up; their mass in a stable step; their motion, handed on to the grid points.
///
/// **Time step.** The row sums k_n of nodalStiffness bound the whole stiffness as a quadratic form: u.K u <= sum k_n |u_n|^2
/// (block Gershgorin: |u_i| |K_ij| |u_j| <= |K_ij| (|u_i|^2 + |u_j|^2)/2). The grid points of a rigid block move by
/// u_n = T + theta z x r_n, r_n from its centroid, so its share of the bound, free of the coupling with its neighbours, is
///   k |T|^2 + 2 theta T.(z x s) + J theta^2,   k = sum k_n,   s = sum k_n r_n,   J = sum k_n |r_n|^2.
/// Its fastest motion against a mass m and a moment I has  omega^2 = (k/m + J/I)/2 + sqrt((k/m - J/I)^2/4 + |s|^2/(m I)).
/// Scaled masses take the row sums of [k, |s|/l; |s|/l, J/l^2] with the length l = sqrt(J/k):
///   m = c (k + |s|/l),   I = c (J + |s| l),   c = dt^2 / (4 safety^2),
/// so that the share stays below (m |T|^2 + I theta^2)/c. Since |s| <= sqrt(k J), both are at most twice what they would be without |s|.
namespace blocks {

/// What a rigid block and its neighbours make of each other, as bounds: see above.
struct RigidStiffness {
	Real translation; ///< k [N/m]
	Real coupling;    ///< |s| [N]
	Real rotation;    ///< J [N m]
};
RigidStiffness rigidStiffness(const BlockAssembly&, const std::vector<Real>& nodalStiffness, const RigidBlock&);

enum class Masses { actual, resisting }; ///< the true ones, or those that resist motion: scaled ones, if they are scaled

/// 2/omega of the fastest rigid block as far as it may move freely; infinite if there is none [s].
Real rigidTimeStep(const BlockAssembly&, const std::vector<Real>& nodalStiffness, Masses);

/// Masses and moments of the rigid blocks for quasi-static runs, as scaleInertia does it for grid points. A block that touches nothing
/// has no limit and keeps its true mass.
void scaleRigidInertia(BlockAssembly&, const std::vector<Real>& nodalStiffness, Real dt, Real safety);

/// True masses of rigid blocks.
void restoreRigidInertia(BlockAssembly&);

/// After one of the two, for a block of that velocity and the old masses (along x, along y, about z): a block that has met others, and so got
/// a scaled mass thousands of times its own, keeps its momentum and not its speed, or it would strike with energy from nowhere. Along
/// free directions where the mass falls, the speed stays. What this takes from the kinetic energy is booked as work from outside.
void changeInertia(RigidBlock&, const Vec3& old, Vec3& velocity);

/// After gatherForces: force and moment of every rigid block, loads included.
void gatherRigidForces(BlockAssembly&);

/// What has become of a rigid block in a step.
struct RigidMotion {
	Vec2 centre;   ///< at the end of the step [m]
	Vec2 halfTurn; ///< cosine and sine of half the angle turned since the reference state
	Vec3 velocity; ///< in the middle of the step [m/s, rad/s]
	Vec3 force;    ///< all forces that moved it, at the start of the step [N, N m]
};

/// Before integrate(): gives the grid points the velocity that takes them to their new places in this step, and books what it took.
/// What acts along free directions beyond neighbours and loads is work from outside; what acts there and does not accelerate the block
/// is damping. Along prescribed directions, all that it takes is work from outside.
StepWork followRigidMotion(BlockAssembly&, RigidBlock&, const RigidMotion&, Real dt);

} // namespace blocks
