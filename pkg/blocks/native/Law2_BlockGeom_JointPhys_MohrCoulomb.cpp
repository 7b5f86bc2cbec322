// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/step/Contacts.hpp>
#include <blocks/kernel/step/Joints.hpp>
#include <blocks/native/Law2_BlockGeom_JointPhys_MohrCoulomb.hpp>

namespace yade {

Law2_BlockGeom_JointPhys_MohrCoulomb::~Law2_BlockGeom_JointPhys_MohrCoulomb() = default;

bool Law2_BlockGeom_JointPhys_MohrCoulomb::go(shared_ptr<IGeom>& geom, shared_ptr<IPhys>&, Interaction*)
{
	const auto* g = dynamic_cast<const BlockGeom*>(geom.get());
	if (!g || !g->model) return true; // Ig2_Block_Block_BlockGeom has complained
	auto& a = g->model->assembly;
	if (g->pair >= 0) blocks::withOwnLaw(a, [&](const auto& law) { blocks::advanceStresses(a, blocks::jointsOf(a, g->pair), law); });
	if (g->contact >= 0) {
		if (const string missing = g->model->withoutJoint(g->contact); !missing.empty()) g->model->complain(missing);
		blocks::advanceContact(a, g->contact, scene->dt);
	}
	return g->pair >= 0 || g->contact >= 0; // blocks that have parted are no more
}

YADE_PLUGIN((Law2_BlockGeom_JointPhys_MohrCoulomb));

} // namespace yade
