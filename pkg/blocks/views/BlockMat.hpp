// yade-blocks, GPL-2.0-or-later
#pragma once
#include <core/Dispatching.hpp>
#include <pkg/common/ElastMat.hpp>

namespace yade {

/// Elastic material of blocks.
class BlockMat : public ElastMat {
public:
	virtual ~BlockMat();

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(BlockMat, ElastMat,
		"Isotropic linear elastic material of deformable blocks: young [Pa], poisson in (-1, 0.5), density [kg/m3]. What happens between blocks is "
		"said by :yref:`JointMat`.",
		/*attrs*/,
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(BlockMat, ElastMat);
};
REGISTER_SERIALIZABLE(BlockMat);

} // namespace yade
