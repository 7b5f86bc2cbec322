// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/model/JointDetection.hpp>
#include <blocks/views/BlockModel.hpp>
#include <blocks/views/JointMat.hpp>
#include <set>

namespace yade {

int BlockModel::bond(const vector<shared_ptr<JointMat>>& list, Real tolerance)
{
	requireOpen("BlockModel.bond");
	blocks::BlockAssembly& a           = assembly;
	const int              materials   = int(materialLabels.size());
	auto                   found       = blocks::detectSegments(a, tolerance);
	const auto             materialsOf = [&](const std::array<int, 2>& block) -> std::array<int, 2> {
                return { a.mesh.blockMaterial[block[0]], a.mesh.blockMaterial[block[1]] };
	};
	if (!list.empty()) {
		std::set<std::array<int, 2>> touching;
		for (const blocks::Segment& g : found)
			touching.insert(materialsOf(g.block));
		for (const auto& [one, other] : touching) {
			const string &first = materialLabels[one], &second = materialLabels[other];
			if (!jointBetween(list, first, second))
				throw std::invalid_argument("BlockModel.bond: joints has " + noJointFor(first, second) + ", whose blocks touch");
		}
	}
	for (const auto& joint : list) // a label that no block has is a mistake
		for (const string& label : { joint->material1, joint->material2 })
			if (std::find(materialLabels.begin(), materialLabels.end(), label) == materialLabels.end())
				throw std::invalid_argument("BlockModel.bond: a JointMat names the material \"" + label + "\", which no block has");
	a.bond(std::move(found));
	jointMats = list;
	a.joints.ofMaterials.assign(materials * materials, 0);
	for (const auto& joint : list) {
		auto index = [&](const string& label) { return int(std::find(materialLabels.begin(), materialLabels.end(), label) - materialLabels.begin()); };
		const int first = index(joint->material1), second = index(joint->material2), kind = a.addKind(blocks::neverBonded(joint->params()));
		a.joints.ofMaterials[first * materials + second] = a.joints.ofMaterials[second * materials + first] = kind;
	}
	if (!list.empty()) {
		const auto& pairs = a.joints.pairs;
		for (size_t pair = 0, next; pair < pairs.size(); pair = next) { // many have the same two materials one after another
			const auto of = materialsOf(pairs[pair].block);
			for (next = pair + 1; next < pairs.size() && materialsOf(pairs[next].block) == of;)
				++next;
			setJoints(pairs[pair].first, pairs[next - 1].last, *jointBetween(list, materialLabels[of[0]], materialLabels[of[1]]));
		}
	}
	return int(a.joints.pairs.size());
}

void BlockModel::setJoint(int pair, const JointMat& joint, const vector<shared_ptr<JointMat>>& all)
{
	const std::lock_guard<std::mutex> lock(complaintMutex);
	// all kinds at once, before any thread reads one of them: a list that grows later would move
	for (const auto& other : all)
		assembly.addKind(other->params(), other->softening());
	const auto& p = assembly.joints.pairs[pair];
	setJoints(p.first, p.last, joint);
}

void BlockModel::setJoints(int first, int last, const JointMat& joint)
{
	assembly.setJoints(first, last, joint.params(), joint.bonded ? blocks::Joint::intact : blocks::Joint::unbonded, joint.softening());
	stiffnessChanged();
}

string BlockModel::withoutJoint(int contact) const
{
	const blocks::FreeContact& c = assembly.state.contacts[contact];
	if (c.joint.kn > 0 || c.active.empty()) return "";
	return "there is " + noJointFor(labelOf(c.block[0]), labelOf(c.block[1])) + ", whose blocks " + std::to_string(c.block[0]) + " and "
		+ std::to_string(c.block[1]) + " touch and would pass through each other";
}

void BlockModel::requireProperties()
{
	if (propertiesKnown == version) return;
	const auto& joints = assembly.joints;
	for (int i = 0; i < joints.count(); ++i)
		if (joints.kind[i] == 0)
			throw std::runtime_error(
				"the joint between blocks " + std::to_string(joints.segments[i].block[0]) + " and "
				+ std::to_string(joints.segments[i].block[1])
				+ " has no properties: give JointMats to BlockModel.bond(), or use an InteractionLoop with Ip2_BlockMat_BlockMat_JointPhys and "
				  "BlockForces");
	propertiesKnown = version;
}

} // namespace yade
