// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/model/Outline.hpp>
#include <blocks/native/Bo1_Block_Aabb.hpp>
#include <core/Aabb.hpp>

namespace yade {

Bo1_Block_Aabb::~Bo1_Block_Aabb() = default;

void Bo1_Block_Aabb::go(const shared_ptr<Shape>& shape, shared_ptr<Bound>& bound, const Se3r& se3, const Body*)
{
	if (!bound) bound = shared_ptr<Bound>(new Aabb);
	const Block* block = static_cast<const Block*>(shape.get());
	const auto&  a     = block->assembly();
	// so far that a collider without BlockContacts is noticed before it is too late
	const Real        margin = 2 * blocks::FreeContacts::mayMove * blocks::meanEdge(a, block->index);
	const blocks::Box box    = blocks::grown(blocks::boxOf(a, block->index), margin);
	bound->min               = Vector3r(box.min().x(), box.min().y(), se3.position.z());
	bound->max               = Vector3r(box.max().x(), box.max().y(), se3.position.z());
}

YADE_PLUGIN((Bo1_Block_Aabb));

} // namespace yade
