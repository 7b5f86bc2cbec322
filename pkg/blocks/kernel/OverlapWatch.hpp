// yade-blocks, GPL-2.0-or-later
#pragma once
#include "Types.hpp"

/// Blocks that overlap more than the springs between them were made for. Springs stand for a joint that is thin against the
/// zones behind it, and a free contact carries less the deeper it gets once it has passed a share of its depth limit (EdgeContact.hpp):
/// from there on blocks go through each other.
namespace blocks {

struct BlockAssembly;

/// Two edges, of two blocks, that overlap.
struct Overlap {
	std::array<int, 2> block { -1, -1 }; ///< -1: none
	Real               depth = 0;        ///< [m]
	Real               bound = 0;        ///< what the depth is compared with [m]

	Real share() const { return block[0] < 0 ? 0 : depth / bound; }
};

class OverlapWatch {
public:
	/// Overlap by height of the lower of the two zones behind, from which a joint is not thin any more.
	static constexpr Real thin = 0.1;
	/// Depth by depth limit, area by outline of the smaller block, of the greatest normal force between parallel edges: the maximum of
	/// d/dD (D^2 h(6 D^2)). A bonded joint knows no limit, but has to become a free contact when it breaks: the same is asked of it.
	static constexpr Real lostFrom = 0.41;

	/// Looks at all joints and contacts that touch.
	void look(const BlockAssembly&);

	Overlap thickest; ///< deeper end by zone height: the greatest
	Overlap deepest;  ///< root mean square of both ends by the depth `lostFrom` x limit: the greatest
	int     inverted = -1; ///< block of the first zone that has turned inside out, or -1

private:
	void measure(const BlockAssembly&);
	void compare(const std::array<int, 2>& block, int edge1, int edge2, Real end0, Real end1);

	std::vector<Real> zoneHeight; ///< of the zone behind the boundary edge that starts at a grid point; infinite without zones [m]
	std::vector<Real> greatest;   ///< block -> lostFrom x depth limit [m]
};

} // namespace blocks
