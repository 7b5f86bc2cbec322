// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/step/ContactResults.hpp>
#include <blocks/kernel/step/Joints.hpp>
#include <blocks/views/BlockGeom.hpp>

namespace yade {

BlockGeom::~BlockGeom() = default;

namespace {
	template <class Value> py::list eachPoint(const BlockGeom& geom, const Value& value)
	{
		if (!geom.model) throw std::runtime_error("BlockGeom.model is empty: it is made by BlockModel.insert");
		py::list list;
		if (geom.pair < 0) return list;
		auto&       a    = geom.model->assembly;
		const auto& pair = a.joints.pairs[geom.pair];
		for (int i = 2 * pair.first; i < 2 * pair.last; ++i)
			list.append(value(a, i));
		return list;
	}
}

py::tuple BlockGeom::points() const
{
	const py::list indices = eachPoint(*this, [](const blocks::BlockAssembly&, int i) { return i; });
	return py::len(indices) ? py::make_tuple(indices[0], indices[-1] + 1) : py::make_tuple(0, 0);
}

py::list BlockGeom::ends() const
{
	py::list list;
	if (!model) return list;
	const blocks::BlockAssembly& a = model->assembly; // looking makes no new edition of the contacts
	if (contact < 0 || contact >= int(a.state.contacts.size())) return list;
	const auto& free = a.state.contacts[contact];
	for (int active = 0; active < int(free.active.size()); ++active)
		for (int k : { 0, 1 }) {
			const auto end = blocks::contactEnd(a, free, active, k);
			py::dict   entry;
			entry["position"] = Vector2r(end.position);
			entry["normal"]   = Vector2r(end.normal);
			entry["depth"]    = end.depth;
			entry["sigma"]    = end.sigma;
			entry["tau"]      = end.tau;
			entry["area"]     = end.area;
			list.append(entry);
		}
	return list;
}

py::list BlockGeom::positions() const
{
	return eachPoint(*this, [](const blocks::BlockAssembly& a, int i) { return Vector2r(blocks::contactPosition(a, i)); });
}
py::list BlockGeom::normals() const
{
	return eachPoint(*this, [](const blocks::BlockAssembly& a, int i) {
		const auto frame = blocks::frameOf(a, i / 2);
		return Vector2r(frame.nx, frame.ny);
	});
}
py::list BlockGeom::areas() const
{
	return eachPoint(*this, [](const blocks::BlockAssembly& a, int i) { return a.joints.columns.area[i / 2]; });
}
py::list BlockGeom::openings() const
{
	return eachPoint(*this, [](const blocks::BlockAssembly& a, int i) { return a.state.opening[i]; });
}
py::list BlockGeom::slips() const
{
	return eachPoint(*this, [](const blocks::BlockAssembly& a, int i) { return a.state.slip[i]; });
}

YADE_PLUGIN((BlockGeom));

} // namespace yade
