// yade-blocks, GPL-2.0-or-later
#include <blocks/views/BlockState.hpp>

namespace yade {

BlockState::~BlockState() = default;

Vector3r BlockState::centroid() const
{
	if (!model) return se3.position;
	const blocks::Vec2 x = model->assembly.centroid(index);
	return { x.x(), x.y(), 0 };
}

Vector3r BlockState::velocity() const
{
	Vector3r sum   = Vector3r::Zero();
	Real     total = 0;
	if (!model) return sum;
	const auto& a = model->assembly;
	for (int n = a.mesh.firstNode[index]; n < a.mesh.firstNode[index + 1]; ++n) {
		sum += a.mesh.mass[n] * Vector3r(a.state.velocity[n].x(), a.state.velocity[n].y(), 0);
		total += a.mesh.mass[n];
	}
	return total > 0 ? Vector3r(sum / total) : sum; // a removed block has no mass
}

void BlockState::refuse(const py::object&)
{
	throw std::invalid_argument("the motion of a deformable block is that of its grid points: use BlockModel.drive, or write to BlockModel.displacement "
	                            "and BlockModel.velocity");
}

YADE_PLUGIN((BlockState));

} // namespace yade
