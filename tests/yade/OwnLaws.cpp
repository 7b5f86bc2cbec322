// yade-blocks, GPL-2.0-or-later
#include <blocks/engines/BlockLaw.hpp>
#include <blocks/kernel/step/Contacts.hpp>
#include <blocks/views/JointPhys.hpp>
#include <core/Dispatching.hpp>

/// Joint laws of one's own, as a plugin beside yadeblocks has them: for BlockLoop.law, with columns, and as a Law2 for YADE's InteractionLoop.
namespace yade {

/// Joints that yield the more in shear the farther they have slid to and fro: tau = ks us / (1 + wear/w).
class WearLaw : public BlockLaw {
public:
	virtual ~WearLaw() = default;
	const vector<string>& columns() const override
	{
		static const vector<string> names { "wear", "slipBefore" };
		return names;
	}
	void advance(BlockModel& model, blocks::JointRange range) const override
	{
		auto&         s    = model.assembly.state;
		vector<Real>& wear = s.lawColumns["wear"];
		vector<Real>& last = s.lawColumns["slipBefore"];
		for (int i = 2 * range.first; i < 2 * range.last; ++i) {
			const blocks::JointParams& p = model.assembly.joints.ofPoint(i);
			wear[i] += std::abs(s.slip[i] - last[i]);
			last[i]    = s.slip[i];
			s.sigma[i] = p.kn * s.opening[i];
			s.tau[i]   = p.ks * s.slip[i] / (1 + wear[i] / w);
		}
	}

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(WearLaw, BlockLaw, "Joints that wear.", ((Real, w, 1e-5, , "Wear at which half of the shear stiffness is left [m].")));
	// clang-format on
};
REGISTER_SERIALIZABLE(WearLaw);

/// Elastic up to the tensile strength; nothing but closing stresses from then on.
static void cutOff(blocks::BlockAssembly& a, blocks::JointRange range)
{
	auto& s = a.state;
	for (int i = 2 * range.first; i < 2 * range.last; ++i) {
		const blocks::JointParams& p = a.joints.ofPoint(i);
		if (s.status[i] == blocks::Joint::intact && p.kn * s.opening[i] > p.tension) s.status[i] = blocks::Joint::brokenInTension;
		const bool whole = s.status[i] == blocks::Joint::intact;
		s.sigma[i]       = whole || s.opening[i] < 0 ? p.kn * s.opening[i] : 0;
		s.tau[i]         = whole ? p.ks * s.slip[i] : 0;
	}
}

class CutOffLaw : public BlockLaw {
public:
	virtual ~CutOffLaw() = default;
	void advance(BlockModel& model, blocks::JointRange range) const override { cutOff(model.assembly, range); }

	// clang-format off
	YADE_CLASS_BASE_DOC(CutOffLaw, BlockLaw, "Joints with a tension cut-off, and no friction.");
	// clang-format on
};
REGISTER_SERIALIZABLE(CutOffLaw);

/// The same in YADE's InteractionLoop. A pair of blocks has joints, a free contact, or both.
class Law2_BlockGeom_JointPhys_CutOff : public LawFunctor {
public:
	virtual ~Law2_BlockGeom_JointPhys_CutOff() = default;
	bool go(shared_ptr<IGeom>& geom, shared_ptr<IPhys>&, Interaction*) override
	{
		const auto& g = static_cast<const BlockGeom&>(*geom);
		auto&       a = g.model->assembly;
		if (g.pair >= 0) cutOff(a, blocks::jointsOf(a, g.pair));
		if (g.contact >= 0) blocks::advanceContact(a, g.contact, scene->dt);
		return true;
	}

	// clang-format off
	YADE_CLASS_BASE_DOC(Law2_BlockGeom_JointPhys_CutOff, LawFunctor, "Joints with a tension cut-off, and no friction.");
	// clang-format on
	FUNCTOR2D(BlockGeom, JointPhys);
};
REGISTER_SERIALIZABLE(Law2_BlockGeom_JointPhys_CutOff);

YADE_PLUGIN((WearLaw)(CutOffLaw)(Law2_BlockGeom_JointPhys_CutOff));

} // namespace yade
