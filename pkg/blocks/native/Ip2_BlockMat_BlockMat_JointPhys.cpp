// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/step/Contacts.hpp>
#include <blocks/native/Ip2_BlockMat_BlockMat_JointPhys.hpp>

namespace yade {

Ip2_BlockMat_BlockMat_JointPhys::~Ip2_BlockMat_BlockMat_JointPhys() = default;

void Ip2_BlockMat_BlockMat_JointPhys::go(
	const shared_ptr<Material>& material1, const shared_ptr<Material>& material2, const shared_ptr<Interaction>& interaction)
{
	const auto* geom = dynamic_cast<const BlockGeom*>(interaction->geom.get());
	if (!geom || !geom->model) return; // Ig2_Block_Block_BlockGeom has complained
	if (interaction->phys) {
		const auto* known = dynamic_cast<const JointPhys*>(interaction->phys.get());
		if (!known || known->model != geom->model)
			geom->model->complain(
				"phys of the interaction of bodies " + std::to_string(interaction->id1) + " and " + std::to_string(interaction->id2)
				+ " was replaced, but joints stay in their model: use BlockModel.setJoints");
		else if (known->fromBond && !jointList.empty())
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
		if (!joint && geom->pair < 0)
			; // near each other, no more: they may do without until they touch
		else if (!joint)
			geom->model->complain("Ip2_BlockMat_BlockMat_JointPhys.joints has " + noJointFor(a, b) + ", whose blocks touch");
		else if (geom->pair >= 0)
			geom->model->setJoint(geom->pair, *joint, jointList);
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
