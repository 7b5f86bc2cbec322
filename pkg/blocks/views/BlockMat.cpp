// yade-blocks, GPL-2.0-or-later
#include <blocks/views/BlockMat.hpp>

namespace yade {

BlockMat::~BlockMat() = default;

YADE_PLUGIN((BlockMat));

} // namespace yade
