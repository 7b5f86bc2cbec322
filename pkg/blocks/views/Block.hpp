// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/BlockModel.hpp>
#include <core/Dispatching.hpp>
#include <core/Shape.hpp>

namespace yade {

/// A deformable polygon: an index into the scene's BlockModel.
class Block : public Shape {
public:
	virtual ~Block();

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(Block, Shape,
		"Deformable polygonal block: a range of grid points and zones in a :yref:`BlockModel`. Blocks are made by :yref:`BlockModel.insert`, not by "
		"hand. "
		"The body's state.pos is the centroid of its mass; ``O.forces`` knows nothing of grid points, see :yref:`Block.force<Block.force>`. "
		"A rigid block (:yref:`BlockModel.addRigid`) has no zones; it moves as its body does, and ``O.forces`` has all that acts on it.",
		((shared_ptr<BlockModel>, model, , Attr::readonly, "The model that holds the block."))
		((int, index, -1, Attr::readonly, "Index of the block in the model.")),
		createIndex();,
		.add_property("outline", &Block::outline, "Present positions of the boundary grid points, edge by edge, shape (edges, 2) [m].")
		.add_property("force", &Block::force, "Sum of the unbalanced forces of the block's grid points [N]; of a rigid block: what neighbours and "
			"tractions put on it.")
		.add_property("nodes", &Block::nodes, "First and one-past-last grid point of the block.")
		.add_property("zones", &Block::zones, "First and one-past-last zone of the block.")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(Block, Shape);

	/// The model's arrays; an error for a block that was made by hand.
	const blocks::BlockAssembly& assembly() const;

	py::list  outline() const;
	Vector2r  force() const;
	py::tuple nodes() const;
	py::tuple zones() const;
};
REGISTER_SERIALIZABLE(Block);

} // namespace yade
