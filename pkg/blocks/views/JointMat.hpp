// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/laws/SofteningLaw.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

/// Properties of the joints between two materials.
class JointMat : public Serializable {
public:
	virtual ~JointMat();

	/// Checked; an exception names what is wrong.
	blocks::JointParams     params() const;
	blocks::SofteningParams softening() const;

	/// Whether this is about these two materials.
	bool isOf(const string& a, const string& b) const { return (material1 == a && material2 == b) || (material1 == b && material2 == a); }

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(JointMat, Serializable,
		"Properties of the joints between blocks of two materials (which may be one and the same): elastic, then brittle Mohr-Coulomb with a tension "
		"cut-off (paper, section 2.2, Eqs. 1-3), "
		"or, with fracture energies GfI and GfII, with strengths that fall gradually (Lourenco and Rots 1997, tension and shear coupled): ft, c and "
		"tan(phi) go from their values to the residual ones as e^-k, with dk = sqrt((ft l1/GfI)^2 + (c l2/(GfII + GfIIPressure p))^2) for inelastic "
		"opening l1 and slip l2 under a pressure p. "
		"Tension and cohesion must then be positive, cohesion at least tension tan(frictionAngle), and (tension^2/(kn GfI))^2 + (cohesion^2/(ks "
		"GfII))^2 below 1, or a single point would snap back; under a pressure p shear needs ks > c (c + p (tan(phi) - tan(phi_res)))/(GfII + "
		"GfIIPressure p), which is not known beforehand (:yref:`snappedBack<BlockModel.snappedBack>`). "
		"Given to :yref:`bond<BlockModel.bond>` (or to :yref:`Ip2_BlockMat_BlockMat_JointPhys`), which refuses impossible values.",
		((string, material1, "", , "Label of one material."))
		((string, material2, "", , "Label of the other."))
		((Real, kn, 0, , "Normal stiffness JKn [Pa/m]."))
		((Real, ks, 0, , "Shear stiffness JKs [Pa/m]."))
		((Real, frictionAngle, 0, , "Friction angle Jfric [rad]."))
		((Real, cohesion, 0, , "Cohesion Jcoh [Pa]."))
		((Real, tension, 0, , "Tensile strength (tension cut-off) Jten [Pa]."))
		((Real, dilationAngle, 0, , "Dilation angle Jdil [rad]; at most frictionAngleResidual, or sliding would make energy. The joint opens by "
			"tan(dilationAngle) times its largest slip so far: sliding back lowers nothing, and a joint that slid while it was open closes on the "
			"raised place, which lifts its blocks."))
		((Real, frictionAngleResidual, -1, , "Friction angle after failure Jfric_res [rad]; -1: as before."))
		((Real, cohesionResidual, 0, , "Cohesion after failure Jcoh_res [Pa]."))
		((Real, tensionResidual, 0, , "Tensile strength after failure [Pa]."))
		((Real, dilationLimitSlip, -1, , "Slip beyond which the joint dilates no further [m]; -1: none. With general contact a quarter of the joint's "
			"length is the most: then its edges become a free contact, which keeps what it has dilated."))
		((Real, GfI, 0, , "Fracture energy of opening [J/m2 = N/m]; 0, with GfII: brittle. Clay brick masonry: 5 to 20 N/m at strengths of 0.3 to 0.9 "
			"N/mm2 (Van der Pluijm 1992, as in Lourenco 1996)."))
		((Real, GfII, 0, , "Fracture energy of slip, without that of friction [J/m2 = N/m]. Clay brick masonry: 10 to 250 N/m at cohesions of 0.1 to "
			"1.8 N/mm2 (Van der Pluijm 1993, as in Lourenco 1996)."))
		((Real, GfIIPressure, 0, , "What GfII rises by with the pressure on the joint [J/m2 by Pa = m]. Clay brick masonry: 0.13 mm (Van der Pluijm "
			"1993, GfII = 58 N/m + 0.13 mm p, as in Lourenco 1996; from memory, not checked)."))
		((Real, lastingShare, 0, , "Share of the inelastic opening that lasts when a joint that softens is unloaded: 0 secant to the origin, 1 plastic "
			"(as Lourenco and Rots 1997) [-]."))
		((Real, dilationDecay, 0, , "Dilatancy of a joint that softens falls with slip as e^(-dilationDecay slip); reversal takes nothing back and "
			"raises nothing [1/m]. 17 1/mm in Van der Pluijm's tests, as in Lourenco 1996."))
		((Real, dilationPressure, -1, , "Pressure at which a joint that softens dilates no more; below, dilatancy falls linearly with it [Pa]; -1: "
			"none."))
		((Real, capStrength, 0, , "Compressive strength of a joint that stands for a whole bed joint [Pa]; 0: none. Elliptic cap sigma^2 + capShear "
			"tau^2 + capLinear sigma = F^2 - capLinear F, after Lourenco and Rots 1997. A joint with a cap never becomes a free contact."))
		((Real, capFirst, 0, , "F at which the cap begins to yield [Pa]; it rises along a parabola from there."))
		((Real, capResidual, 0, , "F in the end [Pa]."))
		((Real, capPeakClosure, 0, , "Inelastic closure at which F reaches capStrength [m]."))
		((Real, capEnergy, 0, , "Energy dissipated by the cap after its peak, above capResidual [J/m2]."))
		((Real, capShear, 0, , "Weight of the shear stress in the cap, Css [-]; 9 in Lourenco and Rots 1997."))
		((Real, capLinear, 0, , "Linear term of the cap, Cn [Pa]."))
		((bool, bonded, true, , "Whether the joints are whole at first; False: dry, they start with the residual properties."))
	);
	// clang-format on
};
REGISTER_SERIALIZABLE(JointMat);

/// A list of JointMats from Python, each checked, none twice for a pair of materials.
vector<shared_ptr<JointMat>> checkedJoints(const py::object& list);

/// The one for two materials; null if there is none.
const JointMat* jointBetween(const vector<shared_ptr<JointMat>>&, const string& material1, const string& material2);
/// What messages say where there is none.
string noJointFor(const string& material1, const string& material2);

} // namespace yade
