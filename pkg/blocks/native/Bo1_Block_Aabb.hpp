// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/Block.hpp>
#include <core/Dispatching.hpp>

namespace yade {

/// Bounding boxes of blocks, for colliders that see to other bodies.
class Bo1_Block_Aabb : public BoundFunctor {
public:
	virtual ~Bo1_Block_Aabb();
	void go(const shared_ptr<Shape>&, shared_ptr<Bound>&, const Se3r&, const Body*) override;

	// clang-format off
	YADE_CLASS_BASE_DOC(Bo1_Block_Aabb, BoundFunctor,
		"Bounding box of a :yref:`Block` around its grid points as they are (blocks turn and deform).");
	// clang-format on
	FUNCTOR1D(Block);
};
REGISTER_SERIALIZABLE(Bo1_Block_Aabb);

} // namespace yade
