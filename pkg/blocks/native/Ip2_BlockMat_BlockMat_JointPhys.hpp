// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/JointMat.hpp>
#include <blocks/views/JointPhys.hpp>
#include <core/Dispatching.hpp>

namespace yade {

/// Gives every pair of blocks the joint of its two materials.
class Ip2_BlockMat_BlockMat_JointPhys : public IPhysFunctor {
public:
	virtual ~Ip2_BlockMat_BlockMat_JointPhys();
	void go(const shared_ptr<Material>&, const shared_ptr<Material>&, const shared_ptr<Interaction>&) override;
	void pyHandleCustomCtorArgs(py::tuple&, py::dict&) override;

	py::list getJoints() const;
	void     setJoints(const py::object&);

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(Ip2_BlockMat_BlockMat_JointPhys, IPhysFunctor,
		"Joint properties for every pair of materials: ``Ip2_BlockMat_BlockMat_JointPhys(joints=[JointMat(material1='unit', material2='mortar', ...), "
		"...])``. "
		"A pair of touching materials without a JointMat is an error that names it.",
		((vector<shared_ptr<JointMat>>, jointList, , Attr::hidden, "One for each pair of materials."))
		,
		/*ctor*/,
		.add_property("joints", &Ip2_BlockMat_BlockMat_JointPhys::getJoints, &Ip2_BlockMat_BlockMat_JointPhys::setJoints, "List of :yref:`JointMat`, "
			"one for each pair of materials that touch.")
	);
	// clang-format on
	FUNCTOR2D(BlockMat, BlockMat);
};
REGISTER_SERIALIZABLE(Ip2_BlockMat_BlockMat_JointPhys);

} // namespace yade
