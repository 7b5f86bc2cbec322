// yade-blocks, GPL-2.0-or-later
#include <blocks/engines/BlockLoop.hpp>
#include <blocks/kernel/step/Step.hpp>
#include <blocks/views/ContactViews.hpp>

namespace yade {

BlockLoop::~BlockLoop() = default;

namespace {
	/// A BlockLaw as the kernel calls it.
	class LawOnRange : public blocks::JointLawOnRange {
	public:
		LawOnRange(const BlockLaw& l, BlockModel& m)
			: law(l)
			, model(m)
		{
		}
		void                            advance(blocks::BlockAssembly&, blocks::JointRange range) const override { law.advance(model, range); }
		bool                            serial() const override { return law.serial(); }
		const std::vector<std::string>& columns() const override { return law.columns(); }
		std::string                     name() const override { return "BlockLoop.law: " + law.getClassName(); }

	private:
		const BlockLaw& law;
		BlockModel&     model;
	};
}

/// Only where contacts without properties are known, which is rare.
void BlockLoop::requireContactJoints(const BlockModel& model)
{
	if (model.assembly.contacts.version != knownContacts) {
		knownContacts = model.assembly.contacts.version;
		incomplete.clear();
		for (int i : model.assembly.contacts.order)
			if (!(model.assembly.state.contacts[i].joint.kn > 0)) incomplete.push_back(i);
	}
	for (int i : incomplete)
		if (const string missing = model.withoutJoint(i); !missing.empty()) throw std::runtime_error(missing + ": give it to BlockModel.bond");
}

void BlockLoop::computeForces(BlockModel& model, int threads)
{
	blocks::BlockAssembly& a = model.assembly;
	model.requireProperties();
	if (contact != a.contacts.wanted) blocks::setGeneralContact(a, contact);
	if (!law && !a.forces.before.status.empty()) a.forces.before = {}; // only other ways to drive the step need it, say behind a load
	if (law) {
		if (a.joints.anySoftens())
			throw std::runtime_error("BlockLoop.law: a law of one's own has no joints that soften; JointMat.GfI and GfII must be 0 with it");
		const LawOnRange own(*law, model);
		blocks::computeForces(a, own, scene->dt, scene->trackEnergy, threads);
	} else
		blocks::withOwnLaw(a, [&](const auto& its) { blocks::computeForces(a, its, scene->dt, scene->trackEnergy, threads); });
	if (contact) {
		showContacts(scene, model);
		requireContactJoints(model);
	}
}

YADE_PLUGIN((BlockLoop));

} // namespace yade
