// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/geometry/EdgeDivision.hpp>
#include <blocks/kernel/geometry/Polygon.hpp>
#include <blocks/kernel/geometry/PolygonRules.hpp>
#include <blocks/kernel/geometry/Tessellation.hpp>
#include <blocks/kernel/geometry/Zoning.hpp>
#include <blocks/kernel/model/Outline.hpp>
#include <blocks/python/ModelPython.hpp>
#include <blocks/python/Polygons.hpp>
#include <blocks/views/Materials.hpp>
#include <map>

/// What Python sees of a BlockModel's building: regions become blocks, blocks are bonded. A refusal adds nothing.
namespace yade {

using blocks::BlockAssembly;
using blocks::Vec2;

namespace {

	const std::map<string, blocks::Zoning> zonings { { "fan", blocks::Zoning::fan },
		                                         { "corners", blocks::Zoning::corners },
		                                         { "regular", blocks::Zoning::regular },
		                                         { "delaunay", blocks::Zoning::delaunay } };

	constexpr Real trianglesOfCell = 6; ///< cells have six edges on average

	constexpr Real shortestEdge = 1e-9; ///< of a region, by its outline; nobody means so short ones, and zones behind them would be as thin

	/// A region on its way to become blocks: checked when it is made, and all or none of its blocks are added.
	class Addition {
	public:
		Addition(BlockModel& m, const char* method, blocks::Polygon outline, const string& label)
			: region(std::move(outline))
			, model(m)
			, material(label)
		{
			model.requireOpen(method);
			trial.thickness = model.assembly.thickness;
			trial.addMaterial(materialOf(model, material));
			blocks::requireSimple(this->region, "region");
			blocks::requireLongEdges(this->region, shortestEdge, "region");
			model.requireFree(this->region);
		}
		const blocks::Polygon region;

		/// Takes note of a block; refuses one that the assembly would refuse.
		void add(blocks::Zones zones)
		{
			trial.addBlock(zones.points, zones.rings, zones.triangles, 0);
			noted.push_back(std::move(zones));
		}

		/// Adds the blocks to the model; the index of the first.
		int commit()
		{
			const int index = model.materialIndex(material), first = model.assembly.blockCount();
			for (const blocks::Zones& zones : noted)
				model.assembly.addBlock(zones.points, zones.rings, zones.triangles, index);
			model.claim(region);
			return first;
		}

	private:
		BlockModel&                model;
		const string               material;
		BlockAssembly              trial;
		std::vector<blocks::Zones> noted;
	};

	enum class Shape { voronoi, triangles };

	/// Fills a region with cells or the triangles of cells.
	py::dict addCells(
		Shape             shape,
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
		const string&     zoning,
		int               edgeSegments)
	{
		const bool triangles = shape == Shape::triangles;
		Addition   addition(model, triangles ? "BlockModel.addTriangles" : "BlockModel.addVoronoi", polygon(outer, holes), material);
		if (sizeMeaning != "edge" && sizeMeaning != "sqrtArea")
			throw std::invalid_argument("sizeMeaning must be 'edge' or 'sqrtArea', got '" + sizeMeaning + "'");
		if (zoning != "fan" && zoning != "corners") throw std::invalid_argument("zoning of cells must be 'fan' or 'corners', got '" + zoning + "'");
		blocks::require(seed >= 0, "seed must not be negative", Real(seed));
		blocks::require(size > 0 || py::len(seeds) > 0, "size must be positive [m]", size);
		blocks::require(edgeSegments >= 1 && edgeSegments <= 100, "edgeSegments must lie in [1, 100]", edgeSegments);

		blocks::TessellationOptions options;
		options.size    = triangles && sizeMeaning == "sqrtArea" ? std::sqrt(trianglesOfCell) * size : size;
		options.meaning = sizeMeaning == "edge" ? blocks::SizeMeaning::edge : blocks::SizeMeaning::sqrtArea;
		options.lloyd   = lloyd;
		options.seed    = seed;
		options.seeds   = ring(seeds);
		if (!(mergeFraction < 0)) options.mergeFraction = mergeFraction;
		const blocks::Cells cells = blocks::tessellate(addition.region, options);

		std::map<blocks::Zoning, int> counts;
		Real                          edges = 0, roots = 0;
		long                          edgeCount = 0, blockCount = 0;
		for (size_t i = 0; i < cells.cells.size(); ++i) {
			const blocks::Ring ring = blocks::ringOf(cells, i);
			for (const blocks::Ring& outline : triangles ? blocks::trianglesOf(ring) : std::vector<blocks::Ring> { ring }) {
				for (size_t k = 0; k < outline.size(); ++k)
					edges += (outline[(k + 1) % outline.size()] - outline[k]).norm(), ++edgeCount;
				roots += std::sqrt(blocks::signedArea(outline)), ++blockCount;
				blocks::CellZones cell = blocks::cellZones(blocks::withEdgesDivided(outline, edgeSegments), zonings.at(zoning));
				addition.add(std::move(cell.zones));
				++counts[cell.zoning];
			}
		}
		const int first = addition.commit();
		py::dict  out, zoned;
		for (const char* name : { "fan", "corners", "delaunay" })
			zoned[name] = counts[zonings.at(name)];
		out["blocks"]       = py::make_tuple(first, model.assembly.blockCount());
		out["meanEdge"]     = triangles ? edges / edgeCount : cells.meanEdge;
		out["meanSqrtArea"] = triangles ? roots / blockCount : cells.meanSqrtArea;
		out["zoning"]       = zoned;
		return out;
	}

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
		const string&     zoning,
		int               edgeSegments)
	{
		return addCells(Shape::voronoi, model, outer, material, size, sizeMeaning, lloyd, seed, holes, seeds, mergeFraction, zoning, edgeSegments);
	}

	py::dict addTriangles(
		BlockModel&       model,
		const py::object& outer,
		const string&     material,
		Real              size,
		const string&     sizeMeaning,
		int               lloyd,
		long              seed,
		const py::object& holes,
		Real              mergeFraction,
		const string&     zoning,
		int               edgeSegments)
	{
		const py::tuple random;
		return addCells(Shape::triangles, model, outer, material, size, sizeMeaning, lloyd, seed, holes, random, mergeFraction, zoning, edgeSegments);
	}

	/// The region with those boundary points of the blocks that are there which lie on its outline. What is thin counts by its width: the far side of a
	/// sliver does not lie on the edge along its near one.
	blocks::Polygon withNeighboursPoints(const BlockAssembly& a, blocks::Polygon region)
	{
		const Real own = std::min(std::sqrt(blocks::signedArea(region)), blocks::meanWidth(region));
		Vec2       low = region.outer[0], high = low;
		for (const Vec2& p : region.outer)
			low = low.cwiseMin(p), high = high.cwiseMax(p);
		for (int block = 0; block < a.blockCount(); ++block) {
			std::vector<Vec2> points;
			for (int e = a.mesh.firstEdge[block]; e < a.mesh.firstEdge[block + 1]; ++e) {
				const Vec2 p = a.position(a.mesh.edgeNodes[e][0]);
				if (((p - low).array() >= -1e-6 * own).all() && ((high - p).array() >= -1e-6 * own).all()) points.push_back(p);
			}
			if (points.empty()) continue;
			region = blocks::withPointsOnEdges(region, points, 1e-6 * std::min(own, blocks::meanWidth(blocks::outlineOf(a, block))));
		}
		return region;
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
		Addition addition(model, "BlockModel.addRegion", polygon(outer, holes), material);
		if (!zonings.count(zoning))
			throw std::invalid_argument("zoning of a region must be 'delaunay', 'regular', 'fan' or 'corners', got '" + zoning + "'");
		const blocks::Polygon outline = conforming ? withNeighboursPoints(model.assembly, addition.region) : addition.region;
		addition.add(blocks::regionZones(outline, zonings.at(zoning), zoneSize));
		return addition.commit();
	}

	int addRigid(BlockModel& model, const py::object& outer, const string& material, const py::object& holes)
	{
		Addition addition(model, "BlockModel.addRigid", polygon(outer, holes), material);
		addition.add(blocks::outlineOf(addition.region));
		return addition.commit();
	}

	int bond(BlockModel& model, const py::object& joints, Real tolerance)
	{
		const py::extract<Real> number(joints);
		if (number.check()) return model.bond({}, number()); // the first argument was the tolerance once
		return model.bond(checkedJoints(joints), tolerance);
	}

} // namespace

void defineBuilding(PythonModel& c)
{
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
	       arg("zoning")        = "fan",
	       arg("edgeSegments")  = 1),
	      "Fills a simple polygon, with holes, with Voronoi blocks of a material (a label in O.materials). outline: counter-clockwise points, shape (n, 2) "
	      "[m]; holes: such lists, in either direction; "
	      "size: mean edge or mean sqrt(area) of the cells, as sizeMeaning ('edge', 'sqrtArea') says [m]; lloyd: iterations towards regular cells; seed: "
	      "of the random points; "
	      "seeds: explicit points instead; mergeFraction: edges shorter than this fraction of the size are merged (negative: the default); edgeSegments: "
	      "equal parts of every edge, each a joint of its own, so that contact points lie inside edges too and not only where three joints meet (cut into "
	      "n, "
	      "a joint is 1 + 2/n^2 times as stiff and strong in bending as the edge it stands for); zoning: 'fan' "
	      "(a grid point in the middle) or 'corners' (none). A cell of which no point sees every edge, or whose zones would be slivers (longest edge by "
	      "least height above 30, where an equilateral triangle has 1), gets that zoning of 'fan', 'corners' and 'delaunay' (a mesh as addRegion makes "
	      "them) whose worst zone is the least flat. "
	      "Returns {'blocks': (first, last+1), 'meanEdge': [m], 'meanSqrtArea': [m], 'zoning': number of cells by zoning}. Errors: ValueError for polygons "
	      "that cross themselves or another region, and impossible sizes; nothing is added then.")
		.def("addTriangles",
	             &addTriangles,
	             (arg("outline"),
	              arg("material"),
	              arg("size"),
	              arg("sizeMeaning")   = "sqrtArea",
	              arg("lloyd")         = 2,
	              arg("seed")          = 1,
	              arg("holes")         = py::tuple(),
	              arg("mergeFraction") = -1.,
	              arg("zoning")        = "corners",
	              arg("edgeSegments")  = 1),
	             "Fills a simple polygon, with holes, with triangular blocks: the cells of addVoronoi, each cut into triangles from a point in its middle. "
	             "They "
	             "shear more easily than Voronoi cells, which interlock (Mayer and Stead 2017). size: of the triangles, as sizeMeaning says: mean edge, or "
	             "sqrt(area), of which a cell has six; zoning: 'corners' (one zone a block) or 'fan' (three); the rest, what is returned and the errors "
	             "are "
	             "those of :yref:`addVoronoi<BlockModel.addVoronoi>`.")
		.def("addRegion",
	             &addRegion,
	             (arg("outline"), arg("material"), arg("zoneSize"), arg("holes") = py::tuple(), arg("conforming") = true, arg("zoning") = "delaunay"),
	             "Adds one block: a simple polygon meshed with zones of the given size [m]. outline: counter-clockwise points, shape (n, 2) [m]; holes: "
	             "such "
	             "lists, in either direction. zoning: 'delaunay' (graded), 'regular' (a grid, for rectangles without holes; 'delaunay' where neighbours' "
	             "points are none of the grid's), 'fan' (one grid point that sees the whole outline; no holes) or 'corners' (no inner grid point). Edges "
	             "of "
	             "the outline are divided until none is longer than zoneSize. conforming: boundary points of the blocks that are there already become its "
	             "own where they lie on its outline, which is divided between them. Returns the block's index. "
	             "Zones of constant strain are too stiff in bending: a cantilever deflects by 0.62, 0.86, 0.96, 0.99 of what Timoshenko has with zones of "
	             "h/2, "
	             "h/4, h/8, h/16 (nu 0.2; tests/verification). "
	             "Errors: ValueError for polygons that cross themselves or another region, and zonings that do not suit; nothing is added then.")
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
		.def("bond",
	             &bond,
	             (arg("joints") = py::tuple(), arg("tolerance") = 1e-6),
	             "Finds the joints: overlaps of facing edges, apart by no more than tolerance times their length or the width of their blocks. joints: a "
	             "list of :yref:`JointMat`, the properties for every pair of materials that touch (without it they must come from "
	             ":yref:`Ip2_BlockMat_BlockMat_JointPhys`). To be called once, after all blocks. Returns the number of pairs. Errors: ValueError where "
	             "blocks overlap, or one lies within another, for a pair of materials that touch without a JointMat, and for impossible properties.");
}

} // namespace yade
