// yade-blocks, GPL-2.0-or-later
#include "Block.hpp"

namespace yade {

Block::~Block()       = default;
BlockMat::~BlockMat() = default;

py::list Block::outline() const
{
	py::list    list;
	const auto& a = model->assembly;
	for (int e = a.firstEdge[index]; e < a.firstEdge[index + 1]; ++e)
		list.append(Vector2r(a.position[a.edgeNodes[e][0]]));
	return list;
}

Vector2r Block::force() const
{
	Vector2r    sum = Vector2r::Zero();
	const auto& a   = model->assembly;
	for (int n = a.firstNode[index]; n < a.firstNode[index + 1]; ++n)
		sum += a.force[n];
	return sum;
}

py::tuple Block::nodes() const { return py::make_tuple(model->assembly.firstNode[index], model->assembly.firstNode[index + 1]); }
py::tuple Block::zones() const { return py::make_tuple(model->assembly.firstZone[index], model->assembly.firstZone[index + 1]); }

YADE_PLUGIN((Block)(BlockMat));

} // namespace yade
