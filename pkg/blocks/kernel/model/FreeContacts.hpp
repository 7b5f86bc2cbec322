// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/laws/EdgeContact.hpp>
#include <blocks/kernel/laws/JointLaw.hpp>

/// Contact of blocks that were never bonded, or whose joints have broken: they slide, part and meet again.
///
/// A contact of two blocks holds all pairs of their edges that can touch before a vertex of either block has moved by
/// `mayMove` x its mean edge; then they are looked for anew. What a pair of edges remembers (its slip) is carried over by the
/// names of its edges, so nothing depends on the order in which contacts were made, or on threads.
///
/// Most pairs do not touch. Such a pair rests, without being looked at, until the two blocks have gone so far that it might.
namespace blocks {

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
	unsigned                  looks    = 0;     ///< since its pairs were found
	Real                      friction = 0;     ///< dissipated so far [J]
	JointParams               joint;            ///< residual values count; kn = 0 until they are known
};

/// How far blocks that have contacts have gone. A vertex moves between two moments by no more than its block's path has grown.
struct Odometer {
	std::vector<Vec2> seenAt; ///< of grid points, displacements up to which the paths count [m]
	std::vector<Real> path;   ///< of blocks: the largest step of any of their grid points, summed over the steps [m]
};

/// When neighbours were last looked for. It decides which contacts there are, and so masses; empty without general contact.
struct ContactMemory {
	std::vector<Vec2> detectedAt; ///< displacements at which the edge pairs of the grid point's block were last looked for [m]
	std::vector<Vec2> lookedAt;   ///< displacements at the last look [m]
	Real              mayGo = 0;  ///< until a grid point is this far from lookedAt, nobody need look [m]
};

/// Who may touch whom. All of it follows from the state.
struct FreeContacts {
	bool wanted  = false; ///< whether the scene has general contact
	bool started = false; ///< whether anything below is known
	long version = 0;     ///< grows whenever contacts come, go or change their stiffness
	long looks   = 0;     ///< how often neighbours were looked for

	// ---- contacts by blocks
	std::vector<int> order;                 ///< contacts sorted by blocks
	std::vector<int> firstOfBlock, ofBlock; ///< block -> its contacts, sorted by the other block; empty without contacts
	std::vector<int> blocksInContact;       ///< blocks that have any

	// ---- shapes, from the reference positions
	std::vector<Real> sharpness, rounding;  ///< of grid points on outlines, see EdgeShape
	std::vector<int>  edgeFrom;             ///< grid point -> the boundary edge that starts there, or -1
	std::vector<Real> depthLimit, meanEdge; ///< of blocks [m]
	Real              leastDepth = 0;       ///< the least of depthLimit [m]

	// ---- how far things have moved
	std::vector<Real> sleepsUntil; ///< contact -> nothing of it touches before the paths of its two blocks add up to this; 0: to be looked at [m]
	Odometer          odometer;
	std::vector<int>  waiting; ///< broken joints that will be released, in their order

	static constexpr Real mayMove = 0.016; ///< of a mean edge, until edge pairs are looked for anew
};

struct BlockAssembly;

/// Mean length of a block's boundary edges without stress [m].
Real meanEdge(const BlockAssembly&, int block);

/// Lists the contacts by blocks; again whenever some have come or gone.
void sortContacts(BlockAssembly&);

/// The nodes and shape of a pair of edges, from its two edges.
void nameEdges(const BlockAssembly&, EdgePair&);

/// Which pairs touch is not known any more; the next updateContact looks at all of them.
void forgetActive(FreeContact&);

/// Computes again what is not saved; the next step looks for neighbours anew.
void rebuildContacts(BlockAssembly&);

} // namespace blocks
