// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/Types.hpp>

/// Blocks that overlap more than the springs between them were made for. Springs stand for joints that are thin against the zones
/// behind them. And a free contact that gets too deep comes to carry nothing (EdgeContact.hpp): blocks go through each other.
namespace blocks {

struct BlockAssembly;

/// The block of the first zone that has turned inside out, or -1.
int firstInverted(const BlockAssembly&);

/// The first joint that acts, though its edges, which ran against each other, have turned by more than a right angle, or, without general contact, have slid
/// past each other; or -1. With general contact the other edges of its blocks act, too, and a joint that has not broken may be long in sliding.
int firstStrayed(const BlockAssembly&);

/// Two edges, of two blocks, that overlap.
struct Overlap {
	std::array<int, 2> block { -1, -1 };
	Real               depth  = 0; ///< [m]
	Real               height = 1; ///< of the lower of the two zones behind the edges; of rigid blocks the depth at which a contact is lost [m]

	Real share() const { return depth / height; }
	void raise(const std::array<int, 2>& blocks, Real d, Real h)
	{
		if (d * height > depth * h) block = blocks, depth = d, height = h;
	}
};

class OverlapWatch {
public:
	/// Overlap by height of the zones behind beyond which a joint is not thin any more: single ones are told from half of it,
	/// a run whose closed joints exceed it in the mean has the wrong springs.
	static constexpr Real thin = 0.1, told = thin / 2;

	/// Looks at all joints and contacts that touch, and at all zones.
	void look(const BlockAssembly&);

	Overlap            joint, contact;     ///< of bonded edges and of free ones: the greatest share
	Real               mean = 0;           ///< share of bonded edges, over the area of those that overlap
	std::array<int, 2> through { -1, -1 }; ///< the first block whose innermost point lies within the other one; -1: none
	int                entries = 0;        ///< how many pairs of that kind there are

	const Overlap& thickest() const { return joint.share() > contact.share() ? joint : contact; }

private:
	void measure(const BlockAssembly&);
	bool entered(const BlockAssembly&, int block, int other) const;

	std::vector<Real>               zoneHeight; ///< of the zone behind the boundary edge that starts at a grid point; infinite without zones [m]
	std::vector<std::array<int, 3>> innermost;  ///< block -> grid points whose mean is farthest from the outline; -1: it has no zones
};

} // namespace blocks
