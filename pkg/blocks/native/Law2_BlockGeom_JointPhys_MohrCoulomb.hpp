// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/JointPhys.hpp>
#include <core/Dispatching.hpp>

namespace yade {

/// Joint stresses from opening and slip.
class Law2_BlockGeom_JointPhys_MohrCoulomb : public LawFunctor {
public:
	virtual ~Law2_BlockGeom_JointPhys_MohrCoulomb();
	bool go(shared_ptr<IGeom>&, shared_ptr<IPhys>&, Interaction*) override;

	// clang-format off
	YADE_CLASS_BASE_DOC(Law2_BlockGeom_JointPhys_MohrCoulomb, LawFunctor,
		"Brittle Mohr-Coulomb joint with tension cut-off (paper, section 2.2, Eqs. 1-3): elastic until sigma > tension or |tau| > cohesion - sigma "
		"tan(friction angle) "
		"(tension positive); then the residual strengths hold. Stresses stay at the contact points; :yref:`BlockForces` gathers them.");
	// clang-format on
	FUNCTOR2D(BlockGeom, JointPhys);
};
REGISTER_SERIALIZABLE(Law2_BlockGeom_JointPhys_MohrCoulomb);

} // namespace yade
