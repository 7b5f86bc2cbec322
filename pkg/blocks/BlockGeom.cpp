// yade-blocks, GPL-2.0-or-later
#include "BlockGeom.hpp"
#include <blocks/kernel/model/FreeContacts.hpp>
#include <blocks/kernel/step/ContactKinematics.hpp>
#include <blocks/kernel/step/NodalForces.hpp>

namespace yade {

BlockGeom::~BlockGeom()                                 = default;
Ig2_Block_Block_BlockGeom::~Ig2_Block_Block_BlockGeom() = default;

bool Ig2_Block_Block_BlockGeom::go(
	const shared_ptr<Shape>& shape1,
	const shared_ptr<Shape>& shape2,
	const State&,
	const State&,
	const Vector3r&,
	const bool&,
	const shared_ptr<Interaction>& interaction)
{
	auto  index = [](const shared_ptr<Shape>& shape) { return static_cast<const Block*>(shape.get())->index; };
	auto* geom  = static_cast<BlockGeom*>(interaction->geom.get());
	if (!geom) { // a pair that the collider has found; bonded ones have theirs from BlockModel::insert
		interaction->geom = shared_ptr<BlockGeom>(geom = new BlockGeom);
		geom->model       = static_cast<const Block*>(shape1.get())->model;
	}
	blocks::BlockAssembly& a = geom->model->assembly;
	if (!a.contacts.wanted) { // bonds are all there is
		if (geom->pair >= 0)
			blocks::updateKinematics(a, a.joints.pairs[geom->pair].first, a.joints.pairs[geom->pair].last);
		else
			geom->model->complain(
				"a collider has found blocks " + std::to_string(index(shape1)) + " and " + std::to_string(index(shape2))
				+ " near each other: O.engines needs BlockContacts in front of it, which makes their contacts");
		return geom->pair >= 0;
	}
	if (geom->contactsVersion != a.contacts.version) {
		geom->contactsVersion = a.contacts.version;
		geom->contact         = a.contacts.order.empty() ? -1 : blocks::contactOf(a, index(shape1), index(shape2), geom->contact);
	}
	if (geom->pair >= 0) blocks::updateKinematics(a, a.joints.pairs[geom->pair].first, a.joints.pairs[geom->pair].last, blocks::Which::unreleased);
	if (geom->contact >= 0)
		blocks::updateContact(a, geom->contact);
	else if (geom->pair < 0 && !interaction->isReal()) {
		if (scene->iter % requestInterval == 0) blocks::requestContact(a, index(shape1), index(shape2));
		return false;
	}
	return true;
}

namespace {
	template <class Value> py::list eachPoint(const BlockGeom& geom, const Value& value)
	{
		if (!geom.model) throw std::runtime_error("BlockGeom.model is empty: it is made by BlockModel.insert");
		py::list list;
		if (geom.pair < 0) return list;
		auto&       a    = geom.model->assembly;
		const auto& pair = a.joints.pairs[geom.pair];
		blocks::updateKinematics(a, pair.first, pair.last, blocks::Which::released);
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
	if (!model || contact < 0 || contact >= int(model->assembly.contacts.all.size())) return list;
	const auto& free = model->assembly.contacts.all[contact];
	for (int active = 0; active < int(free.active.size()); ++active)
		for (int k : { 0, 1 }) {
			const auto end = blocks::contactEnd(model->assembly, free, active, k);
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
	return eachPoint(*this, [](const blocks::BlockAssembly& a, int i) { return Vector2r(a.frames[i / 2].nx, a.frames[i / 2].ny); });
}
py::list BlockGeom::areas() const
{
	return eachPoint(*this, [](const blocks::BlockAssembly& a, int i) { return a.joints.segments[i / 2].area; });
}
py::list BlockGeom::openings() const
{
	return eachPoint(*this, [](const blocks::BlockAssembly& a, int i) { return a.state.opening[i]; });
}
py::list BlockGeom::slips() const
{
	return eachPoint(*this, [](const blocks::BlockAssembly& a, int i) { return a.state.slip[i]; });
}

YADE_PLUGIN((BlockGeom)(Ig2_Block_Block_BlockGeom));

} // namespace yade
