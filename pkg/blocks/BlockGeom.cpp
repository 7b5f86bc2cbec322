// yade-blocks, GPL-2.0-or-later
#include "BlockGeom.hpp"
#include <blocks/kernel/ContactKinematics.hpp>
#include <blocks/kernel/NodalForces.hpp>

namespace yade {

BlockGeom::~BlockGeom()                                 = default;
Ig2_Block_Block_BlockGeom::~Ig2_Block_Block_BlockGeom() = default;

bool Ig2_Block_Block_BlockGeom::go(
        const shared_ptr<Shape>& shape1,
        const shared_ptr<Shape>&,
        const State&,
        const State&,
        const Vector3r&,
        const bool&,
        const shared_ptr<Interaction>& interaction)
{
	const Block* block1 = static_cast<const Block*>(shape1.get());
	if (!interaction->geom) return false; // bonded pairs have theirs from BlockModel::insert
	blocks::BlockAssembly& a    = block1->model->assembly;
	const blocks::Pair&    pair = a.pairs[static_cast<const BlockGeom*>(interaction->geom.get())->pair];
	blocks::updateKinematics(a, pair.first, pair.last);
	return true;
}

namespace {
	template <class Value> py::list eachPoint(const BlockGeom& geom, const Value& value)
	{
		if (!geom.model) throw std::runtime_error("BlockGeom.model is empty: it is made by BlockModel.insert");
		py::list    list;
		const auto& a    = geom.model->assembly;
		const auto& pair = a.pairs[geom.pair];
		for (int i = 2 * pair.first; i < 2 * pair.last; ++i)
			list.append(value(a, i));
		return list;
	}
}

py::tuple BlockGeom::points() const
{
	const py::list indices = eachPoint(*this, [](const blocks::BlockAssembly&, int i) { return i; });
	return py::make_tuple(indices[0], indices[-1] + 1);
}

py::list BlockGeom::positions() const
{
	return eachPoint(*this, [](const blocks::BlockAssembly& a, int i) { return Vector2r(blocks::contactPosition(a, i)); });
}
py::list BlockGeom::normals() const
{
	return eachPoint(*this, [](const blocks::BlockAssembly& a, int i) { return Vector2r(a.frames[i / 2].nx, a.frames[i / 2].ny); });
}
py::list BlockGeom::areas() const
{
	return eachPoint(*this, [](const blocks::BlockAssembly& a, int i) { return a.segments[i / 2].area; });
}
py::list BlockGeom::openings() const
{
	return eachPoint(*this, [](const blocks::BlockAssembly& a, int i) { return a.points[i].opening; });
}
py::list BlockGeom::slips() const
{
	return eachPoint(*this, [](const blocks::BlockAssembly& a, int i) { return a.points[i].slip; });
}

YADE_PLUGIN((BlockGeom)(Ig2_Block_Block_BlockGeom));

} // namespace yade
