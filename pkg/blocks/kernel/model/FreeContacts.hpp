// yade-blocks, GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <blocks/kernel/model/ContactList.hpp>
#include <blocks/kernel/model/EdgeColumns.hpp>
#include <blocks/kernel/model/JointCorners.hpp>
#include <blocks/kernel/model/Odometer.hpp>
#include <vector>

/// Contact of blocks that were never bonded, or whose joints have broken: they slide, part and meet again.
///
/// A contact of two blocks holds all pairs of their edges that can touch before a vertex of either block has moved by
/// `mayMove` x its mean edge; then they are looked for anew. What a pair of edges remembers (its slip) is carried over by the
/// names of its edges, so nothing depends on the order in which contacts were made, or on threads.
///
/// Blocks that whole joints hold together at a corner are not asked there (JointCorners.hpp): while nothing breaks there is nothing to do. When such a joint
/// breaks the pairs of edges that it held are looked for.
///
/// Most pairs do not touch. Such a pair rests, without being looked at, until the two blocks have gone so far that it might. Blocks that move along
/// together go far without nearing each other: so before a pair is looked at, its corners are compared with where they were.
namespace blocks {

/// When to look at a contact.
struct Sleep {
	std::array<int, 2> block;
	Real               until  = 0; ///< no pair that rests touches before the paths of the two blocks add up to this [m]
	int                inWork = 0; ///< pairs that do not rest
	int                pairs  = 0;
	Rest*              rests  = nullptr; ///< of its pairs; known while the columns are, see followEdition()
};

/// What a pair of edges does to a block, at the two grid points of its edge.
struct SideForce {
	std::array<int, 2>  node;
	std::array<Vec2, 2> force; ///< [N]
};

/// Where the forces of a contact on a block are: room for all its pairs, of which those in work come first.
struct ForceRange {
	int first = 0, last = 0;
};

/// By which share of the depth at which their contact is lost two blocks may near each other, in a step.
namespace nearing {
	constexpr Real trueMasses   = 0.05; ///< they keep their energy within 1 %, see touchStiffness
	constexpr Real scaledMasses = 0.25; ///< the contact acts in four steps at least before it is lost
} // namespace nearing

/// Who may touch whom. All of it follows from the state.
struct FreeContacts {
	bool wanted    = false; ///< whether the scene has general contact
	bool started   = false; ///< whether anything below is known
	bool strangers = true;  ///< whether others than integrate() may move grid points or change velocities; then all are compared in every step
	long version   = 0;     ///< grows whenever contacts come, go or change their stiffness
	long looks     = 0;     ///< how often neighbours were looked for

	// ---- contacts by blocks
	std::vector<int> order;                 ///< contacts sorted by blocks
	std::vector<int> firstOfBlock, ofBlock; ///< block -> its contacts, sorted by the other block; empty without contacts
	std::vector<int> blocksInContact;       ///< blocks that have any

	// ---- forces of those pairs that are in work, block by block
	std::vector<SideForce>          forces;  ///< of all of them on either block; 0 where edges do not touch
	std::vector<ForceRange>         range;   ///< of each of `ofBlock`
	std::vector<std::array<int, 2>> rangeOf; ///< contact -> where its two are, that of its first block and that of its second

	const ForceRange& rangeOn(int side, int contact) const { return range[rangeOf[contact][side]]; }
	ForceRange&       rangeOn(int side, int contact) { return range[rangeOf[contact][side]]; }

	// ---- shapes and corners, from the reference positions
	JointCorners      corners;
	std::vector<Real> sharpness, rounding;                ///< of grid points on outlines, see EdgeShape
	std::vector<int>  edgeFrom;                           ///< grid point -> the boundary edge that starts there, or -1
	std::vector<Real> depthLimit, meanEdge;               ///< of blocks [m]
	Real              leastDepth = 0;                     ///< the least of depthLimit [m]
	Real              mostAStep  = nearing::scaledMasses; ///< set with the masses, as a share of depthLimit

	// ---- what a step works on
	std::vector<EdgesInWork> inWork;        ///< of every `run` contacts of `order`
	long                     columnsOf = 0; ///< the edition of the State's contacts that they hold, see followEdition()
	static constexpr int     run       = 64;

	// ---- how far things have moved
	std::vector<Sleep> sleep; ///< of the contacts in `order`
	Odometer           odometer;
	std::vector<int>   waiting;   ///< broken joints that will be released, in their order
	std::vector<int>   loosening; ///< joints that are not whole any more, which corners do not know yet

	static constexpr Real mayMove = 0.016; ///< of a mean edge, until edge pairs are looked for anew
};

struct BlockAssembly;

/// Lists the contacts by blocks; again whenever some have come or gone.
void sortContacts(BlockAssembly&);

/// Contacts of those pairs of blocks [sorted] that have none. Their properties are those of the two materials, if they are known.
void makeContacts(BlockAssembly&, const std::vector<std::array<int, 2>>& wanted);

inline std::array<int, 2> ordered(int block1, int block2) { return { std::min(block1, block2), std::max(block1, block2) }; }

/// The contact of two blocks, or -1.
int contactOf(const BlockAssembly&, int block1, int block2);

/// Which pairs touch is not known any more; the next step looks at all of them.
void forgetActive(FreeContact&);

/// Makes room for the forces of all contacts; again whenever pairs have come or gone. Nothing touches until the next step.
void placeForces(BlockAssembly&);

/// Has columns filled anew if somebody may have changed a contact since they were, with room for all pairs: nothing is allocated for them until the next
/// change. The step asks for it.
void followEdition(BlockAssembly&);

/// work(pair, force on the first block) for the pairs of a contact that touched in the last step.
template <class Work> void forEachTouching(const FreeContacts& f, const FreeContact& c, int contact, const Work& work)
{
	const ForceRange& range = f.rangeOn(0, contact);
	for (int k = 0, at = range.first; at < range.last; ++k) {
		if (c.rests[k].until != inWork) continue;
		if (c.edges[k].touching) work(c.edges[k], f.forces[at]);
		++at;
	}
}

/// Computes again what is not saved; the next step looks for neighbours anew.
void rebuildContacts(BlockAssembly&);

} // namespace blocks
