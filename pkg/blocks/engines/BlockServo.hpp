// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/engines/BlockEngine.hpp>

namespace yade {

/// Slows loading where the blocks cannot follow.
class BlockServo : public BlockEngine {
public:
	virtual ~BlockServo();
	void step(BlockModel&) override;
	void postLoad(BlockServo&);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(BlockServo, BlockEngine,
		"Keeps loading quasi-static: every ``period`` steps the speed of the motion groups is lowered by the factor 0.8 if the unbalanced force ratio "
		"(:yref:`BlockModel.unbalancedRatio`) is above ``target``, else raised by 1.1, between ``least`` and 1 x their velocity. "
		"Stands between BlockLoop and BlockMotion. Only groups driven by a velocity are slowed.",
		((vector<string>, groups, , , "Names of the motion groups to slow."))
		((Real, target, 1e-3, Attr::triggerPostLoad, "Unbalanced force ratio to keep [-]."))
		((Real, floor, 0, Attr::triggerPostLoad, "Least sum of contact forces that counts in the ratio [N], or a start from zero load stalls: say 1e-3 "
			"x strength x section."))
		((Real, least, 0.05, Attr::triggerPostLoad, "Least speed as a fraction of the groups' velocity, in (0, 1] [-]."))
		((int, period, 10, Attr::triggerPostLoad, "Steps between two looks."))
		((Real, throttle, 1, Attr::readonly, "Present speed as a fraction of the groups' velocity [-]."))
	);
	// clang-format on

private:
	struct Settings {
		Real target = 1e-3, floor = 0, least = 0.05;
		int  period = 10;
	};
	Settings accepted;
};
REGISTER_SERIALIZABLE(BlockServo);

} // namespace yade
