// yade-blocks, GPL-2.0-or-later
#include <blocks/views/ContactViews.hpp>
#include <blocks/views/JointPhys.hpp>
#include <core/Interaction.hpp>
#include <core/InteractionContainer.hpp>
#include <utility>

namespace yade {

namespace {
	BlockGeom* geomOf(const shared_ptr<Interaction>& interaction) { return interaction ? dynamic_cast<BlockGeom*>(interaction->geom.get()) : nullptr; }

	void point(Interaction& interaction, int contact)
	{
		static_cast<BlockGeom*>(interaction.geom.get())->contact = contact;
		if (auto* phys = dynamic_cast<JointPhys*>(interaction.phys.get())) phys->contact = contact;
	}

	shared_ptr<Interaction> show(BlockModel& model, int contact)
	{
		const blocks::FreeContact& c           = std::as_const(model.assembly).state.contacts[contact]; // looking makes no new edition
		const auto                 self        = YADE_PTR_CAST<BlockModel>(model.shared_from_this());
		auto                       interaction = shared_ptr<Interaction>(new Interaction(model.firstBody + c.block[0], model.firstBody + c.block[1]));
		auto                       geom        = shared_ptr<BlockGeom>(new BlockGeom);
		geom->model                            = self;
		interaction->geom                      = geom;
		if (c.joint.kn > 0) {
			auto phys         = shared_ptr<JointPhys>(new JointPhys);
			phys->model       = self;
			phys->fromBond    = true;
			interaction->phys = phys;
		}
		return interaction;
	}

	/// Whether every contact that is shown is still there, in the same place.
	bool allAreLeft(const BlockModel& model)
	{
		const auto& all   = model.assembly.state.contacts;
		const auto& shown = model.shownBlocks;
		if (shown.size() > all.size()) return false;
		for (size_t i = 0; i < shown.size(); ++i)
			if (shown[i][0] >= 0 && shown[i] != all[i].block) return false;
		return true;
	}

	void showContact(Scene* scene, BlockModel& model, int i)
	{
		const auto& block = std::as_const(model.assembly).state.contacts[i].block;
		auto        known = scene->interactions->find(model.firstBody + block[0], model.firstBody + block[1]);
		if (!geomOf(known)) {
			if (known) scene->interactions->erase(known->id1, known->id2, known->linIx); // what a collider left, which has nothing in it
			known = show(model, i);
			scene->interactions->insert(known);
		}
		point(*known, i);
		model.shownBlocks[i] = block;
	}
}

void showContacts(Scene* scene, BlockModel& model)
{
	const blocks::BlockAssembly& a = model.assembly;
	if (model.shownContacts == a.contacts.version) return;
	model.shownContacts = a.contacts.version;
	model.stiffnessChanged();
	if (!model.showsInteractions) return;

	vector<shared_ptr<Interaction>> gone;
	if (model.shownBlocks.empty() || !allAreLeft(model)) {
		model.shownBlocks.clear();
		for (const auto& interaction : *scene->interactions)
			if (auto* geom = geomOf(interaction)) {
				if (geom->contact < 0 && geom->pair >= 0) continue;
				point(*interaction, -1);
				if (geom->pair < 0) gone.push_back(interaction);
			}
	}
	model.shownBlocks.resize(a.state.contacts.size(), { -1, -1 });
	for (int i : a.contacts.order)
		if (model.shownBlocks[i][0] < 0) showContact(scene, model, i);
	for (const auto& interaction : gone)
		if (geomOf(interaction)->contact < 0) scene->interactions->erase(interaction->id1, interaction->id2, interaction->linIx);
}

void showAllContacts(Scene* scene, BlockModel& model)
{
	model.shownBlocks.clear();
	showContacts(scene, model);
}

} // namespace yade
