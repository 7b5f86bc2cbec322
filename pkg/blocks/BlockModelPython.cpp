// yade-blocks, GPL-2.0-or-later
#include "BlockModel.hpp"
#include "JointPhys.hpp"
#include <blocks/kernel/analysis/ElasticJump.hpp>
#include <blocks/kernel/analysis/Energy.hpp>
#include <blocks/kernel/geometry/Zoning.hpp>
#include <blocks/kernel/step/ContactKinematics.hpp>
#include <blocks/kernel/step/NodalForces.hpp>
#include <boost/python/numpy.hpp>
#include <core/Omega.hpp>

/// What Python sees of a BlockModel besides its building: its arrays, its boundary conditions.
namespace yade {

namespace np = boost::python::numpy;
using blocks::BlockAssembly;
using blocks::MotionGroup;
using blocks::Vec2;

namespace {

	// ---- from Python

	vector<long> integers(const py::object& sequence)
	{
		const py::object list = py::import("numpy").attr("asarray")(sequence).attr("ravel")().attr("tolist")();
		vector<long>     out;
		for (long i = 0; i < py::len(list); ++i)
			out.push_back(py::extract<long>(list[i]));
		return out;
	}

	// ---- boundary conditions

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
				g.dofs.push_back(int(2 * node + (axis - 'x')));
		return g;
	}

	void add(BlockModel& model, MotionGroup g)
	{
		for (const MotionGroup& other : model.assembly.groups)
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
		model.assembly.releaseGroup(int(&g - model.assembly.groups.data()));
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
	Real     force(BlockModel& model, const string& name) { return model.group(name).force; }
	Real     velocity(BlockModel& model, const string& name) { return model.group(name).velocity; }
	Real     travelled(BlockModel& model, const string& name) { return model.group(name).travelled; }
	Real     work(BlockModel& model, const string& name) { return model.group(name).work; }
	py::list groupNames(const BlockModel& model)
	{
		py::list names;
		for (const MotionGroup& g : model.assembly.groups)
			names.append(g.name);
		return names;
	}

	py::dict elasticJump(BlockModel& model, Real fraction)
	{
		const blocks::ElasticJump jump = blocks::elasticJump(model.assembly, fraction, Omega::instance().getScene()->time);
		py::dict                  out;
		out["time"]  = jump.time;
		out["point"] = jump.point;
		return out;
	}

	void gravity(BlockModel& model, const Vector2r& g) { blocks::addGravity(model.assembly, g); }

	void traction(BlockModel& model, const py::object& edges, const Vector2r& stress)
	{
		const auto list = integers(edges);
		if (list.empty()) throw std::invalid_argument("BlockModel.traction: no edges were chosen");
		for (long edge : list)
			blocks::addTraction(model.assembly, int(edge), stress);
	}

	// ---- arrays

	enum class Use { state, result }; ///< scripts may write the one but not the other

	void startNumpy()
	{
		static const bool ready = (np::initialize(), true);
		(void)ready;
	}

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
		const bool    grows = py::extract<BlockModel&>(self)().firstBody < 0;
		if (grows) array = array.attr("copy")();
		if (grows || use == Use::result) array.attr("setflags")(false);
		return array;
	}

	BlockAssembly& arrays(const py::object& self) { return py::extract<BlockModel&>(self)().assembly; }

	py::object zoneStress(const py::object& self)
	{
		BlockAssembly& a = arrays(self);
		startNumpy();
		np::ndarray out  = np::empty(py::make_tuple(a.zoneCount(), 3), np::dtype::get_builtin<Real>());
		Real*       data = reinterpret_cast<Real*>(out.get_data());
		for (int block = 0; block < a.blockCount(); ++block)
			for (int z = a.firstZone[block]; z < a.firstZone[block + 1]; ++z) {
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
		std::vector<int>          corners; // grid points of the rings, one ring after the other
		std::vector<blocks::Ring> rings;
		for (int e = a.firstEdge[block], first = -1; e < a.firstEdge[block + 1]; ++e) {
			const auto [node, next] = a.edgeNodes[e];
			if (first < 0) rings.emplace_back(), first = node;
			rings.back().push_back(a.reference[node]);
			corners.push_back(node);
			if (next == first) first = -1;
		}
		const blocks::Zones zones = blocks::cornerZones(blocks::Polygon { rings[0], { rings.begin() + 1, rings.end() } });
		startNumpy();
		np::ndarray out  = np::empty(py::make_tuple(zones.triangles.size(), 3), np::dtype::get_builtin<int>());
		int*        data = reinterpret_cast<int*>(out.get_data());
		for (const auto& triangle : zones.triangles)
			for (int corner : triangle)
				*data++ = corners[corner];
		return out;
	}

	py::object contactPositions(const py::object& self)
	{
		BlockAssembly& a = arrays(self);
		startNumpy();
		np::ndarray out  = np::empty(py::make_tuple(a.points.size(), 2), np::dtype::get_builtin<Real>());
		Real*       data = reinterpret_cast<Real*>(out.get_data());
		for (size_t i = 0; i < a.points.size(); ++i) {
			const Vec2 x = blocks::contactPosition(a, int(i));
			data[2 * i] = x.x(), data[2 * i + 1] = x.y();
		}
		return out;
	}

#define VIEW(use, name, Number, member, columns, doc)                                                                                                          \
	.add_property(#name, py::make_function(+[](py::object self) -> py::object { return view<Number>(self, arrays(self).member, columns, Use::use); }), doc)
#define VIEW_FIELD(use, name, Number, member, Item, field, columns, doc)                                                                                       \
	.add_property(                                                                                                                                         \
		#name,                                                                                                                                         \
		py::make_function(+[](py::object self) -> py::object {                                                                                         \
			return view<Number>(self, arrays(self).member, columns, Use::use, offsetof(blocks::Item, field));                                      \
		}),                                                                                                                                            \
		doc)

/// ... of joints: of those that are released, which no step follows, as they are now
#define VIEW_JOINT(name, member, Item, field, columns, doc)                                                                                                    \
	.add_property(                                                                                                                                         \
		#name,                                                                                                                                         \
		py::make_function(+[](py::object self) -> py::object {                                                                                         \
			blocks::updateKinematics(arrays(self), 0, int(arrays(self).segments.size()), blocks::Which::released);                                 \
			return view<Real>(self, arrays(self).member, columns, Use::result, offsetof(blocks::Item, field));                                     \
		}),                                                                                                                                            \
		doc)

	py::dict zoneQuality(const BlockModel& m)
	{
		if (m.assembly.zoneCount() == 0) throw std::runtime_error("BlockModel.zoneQuality: the model has no zones yet");
		const auto q = blocks::quality({ m.assembly.reference, {}, m.assembly.zoneNodes });
		py::dict   out;
		out["minAngle"] = q.minAngle, out["maxAngle"] = q.maxAngle;
		out["minArea"] = q.minArea, out["maxArea"] = q.maxArea;
		out["worstAspect"] = q.worstAspect;
		return out;
	}

	int  blockCount(const BlockModel& m) { return m.assembly.blockCount(); }
	int  nodeCount(const BlockModel& m) { return m.assembly.nodeCount(); }
	int  zoneCount(const BlockModel& m) { return m.assembly.zoneCount(); }
	int  contactCount(const BlockModel& m) { return int(m.assembly.points.size()); }
	Real unbalancedRatio(const BlockModel& m, Real floor) { return blocks::unbalancedRatio(m.assembly, floor); }
	Real kineticEnergy(const BlockModel& m) { return blocks::kineticEnergy(m.assembly); }

} // namespace

void BlockModelPython::visit(py::class_<BlockModel, shared_ptr<BlockModel>, py::bases<Serializable>, boost::noncopyable>& c) const
{
	using py::arg;
	c.def("insert", &BlockModel::insert, "Hands the model over to the scene: one Body a block into O.bodies, one Interaction a pair into O.interactions.")
		.def("drive",
	             &drive,
	             (arg("name"), arg("nodes"), arg("axes"), arg("velocity") = 0., arg("rampTime") = 0., arg("startTime") = 0.),
	             "Prescribes the velocity [m/s] of grid points along 'x', 'y' or 'xy' (0: held), reached smoothly within rampTime [s] after startTime [s].")
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
		.def("groupForce", &force, (arg("name")), "Force that a group puts on the blocks along its axes, in the last step [N].")
		.def("groupVelocity", &velocity, (arg("name")), "Present velocity of a group [m/s].")
		.def("groupTravelled", &travelled, (arg("name")), "Displacement of a group so far [m].")
		.def("groupWork", &work, (arg("name")), "Work that a group has done on the blocks [J].")
		.add_property("groups", &groupNames, "Names of the motion groups.")
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
	             "To be called after the first step, which brings the joints' properties (Mohr-Coulomb). Returns {'time': of loading at full speed that "
	             "was leapt over [s], 'point': the contact point that will fail first}. "
	             "Errors: RuntimeError where joints are broken or never were bonded, blocks are not held, nothing is driven, or the loads alone break a "
	             "joint; nothing is changed then.")
		.def("unbalancedRatio",
	             &unbalancedRatio,
	             (arg("floor") = 0.),
	             "Sum of unbalanced |force| over free degrees of freedom (of rigid blocks: of their bodies, without moments) by twice the sum of contact "
	             "|forces|, the latter at least floor [N]. YADE's utils.unbalancedForce() knows nothing of grid points.")
		.def("kineticEnergy", &kineticEnergy, "Kinetic energy, with the scaled masses if masses are scaled [J].")
		.def("zoneStress",
	             py::make_function(&zoneStress),
	             "Cauchy stress of every zone: sxx, syy, sxy, tension positive; shape (zones, 3) [Pa]. A copy.")
		.def("zoneQuality",
	             &zoneQuality,
	             "Quality of the mesh, a dictionary: minAngle, maxAngle [rad], minArea, maxArea [m2], worstAspect (longest edge by least height, 1 for an "
	             "equilateral triangle).")
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
		.add_property("contactCount", &contactCount, "Number of contact points.") VIEW(
			state, position, Real, position, 2, "Grid points' positions, shape (grid points, 2) [m].")
			VIEW(result, reference, Real, reference, 2, "Grid points' positions without stress, shape (grid points, 2) [m].") VIEW(
				state, velocity, Real, velocity, 2, "Grid points' velocities half a step ago, shape (grid points, 2) [m/s].")
				VIEW(result, force, Real, force, 2, "Grid points' unbalanced forces, shape (grid points, 2) [N].") VIEW(
					result, mass, Real, mass, 1, "Grid points' true masses; 0 on rigid blocks, whose body has it all [kg].")
					VIEW(result, inertia, Real, inertia, 1, "Grid points' masses as they resist motion, scaled if BlockTimeStepper scales them [kg].") VIEW(
						result, zoneNodes, int, zoneNodes, 3, "Grid points of every zone, counter-clockwise, shape (zones, 3).")
						VIEW(result, zoneVolume, Real, zoneVolume, 1, "Volumes of the zones [m3].") VIEW(
							result, firstNode, int, firstNode, 1, "First grid point of every block, and their number at the end.")
							VIEW(result, firstZone, int, firstZone, 1, "First zone of every block, and their number at the end.") VIEW(
								result,
								firstEdge,
								int,
								firstEdge,
								1,
								"First boundary edge of every block, and their number at the end.")
								VIEW(result,
	                                                             blockMaterial,
	                                                             int,
	                                                             blockMaterial,
	                                                             1,
	                                                             "Material of every block, an index into materialLabels.")
									VIEW(result,
	                                                                     edgeNodes,
	                                                                     int,
	                                                                     edgeNodes,
	                                                                     2,
	                                                                     "Grid points of the boundary edges, material on the left, shape (edges, 2).")
										VIEW_FIELD(
											result,
											segmentNodes,
											int,
											segments,
											Segment,
											node,
											4,
											"Edge a1, b1 of the first and a2, b2 of the second block of every "
											"segment, shape (segments, 4).")
											VIEW_FIELD(
												result,
												segmentBlocks,
												int,
												segments,
												Segment,
												block,
												2,
												"The two blocks of every segment, shape (segments, 2).")
												VIEW_FIELD(
													result,
													segmentParameters,
													Real,
													segments,
													Segment,
													s1,
													4,
													"Where the two contact points are along the first "
													"edge, then along the second (0 at a, 1 at b), shape "
													"(segments, 4).")
													VIEW_FIELD(
														result,
														segmentArea,
														Real,
														segments,
														Segment,
														area,
														1,
														"Area of each of the two contact points of "
														"every segment; 0 once it has broken and its "
														"edges are a free contact, which has all that "
														"they carry [m2].")
														VIEW_JOINT(
															normal,
															frames,
															SegmentFrame,
															nx,
															2,
															"Unit normals of the segments, out of "
															"the first block, shape (segments, 2).")
															VIEW_JOINT(
																pointOpening,
																points,
																ContactPoint,
																opening,
																1,
																"Openings of the contact "
																"points, two a segment [m].")
																VIEW_JOINT(
																	pointSlip,
																	points,
																	ContactPoint,
																	slip,
																	1,
																	"Slips of the contact "
																	"points [m].")
																	VIEW_FIELD(
																		result,
																		pointSigma,
																		Real,
																		points,
																		ContactPoint,
																		sigma,
																		1,
																		"Normal "
																		"stresses of "
																		"the contact "
																		"points, "
																		"tension "
																		"positive "
																		"[Pa].")
																		VIEW_FIELD(
																			result,
																			pointTau,
																			Real,
																			points,
																			ContactPoint,
																			tau,
																			1,
																			"Shear "
																			"stress"
																			"es of "
																			"the "
																			"contac"
																			"t "
																			"points"
																			" [Pa]"
																			".")
		.add_property(
			"pointStatus",
			py::make_function(+[](py::object self) -> py::object {
				return view<std::uint8_t>(
					self,
					arrays(self).points,
					1,
					Use::result,
					offsetof(blocks::ContactPoint, joint) + offsetof(blocks::JointState, status));
			}),
			"0 intact, 1 broken in tension, 2 broken in shear, 3 never bonded.");
}

namespace {
	/// Reads or sets one property of a pair's joint; a change is checked and reaches masses and time step.
	template <Real blocks::JointParams::*member> Real get(const JointPhys& phys) { return phys.joint().*member; }
	template <Real blocks::JointParams::*member> void set(JointPhys& phys, Real value)
	{
		blocks::JointParams changed = phys.joint();
		changed.*member             = value;
		blocks::validate(changed);
		phys.joint() = changed;
		phys.model->stiffnessChanged();
	}
	template <Real blocks::JointParams::*member> Real getAngle(const JointPhys& phys) { return std::atan(phys.joint().*member); }
	template <Real blocks::JointParams::*member> void setAngle(JointPhys& phys, Real angle)
	{
		blocks::require(angle >= 0 && angle < M_PI / 2, "an angle of JointPhys must lie in [0, pi/2) rad", angle);
		set<member>(phys, std::tan(angle));
	}

	template <class Value> py::list ofPoints(const JointPhys& phys, const Value& value)
	{
		py::list list;
		phys.joint();
		const auto& a = phys.model->assembly;
		for (int i = 2 * a.pairs[phys.pair].first; i < 2 * a.pairs[phys.pair].last; ++i)
			list.append(value(a.points[i]));
		return list;
	}
	py::list sigma(const JointPhys& phys)
	{
		return ofPoints(phys, [](const blocks::ContactPoint& p) { return p.sigma; });
	}
	py::list tau(const JointPhys& phys)
	{
		return ofPoints(phys, [](const blocks::ContactPoint& p) { return p.tau; });
	}
	py::list status(const JointPhys& phys)
	{
		return ofPoints(phys, [](const blocks::ContactPoint& p) { return int(p.joint.status); });
	}
} // namespace

void JointPhysPython::visit(py::class_<JointPhys, shared_ptr<JointPhys>, py::bases<IPhys>, boost::noncopyable>& c) const
{
	using P = blocks::JointParams;
	c.add_property("kn", &get<&P::kn>, &set<&P::kn>, "Normal stiffness [Pa/m].")
		.add_property("ks", &get<&P::ks>, &set<&P::ks>, "Shear stiffness [Pa/m].")
		.add_property("cohesion", &get<&P::cohesion>, &set<&P::cohesion>, "Cohesion [Pa].")
		.add_property("tension", &get<&P::tension>, &set<&P::tension>, "Tensile strength [Pa].")
		.add_property("cohesionResidual", &get<&P::cohesionResidual>, &set<&P::cohesionResidual>, "Cohesion after failure [Pa].")
		.add_property("tensionResidual", &get<&P::tensionResidual>, &set<&P::tensionResidual>, "Tensile strength after failure [Pa].")
		.add_property(
			"dilationLimitSlip", &get<&P::dilationLimitSlip>, &set<&P::dilationLimitSlip>, "Slip beyond which the joint dilates no further [m].")
		.add_property("frictionAngle", &getAngle<&P::tanPhi>, &setAngle<&P::tanPhi>, "Friction angle [rad].")
		.add_property("frictionAngleResidual", &getAngle<&P::tanPhiResidual>, &setAngle<&P::tanPhiResidual>, "Friction angle after failure [rad].")
		.add_property("dilationAngle", &getAngle<&P::tanDilation>, &setAngle<&P::tanDilation>, "Dilation angle [rad].")
		.add_property("sigma", &sigma, "Normal stresses at the pair's contact points, tension positive [Pa].")
		.add_property("tau", &tau, "Shear stresses at the pair's contact points [Pa].")
		.add_property("status", &status, "Of the pair's contact points: 0 intact, 1 broken in tension, 2 broken in shear, 3 never bonded.");
}

} // namespace yade
