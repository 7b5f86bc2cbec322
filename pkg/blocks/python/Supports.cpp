// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/step/Loads.hpp>
#include <blocks/python/Follow.hpp>
#include <blocks/python/ModelPython.hpp>
#include <blocks/python/Numpy.hpp>
#include <core/Omega.hpp>
#include <limits>

/// Groups, loads, the elastic jump.
namespace yade {

using blocks::MotionGroup;

vector<long> integers(const py::object& sequence)
{
	const py::object list = py::import("numpy").attr("asarray")(sequence).attr("ravel")().attr("tolist")();
	vector<long>     out;
	for (long i = 0; i < py::len(list); ++i)
		out.push_back(py::extract<long>(list[i])); // too large for a long: Python says so
	return out;
}

namespace {

	/// Within what an int holds; the assembly knows how many there are.
	int inRange(long index, const string& what)
	{
		constexpr long most = std::numeric_limits<int>::max() / 2;
		if (index < -most || index > most) throw std::invalid_argument(what + " must be an index that exists, got " + std::to_string(index));
		return int(index);
	}

	MotionGroup groupOf(const string& name, const py::object& nodes, const string& axes, Real rampTime, Real startTime)
	{
		MotionGroup g;
		g.name      = name;
		g.rampTime  = rampTime;
		g.startTime = startTime;
		for (char axis : axes)
			if (axis != 'x' && axis != 'y')
				throw std::invalid_argument("motion group \"" + name + "\": axes must be 'x', 'y' or 'xy', got '" + axes + "'");
		for (long node : integers(nodes))
			for (char axis : axes)
				g.dofs.push_back(int(2 * inRange(node, "motion group \"" + name + "\": a grid point") + (axis - 'x')));
		return g;
	}

	void add(BlockModel& model, MotionGroup g)
	{
		for (const MotionGroup& other : model.assembly.state.groups)
			if (other.name == g.name) throw std::invalid_argument("there is a motion group \"" + g.name + "\" already");
		model.assembly.addGroup(std::move(g));
		model.stiffnessChanged();
	}

	void drive(BlockModel& model, const string& name, const py::object& nodes, const string& axes, Real velocity, Real rampTime, Real startTime)
	{
		MotionGroup g = groupOf(name, nodes, axes, rampTime, startTime);
		g.target      = velocity;
		add(model, g);
	}

	void push(BlockModel& model, const string& name, const py::object& nodes, const string& axis, Real force, Real rampTime, Real startTime)
	{
		if (axis.size() != 1) throw std::invalid_argument("motion group \"" + name + "\": a force acts along one axis, 'x' or 'y', got '" + axis + "'");
		MotionGroup g = groupOf(name, nodes, axis, rampTime, startTime);
		g.drive       = MotionGroup::Drive::force;
		g.target      = force;
		add(model, g);
	}

	void release(BlockModel& model, const string& name)
	{
		const MotionGroup& g = model.group(name);
		model.assembly.releaseGroup(int(&g - model.assembly.state.groups.data()));
		model.stiffnessChanged();
	}

	void setTarget(BlockModel& model, const string& name, Real target, Real rampTime)
	{
		blocks::require(std::isfinite(target), "motion group \"" + name + "\": target must be finite", target);
		blocks::require(rampTime >= 0 && std::isfinite(rampTime), "motion group \"" + name + "\": rampTime must not be negative [s]", rampTime);
		MotionGroup& group = model.group(name);
		group.target       = target;
		if (rampTime == 0) return;
		group.startTime = Omega::instance().getScene()->time;
		group.rampTime  = rampTime;
	}
	void setThrottle(BlockModel& model, const string& name, Real throttle)
	{
		blocks::require(throttle >= 0 && throttle <= 1, "motion group \"" + name + "\": throttle must lie in [0, 1]", throttle);
		model.group(name).throttle = throttle;
	}
	/// Along one of a group's axes; the parts of two axes accelerate alike.
	Real force(BlockModel& model, const string& name, const string& axis)
	{
		const MotionGroup&           g          = model.group(name);
		const blocks::BlockAssembly& a          = model.assembly;
		Vector2r                     resistance = Vector2r::Zero(), inertia = Vector2r::Zero();
		bool                         on[2] = { false, false };
		for (int dof : g.dofs) {
			resistance[dof % 2] -= a.forces.nodal[dof / 2][dof % 2];
			inertia[dof % 2] += a.state.inertia[dof / 2];
			on[dof % 2] = true;
		}
		if (axis.empty()) {
			if (on[0] && on[1])
				throw std::invalid_argument(
					"motion group \"" + name + "\" acts along x and y, which are two forces: call groupForce(\"" + name
					+ "\", axis=\"x\") or axis=\"y\"");
			return g.force;
		}
		if (axis != "x" && axis != "y") throw std::invalid_argument("BlockModel.groupForce: axis must be 'x' or 'y', got '" + axis + "'");
		const int k = axis == "y";
		if (!on[k]) throw std::invalid_argument("motion group \"" + name + "\" does not act along '" + axis + "'");
		return resistance[k] + (g.force - resistance.sum()) * inertia[k] / inertia.sum();
	}
	/// Of the forces on all grid points of the group, about a point.
	Real moment(BlockModel& model, const string& name, const Vector2r& about)
	{
		const MotionGroup&           g          = model.group(name);
		const blocks::BlockAssembly& a          = model.assembly;
		Real                         resistance = 0, inertia = 0;
		for (int dof : g.dofs) {
			resistance -= a.forces.nodal[dof / 2][dof % 2];
			inertia += a.state.inertia[dof / 2];
		}
		Real sum = 0;
		for (int dof : g.dofs) { // all of them accelerate alike
			const Vector2r arm   = a.position(dof / 2) - about;
			const Real     force = (g.force - resistance) * a.state.inertia[dof / 2] / inertia - a.forces.nodal[dof / 2][dof % 2];
			sum += dof % 2 ? arm[0] * force : -arm[1] * force;
		}
		return sum;
	}
	py::object nodesOf(BlockModel& model, const string& name)
	{
		vector<int> nodes;
		for (int dof : model.group(name).dofs)
			nodes.push_back(dof / 2);
		std::sort(nodes.begin(), nodes.end());
		nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
		return numpyOf(nodes, false).attr("copy")();
	}
	string axesOf(BlockModel& model, const string& name)
	{
		bool on[2] = { false, false };
		for (int dof : model.group(name).dofs)
			on[dof % 2] = true;
		return string(on[0] ? "x" : "") + (on[1] ? "y" : "");
	}
	Real     velocity(BlockModel& model, const string& name) { return model.group(name).velocity; }
	Real     travelled(BlockModel& model, const string& name) { return model.group(name).travelled; }
	Real     work(BlockModel& model, const string& name) { return model.group(name).work; }
	py::list groupNames(const BlockModel& model)
	{
		py::list names;
		for (const MotionGroup& g : model.assembly.state.groups)
			names.append(g.name);
		return names;
	}

	void gravity(BlockModel& model, const Vector2r& g) { blocks::addGravity(model.assembly, g); }

	void traction(BlockModel& model, const py::object& edges, const Vector2r& stress)
	{
		const auto list = integers(edges);
		if (list.empty()) throw std::invalid_argument("BlockModel.traction: no edges were chosen");
		for (long edge : list)
			blocks::addTraction(model.assembly, inRange(edge, "BlockModel.traction: an edge"), stress);
	}

} // namespace

void defineSupports(PythonModel& c)
{
	using py::arg;
	c.def("drive",
	      &drive,
	      (arg("name"), arg("nodes"), arg("axes"), arg("velocity") = 0., arg("rampTime") = 0., arg("startTime") = 0.),
	      "Prescribes the velocity [m/s] of grid points along 'x', 'y' or 'xy' (0: held), reached smoothly within rampTime [s] after startTime [s]. Too "
	      "fast, a quasi-static model is too strong: halve the velocity and compare.")
		.def("push",
	             &push,
	             (arg("name"), arg("nodes"), arg("axis"), arg("force"), arg("rampTime") = 0., arg("startTime") = 0.),
	             "Moves grid points along one axis as one, as under a platen that stays parallel, by a total force [N].")
		.def("release",
	             &release,
	             (arg("name")),
	             "Sets the grid points of a group free; they go on with the velocity they have. Its work stays in the accounts.")
		.def("setTarget",
	             &setTarget,
	             (arg("name"), arg("target"), arg("rampTime") = 0.),
	             "New velocity [m/s] or force [N] of a group; with a rampTime [s] it starts from zero now.")
		.def("setThrottle", &setThrottle, (arg("name"), arg("throttle")), "Factor in [0, 1] on the velocity of a group, for servos.")
		.def("groupForce",
	             &force,
	             (arg("name"), arg("axis") = ""),
	             "Force that a group puts on the blocks along an axis, in the last step [N]. A group along 'xy' has two: axis='x' or 'y' is needed there. "
	             "Errors: ValueError for a group that is not there, an axis it does not act along, or none where it has two.")
		.def("groupMoment",
	             &moment,
	             (arg("name"), arg("about")),
	             "Moment about a point (x, y) [m] of the forces that a group puts on the blocks, counter-clockwise, in the last step [N m].")
		.def("groupNodes", &nodesOf, (arg("name")), "Grid points of a group, in ascending order. A copy.")
		.def("groupAxes", &axesOf, (arg("name")), "Axes along which a group acts: 'x', 'y' or 'xy'.")
		.def("groupVelocity", &velocity, (arg("name")), "Present velocity of a group [m/s].")
		.def("groupTravelled", &travelled, (arg("name")), "Displacement of a group so far [m].")
		.def("groupWork", &work, (arg("name")), "Work that a group has done on the blocks [J].")
		.def("gravity", &gravity, (arg("g")), "Adds gravity, a vector [m/s2], on the true masses, those of rigid blocks included.")
		.def("traction",
	             &traction,
	             (arg("edges"), arg("stress")),
	             "Adds a traction vector [Pa] on boundary edges (indices into edgeNodes), as dead load.")
		.def("elasticJump",
	             &elasticJump,
	             (arg("fraction") = 0.97),
	             "Leaps over the elastic part of the loading: solves for the answer to all loads, pushed groups at their full force and driven groups up "
	             "to this fraction of the first failure, and goes on from there at full speed; no ramps, no settling. "
	             "Joints must have their properties (Mohr-Coulomb), from bond() or from a first step. Returns {'time': of loading at full speed that "
	             "was leapt over [s], 'point': the contact point that will fail first}. "
	             "Rigid blocks move along, those with a prescribed velocity as driven ones. "
	             "Errors: RuntimeError where joints are broken or never were bonded, blocks are not held, nothing is driven, or the loads alone break a "
	             "joint; nothing is changed then.")
		.def("follow",
	             &follow,
	             (arg("group"),
	              arg("peak")         = false,
	              arg("drop")         = 0.5,
	              arg("displacement") = std::numeric_limits<Real>::infinity(),
	              arg("cracks")       = std::numeric_limits<int>::max(),
	              arg("release")      = "path",
	              arg("gauges")       = py::list(),
	              arg("progress")     = py::object()),
	             followDoc)
		.add_property("groups", &groupNames, "Names of the motion groups.");
}

} // namespace yade
