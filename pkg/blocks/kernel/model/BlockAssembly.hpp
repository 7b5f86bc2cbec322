// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/laws/JointLaw.hpp>
#include <blocks/kernel/laws/Zone.hpp>
#include <blocks/kernel/model/FreeContacts.hpp>
#include <blocks/kernel/model/Motion.hpp>
#include <blocks/kernel/model/RigidBlock.hpp>

/// Everything hot, in flat arrays: one BlockAssembly holds all blocks of a scene.
namespace blocks {

struct Material {
	Real young   = 0; ///< [Pa]
	Real poisson = 0; ///< [-]
	Real density = 0; ///< [kg/m3]
};

/// Where two boundary edges of two blocks overlap: a contact point at each end of the overlap, each with half its area.
struct Segment {
	std::array<int, 4>  node;  ///< edge a1 -> b1 of the first block, a2 -> b2 of the second
	std::array<int, 2>  block; ///< first < second
	std::array<Real, 2> s1;    ///< where the points are along the first block's edge (0 at a1, 1 at b1)
	std::array<Real, 2> s2;    ///< where they are along the second's
	Real                area;  ///< of each of the two points; 0 once the edges are a free pair [m2]

	bool released() const { return area == 0; }
};

/// The frame of a segment, turning with its hosts: n bisects the two edge normals and points out of the first block.
struct SegmentFrame {
	Real nx = 0, ny = 0;   ///< unit normal; the tangent is n turned by +90 degrees
	Real r1x = 0, r1y = 0; ///< n1 / L1, by which the first edge's nodes turn the frame [1/m]
	Real r2x = 0, r2y = 0; ///< n2 / L2 [1/m]
};

struct ContactPoint {
	Real       opening = 0, slip = 0;         ///< relative displacement since bonding, in the frame [m]
	Real       sigma = 0, tau = 0;            ///< joint stresses [Pa]
	Real       bondOpening = 0, bondSlip = 0; ///< distance of the hosts when they were bonded, in the frame [m]
	JointState joint;
};

/// Segments [first, last) between one pair of blocks: what one YADE Interaction carries.
struct Pair {
	std::array<int, 2> block;
	int                first, last;
};

struct BlockAssembly {
	// ---- the whole
	Real                  thickness = 1; ///< out of plane [m]
	Plane                 plane     = Plane::strain;
	Strain                strain    = Strain::large;
	std::vector<Material> materials;

	// ---- grid points
	std::vector<Vec2> reference; ///< positions without stress [m]
	std::vector<Vec2> position;  ///< [m]
	std::vector<Vec2> velocity;  ///< at the last half step [m/s]
	std::vector<Vec2> force;     ///< unbalanced force: zones, joints, loads [N]
	std::vector<Vec2> load;      ///< dead load, gravity included; empty if there is none [N]
	std::vector<Real> mass;      ///< true mass; 0 for grid points of rigid blocks [kg]
	std::vector<Real> inertia;   ///< mass that resists motion: the true or the scaled one [kg]
	std::vector<Vec2> mobility;  ///< 1 / inertia, and 0 where motion is prescribed [1/kg]

	// ---- zones
	std::vector<std::array<int, 3>> zoneNodes;
	std::vector<ZoneGradients>      zoneGradient; ///< [1/m]
	std::vector<Real>               zoneVolume;   ///< [m3]

	// ---- blocks, as ranges
	std::vector<int> firstNode { 0 }, firstZone { 0 }, firstEdge { 0 }; ///< one more entry than there are blocks
	std::vector<int> blockMaterial;

	// ---- blocks without zones
	std::vector<RigidBlock> rigid; ///< in the order of the blocks

	// ---- boundary edges, block by block: material on the left
	std::vector<std::array<int, 2>> edgeNodes;

	// ---- joints
	std::vector<Segment>             segments; ///< sorted by pair
	std::vector<SegmentFrame>        frames;
	std::vector<ContactPoint>        points; ///< two a segment
	std::vector<Pair>                pairs;
	std::vector<JointParams>         joints;          ///< of each pair
	std::vector<std::array<Vec2, 4>> segmentForce;    ///< on a1, b1, a2, b2 [N]
	std::vector<int>                 firstSide { 0 }; ///< block -> its range in sides
	std::vector<int>                 sides;           ///< 2 segment + side, in the order in which a block gathers them; not of released segments

	// ---- blocks that touch without being bonded
	FreeContacts contacts;
	Odometer     odometer;

	// ---- boundary conditions
	std::vector<MotionGroup> groups;
	ReleasedWork             released;

	int  blockCount() const { return int(blockMaterial.size()); }
	int  nodeCount() const { return int(position.size()); }
	int  zoneCount() const { return int(zoneNodes.size()); }
	int  blockOfNode(int node) const;
	Vec2 centroid(int block) const; ///< of the block's present mass [m]

	/// A block's present outline, with its holes [m].
	Polygon outline(int block) const;

	/// Checks and stores a material; its index.
	int addMaterial(const Material&);

	/// Adds a block and returns its index. `rings` are the boundary nodes, material on the left; triangles are counter-clockwise.
	/// Without triangles the block is rigid: its mass is that of the area within its rings.
	int
	addBlock(const std::vector<Vec2>& points, const std::vector<std::vector<int>>& rings, const std::vector<std::array<int, 3>>& triangles, int material);

	/// Takes the segments that detectSegments found: sorts out pairs, sides and the distances at bonding.
	void bond(std::vector<Segment>);

	/// Joins degrees of freedom into a group that moves as one; a degree of freedom belongs to one group at most.
	int addGroup(MotionGroup);

	/// Sets the degrees of freedom of a group free; what it has done stays in the accounts.
	void releaseGroup(int group);

	/// Computes again what follows from the rest: zone gradients and volumes, frames, sides, mobility. After loading.
	void rebuild();

	/// The sides of the blocks; again whenever segments have been released.
	void listSides();

	/// inertia -> mobility, with zeros where motion is prescribed.
	void updateMobility();

	/// The first grid point whose state is not a number, or -1.
	int firstBadNode() const;

private:
	void rebuildZones(int first);
	void rebuildJoints();
};

} // namespace blocks
