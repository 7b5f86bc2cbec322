// yade-blocks, GPL-2.0-or-later
#pragma once
#include "Block.hpp"
#include "BlockEngines.hpp"
#include <core/Dispatching.hpp>

namespace yade {

/// Bounding boxes of blocks, wide enough to be right until BlockContacts wakes the collider again.
class Bo1_Block_Aabb : public BoundFunctor {
public:
	virtual ~Bo1_Block_Aabb();
	void go(const shared_ptr<Shape>&, shared_ptr<Bound>&, const Se3r&, const Body*) override;

	/// Distance that a block's points may move between two runs of the collider, as a fraction of its mean edge.
	static constexpr Real sweep = 0.1;

	// clang-format off
	YADE_CLASS_BASE_DOC(Bo1_Block_Aabb, BoundFunctor,
		"Bounding box of a :yref:`Block` around its grid points as they are (blocks turn and deform), with a margin for contact and for the motion until :yref:`BlockContacts` wakes the collider.");
	// clang-format on
	FUNCTOR1D(Block);
};
REGISTER_SERIALIZABLE(Bo1_Block_Aabb);

/// Lets blocks that were never bonded, or whose joints broke, slide, part and meet again.
class BlockContacts : public GlobalEngine {
public:
	virtual ~BlockContacts();
	void action() override;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(BlockContacts, GlobalEngine,
		"General contact: turns broken joints into contacts that may slide along edges and past corners, part and meet again (with the residual properties), and lets the collider find new ones. "
		"Stands first, before ``InsertionSortCollider([Bo1_Block_Aabb()], verletDist=0)``, which it wakes only when some point has moved far enough. A scene whose blocks keep their neighbours leaves both out.",
		((long, colliderRuns, 0, Attr::readonly, "How often the collider was woken."))
		((vector<Vector2r>, sortedAt, , Attr::hidden, "Grid points at the last run of the collider [m]."))
	);
	// clang-format on

private:
	void update();
	void refuseOtherShapes() const;
	bool colliderNeeded(const BlockModel&);

	ModelOfScene modelOf;
	vector<Real> reach;     ///< of every block: the distance that its points may move [m]
	vector<Real> nearUntil; ///< of every block: no point is that far from where it was sorted before the path is this long [m]
	long         contactsVersion = 0;
	size_t       bodiesSeen      = 0;
};
REGISTER_SERIALIZABLE(BlockContacts);

} // namespace yade
