// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/model/Outline.hpp>
#include <blocks/kernel/step/ContactSearch.hpp>
#include <blocks/native/BlockContacts.hpp>
#include <blocks/views/Block.hpp>
#include <blocks/views/ContactViews.hpp>
#include <core/Aabb.hpp>
#include <core/Body.hpp>
#include <core/BodyContainer.hpp>

namespace yade {

Bo1_Block_Aabb::~Bo1_Block_Aabb() = default;
BlockContacts::~BlockContacts()   = default;

void Bo1_Block_Aabb::go(const shared_ptr<Shape>& shape, shared_ptr<Bound>& bound, const Se3r& se3, const Body*)
{
	if (!bound) bound = shared_ptr<Bound>(new Aabb);
	const Block* block = static_cast<const Block*>(shape.get());
	const auto&  a     = block->assembly();
	Vector2r     lo = a.position(a.mesh.firstNode[block->index]), hi = lo;
	for (int n = a.mesh.firstNode[block->index]; n < a.mesh.firstNode[block->index + 1]; ++n) {
		lo = lo.cwiseMin(a.position(n));
		hi = hi.cwiseMax(a.position(n));
	}
	const Real margin = 2 * blocks::FreeContacts::mayMove
		* blocks::meanEdge(a, block->index); // so that a collider without BlockContacts is noticed before it is too late
	bound->min = Vector3r(lo.x() - margin, lo.y() - margin, se3.position.z());
	bound->max = Vector3r(hi.x() + margin, hi.y() + margin, se3.position.z());
}

void BlockContacts::newScene() { started = false; }

void BlockContacts::step(BlockModel& model)
{
	auto& a = model.assembly;
	if (!started || scene->bodies->size() != bodiesSeen) refuseOtherShapes();
	if (!started) {
		blocks::setGeneralContact(a, true);
		bool onlyBlocks = true;
		for (const auto& body : *scene->bodies)
			onlyBlocks = onlyBlocks && dynamic_cast<const Block*>(body->shape.get());
		for (const auto& engine : scene->engines)
			if (engine->getClassName() == "InsertionSortCollider" && onlyBlocks) engine->dead = true;
	}
	started    = true;
	bodiesSeen = scene->bodies->size();
	blocks::prepareContacts(a, scene->dt, scene->trackEnergy);
	showAllContacts(scene, model); // YADE erases what it takes for no interaction any more
	colliderRuns = a.contacts.looks;
}

void BlockContacts::refuseOtherShapes() const
{
	mask_t ofBlocks = 0;
	for (const auto& body : *scene->bodies)
		if (dynamic_cast<const Block*>(body->shape.get())) ofBlocks |= body->groupMask;
	for (const auto& body : *scene->bodies)
		if (body->shape && !dynamic_cast<const Block*>(body->shape.get()) && (body->groupMask & ofBlocks))
			throw std::runtime_error(
				"body " + std::to_string(body->id) + " is a " + body->shape->getClassName()
				+ ", which blocks cannot touch: use BlockModel.addRigid, or give it a mask that no block has");
}

YADE_PLUGIN((Bo1_Block_Aabb)(BlockContacts));

} // namespace yade
