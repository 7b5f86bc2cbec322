// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/model/BlockAssembly.hpp>

namespace blocks {

int BlockAssembly::addKind(const JointParams& params, const SofteningParams& softening)
{
	validate(params);
	validate(params, softening);
	auto& kinds = joints.kinds;
	if (softening.softens() && !joints.anySoftens()) {
		joints.softening.resize(kinds.size());
		state.softened.start(pointCount());
	}
	constexpr int remembered = 64; // where every joint has its own properties, looking for equal ones is in vain
	const int     count      = int(kinds.size());
	for (int kind = std::max(0, count - remembered); kind < count; ++kind)
		if (kinds[kind] == params && (!joints.anySoftens() || joints.softening[kind] == softening)) return kind;
	kinds.push_back(params);
	if (joints.anySoftens()) joints.softening.push_back(softening);
	joints.anyCap = joints.anyCap || softening.cap.strength > 0;
	return count;
}

void BlockAssembly::setJoints(int first, int last, const JointParams& params, Joint status, const SofteningParams& softening)
{
	const int kind = addKind(params, softening);
	for (int i = first; i < last; ++i) {
		joints.kind[i] = kind;
		for (int k : { 0, 1 })
			state.status[2 * i + k] = status;
		if (status != Joint::intact) forces.broke[i / Joints::batch] = true;
	}
	noteKinds(first, last);
}

void BlockAssembly::requireChangeable(int joint, const JointParams& params, const SofteningParams& softening) const
{
	validate(params);
	validate(params, softening);
	for (int p : { 2 * joint, 2 * joint + 1 })
		require(softening.softens() || state.status[p] != Joint::softening, "a joint that has begun to soften cannot become brittle; joint", joint);
}

void BlockAssembly::changeJoint(int joint, const JointParams& params, const SofteningParams& softening)
{
	requireChangeable(joint, params, softening);
	if (softening.softens() && !joints.softens(joint)) { // what has broken stays broken
		addKind(params, softening);                  // the columns are there now
		for (int p : { 2 * joint, 2 * joint + 1 })
			if (state.status[p] != Joint::intact && state.status[p] != Joint::unbonded) state.softened.k[p] = softeningEnd;
	}
	joints.kind[joint] = addKind(params, softening);
	noteKinds(joint, joint + 1);
}

void BlockAssembly::releaseJoint(int joint)
{
	state.released[joint] = true;
	noteKinds(joint, joint + 1);
}

void BlockAssembly::noteKinds(int first, int last)
{
	for (int i = first; i < last; ++i) {
		joints.effective[i]    = state.released[i] ? releasedKind : joints.kind[i];
		joints.columns.area[i] = state.released[i] ? 0 : joints.segments[i].area;
	}
	for (int b = first / Joints::batch; b * Joints::batch < last; ++b) {
		const auto begin      = joints.effective.begin() + b * Joints::batch;
		const auto end        = joints.effective.begin() + std::min((b + 1) * Joints::batch, joints.count());
		joints.kindOfBatch[b] = std::all_of(begin, end, [&](int kind) { return kind == *begin; }) ? *begin : mixedKinds;
	}
}

void BlockAssembly::nameJoints(const std::string& name, const std::vector<int>& which)
{
	if (name.empty()) throw std::invalid_argument("a name of joints must not be empty");
	for (int i : which)
		require(i >= 0 && i < joints.count(), "name of joints \"" + name + "\": there is no such joint", i);
	if (which.empty()) throw std::invalid_argument("name of joints \"" + name + "\": there must be at least one joint");
	auto& names = joints.names;
	joints.nameOf.resize(joints.count(), Joints::unnamed);
	const int number = int(std::find(names.begin(), names.end(), name) - names.begin());
	if (number == int(names.size())) names.push_back(name);
	for (int i : which)
		joints.nameOf[i] = number;

	std::vector<int> left(names.size(), 0); // of each name, how many joints have it
	for (int of : joints.nameOf)
		if (of != Joints::unnamed) ++left[of];
	for (int k = int(names.size()) - 1; k >= 0; --k) {
		if (left[k]) continue;
		names.erase(names.begin() + k);
		for (int& of : joints.nameOf)
			if (of > k) --of;
	}
}

} // namespace blocks
