// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/step/ContactSearch.hpp>
#include <blocks/native/BlockContacts.hpp>
#include <blocks/views/Block.hpp>
#include <blocks/views/ContactViews.hpp>
#include <core/Body.hpp>
#include <core/BodyContainer.hpp>

namespace yade {

BlockContacts::~BlockContacts() = default;

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

YADE_PLUGIN((BlockContacts));

} // namespace yade
