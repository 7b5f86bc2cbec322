// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/laws/JointLaw.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

/// Properties of the joints between two materials.
class JointMat : public Serializable {
public:
	virtual ~JointMat();

	/// Checked; an exception names what is wrong.
	blocks::JointParams params() const;

	/// Whether this is about these two materials.
	bool isOf(const string& a, const string& b) const { return (material1 == a && material2 == b) || (material1 == b && material2 == a); }

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(JointMat, Serializable,
		"Properties of the joints between blocks of two materials (which may be one and the same): elastic, then brittle Mohr-Coulomb with a tension cut-off (paper, section 2.2, Eqs. 1-3). "
		"Given to :yref:`bond<BlockModel.bond>` (or to :yref:`Ip2_BlockMat_BlockMat_JointPhys`), which refuses impossible values.",
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
		((Real, dilationLimitSlip, -1, , "Slip beyond which the joint dilates no further [m]; -1: none. With general contact a quarter of the joint's length is the most: then its edges become a free contact, which keeps what it has dilated."))
		((bool, bonded, true, , "Whether the joints are whole at first; False: dry, they start with the residual properties."))
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(JointMat);

/// A list of JointMats from Python, each checked, none twice for a pair of materials.
vector<shared_ptr<JointMat>> checkedJoints(const py::object& list);

/// The one for two materials; null if there is none.
const JointMat* jointBetween(const vector<shared_ptr<JointMat>>&, const string& material1, const string& material2);

} // namespace yade
