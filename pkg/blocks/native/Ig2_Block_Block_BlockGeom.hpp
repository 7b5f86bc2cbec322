// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/BlockGeom.hpp>
#include <core/Dispatching.hpp>

namespace yade {

/// Opening and slip at every contact point of a pair.
class Ig2_Block_Block_BlockGeom : public IGeomFunctor {
public:
	virtual ~Ig2_Block_Block_BlockGeom();
	bool go(const shared_ptr<Shape>&, const shared_ptr<Shape>&, const State&, const State&, const Vector3r&, const bool&, const shared_ptr<Interaction>&)
		override;

	// clang-format off
	YADE_CLASS_BASE_DOC(Ig2_Block_Block_BlockGeom, IGeomFunctor,
		"Opening and slip at the contact points of two bonded :yref:`blocks<Block>`, in a frame that turns with their edges (UDEC's point contacts; "
		"paper, section 2.2); with :yref:`BlockContacts`, depth and overlap of the edges of blocks that are not bonded, or no more.");
	// clang-format on
	FUNCTOR2D(Block, Block);
	DEFINE_FUNCTOR_ORDER_2D(Block, Block);
};
REGISTER_SERIALIZABLE(Ig2_Block_Block_BlockGeom);

} // namespace yade
