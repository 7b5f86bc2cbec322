// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/engines/OnBlocks.hpp>
#include <pkg/common/PeriodicEngines.hpp>

namespace yade {

/// Notes which contact point broke, when, where and how.
class BlockCrackRecorder : public OnBlocks<PeriodicEngine> {
public:
	virtual ~BlockCrackRecorder();
	void     action() override;
	py::list events() const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(BlockCrackRecorder, PeriodicEngine,
		"Records every contact point that breaks: step, time [s], position [m], normal, 'tension' or 'shear', ids of the two bodies, labels of their "
		"materials, damage (1, or from 0.9 on where joints soften: from there they count as cracked), name of the joint (- for none; see "
		":yref:`nameJoints<BlockModel.nameJoints>`). "
		"Stands behind :yref:`BlockLoop`; iterPeriod=1 unless given (with a longer period, step and time are those of the look that found the crack).",
		((string, fileName, "", , "Text file that gets a line for every crack as it happens (say 'cracks_' + O.tags['id'] + '.txt'); empty: none."))
		((vector<int>, known, , Attr::hidden, "Status of every contact point at the last look."))
		((vector<int>, points, , Attr::readonly, "Contact points that broke, in the order in which they broke."))
		((vector<int>, modes, , Attr::readonly, "1 tension, 2 shear, of each event."))
		((vector<long>, steps, , Attr::hidden, "Step of each event."))
		((vector<Real>, times, , Attr::readonly, "Time of each event [s]."))
		((vector<Real>, damages, , Attr::readonly, "Damage of the contact point at each event [-]."))
		((vector<Vector2r>, positions, , Attr::readonly, "Where each event happened [m]."))
		,
		iterPeriod = 1; initRun = true;,
		.add_property("events", &BlockCrackRecorder::events, "The events as a list of dictionaries: step, time, position, mode, point, ids, materials, "
			"damage, name.")
	);
	// clang-format on

private:
	void look(const BlockModel&);
};
REGISTER_SERIALIZABLE(BlockCrackRecorder);

} // namespace yade
