// yade-blocks, GPL-2.0-or-later
#include <blocks/python/ModelPython.hpp>
#include <blocks/python/Numpy.hpp>
#include <boost/python/raw_function.hpp>
#include <cmath>

/// Properties of joints by the joint, as columns.
namespace yade {

namespace np = boost::python::numpy;
using blocks::JointParams;

namespace {

	struct Property {
		const char* name;
		Real JointParams::*member;
		bool               isAngle;
	};
	const Property properties[] = { { "kn", &JointParams::kn, false },
		                        { "ks", &JointParams::ks, false },
		                        { "cohesion", &JointParams::cohesion, false },
		                        { "tension", &JointParams::tension, false },
		                        { "frictionAngle", &JointParams::tanPhi, true },
		                        { "cohesionResidual", &JointParams::cohesionResidual, false },
		                        { "tensionResidual", &JointParams::tensionResidual, false },
		                        { "frictionAngleResidual", &JointParams::tanPhiResidual, true },
		                        { "dilationAngle", &JointParams::tanDilation, true },
		                        { "dilationLimitSlip", &JointParams::dilationLimitSlip, false } };

	py::dict jointProperties(const BlockModel& model)
	{
		startNumpy();
		const auto& joints = model.assembly.joints;
		py::dict    out;
		for (const Property& p : properties) {
			np::ndarray column = np::empty(py::make_tuple(joints.count()), np::dtype::get_builtin<Real>());
			Real*       data   = reinterpret_cast<Real*>(column.get_data());
			for (int i = 0; i < joints.count(); ++i)
				data[i] = p.isAngle ? std::atan(joints.of(i).*p.member) : joints.of(i).*p.member;
			out[p.name] = column;
		}
		return out;
	}

	/// One number for each of `count` joints, from one number or as many.
	vector<Real> column(const py::object& values, const char* name, int count)
	{
		const py::object list = py::import("numpy").attr("asarray")(values, "float64").attr("ravel")().attr("tolist")();
		const long       n    = py::len(list);
		if (n != 1 && n != count)
			throw std::invalid_argument(
				"BlockModel.setJoints: " + string(name) + " must be one number or one for each joint, " + std::to_string(count) + ", got "
				+ std::to_string(n));
		vector<Real> out(count);
		for (int i = 0; i < count; ++i)
			out[i] = py::extract<Real>(list[n == 1 ? 0 : i]);
		return out;
	}

	py::object setJoints(py::tuple args, py::dict keywords)
	{
		if (py::len(args) > 2)
			throw std::invalid_argument("BlockModel.setJoints takes joints and keywords, got " + std::to_string(py::len(args) - 1) + " arguments");
		BlockModel& model = py::extract<BlockModel&>(args[0]);
		auto&       a     = model.assembly;
		if (a.joints.count() == 0) throw std::runtime_error("BlockModel.setJoints: there are no joints yet; call bond() first");
		vector<long> chosen;
		py::object   which = py::len(args) == 2 ? py::object(args[1]) : py::object();
		if (keywords.has_key("joints")) {
			which = keywords["joints"];
			keywords["joints"].del();
		}
		if (which.is_none())
			for (int i = 0; i < a.joints.count(); ++i)
				chosen.push_back(i);
		else
			chosen = integers(which);
		for (long i : chosen)
			blocks::require(i >= 0 && i < a.joints.count(), "BlockModel.setJoints: no such joint; joints has indices of segments", Real(i));

		vector<JointParams> changed;
		for (long i : chosen)
			changed.push_back(a.joints.of(int(i)));
		const py::list names = keywords.keys();
		for (long k = 0; k < py::len(names); ++k) {
			const string name = py::extract<string>(names[k]);
			const auto   p    = std::find_if(std::begin(properties), std::end(properties), [&](const Property& q) { return q.name == name; });
			if (p == std::end(properties)) {
				string known;
				for (const Property& q : properties)
					known += (known.empty() ? "" : ", ") + string(q.name);
				throw std::invalid_argument("BlockModel.setJoints: there is no property \"" + name + "\"; there are: " + known);
			}
			const vector<Real> values = column(keywords[names[k]], p->name, int(chosen.size()));
			for (size_t i = 0; i < values.size(); ++i) {
				if (p->isAngle)
					blocks::require(
						values[i] >= 0 && values[i] < M_PI / 2,
						"BlockModel.setJoints: " + name + " must lie in [0, pi/2) rad",
						values[i]);
				changed[i].*p->member = p->isAngle ? std::tan(values[i]) : values[i];
			}
		}
		for (const JointParams& p : changed)
			blocks::validate(p); // all before any is set
		for (size_t i = 0; i < chosen.size(); ++i)
			a.changeJoint(int(chosen[i]), changed[i]);
		model.stiffnessChanged();
		return py::object();
	}

} // namespace

void defineJoints(PythonModel& c)
{
	c.add_property(
		 "jointProperties",
		 &jointProperties,
		 "Properties of all joints as a dictionary of columns, one entry a segment: kn, ks [Pa/m], cohesion, tension, cohesionResidual, "
		 "tensionResidual [Pa], "
		 "frictionAngle, frictionAngleResidual, dilationAngle [rad], dilationLimitSlip [m]. Copies; :yref:`setJoints<BlockModel.setJoints>` changes "
		 "them.")
		.def("setJoints",
	             py::raw_function(&setJoints, 1),
	             "setJoints(joints=None, kn=..., ks=..., cohesion=..., ...): new properties for the given joints (indices of segments; None: all), each "
	             "one "
	             "number or one for each of them; names as in :yref:`jointProperties<BlockModel.jointProperties>`. So joints of a region or of a list can "
	             "have their own. Reaches masses and time step. Errors: ValueError for impossible values and unknown names; nothing is changed then.");
}

} // namespace yade
