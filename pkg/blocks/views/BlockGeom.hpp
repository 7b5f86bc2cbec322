// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/views/Block.hpp>
#include <core/IGeom.hpp>
#include <core/Interaction.hpp>

namespace yade {

/// Where two blocks touch: a range of contact points in the model.
class BlockGeom : public IGeom {
public:
	virtual ~BlockGeom();

	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(BlockGeom, IGeom,
		"Contact points between two blocks. Each segment, an overlap of two edges, has one at either end; their areas add up to the common surface.",
		((shared_ptr<BlockModel>, model, , Attr::readonly, "The model that holds the points."))
		((int, pair, -1, Attr::readonly, "Index of the pair of bonded blocks in the model; -1: never bonded."))
		((int, contact, -1, Attr::readonly, "Index of the pair's free contact in the model; -1: none (see :yref:`BlockContacts`).")),
		createIndex();,
		.add_property("ends", &BlockGeom::ends, "Free contact, edge by edge, two ends each: list of dictionaries with position [m], normal (out of the "
			"first block), depth [m], sigma, tau [Pa], area [m2].")
		.add_property("points", &BlockGeom::points, "First and one-past-last contact point of the pair.")
		.add_property("positions", &BlockGeom::positions, "Contact points, midway between the blocks [m].")
		.add_property("normals", &BlockGeom::normals, "Unit normals at the contact points, out of the first block.")
		.add_property("areas", &BlockGeom::areas, "Areas of the contact points [m2].")
		.add_property("openings", &BlockGeom::openings, "Openings since bonding [m].")
		.add_property("slips", &BlockGeom::slips, "Slips since bonding [m].")
	);
	// clang-format on
	REGISTER_CLASS_INDEX(BlockGeom, IGeom);

	py::tuple points() const;
	py::list  ends() const;
	py::list  positions() const, normals() const, areas() const, openings() const, slips() const;
};
REGISTER_SERIALIZABLE(BlockGeom);

} // namespace yade
