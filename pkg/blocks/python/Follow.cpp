// yade-blocks, GPL-2.0-or-later
#include <blocks/engines/RigidBodies.hpp>
#include <blocks/kernel/analysis/ElasticJump.hpp>
#include <blocks/kernel/analysis/Follow.hpp>
#include <blocks/python/Follow.hpp>
#include <boost/python/numpy.hpp>
#include <core/Omega.hpp>

namespace yade {

namespace np = boost::python::numpy;

namespace {
	template <class Number, class Items, class Value> np::ndarray column(const Items& items, const Value& value)
	{
		np::ndarray out  = np::empty(py::make_tuple(items.size()), np::dtype::get_builtin<Number>());
		Number*     data = reinterpret_cast<Number*>(out.get_data());
		for (const auto& item : items)
			*data++ = value(item);
		return out;
	}

	/// As BlockModel.pointStatus counts: 1 tension, 2 shear, 0 nothing breaks.
	int modeOf(blocks::PointEvent how) { return how == blocks::PointEvent::none ? 0 : how == blocks::PointEvent::tension ? 1 : 2; }

	string shown(const py::object& object) { return py::extract<string>(object.attr("__repr__")()); }

	/// How many gauges a list holds.
	long lengthOf(const py::object& gauges)
	{
		if (!PySequence_Check(gauges.ptr())) throw std::invalid_argument("BlockModel.follow.gauges must be a list of Gauges, got " + shown(gauges));
		return py::len(gauges);
	}
}

const char* const followDoc
	= "Follows the loading along one group from event to event (failure, slip, stick, opening, closing), the exact quasi-static answer of the brittle "
	  "model "
	  "in small displacement: no rate, damping or mass. All other loads act fully and stay; forces that engines put on rigid blocks' bodies are not known. "
	  "Joints must have their properties (Mohr-Coulomb), from bond() or from a first step. It leaves the model in the state reached, from where time steps "
	  "go on at the group's full speed (a group's force: stays "
	  "as reached). "
	  "group: name of a driven or pushed group, followed in the direction of its target, or index of a rigid block whose body has a prescribed velocity. "
	  "It ends by whichever comes first: the force has fallen below drop (0: do not ask) of its largest value, snap-backs included, after which peak=True "
	  "goes back to that largest value; the group "
	  "has moved by displacement [m] from here; so many contact points have broken (cracks); progress(displacement [m], force [N], broken) returned False; "
	  "the path "
	  "ends by itself ('ended' says where and why: blocks have slid, parted or overlap by more than a tenth of an edge; no admissible state; equilibrium "
	  "lost; nothing left "
	  "to break). It knows joints alone: blocks that meet in a corner without a joint do not feel each other. "
	  "release: 'path' lets the load fall where that keeps the next point whole, as a machine of infinite stiffness and speed would (snap-back); 'cascade' "
	  "holds it while points "
	  "break one after the other. gauges: objects with the attributes below, above (grid points) and axis, as yadeblocks.specimen.Gauge. "
	  "Returns a dictionary. Along the path, a point where something stands at its strength and one where what it lost has been given away: displacement "
	  "[m], force [N] "
	  "in the direction of loading, broken (contact points so far), point (that breaks next, or -1), gauges (changes, one array a gauge [m]). Then "
	  "crackPoint, crackMode (1 tension, "
	  "2 shear) in the order of breaking; ended; reached (displacement, force); steps (straight pieces); energy (work, zones, joints, friction, excess, "
	  "which dynamics "
	  "would carry away, anchors) [J]; residual and inadmissible (largest over the path, relative); handOver (unbalanced force left in large displacement, "
	  "by the largest force at "
	  "a contact point); looseBlocks, tied by soft springs whose largest force is anchorForce [N]. "
	  "Errors: RuntimeError for a group without target, blocks that nothing holds (with their indices), joints without properties or softening, blocks "
	  "that touch "
	  "without a joint; ValueError for "
	  "values out of range. Nothing is changed then.";

py::dict elasticJump(BlockModel& model, Real fraction)
{
	Scene* scene = Omega::instance().getScene().get();
	if (model.firstBody >= 0) readRigidMotion(scene, model);
	const blocks::ElasticJump jump = blocks::elasticJump(model.assembly, fraction, scene->time);
	if (model.firstBody >= 0) restoreRigidBodies(scene, model);
	py::dict out;
	out["time"]  = jump.time;
	out["point"] = jump.point;
	return out;
}

py::dict
follow(BlockModel&       model,
       const py::object& group,
       bool              peak,
       Real              drop,
       Real              displacement,
       long              cracks,
       const string&     release,
       const py::object& gauges,
       const py::object& progress)
{
	if (release != "path" && release != "cascade")
		throw std::invalid_argument("BlockModel.follow: release must be 'path' or 'cascade', got '" + release + "'");
	blocks::FollowUntil until;
	until.peak         = peak;
	until.drop         = drop;
	until.displacement = displacement;
	blocks::require(cracks >= 1, "BlockModel.follow: cracks must be at least 1", Real(cracks));
	until.cracks = int(std::min(cracks, long(std::numeric_limits<int>::max())));

	blocks::BlockAssembly&    a = model.assembly;
	blocks::Driver            driver;
	const py::extract<string> name(group);
	if (name.check())
		driver.group = int(&model.group(name()) - a.state.groups.data());
	else {
		const py::extract<int> index(group);
		if (!index.check())
			throw std::invalid_argument("BlockModel.follow.group must be the name of a group or the index of a rigid block, got " + shown(group));
		const int block = index();
		for (size_t i = 0; i < a.state.rigid.size(); ++i)
			if (a.state.rigid[i].block == block) driver.rigid = int(i);
		blocks::require(driver.rigid >= 0, "BlockModel.follow needs the name of a group or the index of a rigid block", block);
	}
	std::vector<blocks::Gauge> functionals;
	for (long k = 0; k < lengthOf(gauges); ++k) {
		for (const char* attribute : { "axis", "below", "above" })
			if (!PyObject_HasAttrString(py::object(gauges[k]).ptr(), attribute))
				throw std::invalid_argument("BlockModel.follow.gauges must be a list of Gauges, got " + shown(gauges));
		const int axis = py::extract<int>(gauges[k].attr("axis"));
		functionals.emplace_back();
		for (const char* side : { "below", "above" }) {
			const py::object nodes = gauges[k].attr(side);
			const long       count = py::len(nodes);
			for (long n = 0; n < count; ++n) {
				const int node = py::extract<int>(nodes[n].attr("__int__")());
				blocks::require(node >= 0 && node < a.nodeCount(), "BlockModel.follow: a gauge holds no such grid point", node);
				functionals.back().emplace_back(2 * node + axis, (*side == 'a' ? 1. : -1.) / Real(count));
			}
		}
	}
	if (model.firstBody >= 0) readRigidMotion(Omega::instance().getScene().get(), model);
	const shared_ptr<Scene> scene = Omega::instance().getScene();
	auto                    look  = [&](const blocks::PathPoint& p) {
                if (progress.is_none()) return true;
                const py::object answer = progress(p.displacement, p.force, p.broken);
                return answer.is_none() || py::extract<bool>(answer)();
	};
	const auto report
		= blocks::follow(a, driver, until, release == "path" ? blocks::Release::path : blocks::Release::cascade, scene->time, functionals, look);
	if (model.firstBody >= 0) restoreRigidBodies(scene.get(), model);
	model.stiffnessChanged();

	np::initialize();
	using P = blocks::PathPoint;
	using C = blocks::PathCrack;
	py::dict out, energy;
	out["displacement"] = column<Real>(report.path, [](const P& p) { return p.displacement; });
	out["force"]        = column<Real>(report.path, [](const P& p) { return p.force; });
	out["broken"]       = column<long>(report.path, [](const P& p) { return p.broken; });
	out["point"]        = column<long>(report.path, [](const P& p) { return p.point; });
	py::list values;
	for (const auto& gauge : report.gauges)
		values.append(column<Real>(gauge, [](Real v) { return v; }));
	out["gauges"]       = values;
	out["crackPoint"]   = column<long>(report.cracks, [](const C& c) { return c.point; });
	out["crackMode"]    = column<long>(report.cracks, [](const C& c) { return modeOf(c.how); });
	energy["work"]      = report.energy.work;
	energy["zones"]     = report.energy.zones;
	energy["joints"]    = report.energy.joints;
	energy["friction"]  = report.energy.friction;
	energy["excess"]    = report.energy.excess;
	energy["anchors"]   = report.energy.anchors;
	out["energy"]       = energy;
	out["ended"]        = report.ended;
	out["reached"]      = py::make_tuple(report.reached.displacement, report.reached.force);
	out["steps"]        = report.steps;
	out["residual"]     = report.residual;
	out["inadmissible"] = report.inadmissible;
	out["handOver"]     = report.handOver;
	py::list loose;
	for (int block : report.looseBlocks)
		loose.append(block);
	out["looseBlocks"] = loose;
	out["anchorForce"] = report.anchorForce;
	return out;
}

} // namespace yade
