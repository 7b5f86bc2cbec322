// yade-blocks, GPL-2.0-or-later
#include <blocks/views/JointMat.hpp>
#include <cmath>

namespace yade {

JointMat::~JointMat() = default;

namespace {
	/// Tangent of an angle that a joint may have.
	Real tangent(Real angle, const char* name)
	{
		blocks::require(angle >= 0 && angle < M_PI / 2, std::string("JointMat.") + name + " must lie in [0, pi/2) rad", angle);
		return std::tan(angle);
	}

}

blocks::JointParams JointMat::params() const
{
	blocks::JointParams p;
	p.kn               = kn;
	p.ks               = ks;
	p.cohesion         = cohesion;
	p.tension          = tension;
	p.tanPhi           = tangent(frictionAngle, "frictionAngle");
	p.tanPhiResidual   = frictionAngleResidual == -1 ? p.tanPhi : tangent(frictionAngleResidual, "frictionAngleResidual");
	p.tanDilation      = tangent(dilationAngle, "dilationAngle");
	p.cohesionResidual = cohesionResidual;
	p.tensionResidual  = tensionResidual;
	if (dilationLimitSlip != -1) p.dilationLimitSlip = dilationLimitSlip;
	blocks::validate(p);
	return bonded ? p : blocks::neverBonded(p);
}

blocks::SofteningParams JointMat::softening() const
{
	blocks::SofteningParams s;
	s.energyI          = GfI;
	s.energyII         = GfII;
	s.energyIIPressure = GfIIPressure;
	s.lastingShare     = lastingShare;
	s.dilationDecay    = dilationDecay;
	if (dilationPressure != -1) s.dilationPressure = dilationPressure;
	s.cap = { capStrength, capFirst, capResidual, capPeakClosure, capEnergy, capShear, capLinear };
	blocks::validate(params(), s);
	return s;
}

vector<shared_ptr<JointMat>> checkedJoints(const py::object& list)
{
	vector<shared_ptr<JointMat>> checked;
	if (!PySequence_Check(list.ptr())) throw std::invalid_argument("joints must be a list of JointMat, got " + string(py::extract<string>(py::str(list))));
	for (long i = 0; i < py::len(list); ++i) {
		const py::extract<shared_ptr<JointMat>> extracted(list[i]);
		if (!extracted.check()) throw std::invalid_argument("joints must be a list of JointMat, got " + string(py::extract<string>(py::str(list[i]))));
		const JointMat& joint = *checked.emplace_back(extracted());
		if (joint.material1.empty() || joint.material2.empty())
			throw std::invalid_argument(
				"JointMat.material1 and material2 must be labels of materials, got \"" + joint.material1 + "\" and \"" + joint.material2
				+ "\"");
		joint.softening(); // refuses impossible values now, those of params() too
		for (long j = 0; j < i; ++j)
			if (checked[j]->isOf(joint.material1, joint.material2))
				throw std::invalid_argument(
					"two JointMats for the pair of materials \"" + joint.material1 + "\" and \"" + joint.material2 + "\"");
	}
	return checked;
}

const JointMat* jointBetween(const vector<shared_ptr<JointMat>>& list, const string& material1, const string& material2)
{
	for (const auto& joint : list)
		if (joint->isOf(material1, material2)) return joint.get();
	return nullptr;
}

string noJointFor(const string& material1, const string& material2)
{
	return "no JointMat for the pair of materials \"" + std::min(material1, material2) + "\" and \"" + std::max(material1, material2) + "\"";
}

YADE_PLUGIN((JointMat));

} // namespace yade
