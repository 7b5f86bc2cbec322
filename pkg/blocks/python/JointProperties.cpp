// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/geometry/PolygonRules.hpp>
#include <blocks/kernel/model/JointChoice.hpp>
#include <blocks/kernel/model/StrengthField.hpp>
#include <blocks/kernel/step/Joints.hpp>
#include <blocks/python/JointChoice.hpp>
#include <blocks/python/ModelPython.hpp>
#include <blocks/python/Sequences.hpp>
#include <blocks/views/Numpy.hpp>
#include <boost/python/raw_function.hpp>
#include <cmath>

/// Properties of joints by the joint, as columns.
namespace yade {

namespace np = boost::python::numpy;
using blocks::CapParams;
using blocks::JointParams;
using blocks::SofteningParams;

namespace {

	struct Property {
		const char* name;
		Real JointParams::*member;
		bool               isAngle;
		Real SofteningParams::*softening = nullptr; ///< instead of `member`
		Real CapParams::*cap             = nullptr; ///< likewise
	};

	/// All properties of a joint.
	struct Joint {
		JointParams     params;
		SofteningParams softening;

		Real& operator[](const Property& p) { return p.cap ? softening.cap.*p.cap : p.softening ? softening.*p.softening : params.*p.member; }
	};
	Joint jointOf(const BlockModel& model, int joint) { return { model.assembly.joints.of(joint), model.assembly.joints.softeningOf(joint) }; }

	const Property properties[] = { { "kn", &JointParams::kn, false },
		                        { "ks", &JointParams::ks, false },
		                        { "cohesion", &JointParams::cohesion, false },
		                        { "tension", &JointParams::tension, false },
		                        { "frictionAngle", &JointParams::tanPhi, true },
		                        { "cohesionResidual", &JointParams::cohesionResidual, false },
		                        { "tensionResidual", &JointParams::tensionResidual, false },
		                        { "frictionAngleResidual", &JointParams::tanPhiResidual, true },
		                        { "dilationAngle", &JointParams::tanDilation, true },
		                        { "dilationLimitSlip", &JointParams::dilationLimitSlip, false },
		                        { "GfI", nullptr, false, &SofteningParams::energyI },
		                        { "GfII", nullptr, false, &SofteningParams::energyII },
		                        { "GfIIPressure", nullptr, false, &SofteningParams::energyIIPressure },
		                        { "lastingShare", nullptr, false, &SofteningParams::lastingShare },
		                        { "dilationDecay", nullptr, false, &SofteningParams::dilationDecay },
		                        { "dilationPressure", nullptr, false, &SofteningParams::dilationPressure },
		                        { "capStrength", nullptr, false, nullptr, &CapParams::strength },
		                        { "capFirst", nullptr, false, nullptr, &CapParams::first },
		                        { "capResidual", nullptr, false, nullptr, &CapParams::residual },
		                        { "capPeakClosure", nullptr, false, nullptr, &CapParams::peakClosure },
		                        { "capEnergy", nullptr, false, nullptr, &CapParams::energy },
		                        { "capShear", nullptr, false, nullptr, &CapParams::shear },
		                        { "capLinear", nullptr, false, nullptr, &CapParams::linear } };

	py::dict jointProperties(const BlockModel& model)
	{
		startNumpy();
		const auto& joints = model.assembly.joints;
		py::dict    out;
		for (const Property& p : properties) {
			np::ndarray column = np::empty(py::make_tuple(joints.count()), np::dtype::get_builtin<Real>());
			Real*       data   = reinterpret_cast<Real*>(column.get_data());
			for (int i = 0; i < joints.count(); ++i) {
				const Real value = jointOf(model, i)[p];
				data[i]          = p.isAngle ? std::atan(value) : value;
			}
			out[p.name] = column;
		}
		return out;
	}

	/// One number for each of `count` joints, from one number or as many.
	vector<Real> column(const py::object& values, const char* name, int count)
	{
		py::object list;
		try {
			list = py::import("numpy").attr("asarray")(values, "float64").attr("ravel")().attr("tolist")();
		} catch (const py::error_already_set&) {
			PyErr_Clear();
			throw std::invalid_argument(
				"BlockModel.setJoints: " + string(name) + " must be one number or one for each joint, " + std::to_string(count) + ", got "
				+ string(py::extract<string>(values.attr("__repr__")())));
		}
		const long n = py::len(list);
		if (n != 1 && n != count)
			throw std::invalid_argument(
				"BlockModel.setJoints: " + string(name) + " must be one number or one for each joint, " + std::to_string(count) + ", got "
				+ std::to_string(n));
		vector<Real> out(count);
		for (int i = 0; i < count; ++i)
			out[i] = py::extract<Real>(list[n == 1 ? 0 : i]);
		return out;
	}

	/// Takes a keyword out; None if it is not there.
	py::object taken(py::dict& keywords, const char* name)
	{
		if (!keywords.has_key(name)) return py::object();
		const py::object value = keywords[name];
		keywords[name].del();
		return value;
	}

	py::object setJoints(py::tuple args, py::dict keywords)
	{
		if (py::len(args) > 2)
			throw std::invalid_argument("BlockModel.setJoints takes joints and keywords, got " + std::to_string(py::len(args) - 1) + " arguments");
		BlockModel& model = py::extract<BlockModel&>(args[0]);
		auto&       a     = model.assembly;
		if (a.joints.count() == 0) throw std::runtime_error("BlockModel.setJoints: there are no joints yet; call bond() first");
		py::object which = py::len(args) == 2 ? py::object(args[1]) : py::object();
		if (keywords.has_key("joints")) which = taken(keywords, "joints");
		const py::object   pair = taken(keywords, "pair"), region = taken(keywords, "region");
		const vector<long> chosen = narrowed(model, chosenJoints(model, which, "BlockModel.setJoints"), pair, region, "BlockModel.setJoints");
		if (chosen.empty() && !(pair.is_none() && region.is_none()))
			throw std::invalid_argument("BlockModel.setJoints: no joint is between the two materials of pair and within region");

		vector<Joint> changed;
		for (long i : chosen)
			changed.push_back(jointOf(model, int(i)));
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
				changed[i][*p] = p->isAngle ? std::tan(values[i]) : values[i];
			}
		}
		for (size_t i = 0; i < chosen.size(); ++i) // all before any is set
			a.requireChangeable(int(chosen[i]), changed[i].params, changed[i].softening);
		for (size_t i = 0; i < chosen.size(); ++i)
			a.changeJoint(int(chosen[i]), changed[i].params, changed[i].softening);
		model.stiffnessChanged();
		return py::object();
	}

	py::object scatterStrengths(BlockModel& model, Real cov, Real correlationLength, long seed, const string& kind, const py::object& which)
	{
		auto& a = model.assembly;
		if (a.joints.count() == 0) throw std::runtime_error("BlockModel.scatterStrengths: there are no joints yet; call bond() first");
		model.requireProperties();
		if (kind != "weibull" && kind != "lognormal")
			throw std::invalid_argument("BlockModel.scatterStrengths: kind must be 'weibull' or 'lognormal', got '" + kind + "'");
		blocks::require(seed >= 0, "BlockModel.scatterStrengths: seed must not be negative", Real(seed));
		const auto chosen = chosenJoints(model, which, "BlockModel.scatterStrengths");

		vector<blocks::Vec2> places;
		for (long i : chosen)
			places.push_back((blocks::contactPosition(a, 2 * int(i)) + blocks::contactPosition(a, 2 * int(i) + 1)) / 2);
		blocks::StrengthScatter scatter;
		scatter.kind              = kind == "weibull" ? blocks::StrengthScatter::Kind::weibull : blocks::StrengthScatter::Kind::lognormal;
		scatter.cov               = cov;
		scatter.correlationLength = correlationLength;
		scatter.seed              = std::uint64_t(seed);
		const vector<Real> factor = blocks::strengthFactors(places, scatter);

		vector<Joint> changed;
		for (size_t i = 0; i < chosen.size(); ++i) {
			JointParams& p = changed.emplace_back(jointOf(model, int(chosen[i]))).params;
			p.tension      = p.tensionResidual + factor[i] * (p.tension - p.tensionResidual);
			p.cohesion     = p.cohesionResidual + factor[i] * (p.cohesion - p.cohesionResidual);
			a.requireChangeable(int(chosen[i]), p, changed.back().softening);
		}
		for (size_t i = 0; cov > 0 && i < chosen.size(); ++i)
			a.changeJoint(int(chosen[i]), changed[i].params, changed[i].softening);
		startNumpy();
		np::ndarray out = np::empty(py::make_tuple(factor.size()), np::dtype::get_builtin<Real>());
		std::copy(factor.begin(), factor.end(), reinterpret_cast<Real*>(out.get_data()));
		return out;
	}

} // namespace

void defineJoints(PythonModel& c)
{
	using py::arg;
	c.add_property(
		 "jointProperties",
		 &jointProperties,
		 "Properties of all joints as a dictionary of columns, one entry a segment: kn, ks [Pa/m], cohesion, tension, cohesionResidual, "
		 "tensionResidual [Pa], "
		 "frictionAngle, frictionAngleResidual, dilationAngle [rad], dilationLimitSlip [m]; of joints that soften GfI, GfII [J/m2], GfIIPressure [m], "
		 "lastingShare [-], "
		 "dilationDecay [1/m], dilationPressure [Pa] and those of the cap, as in :yref:`JointMat`. Copies; :yref:`setJoints<BlockModel.setJoints>` "
		 "changes "
		 "them.")
		.def("setJoints",
	             py::raw_function(&setJoints, 1),
	             "setJoints(joints=None, pair=None, region=None, kn=..., ks=..., cohesion=..., ...): new properties for the given joints (indices of "
	             "segments, or a name or several of :yref:`nameJoints<BlockModel.nameJoints>`; None: all), of these for those between two materials and "
	             "in a region, as in :yref:`jointsWhere<BlockModel.jointsWhere>`; each one number or one for each of them; names as in "
	             ":yref:`jointProperties<BlockModel.jointProperties>`. Reaches masses and time step. Errors: ValueError for impossible values, unknown "
	             "names and labels, and a pair or region without joints; nothing is changed then.")
		.def("scatterStrengths",
	             &scatterStrengths,
	             (arg("cov"), arg("correlationLength") = 0., arg("seed") = 1, arg("kind") = "weibull", arg("joints") = py::object()),
	             "Strengths that differ from joint to joint: tension and cohesion, as far as they exceed the residual ones, times a random factor of mean "
	             "1, "
	             "the same for both. cov: standard deviation by mean, in [0, 1]; correlationLength: of the field, whose correlation is e^(-(r/length)^2), "
	             "0: "
	             "none [m]; seed: of the field; kind: distribution, 'weibull' or 'lognormal'; joints: indices of segments or names, None: all. Once, "
	             "before the "
	             "first "
	             "step; nothing is kept of it but the strengths. Returns the factors. Errors: ValueError for impossible values, and where a joint that "
	             "softens would snap back.");
}

} // namespace yade
