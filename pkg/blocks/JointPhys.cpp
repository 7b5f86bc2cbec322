// yade-blocks, GPL-2.0-or-later
#include "JointPhys.hpp"
#include <blocks/kernel/model/FreeContacts.hpp>
#include <blocks/kernel/step/NodalForces.hpp>
#include <limits>

namespace yade {

JointMat::~JointMat()                                                         = default;
JointPhys::~JointPhys()                                                       = default;
Ip2_BlockMat_BlockMat_JointPhys::~Ip2_BlockMat_BlockMat_JointPhys()           = default;
Law2_BlockGeom_JointPhys_MohrCoulomb::~Law2_BlockGeom_JointPhys_MohrCoulomb() = default;

namespace {
	/// Tangent of an angle that a joint may have.
	Real tangent(Real angle, const char* name)
	{
		blocks::require(angle >= 0 && angle < M_PI / 2, std::string("JointMat.") + name + " must lie in [0, pi/2) rad", angle);
		return std::tan(angle);
	}

	/// What is left of a joint between blocks that were never bonded.
	blocks::JointParams unbonded(blocks::JointParams p)
	{
		p.cohesionResidual = p.tensionResidual = 0;
		return p;
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
	return bonded ? p : unbonded(p);
}

void Ip2_BlockMat_BlockMat_JointPhys::go(
	const shared_ptr<Material>& material1, const shared_ptr<Material>& material2, const shared_ptr<Interaction>& interaction)
{
	if (interaction->phys) return;
	const auto* geom  = static_cast<const BlockGeom*>(interaction->geom.get());
	auto        phys  = shared_ptr<JointPhys>(new JointPhys);
	phys->model       = geom->model;
	phys->pair        = geom->pair;
	phys->contact     = geom->contact;
	interaction->phys = phys;

	const string &a = material1->label, &b = material2->label;
	for (const auto& joint : jointList) {
		if (!((joint->material1 == a && joint->material2 == b) || (joint->material1 == b && joint->material2 == a))) continue;
		try {
			if (geom->pair >= 0)
				geom->model->setJoint(geom->pair, joint->params(), joint->bonded);
			else
				blocks::setContactJoint(geom->model->assembly, geom->contact, unbonded(joint->params()));
		} catch (const std::exception& error) { // changed after it was checked
			geom->model->complain(error.what());
		}
		return;
	}
	geom->model->complain(
		"Ip2_BlockMat_BlockMat_JointPhys.joints has no JointMat for the pair of materials \"" + std::min(a, b) + "\" and \"" + std::max(a, b)
		+ "\", whose blocks touch");
}

void Ip2_BlockMat_BlockMat_JointPhys::pyHandleCustomCtorArgs(py::tuple&, py::dict& keywords)
{
	if (!keywords.has_key("joints")) return;
	setJoints(keywords["joints"]);
	keywords["joints"].del();
}

py::list Ip2_BlockMat_BlockMat_JointPhys::getJoints() const
{
	py::list list;
	for (const auto& joint : jointList)
		list.append(joint);
	return list;
}

void Ip2_BlockMat_BlockMat_JointPhys::setJoints(const py::object& joints)
{
	vector<shared_ptr<JointMat>> checked;
	for (long i = 0; i < py::len(joints); ++i) {
		checked.push_back(py::extract<shared_ptr<JointMat>>(joints[i]));
		const JointMat& joint = *checked.back();
		if (joint.material1.empty() || joint.material2.empty())
			throw std::invalid_argument(
				"JointMat.material1 and material2 must be labels of materials, got \"" + joint.material1 + "\" and \"" + joint.material2
				+ "\"");
		joint.params(); // refuses impossible values now
		for (long j = 0; j < i; ++j) {
			const JointMat& other = *checked[j];
			if ((joint.material1 == other.material1 && joint.material2 == other.material2)
			    || (joint.material1 == other.material2 && joint.material2 == other.material1))
				throw std::invalid_argument(
					"two JointMats for the pair of materials \"" + joint.material1 + "\" and \"" + joint.material2 + "\"");
		}
	}
	jointList = std::move(checked);
}

bool Law2_BlockGeom_JointPhys_MohrCoulomb::go(shared_ptr<IGeom>& geom, shared_ptr<IPhys>&, Interaction*)
{
	const auto* g = static_cast<const BlockGeom*>(geom.get());
	auto&       a = g->model->assembly;
	if (!a.contacts.wanted) { // bonds are all there is
		blocks::advanceJoints(a, g->pair, blocks::advance);
		return true;
	}
	if (g->pair >= 0) {
		blocks::advanceJoints(a, g->pair, blocks::advance, blocks::Which::unreleased);
		blocks::watchForRelease(a, g->pair);
	}
	if (g->contact >= 0) blocks::advanceContact(a, g->contact, scene->dt);
	return g->pair >= 0 || g->contact >= 0; // blocks that have parted are no more
}

YADE_PLUGIN((JointMat)(JointPhys)(Ip2_BlockMat_BlockMat_JointPhys)(Law2_BlockGeom_JointPhys_MohrCoulomb));

} // namespace yade
