// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/step/Joints.hpp>
#include <blocks/native/Ig2_Block_Block_BlockGeom.hpp>

namespace yade {

Ig2_Block_Block_BlockGeom::~Ig2_Block_Block_BlockGeom() = default;

namespace {
	/// Somebody has put something else in the place of an interaction's geom or a body's shape.
	void complainOf(const Shape& shape, const char* what, const Interaction& interaction)
	{
		const auto* block = dynamic_cast<const Block*>(&shape);
		if (block && block->model)
			block->model->complain(
				string(what) + " of the interaction of bodies " + std::to_string(interaction.id1) + " and " + std::to_string(interaction.id2)
				+ " was replaced, but blocks keep what BlockModel.insert() gave them");
	}
}

bool Ig2_Block_Block_BlockGeom::go(
	const shared_ptr<Shape>& shape1,
	const shared_ptr<Shape>& shape2,
	const State&,
	const State&,
	const Vector3r&,
	const bool&,
	const shared_ptr<Interaction>& interaction)
{
	const auto* geom = dynamic_cast<const BlockGeom*>(interaction->geom.get());
	if (interaction->geom && !(geom && geom->model)) {
		complainOf(*shape1, "geom", *interaction);
		return true; // it stays: YADE would take it down without Python's leave
	}
	if (!geom) { // a collider has found them; who touches whom is for BlockContacts to find
		const auto* block = static_cast<const Block*>(shape1.get());
		if (!block->model->assembly.contacts.wanted)
			block->model->complain(
				"a collider has found blocks " + std::to_string(block->index) + " and "
				+ std::to_string(static_cast<const Block*>(shape2.get())->index)
				+ " near each other: O.engines needs BlockContacts in front of it, which makes their contacts");
		return false;
	}
	blocks::BlockAssembly& a = geom->model->assembly;
	if (geom->pair >= 0) blocks::updateKinematics(a, blocks::jointsOf(a, geom->pair));
	return true;
}

YADE_PLUGIN((Ig2_Block_Block_BlockGeom));

} // namespace yade
