// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/BlockModel.hpp>
#include <core/State.hpp>

namespace yade {

/// State of the body of a deformable block. Its position is looked up when somebody asks, so that no step needs to write it.
class BlockState : public State {
public:
	virtual ~BlockState();
	Vector3r centroid() const;
	void     refuse(const py::object&);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(BlockState, State,
		"State of the body of a deformable block, which moves by its grid points: ``pos`` is the centroid of its mass as it is now and cannot be set, "
		"nor can velocities and blockedDOFs (see :yref:`BlockModel.drive` and :yref:`BlockModel.displacement`). YADE's C++ engines see the centroid of "
		"the last look at the stability.",
		((shared_ptr<BlockModel>, model, , Attr::readonly, "The model that holds the block."))
		((int, index, -1, Attr::readonly, "Index of the block in the model.")),
		createIndex();,
		.add_property("pos", &BlockState::centroid, &BlockState::refuse, "Centroid of the block's mass as it is now [m].")
		.add_property("vel", &BlockState::velocity, &BlockState::refuse, "Velocity of the block's mass, half a step ago [m/s].")
		.add_property("angVel", &BlockState::rest, &BlockState::refuse, "None: the grid points move, not the body.")
		.add_property("blockedDOFs", &BlockState::blocked, &BlockState::refuse, "All: the grid points move, not the body.")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(BlockState, State);

	Vector3r velocity() const;
	Vector3r rest() const { return Vector3r::Zero(); }
	string   blocked() const { return "xyzXYZ"; }
};
REGISTER_SERIALIZABLE(BlockState);

} // namespace yade
