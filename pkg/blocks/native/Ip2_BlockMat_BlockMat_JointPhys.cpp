// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/step/Contacts.hpp>
#include <blocks/native/Ip2_BlockMat_BlockMat_JointPhys.hpp>

namespace yade {

Ip2_BlockMat_BlockMat_JointPhys::~Ip2_BlockMat_BlockMat_JointPhys() = default;

void Ip2_BlockMat_BlockMat_JointPhys::go(
	const shared_ptr<Material>& material1, const shared_ptr<Material>& material2, const shared_ptr<Interaction>& interaction)
{
	const auto* geom = static_cast<const BlockGeom*>(interaction->geom.get());
	if (interaction->phys) {
		if (static_cast<const JointPhys*>(interaction->phys.get())->fromBond && !jointList.empty())
			geom->model->complain(
				"joints have their properties from BlockModel.bond() already: leave Ip2_BlockMat_BlockMat_JointPhys.joints empty");
		return;
	}
	auto phys         = shared_ptr<JointPhys>(new JointPhys);
	phys->model       = geom->model;
	phys->pair        = geom->pair;
	phys->contact     = geom->contact;
	interaction->phys = phys;

	const string &  a = material1->label, &b = material2->label;
	const JointMat* joint = jointBetween(jointList, a, b);
	try {
		if (!joint)
			geom->model->complain(
				"Ip2_BlockMat_BlockMat_JointPhys.joints has no JointMat for the pair of materials \"" + std::min(a, b) + "\" and \""
				+ std::max(a, b) + "\", whose blocks touch");
		else if (geom->pair >= 0)
			geom->model->setJoint(geom->pair, *joint);
		else
			blocks::setContactJoint(geom->model->assembly, geom->contact, blocks::neverBonded(joint->params()));
	} catch (const std::exception& error) { // changed after it was checked
		geom->model->complain(error.what());
	}
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
	auto checked = checkedJoints(joints);
	for (const auto& joint : checked) // its columns must be there before several threads use them
		blocks::require(
			!joint->softening().softens(),
			"joints that soften have their properties from BlockModel.bond(): JointMat.GfI in Ip2_BlockMat_BlockMat_JointPhys.joints must be 0",
			joint->GfI);
	jointList = std::move(checked);
}

YADE_PLUGIN((Ip2_BlockMat_BlockMat_JointPhys));

} // namespace yade
