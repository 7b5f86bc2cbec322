// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/geometry/Tessellation.hpp>
#include <blocks/kernel/geometry/Zoning.hpp>
#include <blocks/python/ModelPython.hpp>

/// What Python sees of a BlockModel: its building.
namespace yade {

using blocks::BlockAssembly;
using blocks::Vec2;

namespace {

	// ---- from Python

	blocks::Ring ring(const py::object& points)
	{
		const py::object list = py::import("numpy").attr("asarray")(points, "float64").attr("reshape")(-1, 2).attr("tolist")();
		blocks::Ring     out;
		for (long i = 0; i < py::len(list); ++i)
			out.push_back({ py::extract<Real>(list[i][0]), py::extract<Real>(list[i][1]) });
		return out;
	}

	blocks::Polygon polygon(const py::object& outer, const py::object& holes)
	{
		blocks::Polygon out { ring(outer), {} };
		for (long i = 0; i < py::len(holes); ++i)
			out.holes.push_back(ring(holes[i]));
		return out;
	}

	blocks::Zones zonesOf(const blocks::Ring& outline, const string& zoning)
	{
		if (zoning == "fan") return blocks::fanZones(outline);
		if (zoning == "corners") return blocks::cornerZones(outline);
		throw std::invalid_argument("zoning of cells must be 'fan' or 'corners', got '" + zoning + "'");
	}

	// ---- building

	py::dict addVoronoi(
		BlockModel&       model,
		const py::object& outer,
		const string&     material,
		Real              size,
		const string&     sizeMeaning,
		int               lloyd,
		long              seed,
		const py::object& holes,
		const py::object& seeds,
		Real              mergeFraction,
		const string&     zoning)
	{
		model.requireOpen("BlockModel.addVoronoi");
		if (sizeMeaning != "edge" && sizeMeaning != "sqrtArea")
			throw std::invalid_argument("sizeMeaning must be 'edge' or 'sqrtArea', got '" + sizeMeaning + "'");
		blocks::require(seed >= 0, "seed must not be negative", Real(seed));
		const int material_ = model.materialIndex(material);

		blocks::TessellationOptions options;
		options.size    = size;
		options.meaning = sizeMeaning == "edge" ? blocks::SizeMeaning::edge : blocks::SizeMeaning::sqrtArea;
		options.lloyd   = lloyd;
		options.seed    = seed;
		options.seeds   = ring(seeds);
		if (!(mergeFraction < 0)) options.mergeFraction = mergeFraction;
		const blocks::Polygon region = polygon(outer, holes);
		blocks::requireSimple(region, "region");
		model.requireFree(region);
		const blocks::Cells cells = blocks::tessellate(region, options);
		if (zoning != "fan" && zoning != "corners") zonesOf({}, zoning); // refuses before anything is added
		model.claim(region);

		const int first = model.assembly.blockCount();
		for (size_t i = 0; i < cells.cells.size(); ++i) {
			const blocks::Zones zones = zonesOf(blocks::ringOf(cells, i), zoning);
			model.assembly.addBlock(zones.points, zones.rings, zones.triangles, material_);
		}
		py::dict out;
		out["blocks"]       = py::make_tuple(first, model.assembly.blockCount());
		out["meanEdge"]     = cells.meanEdge;
		out["meanSqrtArea"] = cells.meanSqrtArea;
		return out;
	}

	int addRegion(
		BlockModel&       model,
		const py::object& outer,
		const string&     material,
		Real              zoneSize,
		const py::object& holes,
		bool              conforming,
		const string&     zoning)
	{
		model.requireOpen("BlockModel.addRegion");
		const int       material_ = model.materialIndex(material);
		blocks::Polygon region    = polygon(outer, holes);
		blocks::requireSimple(region, "region");
		model.requireFree(region);
		const blocks::Polygon claimed = region;
		BlockAssembly&        a       = model.assembly;
		blocks::Outline       outline = blocks::Outline::split;
		if (conforming) { // the neighbours' boundary points become this block's own
			std::vector<Vec2> points;
			for (const auto& edge : a.mesh.edgeNodes)
				points.push_back(a.position(edge[0]));
			const size_t corners   = region.outer.size();
			const Real   tolerance = 1e-6 * std::sqrt(std::abs(blocks::signedArea(region.outer)));
			region.outer           = blocks::withPointsOnEdges(region.outer, points, tolerance);
			if (region.outer.size() > corners) outline = blocks::Outline::kept;
		}
		blocks::Zones zones;
		if (zoning == "regular")
			zones = blocks::regularZones(region.outer, zoneSize);
		else if (zoning == "delaunay")
			zones = blocks::delaunayZones(region, zoneSize, outline);
		else
			zones = zonesOf(region.outer, zoning);
		const int block = a.addBlock(zones.points, zones.rings, zones.triangles, material_);
		model.claim(claimed);
		return block;
	}

	int addRigid(BlockModel& model, const py::object& outer, const string& material, const py::object& holes)
	{
		model.requireOpen("BlockModel.addRigid");
		const int             material_ = model.materialIndex(material);
		const blocks::Polygon region    = polygon(outer, holes);
		blocks::requireSimple(region, "region");
		model.requireFree(region);
		std::vector<Vec2>             points;
		std::vector<std::vector<int>> rings;
		auto                          add = [&](const blocks::Ring& ring) {
                        rings.emplace_back();
                        for (const Vec2& p : ring) {
                                rings.back().push_back(int(points.size()));
                                points.push_back(p);
                        }
		};
		add(region.outer);
		for (const auto& hole : region.holes)
			add(hole);
		const int block = model.assembly.addBlock(points, rings, {}, material_);
		model.claim(region);
		return block;
	}

	int bond(BlockModel& model, const py::object& joints, Real tolerance)
	{
		const py::extract<Real> number(joints);
		if (number.check()) return model.bond({}, number()); // the first argument was the tolerance once
		return model.bond(checkedJoints(joints), tolerance);
	}

} // namespace

void BlockModelPython::visit(PythonModel& c) const
{
	defineSupports(c);
	defineArrays(c);
	defineJoints(c);
	using py::arg;
	c.def("addVoronoi",
	      &addVoronoi,
	      (arg("outline"),
	       arg("material"),
	       arg("size"),
	       arg("sizeMeaning")   = "sqrtArea",
	       arg("lloyd")         = 2,
	       arg("seed")          = 1,
	       arg("holes")         = py::tuple(),
	       arg("seeds")         = py::tuple(),
	       arg("mergeFraction") = -1.,
	       arg("zoning")        = "fan"),
	      "Fills a simple polygon, with holes, with Voronoi blocks of a material (a label in O.materials). outline: counter-clockwise points, shape (n, 2) "
	      "[m]; "
	      "size: mean edge or mean sqrt(area) of the cells, as sizeMeaning ('edge', 'sqrtArea') says [m]; lloyd: iterations towards regular cells; seed: "
	      "of the random points; "
	      "seeds: explicit points instead; mergeFraction: edges shorter than this fraction of the size are merged (negative: the default); zoning: 'fan' "
	      "(a grid point in the middle) or 'corners'. "
	      "Returns {'blocks': (first, last+1), 'meanEdge': [m], 'meanSqrtArea': [m]}. Errors: ValueError for polygons that cross themselves or another "
	      "region, and impossible sizes.")
		.def("addRegion",
	             &addRegion,
	             (arg("outline"), arg("material"), arg("zoneSize"), arg("holes") = py::tuple(), arg("conforming") = true, arg("zoning") = "delaunay"),
	             "Adds one block: a simple polygon meshed with zones of the given size [m]. zoning: 'delaunay', 'regular' (rectangles), 'fan' or "
	             "'corners'. "
	             "conforming: boundary points of the blocks that are there already become its own where they lie on its outline. Returns the block's "
	             "index.")
		.def("addRigid",
	             &addRigid,
	             (arg("outline"), arg("material"), arg("holes") = py::tuple()),
	             "Adds a rigid block: a platen or a support, of any simple outline [m], counter-clockwise, with holes. It has no zones; its density is the "
	             "material's, its joints and contacts are those of the "
	             "material pair. Its body moves by YADE's own means: it is free in the plane at first (blockedDOFs 'zXY'), and with "
	             "``O.bodies[model.bodyOf(block)].state`` it is held (blockedDOFs 'xyzXYZ'), "
	             "driven (vel, angVel), loaded (ForceEngine, ``O.forces``). O.engines then needs ForceResetter first and, unless all rigid blocks are "
	             "held, NewtonIntegrator between BlockLoop and BlockMotion. "
	             "``O.forces.f(id)`` is the sum of all forces on it, so the reaction of a held one is its opposite. Weight comes from "
	             ":yref:`gravity<BlockModel.gravity>`; NewtonIntegrator.gravity must stay zero. "
	             "Masses are scaled in quasi-static runs. Outlines need not share points with those of neighbours to be bonded. Returns the block's index.")
		.def("bodyOf", &BlockModel::bodyOf, (arg("block")), "Id of the body of a block; after insert().")
		.def("bond",
	             &bond,
	             (arg("joints") = py::tuple(), arg("tolerance") = 1e-6),
	             "Finds the joints: overlaps of facing edges, apart by no more than tolerance times their length. joints: a list of :yref:`JointMat`, the "
	             "properties for every pair of materials that touch (without it they must come from :yref:`Ip2_BlockMat_BlockMat_JointPhys`). To be called "
	             "once, after all blocks. Returns the number of pairs. Errors: ValueError where blocks overlap, for a pair of materials that touch without "
	             "a "
	             "JointMat, and for impossible properties.")
		.def("insert",
	             &BlockModel::insert,
	             (arg("interactions") = true),
	             "Hands the model over to the scene: one Body a block into O.bodies, one Interaction a pair into O.interactions (and one a free contact, "
	             "while it lasts). interactions=False leaves those out, for scenes in which an InteractionLoop works on other bodies only, and for very "
	             "large "
	             "ones; :yref:`BlockLoop` does without.");
}

} // namespace yade
