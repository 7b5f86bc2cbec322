// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/analysis/Removal.hpp>
#include <blocks/kernel/step/InSitu.hpp>
#include <blocks/kernel/step/Loads.hpp>
#include <blocks/kernel/step/StiffnessDamping.hpp>
#include <blocks/kernel/step/ViscousBoundaries.hpp>
#include <blocks/python/Follow.hpp>
#include <blocks/python/ModelPython.hpp>
#include <blocks/views/Numpy.hpp>
#include <core/BodyContainer.hpp>
#include <core/Omega.hpp>
#include <limits>

/// Groups, loads, the elastic jump.
namespace yade {

using blocks::MotionGroup;

vector<long> integers(const py::object& sequence)
{
	const py::object list = py::import("numpy").attr("asarray")(sequence).attr("ravel")().attr("tolist")();
	vector<long>     out;
	for (long i = 0; i < py::len(list); ++i) {
		const py::extract<long> whole(list[i]);
		if (!whole.check())
			throw std::invalid_argument(
				"indices must be whole numbers, got " + string(py::extract<string>(py::object(list[i]).attr("__repr__")())));
		out.push_back(whole()); // too large for a long: Python says so
	}
	return out;
}

namespace {

	/// Numbers from any sequence; nothing if it is none, or holds something else.
	vector<Real> numbers(const py::object& sequence)
	{
		vector<Real> out;
		if (!PySequence_Check(sequence.ptr())) return out;
		for (long i = 0; i < py::len(sequence); ++i) {
			const py::extract<Real> number(sequence[i]);
			if (!number.check()) return {};
			out.push_back(number());
		}
		return out;
	}

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
	py::object pushForce(BlockModel& model, const string& name)
	{
		const MotionGroup& group = model.group(name);
		return group.drive == MotionGroup::Drive::force ? py::object(group.target) : py::object();
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

	/// Bodies go with their blocks, and their interactions with them.
	void removeBlocks(BlockModel& model, const py::object& blocks)
	{
		if (model.firstBody < 0)
			throw std::runtime_error("BlockModel.remove must come after BlockModel.insert(): leave out blocks that are not to be there");
		vector<int> list;
		for (long block : integers(blocks))
			list.push_back(inRange(block, "BlockModel.remove: a block"));
		blocks::removeBlocks(model.assembly, list);
		model.zonesChanged();
		Scene* scene = Omega::instance().getScene().get();
		for (int block : list)
			if (scene->bodies->exists(model.firstBody + block)) scene->bodies->erase(model.firstBody + block, false);
	}
	py::object removedBlocks(BlockModel& model)
	{
		vector<int> list;
		for (int block = 0; block < model.assembly.blockCount(); ++block)
			if (model.assembly.isRemoved(block)) list.push_back(block);
		return numpyOf(list, false).attr("copy")();
	}

} // namespace

void defineSupports(PythonModel& c)
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
			"scaled masses, or with another damping than 'none'.")
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
	c.def("drive",
	      &drive,
	      (arg("name"), arg("nodes"), arg("axes"), arg("velocity") = 0., arg("rampTime") = 0., arg("startTime") = 0.),
	      "Prescribes the velocity [m/s] of grid points along 'x', 'y' or 'xy' (0: held), reached smoothly within rampTime [s] after startTime [s]. Too "
	      "fast, a quasi-static model is too strong: halve the velocity and compare.")
		.def("push",
	             &push,
	             (arg("name"), arg("nodes"), arg("axis"), arg("force"), arg("rampTime") = 0., arg("startTime") = 0.),
	             "Moves grid points along one axis as one, as under a platen that stays parallel, by a total force [N].")
		.def("remove",
	             &removeBlocks,
	             (arg("blocks")),
	             "Takes deformable blocks (indices) out of a scene between two steps: excavation, stages. Their joints and contacts carry nothing any "
	             "more, "
	             "their bodies and interactions are gone, and indices of all others stay. What they held is 'blockRemoved' in ``O.energy``. All at once: "
	             "what they carried comes upon their neighbours within a step; take out few at a time, or damp (loading.settle), where joints could "
	             "break of it. "
	             "Errors: ValueError for rigid blocks, blocks that are gone, those with grid points of a group or of a viscous boundary (release it "
	             "first), or all "
	             "that are left; RuntimeError before insert(). elasticJump() and follow() know no such scenes.")
		.add_property("removedBlocks", &removedBlocks, "Indices of the blocks that have been removed, ascending. A copy.")
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
