// yade-blocks, GPL-2.0-or-later
#pragma once
#include "BlockGeom.hpp"
#include <core/IPhys.hpp>

namespace yade {

/// Properties of the joints between two materials.
class JointMat : public Serializable {
public:
	virtual ~JointMat();
	blocks::JointParams params() const;

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(JointMat, Serializable,
		"Properties of the joints between blocks of two materials (which may be one and the same): elastic, then brittle Mohr-Coulomb with a tension cut-off (paper, section 2.2, Eqs. 1-3). "
		"Impossible values are refused when :yref:`Ip2_BlockMat_BlockMat_JointPhys` receives them.",
		((string, material1, "", , "Label of one material."))
		((string, material2, "", , "Label of the other."))
		((Real, kn, 0, , "Normal stiffness JKn [Pa/m]."))
		((Real, ks, 0, , "Shear stiffness JKs [Pa/m]."))
		((Real, frictionAngle, 0, , "Friction angle Jfric [rad]."))
		((Real, cohesion, 0, , "Cohesion Jcoh [Pa]."))
		((Real, tension, 0, , "Tensile strength (tension cut-off) Jten [Pa]."))
		((Real, dilationAngle, 0, , "Dilation angle Jdil [rad]; at most frictionAngleResidual, or sliding would make energy."))
		((Real, frictionAngleResidual, -1, , "Friction angle after failure Jfric_res [rad]; -1: as before."))
		((Real, cohesionResidual, 0, , "Cohesion after failure Jcoh_res [Pa]."))
		((Real, tensionResidual, 0, , "Tensile strength after failure [Pa]."))
		((Real, dilationLimitSlip, -1, , "Slip beyond which the joint dilates no further [m]; -1: none. With :yref:`BlockContacts` a quarter of the joint's length is the most: then its edges become a free contact, which keeps what it has dilated."))
		((bool, bonded, true, , "Whether the joints are whole at first; False: dry, they start with the residual properties."))
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(JointMat);

class JointPhys;

struct JointPhysPython : py::def_visitor<JointPhysPython> {
	void visit(py::class_<JointPhys, shared_ptr<JointPhys>, py::bases<IPhys>, boost::noncopyable>&) const;
};

/// The joint of one pair of blocks.
class JointPhys : public IPhys {
public:
	virtual ~JointPhys();

	blocks::JointParams& joint() const
	{
		if (!model) throw std::runtime_error("JointPhys.model is empty: joints are made by Ip2_BlockMat_BlockMat_JointPhys");
		return pair >= 0 ? model->assembly.joints.ofPair[pair] : model->assembly.contacts.all.at(contact).joint;
	}

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
		"Joint properties for every pair of materials: ``Ip2_BlockMat_BlockMat_JointPhys(joints=[JointMat(material1='unit', material2='mortar', ...), ...])``. "
		"A pair of touching materials without a JointMat is an error that names it.",
		((vector<shared_ptr<JointMat>>, jointList, , Attr::hidden, "One for each pair of materials."))
		,
		/*ctor*/,
		.add_property("joints", &Ip2_BlockMat_BlockMat_JointPhys::getJoints, &Ip2_BlockMat_BlockMat_JointPhys::setJoints, "List of :yref:`JointMat`, one for each pair of materials that touch.")
	);
	// clang-format on
	FUNCTOR2D(BlockMat, BlockMat);
};
REGISTER_SERIALIZABLE(Ip2_BlockMat_BlockMat_JointPhys);

/// Joint stresses from opening and slip.
class Law2_BlockGeom_JointPhys_MohrCoulomb : public LawFunctor {
public:
	virtual ~Law2_BlockGeom_JointPhys_MohrCoulomb();
	bool go(shared_ptr<IGeom>&, shared_ptr<IPhys>&, Interaction*) override;

	// clang-format off
	YADE_CLASS_BASE_DOC(Law2_BlockGeom_JointPhys_MohrCoulomb, LawFunctor,
		"Brittle Mohr-Coulomb joint with tension cut-off (paper, section 2.2, Eqs. 1-3): elastic until sigma > tension or |tau| > cohesion - sigma tan(friction angle) "
		"(tension positive); then the residual strengths hold. Stresses stay at the contact points; :yref:`BlockForces` gathers them.");
	// clang-format on
	FUNCTOR2D(BlockGeom, JointPhys);
};
REGISTER_SERIALIZABLE(Law2_BlockGeom_JointPhys_MohrCoulomb);

} // namespace yade
