// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/engines/BlockEngine.hpp>

namespace yade {

/// General contact in front of YADE's InteractionLoop.
class BlockContacts : public BlockEngine {
public:
	virtual ~BlockContacts();
	void step(BlockModel&) override;
	void newScene() override;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(BlockContacts, BlockEngine,
		"General contact for lists of engines with YADE's InteractionLoop (:yref:`BlockLoop` has it as ``contact=True``): turns broken joints into "
		"contacts that may slide along edges and past corners, part and meet again (with the residual properties), and finds new ones. "
		"Stands first. It needs no collider: an InsertionSortCollider for blocks alone is put to rest. A scene whose blocks keep their neighbours "
		"leaves it out.",
		((long, colliderRuns, 0, Attr::readonly, "How often neighbours were looked for."))
	);
	// clang-format on

private:
	void refuseOtherShapes() const;

	bool   started    = false;
	size_t bodiesSeen = 0;
};
REGISTER_SERIALIZABLE(BlockContacts);

} // namespace yade
