// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/laws/EdgeContact.hpp>
#include <blocks/kernel/laws/JointLaw.hpp>

/// Contact of blocks that were never bonded, or whose joints have broken: they slide, part and meet again.
///
/// A step: prepareContacts (serial; does something only where something moved far, broke or was asked for), then for every
/// contact, in any order and in parallel, updateContact and advanceContact; gatherForces adds the forces.
///
/// A contact of two blocks holds all pairs of their edges that can touch before a vertex of either block has moved by
/// `mayMove` x its mean edge; then they are looked for anew. What a pair of edges remembers (its slip) is carried over by the
/// names of its edges, so nothing depends on the order in which contacts were made, or on threads.
///
/// Most pairs do not touch. Such a pair rests, without being looked at, until the two blocks have gone so far that it might.
namespace blocks {

struct BlockAssembly;

/// Two edges of two blocks that touch or may do so soon.
struct EdgePair {
	std::array<int, 2>  edge; ///< of the first block and of the second
	std::array<int, 4>  node; ///< a0, a1, b0, b1
	bool                touching = false;
	std::array<Real, 2> slip { 0, 0 };  ///< elastic slip of the two ends: tau / ks [m]
	std::array<Real, 2> sigma { 0, 0 }; ///< normal stress of the ends, tension positive [Pa]
	std::array<Real, 2> tau { 0, 0 };   ///< shear stress; positive drags the first block along e_A [Pa]
	Real                area   = 0;     ///< of each end, in the step of the stresses [m2]
	Real                uplift = 0;     ///< by which the joint had dilated that became this pair; it stays [m]
	FourPoints          force;          ///< on the four nodes; meaningful if the pair is active [N]
	EdgeShape           shape;

	bool active() const { return touching; }
};

/// All that happens between two blocks, apart from their bonds.
struct FreeContact {
	std::array<int, 2>        block { -1, -1 }; ///< first < second; -1: an empty slot
	Real                      allRestUntil = 0; ///< the least of restsUntil of those that do not touch [m]
	std::vector<int>          active;           ///< those of `edges` that touch, as of the last updateContact
	std::vector<EdgePair>     edges;            ///< sorted by edge
	std::vector<EdgeGeometry> geometry;         ///< of each of `active`, and room for all that might be
	std::vector<Real>         restsUntil;       ///< of each of `edges`: it does not touch before the paths of the two blocks add up to this [m]
	Real                      friction = 0;     ///< dissipated so far [J]
	JointParams               joint;            ///< residual values count; kn = 0 until they are known
};

/// How far blocks have gone. A vertex moves between two moments by no more than its block's path has grown.
struct Odometer {
	std::vector<Vec2> seenAt; ///< of grid points, positions up to which the paths count [m]
	std::vector<Real> path;   ///< of blocks: the largest step of any of their grid points, summed over the steps [m]
};

struct FreeContacts {
	// ---- saved
	std::vector<FreeContact> all;              ///< an index stays valid while its contact lives
	std::vector<Vec2>        detectedAt;       ///< positions at which the edge pairs of the node's block were last looked for [m]
	Real                     lostFriction = 0; ///< dissipated by contacts that are no more [J]

	// ---- asked for, until the next prepareContacts
	std::vector<std::array<int, 2>> requests;
	std::vector<char>               releasable; ///< pair of bonded blocks -> it may have segments to release

	// ---- computed again after loading
	std::vector<int>  order;                 ///< contacts sorted by blocks
	std::vector<int>  firstOfBlock, ofBlock; ///< block -> its contacts, sorted by the other block; empty without contacts
	std::vector<Real> sharpness, rounding;   ///< of grid points on outlines, see EdgeShape
	std::vector<int>  edgeFrom;              ///< grid point -> the boundary edge that starts there, or -1
	std::vector<Real> depthLimit, meanEdge;  ///< of blocks [m]
	std::vector<Real> nearUntil;             ///< of blocks: no vertex is mayMove from detectedAt before the path is this long [m]

	bool wanted  = false; ///< whether anybody looks for free contacts (BlockContacts)
	long version = 0;     ///< grows whenever nodalStiffness may have changed

	static constexpr Real mayMove = 0.016; ///< of a mean edge, until edge pairs are looked for again
};

/// Distance by which blocks' bounding boxes must be enlarged so that a contact is asked for in time [m].
Real contactMargin(const BlockAssembly&, int block);

/// The contact of two blocks, or -1. `hint` is an index that was right some time ago.
int contactOf(const BlockAssembly&, int block1, int block2, int hint = -1);

/// Asks for a contact of two blocks; prepareContacts makes it, if they are near. From any thread.
void requestContact(BlockAssembly&, int block1, int block2);

/// After a law has worked on a bonded pair: takes note if it has segments both of whose points are broken.
void watchForRelease(BlockAssembly&, int pair);

/// Makes room for watchForRelease; before the first step, and after bond().
void enableRelease(BlockAssembly&);

/// Adds the blocks' motion since the last call to their paths.
void followMotion(BlockAssembly&);

/// Follows the motion, makes the contacts that were asked for, turns broken segments into free edge pairs, looks for edge pairs anew where blocks
/// have moved, forgets contacts of blocks that are far apart. Serial, once a step.
void prepareContacts(BlockAssembly&);

/// What rules the contact: validated joint parameters; only kn, ks and the residual values count.
void setContactJoint(BlockAssembly&, int contact, const JointParams&);

/// Geometry of all edge pairs of a contact.
void updateContact(BlockAssembly&, int contact);

/// Stresses and nodal forces of all edge pairs; dt times the nodes' velocities is the last step's motion.
void advanceContact(BlockAssembly&, int contact, Real dt);

/// Both of these for all contacts.
void advanceContacts(BlockAssembly&, Real dt, int threads = 1);

/// Adds the contact forces on one block's grid points, in a fixed order.
void gatherContactForces(const BlockAssembly&, int block, Vec2* force);

/// The share of contacts, of those that touch and those that may, in the bound of nodalStiffness [N/m].
std::vector<Real> contactStiffness(const BlockAssembly&);

Real contactEnergy(const BlockAssembly&);   ///< elastic energy of all contacts [J]
Real contactFriction(const BlockAssembly&); ///< dissipated by friction in all contacts so far [J]

/// An end of an active edge pair as Python sees it: where, which way, how deep, how much.
struct ContactEnd {
	Vec2 position;   ///< midway between the edges [m]
	Vec2 normal;     ///< out of the first block
	Real depth;      ///< [m]
	Real sigma, tau; ///< [Pa]
	Real area;       ///< [m2]
};
ContactEnd contactEnd(const BlockAssembly&, const FreeContact&, int active, int k);

/// Computes again what is not saved.
void rebuildContacts(BlockAssembly&);

} // namespace blocks
