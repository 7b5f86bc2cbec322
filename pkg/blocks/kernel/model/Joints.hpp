// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/laws/SofteningLaw.hpp>
#include <string>

namespace blocks {

/// A joint: where two boundary edges of two blocks overlap. It has a contact point at each end of the overlap, each with half its area.
/// Contact point k (0 or 1) of joint i has the number 2 i + k.
struct Segment {
	std::array<int, 4>  node;  ///< edge a1 -> b1 of the first block, a2 -> b2 of the second
	std::array<int, 2>  block; ///< first < second
	std::array<Real, 2> s1;    ///< where the points are along the first block's edge (0 at a1, 1 at b1)
	std::array<Real, 2> s2;    ///< where they are along the second's
	Real                area;  ///< of each of the two points [m2]
};

/// Joints [first, last) between one pair of blocks: what one YADE Interaction carries.
struct Pair {
	std::array<int, 2> block;
	int                first, last;
};

/// From the first block to the last, which belongs to it.
struct BlockRange {
	int first, last;
};

/// What the step reads of a joint, as columns, one entry a joint. All follows from the segments and the reference positions.
struct JointColumns {
	std::vector<Real>                e1x, e1y, e2x, e2y;    ///< edges b1 - a1 and b2 - a2 without stress [m]
	std::vector<Real>                dx, dy;                ///< a2 - a1 without stress [m]
	std::array<std::vector<Real>, 2> s1, s2;                ///< of the two points
	std::array<std::vector<Real>, 2> bondOpening, bondSlip; ///< distance of the two points' hosts when they were bonded, in the frame [m]
	std::vector<Real>                area;                  ///< 0 of released joints [m2]
	std::vector<char>                matched; ///< of each batch: whether the two edges of all joints have the same ends, and no distance when bonded
};

/// The joints of bonded blocks.
struct Joints {
	std::vector<Segment> segments; ///< sorted by pair
	std::vector<Pair>    pairs;

	// ---- what stresses in situ have opened and slid the two points by without displacement; empty if there are none [m]
	std::vector<std::array<Real, 2>> inSituOpening, inSituSlip;

	// ---- names of sets of joints; a joint has one or none
	std::vector<std::string> names;  ///< all that joints have; empty if there are none
	std::vector<int>         nameOf; ///< of each joint, an index into names or `unnamed`; empty if there are none
	static constexpr int     unnamed = -1;

	// ---- properties: few kinds, many joints
	std::vector<JointParams>     kinds { JointParams() }; ///< the first stands for joints without properties yet
	std::vector<int>             kind;                    ///< of each joint
	std::vector<int>             ofMaterials;             ///< kind of contacts between two materials, by material1 * materials + material2; 0: none
	std::vector<SofteningParams> softening;               ///< of each kind; empty as long as all joints are brittle

	/// The kind of contacts between two materials; 0 if there is none.
	int kindOfMaterials(int m1, int m2) const
	{
		const int materials = int(std::lround(std::sqrt(Real(ofMaterials.size()))));
		return m1 < materials && m2 < materials ? ofMaterials[m1 * materials + m2] : 0;
	}

	// ---- computed
	bool                            anyCap = false; ///< whether some kind has a cap
	std::vector<std::array<int, 4>> node;           ///< of each joint, as in its segment
	JointColumns                    columns;
	std::vector<int>                effective;     ///< kind of each joint, or releasedKind
	std::vector<int>                kindOfBatch;   ///< the kind of all joints in a batch, or mixedKinds
	std::vector<BlockRange>         blocksOfBatch; ///< what the joints of a batch hold; the first blocks ascend

	static constexpr int batch = 32; ///< so many joints at a time

	int                count() const { return int(segments.size()); }
	const JointParams& of(int joint) const { return kinds[kind[joint]]; }
	const JointParams& ofPoint(int point) const { return of(point / 2); }

	/// What a joint is called; empty if it has no name.
	std::string called(int joint) const { return names.empty() || nameOf[joint] == unnamed ? std::string() : names[nameOf[joint]]; }

	bool anySoftens() const { return !softening.empty(); }
	bool softens(int joint) const { return anySoftens() && softening[kind[joint]].softens(); }
	/// What a joint has of softening; nothing if it is brittle.
	SofteningParams softeningOf(int joint) const { return anySoftens() ? softening[kind[joint]] : SofteningParams(); }
};

} // namespace blocks
