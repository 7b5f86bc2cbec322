// yade-blocks, GPL-2.0-or-later
#include "BlockContacts.hpp"
#include <blocks/kernel/model/FreeContacts.hpp>
#include <core/Aabb.hpp>
#include <core/Body.hpp>
#include <core/BodyContainer.hpp>

namespace yade {

Bo1_Block_Aabb::~Bo1_Block_Aabb() = default;
BlockContacts::~BlockContacts()   = default;

namespace {
	/// How far a block's points may move until the collider looks again [m].
	Real sweepOf(const blocks::BlockAssembly& a, int block)
	{
		return blocks::contactMargin(a, block) * Bo1_Block_Aabb::sweep / (2 * blocks::FreeContacts::mayMove);
	}
}

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
	const Real margin = blocks::contactMargin(a, block->index) + sweepOf(a, block->index);
	bound->min        = Vector3r(lo.x() - margin, lo.y() - margin, se3.position.z());
	bound->max        = Vector3r(hi.x() + margin, hi.y() + margin, se3.position.z());
}

void BlockContacts::action()
{
	visibly([&] { update(); });
}

void BlockContacts::update()
{
	BlockModel& model = modelOf(scene);
	auto&       a     = model.assembly;
	if (modelOf.changed || scene->bodies->size() != bodiesSeen) refuseOtherShapes();
	bodiesSeen = scene->bodies->size();
	if (modelOf.changed || reach.empty()) {
		reach.clear();
		nearUntil.assign(a.blockCount(), 0);
		for (int i = 0; i < a.blockCount(); ++i)
			reach.push_back(sweepOf(a, i));
		contactsVersion = 0;
	}
	if (a.contacts.releasable.size() != a.joints.pairs.size()) blocks::enableRelease(a);
	a.contacts.wanted = true;
	blocks::prepareContacts(a);
	if (a.contacts.version != contactsVersion) {
		contactsVersion = a.contacts.version;
		model.stiffnessChanged();
	}

	const bool needed = colliderNeeded(model);
	for (const auto& engine : scene->engines)
		if (engine->getClassName() == "InsertionSortCollider") engine->dead = !needed;
	if (!needed) return;
	sortedAt = a.position;
	++colliderRuns;
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

bool BlockContacts::colliderNeeded(const BlockModel& model)
{
	const auto& a = model.assembly;
	if (modelOf.changed || sortedAt.size() != a.position.size()) return true;
	for (int block = 0; block < a.blockCount(); ++block) {
		if (a.odometer.path[block] < nearUntil[block]) continue;
		Real square = 0;
		for (int n = a.mesh.firstNode[block]; n < a.mesh.firstNode[block + 1]; ++n)
			square = std::max(square, (a.position(n) - sortedAt[n]).squaredNorm());
		if (!(square <= reach[block] * reach[block])) return true;
		nearUntil[block] = a.odometer.path[block] + reach[block] - std::sqrt(square);
	}
	return false;
}

YADE_PLUGIN((Bo1_Block_Aabb)(BlockContacts));

} // namespace yade
