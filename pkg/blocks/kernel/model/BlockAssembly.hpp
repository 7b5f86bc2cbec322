// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/FreeContacts.hpp>
#include <blocks/kernel/model/Joints.hpp>
#include <blocks/kernel/model/Mesh.hpp>
#include <blocks/kernel/model/Parts.hpp>
#include <blocks/kernel/model/State.hpp>
#include <blocks/kernel/model/Viscous.hpp>

/// Everything hot, in flat arrays: one BlockAssembly holds all blocks of a scene, split by who changes it.
namespace blocks {

/// Loads, viscous boundaries, damping proportional to stiffness, and mobility, which follows from the groups.
struct Supports {
	std::vector<Vec2> load;     ///< dead load, gravity included; empty if there is none [N]
	std::vector<Vec2> mobility; ///< 1 / inertia, and 0 where motion is prescribed [1/kg]

	std::vector<ViscousBoundary> viscous;
	std::vector<Dashpot>         dashpots; ///< of all of them, sorted by grid point

	Real stiffnessDamping = 0; ///< beta: zones and intact joints resist the rate of their strain by beta times their stiffness [s]
};

/// What the joints of a batch dissipated in a step [J].
struct Dissipated {
	Real friction = 0;                   ///< of broken joints; dilation's work against the pressure is taken off
	Real fracture = 0;                   ///< set free by contact points that broke
	Real modeI = 0, modeII = 0, cap = 0; ///< of joints that soften, see SofteningWork
};

/// All contact points as they were at the last step.
struct JointHistory {
	std::vector<Real>  opening, slip, sigma, tau, slipPlastic;
	std::vector<Joint> status;
	Softened           softened;

	void take(const State& s)
	{
		opening = s.opening, slip = s.slip, sigma = s.sigma, tau = s.tau, status = s.status;
		if (!s.softened.empty()) slipPlastic = s.slipPlastic, softened = s.softened;
	}
};

/// Computed anew in each step.
struct Forces {
	std::vector<Vec2> nodal; ///< unbalanced force of every grid point: zones, joints, contacts, loads [N]
	std::vector<Vec2> rate;  ///< of damping proportional to stiffness, within `nodal`; empty if there is none [N]
	std::vector<char> broke; ///< batch of joints -> whether a contact point of it has broken lately

	Parts parts; ///< how blocks are shared out among threads; made anew where joints or threads are others

	// ---- only with energy accounts
	std::vector<Dissipated> dissipated;  ///< by the joints of every batch
	std::vector<Real>       jointEnergy; ///< of every batch's joints [J]
	std::vector<Real>       zoneEnergy;  ///< of every block's zones [J]
	JointHistory            before;      ///< where a law does not book what it dissipates itself
};

struct BlockAssembly {
	// ---- the whole
	Real   thickness = 1; ///< out of plane [m]
	Plane  plane     = Plane::strain;
	Strain strain    = Strain::large;

	Mesh         mesh;     ///< never changes once the blocks are in the scene
	Joints       joints;   ///< changes where somebody sets properties, or joints become free contacts
	Supports     supports; ///< changes where somebody sets loads, groups or masses
	State        state;    ///< changes in every step
	Forces       forces;   ///< computed anew in every step
	FreeContacts contacts; ///< who may touch whom without a bond; empty in scenes without general contact

	int              blockCount() const { return int(mesh.blockMaterial.size()); }
	int              nodeCount() const { return int(mesh.reference.size()); }
	int              zoneCount() const { return int(mesh.zoneNodes.size()); }
	int              pointCount() const { return 2 * joints.count(); }
	int              blockOfNode(int node) const;
	bool             isRigid(int block) const { return mesh.firstZone[block] == mesh.firstZone[block + 1]; }
	bool             isRemoved(int block) const { return !mesh.removed.empty() && mesh.removed[block]; }
	std::vector<int> presentBlocks() const;     ///< those that have not been taken out, in order
	Vec2             centroid(int block) const; ///< of the block's present mass [m]

	/// Where a grid point is now [m].
	Vec2 position(int node) const { return mesh.reference[node] + state.displacement[node]; }
	/// From one grid point to another; exact far from the origin too, where positions are not [m].
	Vec2 between(int from, int to) const { return mesh.reference[to] - mesh.reference[from] + (state.displacement[to] - state.displacement[from]); }
	/// Puts a grid point somewhere [m].
	void place(int node, const Vec2& where) { state.displacement[node] = where - mesh.reference[node]; }

	/// Checks and stores a material; its index.
	int addMaterial(const Material&);

	/// Adds a block and returns its index. `rings` are the boundary nodes, material on the left; triangles are counter-clockwise.
	/// Without triangles the block is rigid: its mass is that of the area within its rings.
	int
	addBlock(const std::vector<Vec2>& points, const std::vector<std::vector<int>>& rings, const std::vector<std::array<int, 3>>& triangles, int material);

	/// Takes the segments that detectSegments found: sorts out pairs, sides and the distances at bonding. Properties are still missing.
	void bond(std::vector<Segment>);

	/// The number of a kind of joints, known or new; the properties are checked. The first that softens makes the columns for all that soften.
	int addKind(const JointParams&, const SofteningParams& = {});

	/// Properties of joints [first, last), and whether they are whole. They are checked.
	void setJoints(int first, int last, const JointParams&, Joint status = Joint::intact, const SofteningParams& = {});
	/// Gives a name to a set of joints. A joint has one name: another that it had is gone, and so is a name that no joint has any more.
	void nameJoints(const std::string& name, const std::vector<int>& which);
	void setJoints(const JointParams& p) { setJoints(0, joints.count(), p); }

	/// Refuses properties that no joint can have, or that this one cannot have any more.
	void requireChangeable(int joint, const JointParams&, const SofteningParams&) const;

	/// Other properties for a joint; what has broken stays broken.
	void changeJoint(int joint, const JointParams&, const SofteningParams&);
	/// Other properties for a joint whose softening stays.
	void changeJoint(int joint, const JointParams& p) { changeJoint(joint, p, joints.softeningOf(joint)); }

	/// A joint's edges become a free contact: from here on the joint carries nothing.
	void releaseJoint(int joint);

	/// Joins degrees of freedom into a group that moves as one; a degree of freedom belongs to one group at most.
	int addGroup(MotionGroup);

	/// Sets the degrees of freedom of a group free; what it has done stays in the accounts.
	void releaseGroup(int group);

	/// Refuses a dashpot on a grid point that a group pushes, or that groups move along both axes.
	void requireDashpotsMove() const;

	/// Computes again what follows from the rest: zone gradients and volumes, columns, sides, mobility. After loading.
	void rebuild();

	/// Computes again what follows from the joints alone: their columns and sides.
	void rebuildJoints();

	/// inertia -> mobility, with zeros where motion is prescribed.
	void updateMobility();

	/// The first grid point whose state is not a number, or -1.
	int firstBadNode() const;

	/// Puts a state back that this assembly had before.
	void restore(const State&);

private:
	void rebuildZones(int firstBlock);
	void noteKinds(int first, int last);
};

/// In place of a kind of joint: the joint is a free contact; the joints of a batch are of several kinds.
constexpr int releasedKind = -1, mixedKinds = -2;

/// The pair of bonded blocks, first < second, or -1.
int pairOf(const BlockAssembly&, const std::array<int, 2>& blocks);

} // namespace blocks
