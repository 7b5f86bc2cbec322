// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/Types.hpp>

namespace blocks {

using Vec3 = Eigen::Matrix<Real, 3, 1>; ///< of a rigid block: along x, along y, about z

/// A block without zones. Its grid points carry forces but no mass; it moves as one, and somebody else integrates that motion
/// (in YADE NewtonIntegrator): see RigidBlocks.hpp.
struct RigidBlock {
	int  block = -1;
	Vec2 origin { 0, 0 };   ///< centroid in the reference state [m]
	Real mass          = 0; ///< true mass [kg]
	Real moment        = 0; ///< true moment of inertia about the centroid [kg m2]
	Real inertia       = 0; ///< mass that resists translation: the true or the scaled one [kg]
	Real rotaryInertia = 0; ///< moment that resists rotation [kg m2]
	Vec2 load { 0, 0 };     ///< dead load at the centroid: gravity [N]

	std::array<bool, 3> free { true, true, true }; ///< whether forces decide on the motion; else somebody prescribes it

	// ---- motion, as its grid points have followed it
	Vec2 centre { 0, 0 };      ///< present centroid [m]
	Vec2 halfTurn { 1, 0 };    ///< cosine and sine of half the angle turned
	Vec3 velocity { 0, 0, 0 }; ///< at the last half step [m/s, rad/s]

	// ---- forces at the last time of forces
	Vec3 force { 0, 0, 0 };      ///< of its neighbours and loads, about the centroid [N, N m]
	Vec3 unbalanced { 0, 0, 0 }; ///< with what acts on it from outside [N, N m]

	// ---- what is done on it from outside: forces, prescribed motion [J]
	Real work         = 0; ///< up to the last time of forces
	Real workTurnover = 0; ///< sum of |work| of the single steps
	Real pendingWork  = 0; ///< of the half step since
};

} // namespace blocks
