// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/engines/BlockForces.hpp>
#include <blocks/engines/BlockLaw.hpp>

namespace yade {

class BlockLoop : public BlockForces {
public:
	virtual ~BlockLoop();

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(BlockLoop, BlockForces,
		"From where the blocks are to the forces on their grid points, in one pass over flat arrays: joints, contacts, zones, loads. Stands where YADE "
		"has its InteractionLoop; :yref:`BlockMotion` stands behind it. "
		"Joints need their properties beforehand, from :yref:`bond<BlockModel.bond>`. The same scene gives the same bits on any number of threads, and "
		"as with YADE's own InteractionLoop (:yref:`Ig2_Block_Block_BlockGeom`, :yref:`Law2_BlockGeom_JointPhys_MohrCoulomb`, :yref:`BlockForces`).",
		((bool, contact, false, , "General contact: broken joints become contacts that may slide along edges and past corners, part and meet again, "
			"with the residual properties; blocks that were never bonded may touch. With scaled masses a broken joint stays one until its edges have "
			"moved by 2 % of their length, up to where both say the same. A scene whose blocks keep their neighbours does without."))
		((shared_ptr<BlockLaw>, law, , , "A joint law of one's own in place of the brittle Mohr-Coulomb one; see :yref:`BlockLaw`."))
	);
	// clang-format on

protected:
	void computeForces(BlockModel&, int threads) override;
	bool stepsJoints() const override { return true; }

private:
	void requireContactJoints(const BlockModel&);

	long        knownContacts = -1; ///< version of the contacts at which `incomplete` was listed
	vector<int> incomplete;         ///< contacts without properties
};
REGISTER_SERIALIZABLE(BlockLoop);

} // namespace yade
