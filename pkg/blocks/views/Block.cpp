// yade-blocks, GPL-2.0-or-later
#include <blocks/views/Block.hpp>

namespace yade {

Block::~Block() = default;

const blocks::BlockAssembly& Block::assembly() const
{
	if (!model) throw std::runtime_error("Block.model is empty: blocks are made by BlockModel.insert");
	return model->assembly;
}

py::list Block::outline() const
{
	py::list    list;
	const auto& a = assembly();
	for (int e = a.mesh.firstEdge[index]; e < a.mesh.firstEdge[index + 1]; ++e)
		list.append(Vector2r(a.position(a.mesh.edgeNodes[e][0])));
	return list;
}

Vector2r Block::force() const
{
	Vector2r    sum = Vector2r::Zero();
	const auto& a   = assembly();
	for (int n = a.mesh.firstNode[index]; n < a.mesh.firstNode[index + 1]; ++n)
		sum += a.forces.nodal[n];
	return sum;
}

py::tuple Block::nodes() const { return py::make_tuple(assembly().mesh.firstNode[index], assembly().mesh.firstNode[index + 1]); }
py::tuple Block::zones() const { return py::make_tuple(assembly().mesh.firstZone[index], assembly().mesh.firstZone[index + 1]); }

YADE_PLUGIN((Block));

} // namespace yade
