// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/step/StiffnessDamping.hpp>
#include <blocks/kernel/step/ViscousBoundaries.hpp>
#include <blocks/python/ModelPython.hpp>
#include <blocks/python/Sequences.hpp>
#include <core/Omega.hpp>

/// Viscous boundaries, and damping proportional to stiffness.
namespace yade {
namespace {

	void viscous(BlockModel& model, const string& name, const py::object& nodes, const py::object& impedance)
	{
		const string      what = "viscous boundary \"" + name + "\": ";
		blocks::Impedance z;
		if (!impedance.is_none()) {
			const vector<Real> pair = numbers(impedance);
			if (pair.size() != 2)
				throw std::invalid_argument(
					what + "impedance must be a pair of numbers, normal and tangential, got "
					+ string(py::extract<string>(impedance.attr("__repr__")())));
			z = { pair[0], pair[1] };
			for (Real part : { z.normal, z.tangential })
				blocks::require(part > 0, what + "impedances must be positive and finite [Pa s/m]", part);
		}
		vector<int> list;
		for (long node : integers(nodes))
			list.push_back(inRange(node, what + "a grid point"));
		blocks::addViscous(model.assembly, name, list, z);
		model.stiffnessChanged(); // masses that are scaled are refused where they are made
	}

	void setIncoming(BlockModel& model, const string& name, const py::object& times, const py::object& velocities)
	{
		const string     what     = "viscous boundary \"" + name + "\": ";
		const int        boundary = blocks::viscousOf(model.assembly, name);
		const py::object array = py::import("numpy").attr("asarray")(velocities, "float"), shape = array.attr("shape");
		const py::object list = py::import("numpy").attr("asarray")(times, "float").attr("ravel")().attr("tolist")();
		if (py::len(shape) != 2 || py::extract<long>(shape[1])() != 2)
			throw std::invalid_argument(what + "velocities must have two columns, along x and y");
		const py::object     rows = array.attr("tolist")();
		vector<Real>         when;
		vector<blocks::Vec2> wave;
		for (long i = 0; i < py::len(list); ++i)
			when.push_back(py::extract<Real>(list[i]));
		for (long i = 0; i < py::len(rows); ++i)
			wave.emplace_back(py::extract<Real>(rows[i][0])(), py::extract<Real>(rows[i][1])());
		blocks::setIncoming(model.assembly, boundary, when, wave);
	}
	void releaseViscous(BlockModel& model, const string& name)
	{
		blocks::releaseViscous(model.assembly, blocks::viscousOf(model.assembly, name));
		model.stiffnessChanged();
	}
	py::tuple viscousForce(BlockModel& model, const string& name)
	{
		const Real         time = Omega::instance().getScene()->time;
		const blocks::Vec2 f    = blocks::viscousForce(model.assembly, blocks::viscousOf(model.assembly, name), time);
		return py::make_tuple(f.x(), f.y());
	}
	py::list viscousNames(const BlockModel& model)
	{
		py::list names;
		for (const blocks::ViscousBoundary& b : model.assembly.supports.viscous)
			names.append(b.name);
		return names;
	}

	Real getStiffnessDamping(const BlockModel& model) { return model.assembly.supports.stiffnessDamping; }
	void setStiffnessDamping(BlockModel& model, Real beta)
	{
		blocks::require(beta >= 0 && std::isfinite(beta), "BlockModel.stiffnessDamping must not be negative [s]", beta);
		blocks::setStiffnessDamping(model.assembly, beta);
		model.stiffnessChanged(); // the step is bounded by it
	}

} // namespace

void defineBoundaries(PythonModel& c)
{
	using py::arg;
	c.def("viscous",
	      &viscous,
	      (arg("name"), arg("nodes"), arg("impedance") = py::object()),
	      "Makes the boundary between these grid points viscous (absorbing): dashpots of rho c_p A across and rho c_s A along it, as if the medium went on "
	      "behind it; c_p and c_s are those of each block's material, A the area of a grid point's share. Plane waves go out at normal incidence; at 30 "
	      "degrees some 2 % of the amplitude comes back, at grazing incidence all. impedance: (normal, tangential) of what is behind [Pa s/m], if it is "
	      "another material or jointed. After bond(): edges that have joints are no boundary. A dashpot acts on what forces move; along the axes of a "
	      "group "
	      "there is none (held sides may end in a viscous base). It carries no lasting force: weight needs a support, or stresses in situ with their "
	      "tractions. The time step need not be shorter. ``O.energy``: 'blockViscous' is what waves took out, what came in is in 'blockWork'. "
	      "Errors: ValueError for a name that is taken, grid points without a boundary edge between them, of rigid blocks, or of groups that push "
	      "or hold both axes, impedances that are not positive; RuntimeError in the first step with scaled masses (quasiStatic=True), whose waves are "
	      "not those of the material. Source: Lysmer and Kuhlemeyer 1969.")
		.def("setIncoming",
	             &setIncoming,
	             (arg("name"), arg("times"), arg("velocities")),
	             "Lets a wave come in through a viscous boundary: its velocities [m/s], shape (times, 2), at ascending times [s]; linear between them, "
	             "zero "
	             "outside. The boundary pulls with twice these velocities times the impedance, so that what comes back goes out. An accelerogram of an "
	             "outcrop "
	             "is twice the incoming wave. Errors: ValueError for no such boundary, times that do not ascend, or shapes that do not fit.")
		.def("releaseViscous",
	             &releaseViscous,
	             (arg("name")),
	             "Takes a viscous boundary away; what went through it stays in the accounts. Error: ValueError if there is none of this name.")
		.def("viscousForce",
	             &viscousForce,
	             (arg("name")),
	             "Force (x, y) that a viscous boundary puts on the blocks at their present velocities [N]. Error: ValueError if there is none of this "
	             "name.")
		.add_property("viscousBoundaries", &viscousNames, "Names of the viscous boundaries.")
		.add_property(
			"stiffnessDamping",
			&getStiffnessDamping,
			&setStiffnessDamping,
			"Damping proportional to stiffness, Rayleigh's beta [s]; 0: none. Zones and intact joints resist the rate of their strain by beta "
			"times "
			"their stiffness: a mode of angular frequency omega loses as with xi = beta omega / 2 of the critical damping, so that what rattles "
			"after a blow dies away and slow motion stays. A rigid motion has none. The time step gets shorter: limit^2 / (sqrt(beta^2 + limit^2) "
			"+ beta). 'blockStiffness' in ``O.energy`` is what it dissipated. Errors: ValueError if it is negative; RuntimeError in the first step "
			"with "
			"scaled masses, or with another damping than 'none'.");
}

} // namespace yade
