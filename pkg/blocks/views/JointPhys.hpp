// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/BlockGeom.hpp>
#include <core/IPhys.hpp>

namespace yade {

class JointPhys;

struct JointPhysPython : py::def_visitor<JointPhysPython> {
	void visit(py::class_<JointPhys, shared_ptr<JointPhys>, py::bases<IPhys>, boost::noncopyable>&) const;
};

/// The joint of one pair of blocks.
class JointPhys : public IPhys {
public:
	virtual ~JointPhys();

	/// Properties of the pair's first joint, or of its free contact.
	const blocks::JointParams& joint() const;

	/// New properties for all of the pair.
	void setJoint(const blocks::JointParams&);

	bool fromBond = false; ///< whether bond() has given the properties

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(JointPhys, IPhys,
		"Joint of a pair of blocks: its properties, which may be set pair by pair (for example by region), and stresses at its contact points.",
		((shared_ptr<BlockModel>, model, , Attr::readonly, "The model that holds the joint."))
		((int, pair, -1, Attr::readonly, "Index of the pair of bonded blocks in the model; -1: never bonded."))
		((int, contact, -1, Attr::readonly, "Index of the free contact of a pair that was never bonded, or has joints that are broken.")),
		createIndex();,
		.def(JointPhysPython())
	);
	// clang-format on
	REGISTER_CLASS_INDEX(JointPhys, IPhys);
};
REGISTER_SERIALIZABLE(JointPhys);

} // namespace yade
