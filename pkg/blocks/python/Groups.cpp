// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/analysis/GroupForce.hpp>
#include <blocks/python/ModelPython.hpp>
#include <blocks/python/Sequences.hpp>
#include <blocks/views/Numpy.hpp>
#include <core/Omega.hpp>

/// Groups: grid points that are held, driven or pushed.
namespace yade {
namespace {

	blocks::MotionGroup groupOf(const string& name, const py::object& nodes, const string& axes, Real rampTime, Real startTime)
	{
		blocks::MotionGroup g;
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

	void add(BlockModel& model, blocks::MotionGroup g)
	{
		for (const blocks::MotionGroup& other : model.assembly.state.groups)
			if (other.name == g.name) throw std::invalid_argument("there is a motion group \"" + g.name + "\" already");
		model.assembly.addGroup(std::move(g));
		model.stiffnessChanged();
	}

	void drive(BlockModel& model, const string& name, const py::object& nodes, const string& axes, Real velocity, Real rampTime, Real startTime)
	{
		blocks::MotionGroup g = groupOf(name, nodes, axes, rampTime, startTime);
		g.target              = velocity;
		add(model, g);
	}

	void push(BlockModel& model, const string& name, const py::object& nodes, const string& axis, Real force, Real rampTime, Real startTime)
	{
		if (axis.size() != 1) throw std::invalid_argument("motion group \"" + name + "\": a force acts along one axis, 'x' or 'y', got '" + axis + "'");
		blocks::MotionGroup g = groupOf(name, nodes, axis, rampTime, startTime);
		g.drive               = blocks::MotionGroup::Drive::force;
		g.target              = force;
		add(model, g);
	}

	void release(BlockModel& model, const string& name)
	{
		const blocks::MotionGroup& g = model.group(name);
		model.assembly.releaseGroup(int(&g - model.assembly.state.groups.data()));
		model.stiffnessChanged();
	}

	void setTarget(BlockModel& model, const string& name, Real target, Real rampTime)
	{
		blocks::require(std::isfinite(target), "motion group \"" + name + "\": target must be finite", target);
		blocks::require(rampTime >= 0 && std::isfinite(rampTime), "motion group \"" + name + "\": rampTime must not be negative [s]", rampTime);
		blocks::MotionGroup& group = model.group(name);
		group.target               = target;
		if (rampTime == 0) return;
		group.startTime = Omega::instance().getScene()->time;
		group.rampTime  = rampTime;
	}
	void setThrottle(BlockModel& model, const string& name, Real throttle)
	{
		blocks::require(throttle >= 0 && throttle <= 1, "motion group \"" + name + "\": throttle must lie in [0, 1]", throttle);
		model.group(name).throttle = throttle;
	}
	string axesOf(BlockModel& model, const string& name)
	{
		bool on[2] = { false, false };
		for (int dof : model.group(name).dofs)
			on[dof % 2] = true;
		return string(on[0] ? "x" : "") + (on[1] ? "y" : "");
	}
	/// Along one of a group's axes.
	Real force(BlockModel& model, const string& name, const string& axis)
	{
		const blocks::MotionGroup& g    = model.group(name);
		const string               axes = axesOf(model, name);
		if (axis.empty()) {
			if (axes == "xy")
				throw std::invalid_argument(
					"motion group \"" + name + "\" acts along x and y, which are two forces: call groupForce(\"" + name
					+ "\", axis=\"x\") or axis=\"y\"");
			return g.force;
		}
		if (axis != "x" && axis != "y") throw std::invalid_argument("BlockModel.groupForce: axis must be 'x' or 'y', got '" + axis + "'");
		if (axes.find(axis) == string::npos) throw std::invalid_argument("motion group \"" + name + "\" does not act along '" + axis + "'");
		return blocks::groupForce(model.assembly, g)[axis == "y"];
	}
	Real moment(BlockModel& model, const string& name, const Vector2r& about) { return blocks::groupMoment(model.assembly, model.group(name), about); }
	py::object nodesOf(BlockModel& model, const string& name)
	{
		vector<int> nodes;
		for (int dof : model.group(name).dofs)
			nodes.push_back(dof / 2);
		std::sort(nodes.begin(), nodes.end());
		nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
		return numpyOf(nodes, false).attr("copy")();
	}
	py::object pushForce(BlockModel& model, const string& name)
	{
		const blocks::MotionGroup& group = model.group(name);
		return group.drive == blocks::MotionGroup::Drive::force ? py::object(group.target) : py::object();
	}
	Real     velocity(BlockModel& model, const string& name) { return model.group(name).velocity; }
	Real     travelled(BlockModel& model, const string& name) { return model.group(name).travelled; }
	Real     work(BlockModel& model, const string& name) { return model.group(name).work; }
	py::list groupNames(const BlockModel& model)
	{
		py::list names;
		for (const blocks::MotionGroup& g : model.assembly.state.groups)
			names.append(g.name);
		return names;
	}

} // namespace

void defineGroups(PythonModel& c)
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
		.def("groupPushForce",
	             &pushForce,
	             (arg("name")),
	             "Force that a group is pushed by once its ramp is over [N]; None of one that is held or driven.")
		.def("groupVelocity", &velocity, (arg("name")), "Present velocity of a group [m/s].")
		.def("groupTravelled", &travelled, (arg("name")), "Displacement of a group so far [m].")
		.def("groupWork", &work, (arg("name")), "Work that a group has done on the blocks [J].")
		.add_property("groups", &groupNames, "Names of the motion groups.");
}

} // namespace yade
