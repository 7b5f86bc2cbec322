// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/step/InSitu.hpp>
#include <blocks/kernel/step/Loads.hpp>
#include <blocks/python/ModelPython.hpp>
#include <blocks/python/Sequences.hpp>

/// Gravity, tractions, stresses in situ.
namespace yade {
namespace {

	void gravity(BlockModel& model, const Vector2r& g) { blocks::addGravity(model.assembly, g); }

	void traction(BlockModel& model, const py::object& edges, const Vector2r& stress)
	{
		const auto list = integers(edges);
		if (list.empty()) throw std::invalid_argument("BlockModel.traction: no edges were chosen");
		for (long edge : list)
			blocks::addTraction(model.assembly, inRange(edge, "BlockModel.traction: an edge"), stress);
	}

	blocks::InSituStress fieldOf(const Vector3r& stress, const Vector3r& gradient, Real level)
	{
		return { { stress[0], stress[1], stress[2] }, { gradient[0], gradient[1], gradient[2] }, level };
	}
	void setStress(BlockModel& model, const Vector3r& stress, const Vector3r& gradient, Real level)
	{
		blocks::setInSitu(model.assembly, fieldOf(stress, gradient, level));
		model.zonesChanged();
	}
	void stressTraction(BlockModel& model, const py::object& edges, const Vector3r& stress, const Vector3r& gradient, Real level)
	{
		const auto list = integers(edges);
		if (list.empty()) throw std::invalid_argument("BlockModel.stressTraction: no edges were chosen");
		for (long edge : list)
			blocks::addInSituTraction(model.assembly, inRange(edge, "BlockModel.stressTraction: an edge"), fieldOf(stress, gradient, level));
	}

} // namespace

void defineLoads(PythonModel& c)
{
	using py::arg;
	c.def("gravity", &gravity, (arg("g")), "Adds gravity, a vector [m/s2], on the true masses, those of rigid blocks included.")
		.def("traction",
	             &traction,
	             (arg("edges"), arg("stress")),
	             "Adds a traction vector [Pa] on boundary edges (indices into edgeNodes), as dead load.")
		.def("setStress",
	             &setStress,
	             (arg("stress"), arg("gradient") = Vector3r(0, 0, 0), arg("level") = 0.),
	             "Gives zones and joints the stresses that they have in situ: (sxx, syy, sxy) [Pa] at y = level [m], tension positive, and their change "
	             "with y "
	             "[Pa/m]. Before the first step. A bonded model under such stresses does not move if its supports and loads are in equilibrium with "
	             "them: stressTraction() on free edges, gravity for a gradient (dsyy/dy + density g_y = 0). Displacements count from there; what "
	             "zones and joints hold is in 'blockZones' and 'blockJoints'. Blocks that touch without a joint have none. "
	             "Errors: ValueError where something has moved, a joint has no properties or cannot carry it. elasticJump() and follow() know none.")
		.def("stressTraction",
	             &stressTraction,
	             (arg("edges"), arg("stress"), arg("gradient") = Vector3r(0, 0, 0), arg("level") = 0.),
	             "Adds to boundary edges (indices into edgeNodes), as dead load, what stresses in situ pull there; see setStress(). Error: ValueError for "
	             "no "
	             "edges, or one that is not there.");
}

} // namespace yade
