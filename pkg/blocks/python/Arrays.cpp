// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/model/Outline.hpp>
#include <blocks/kernel/step/ContactResults.hpp>
#include <blocks/kernel/step/Joints.hpp>
#include <blocks/kernel/step/ZoneForces.hpp>
#include <blocks/python/ModelPython.hpp>
#include <blocks/views/Numpy.hpp>

/// The model's arrays.
namespace yade {

namespace np = boost::python::numpy;
using blocks::BlockAssembly;
using blocks::Vec2;

namespace {

	enum class Use { state, result }; ///< scripts may write the one but not the other

	/// `columns` numbers of each item, from `offset` bytes within it: a numpy view that keeps the model alive. A copy as long
	/// as the model still grows, which moves its memory.
	template <class Number, class Item> py::object view(const py::object& self, std::vector<Item>& items, int columns, Use use, size_t offset = 0)
	{
		startNumpy();
		static Number nothing {};
		char*         data  = items.empty() ? reinterpret_cast<char*>(&nothing) : reinterpret_cast<char*>(items.data()) + offset;
		py::tuple     shape = columns == 1 ? py::make_tuple(items.size()) : py::make_tuple(items.size(), columns);
		py::tuple     steps = columns == 1 ? py::make_tuple(sizeof(Item)) : py::make_tuple(sizeof(Item), sizeof(Number));
		py::object    array = np::from_data(data, np::dtype::get_builtin<Number>(), shape, steps, self);
		BlockModel&   model = py::extract<BlockModel&>(self)();
		const bool    grows = model.firstBody < 0;
		if (grows)
			array = array.attr("copy")();
		else if (use == Use::state)
			model.assembly.contacts.strangers = true; // whoever holds it may write at any time
		if (grows || use == Use::result) array.attr("setflags")(false);
		return array;
	}

	BlockAssembly& arrays(const py::object& self) { return py::extract<BlockModel&>(self)().assembly; }

	/// A view, as long as no joint has become a free contact.
	py::object pointStress(const py::object& self, std::vector<Real> blocks::PointStresses::*which, std::vector<Real>& column)
	{
		const auto& released = arrays(self).state.released;
		if (std::find(released.begin(), released.end(), true) == released.end()) return view<Real>(self, column, 1, Use::result);
		blocks::PointStresses all = blocks::pointStresses(arrays(self), 0, arrays(self).joints.count());
		const py::object      out = numpyOf(all.*which, false).attr("copy")();
		out.attr("setflags")(false);
		return out;
	}

	/// An array as a property.
	template <class View> void column(PythonModel& c, const char* name, const View& view, const char* doc)
	{
		c.add_property(name, py::make_function(+view), doc);
	}

	/// What touches without a bond, as of the last step.
	py::dict freeContacts(const py::object& self)
	{
		const BlockAssembly& a = arrays(self);
		std::vector<int>     both, nodes;
		std::vector<Real>    force;
		for (int i : a.contacts.order)
			forEachTouching(a.contacts, a.state.contacts[i], i, [&](const blocks::EdgePair& pair, const blocks::SideForce& on) {
				const Vec2 first = on.force[0] + on.force[1];
				both.insert(both.end(), a.state.contacts[i].block.begin(), a.state.contacts[i].block.end());
				nodes.insert(nodes.end(), pair.node.begin(), pair.node.end());
				force.insert(force.end(), { first[0], first[1] });
			});
		const auto table = [](auto& numbers, int columns) { return numpyOf(numbers, false).attr("copy")().attr("reshape")(-1, columns); };
		py::dict   out;
		out["blocks"] = table(both, 2);
		out["nodes"]  = table(nodes, 4);
		out["force"]  = table(force, 2);
		return out;
	}

	py::object zoneStress(const py::object& self)
	{
		BlockAssembly& a = arrays(self);
		startNumpy();
		np::ndarray out  = np::empty(py::make_tuple(a.zoneCount(), 3), np::dtype::get_builtin<Real>());
		Real*       data = reinterpret_cast<Real*>(out.get_data());
		for (int block = 0; block < a.blockCount(); ++block)
			for (int z = a.mesh.firstZone[block]; z < a.mesh.firstZone[block + 1]; ++z) {
				const blocks::ZoneStress s = blocks::cauchyStress(a, block, z);
				data[3 * z] = s.sxx, data[3 * z + 1] = s.syy, data[3 * z + 2] = s.sxy;
			}
		return out;
	}

	py::object cornerTriangles(const py::object& self, int block)
	{
		BlockAssembly& a = arrays(self);
		if (block < 0 || block >= a.blockCount())
			throw std::invalid_argument(
				"BlockModel.cornerTriangles: block must lie in [0, " + std::to_string(a.blockCount()) + "), got " + std::to_string(block));
		const auto triangles = blocks::cornerTriangles(a, block);
		startNumpy();
		np::ndarray out = np::empty(py::make_tuple(triangles.size(), 3), np::dtype::get_builtin<int>());
		if (!triangles.empty()) std::copy_n(triangles.data()->data(), 3 * triangles.size(), reinterpret_cast<int*>(out.get_data()));
		return out;
	}

	py::object contactPositions(const py::object& self)
	{
		BlockAssembly& a = arrays(self);
		startNumpy();
		np::ndarray out  = np::empty(py::make_tuple(a.state.status.size(), 2), np::dtype::get_builtin<Real>());
		Real*       data = reinterpret_cast<Real*>(out.get_data());
		for (size_t i = 0; i < a.state.status.size(); ++i) {
			const Vec2 x = blocks::contactPosition(a, int(i));
			data[2 * i] = x.x(), data[2 * i + 1] = x.y();
		}
		return out;
	}

	py::object damages(const py::object& self)
	{
		BlockAssembly& a = arrays(self);
		startNumpy();
		np::ndarray out  = np::empty(py::make_tuple(a.pointCount()), np::dtype::get_builtin<Real>());
		Real*       data = reinterpret_cast<Real*>(out.get_data());
		for (int i = 0; i < a.pointCount(); ++i)
			data[i] = blocks::damageOf(a, i);
		out.attr("setflags")(false);
		return out;
	}

	py::object position(const py::object& self)
	{
		BlockAssembly& a = arrays(self);
		startNumpy();
		np::ndarray out  = np::empty(py::make_tuple(a.nodeCount(), 2), np::dtype::get_builtin<Real>());
		Real*       data = reinterpret_cast<Real*>(out.get_data());
		for (int n = 0; n < a.nodeCount(); ++n) {
			const Vec2 x = a.position(n);
			data[2 * n] = x.x(), data[2 * n + 1] = x.y();
		}
		out.attr("setflags")(false);
		return out;
	}

	py::object normals(const py::object& self)
	{
		BlockAssembly& a = arrays(self);
		startNumpy();
		np::ndarray out  = np::empty(py::make_tuple(a.joints.count(), 2), np::dtype::get_builtin<Real>());
		Real*       data = reinterpret_cast<Real*>(out.get_data());
		for (int i = 0; i < a.joints.count(); ++i) {
			const auto f = blocks::frameOf(a, i);
			data[2 * i] = f.nx, data[2 * i + 1] = f.ny;
		}
		return out;
	}

	/// Openings and slips of released joints, which no step follows, as they are now.
	template <std::vector<Real> blocks::State::*column> py::object motion(const py::object& self)
	{
		BlockAssembly& a = arrays(self);
		for (int i = 0; i < a.joints.count(); ++i)
			if (a.state.released[i]) blocks::updateKinematics(a, { i, i + 1 });
		return view<Real>(self, a.state.*column, 1, Use::result);
	}

	py::dict lawColumns(BlockModel& model)
	{
		blocks::LawColumns& all = model.assembly.state.lawColumns;
		py::dict            out;
		for (const string& name : all.names) {
			const py::object column = numpyOf(all[name], false).attr("copy")();
			column.attr("setflags")(false);
			out[name] = column;
		}
		return out;
	}

	void dropLawColumns(BlockModel& model) { model.assembly.state.lawColumns = {}; }

	long snappedBack(const BlockModel& m) { return m.assembly.state.softened.snapped; }
	int  blockCount(const BlockModel& m) { return m.assembly.blockCount(); }
	int  nodeCount(const BlockModel& m) { return m.assembly.nodeCount(); }
	int  zoneCount(const BlockModel& m) { return m.assembly.zoneCount(); }
	int  contactCount(const BlockModel& m) { return m.assembly.pointCount(); }

} // namespace

void defineArrays(PythonModel& c)
{
	using py::arg;
	c.def("freeContacts",
	      &freeContacts,
	      "Edges that touch without a bond, as of the last step, as a dictionary of copies, one entry a pair of edges: blocks, the two (n, 2); "
	      "nodes, the "
	      "grid points a0, a1 of the first block's edge and b0, b1 of the second's (n, 4); force, on the first block (n, 2) [N]. Empty without "
	      "general contact.")
		.def("zoneStress",
	             py::make_function(&zoneStress),
	             "Cauchy stress of every zone: sxx, syy, sxy, tension positive; shape (zones, 3) [Pa]. A copy.")
		.def("cornerTriangles",
	             &cornerTriangles,
	             (arg("block")),
	             "Triangles between the corners of a block and of its holes (constrained Delaunay), to draw rigid blocks, which have no zones: grid "
	             "points, counter-clockwise, shape (triangles, 3). A copy. "
	             "Errors: ValueError for a block that is not there.")
		.def("contactPositions", py::make_function(&contactPositions), "Positions of the contact points, shape (contact points, 2) [m]. A copy.")
		.add_property("blockCount", &blockCount, "Number of blocks.")
		.add_property("nodeCount", &nodeCount, "Number of grid points.")
		.add_property("zoneCount", &zoneCount, "Number of zones.")
		.add_property("contactCount", &contactCount, "Number of contact points.")
		.add_property(
			"position",
			py::make_function(&position),
			"Grid points' positions, shape (grid points, 2) [m]. A copy that cannot be written: "
			"write to displacement.")
		.add_property("normal", py::make_function(&normals), "Unit normals of the joints, out of the first block, shape (segments, 2). A copy.")
		.add_property("pointOpening", py::make_function(&motion<&blocks::State::opening>), "Openings of the contact points, two a joint [m].")
		.add_property("pointSlip", py::make_function(&motion<&blocks::State::slip>), "Slips of the contact points [m].")
		.add_property(
			"pointDamage",
			py::make_function(&damages),
			"Damage of the contact points: 0 whole or never bonded, 1 nothing but residual "
			"strength is left; joints that do not soften have no other values. A copy.")
		.add_property(
			"lawColumns",
			&lawColumns,
			"Columns of a joint law of one's own (:yref:`BlockLaw`, :yref:`NumpyLaw`): name -> one number a "
			"contact point, two a joint, in the unit that the law gives them. Empty until such a law has worked. Copies.")
		.def("dropLawColumns",
	             &dropLawColumns,
	             "Forgets the columns of a joint law of one's own, so that a law with other ones can follow; its "
	             "columns are 0 again.")
		.add_property(
			"snappedBack",
			&snappedBack,
			"How often a contact point of a joint that softens has snapped back: its pressure was too high for "
			"the stress to follow the softening curve, and it dropped to it.");

	// ---- the arrays themselves
	column(
		c,
		"displacement",
		[](const py::object& self) { return view<Real>(self, arrays(self).state.displacement, 2, Use::state); },
		"Displacements of the grid points since the reference positions, shape (grid points, 2) [m].");
	column(
		c,
		"reference",
		[](const py::object& self) { return view<Real>(self, arrays(self).mesh.reference, 2, Use::result); },
		"Grid points' positions without stress, shape (grid points, 2) [m].");
	column(
		c,
		"velocity",
		[](const py::object& self) { return view<Real>(self, arrays(self).state.velocity, 2, Use::state); },
		"Grid points' velocities half a step ago, shape (grid points, 2) [m/s].");
	column(
		c,
		"force",
		[](const py::object& self) { return view<Real>(self, arrays(self).forces.nodal, 2, Use::result); },
		"Grid points' unbalanced forces, shape (grid points, 2) [N].");
	column(
		c,
		"mass",
		[](const py::object& self) { return view<Real>(self, arrays(self).mesh.mass, 1, Use::result); },
		"Grid points' true masses; 0 on rigid blocks, whose body has it all [kg].");
	column(
		c,
		"inertia",
		[](const py::object& self) { return view<Real>(self, arrays(self).state.inertia, 1, Use::result); },
		"Grid points' masses as they resist motion, scaled if BlockMotion scales them [kg].");
	column(
		c,
		"zoneNodes",
		[](const py::object& self) { return view<int>(self, arrays(self).mesh.zoneNodes, 3, Use::result); },
		"Grid points of every zone, counter-clockwise, shape (zones, 3).");
	column(
		c,
		"zoneVolume",
		[](const py::object& self) { return view<Real>(self, arrays(self).mesh.zoneVolume, 1, Use::result); },
		"Volumes of the zones [m3].");
	column(
		c,
		"firstNode",
		[](const py::object& self) { return view<int>(self, arrays(self).mesh.firstNode, 1, Use::result); },
		"First grid point of every block, and their number at the end.");
	column(
		c,
		"firstZone",
		[](const py::object& self) { return view<int>(self, arrays(self).mesh.firstZone, 1, Use::result); },
		"First zone of every block, and their number at the end.");
	column(
		c,
		"firstEdge",
		[](const py::object& self) { return view<int>(self, arrays(self).mesh.firstEdge, 1, Use::result); },
		"First boundary edge of every block, and their number at the end.");
	column(
		c,
		"blockMaterial",
		[](const py::object& self) { return view<int>(self, arrays(self).mesh.blockMaterial, 1, Use::result); },
		"Material of every block, an index into materialLabels.");
	column(
		c,
		"edgeNodes",
		[](const py::object& self) { return view<int>(self, arrays(self).mesh.edgeNodes, 2, Use::result); },
		"Grid points of the boundary edges, material on the left, shape (edges, 2).");
	column(
		c,
		"segmentNodes",
		[](const py::object& self) { return view<int>(self, arrays(self).joints.segments, 4, Use::result, offsetof(blocks::Segment, node)); },
		"Edge a1, b1 of the first and a2, b2 of the second block of every joint, shape (segments, 4).");
	column(
		c,
		"segmentBlocks",
		[](const py::object& self) { return view<int>(self, arrays(self).joints.segments, 2, Use::result, offsetof(blocks::Segment, block)); },
		"The two blocks of every joint, shape (segments, 2).");
	column(
		c,
		"segmentParameters",
		[](const py::object& self) { return view<Real>(self, arrays(self).joints.segments, 4, Use::result, offsetof(blocks::Segment, s1)); },
		"Where the two contact points are along the first edge, then along the second (0 at a, 1 at b), shape (segments, 4).");
	column(
		c,
		"segmentArea",
		[](const py::object& self) { return view<Real>(self, arrays(self).joints.columns.area, 1, Use::result); },
		"Area of each of the two contact points of every joint; 0 once it has broken and its edges are a free contact, which has all that they carry "
		"[m2].");
	column(
		c,
		"pointSigma",
		[](const py::object& self) { return pointStress(self, &blocks::PointStresses::sigma, arrays(self).state.sigma); },
		"Normal stresses of the contact points, tension positive [Pa]; where a joint has become a free contact, those of the edges that took its place "
		"(then a copy).");
	column(
		c,
		"pointTau",
		[](const py::object& self) { return pointStress(self, &blocks::PointStresses::tau, arrays(self).state.tau); },
		"Shear stresses of the contact points, as pointSigma [Pa].");
	column(
		c,
		"pointStatus",
		[](const py::object& self) { return view<std::uint8_t>(self, arrays(self).state.status, 1, Use::result); },
		"0 intact, 1 broken in tension, 2 broken in shear, 3 never bonded, 4 softening: beyond its peak. A joint that softens counts as broken from a "
		"damage of 0.9 on.");
}

} // namespace yade
