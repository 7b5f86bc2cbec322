// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// The arithmetic of joints, a batch of them side by side: plain loops over columns, without indirections. The compiler makes them
/// as wide as the processor; without fused operations the bits are the same at any width.
namespace blocks {

/// Up to Joints::batch joints in work. Arrays of two belong to the two contact points.
struct JointBatch {
	static constexpr int size = Joints::batch;
	using Lane                = Real[size];

	// ---- gathered: displacements of b1 and of b2 less that of their edge's start, and of a2 less that of a1 [m]
	alignas(64) Lane u1x, u1y, u2x, u2y, ux, uy;
	// ---- properties
	alignas(64) Lane kn, ks, tension, cohesion, tanPhi;
	// ---- kinematics
	alignas(64) Lane nx, ny, r1x, r1y, r2x, r2y; ///< the frame, see JointFrame
	alignas(64) Lane dn[2], dt[2];               ///< x2 - x1 in the frame [m]
	alignas(64) Lane opening[2], slip[2];        ///< [m]
	// ---- stresses
	alignas(64) Lane sigma[2], tau[2];        ///< [Pa]
	alignas(64) std::int64_t beyond[size] {}; ///< contact points beyond a strength
	std::int64_t pointsBeyond = 0;            ///< contact points beyond a strength, in all lanes
	int          asks[size], asking = 0;      ///< lanes that ask the law, and how many
	JointForces  force;
};

/// Displacements, gathered.
void gatherDisplacements(const BlockAssembly&, int first, int count, JointBatch&);

/// Frame, opening and slip of joints first, first + 1, ...
void moveJoints(const JointColumns&, int first, int count, JointBatch&);

/// Stresses as long as nothing breaks, for joints that have no slip and no uplift, and which this takes beyond a strength.
void elasticStresses(int count, JointBatch&);

/// Whether the elastic stresses of a contact point are beyond its strength.
inline bool isBeyond(const JointBatch& b, int joint, int k)
{
	return (b.sigma[k][joint] > b.tension[joint]) | (std::abs(b.tau[k][joint]) > b.cohesion[joint] - b.sigma[k][joint] * b.tanPhi[joint]);
}

/// What the springs of joints hold that are all elastic [J].
Real elasticEnergy(const JointColumns&, int first, int count, const JointBatch&);

/// Forces from stresses.
void loadEdges(const JointColumns&, int first, int count, JointBatch&);

} // namespace blocks
