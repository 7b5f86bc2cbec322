// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/geometry/PolygonRules.hpp>
#include <blocks/kernel/model/JointChoice.hpp>
#include <blocks/kernel/model/StrengthField.hpp>
#include <blocks/kernel/step/Joints.hpp>
#include <blocks/python/Building.hpp>
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

	/// Joints that have one of these names.
	vector<long> namedJoints(const BlockModel& model, const vector<string>& wanted, const string& method)
	{
		const auto& joints = model.assembly.joints;
		string      known;
		for (const string& name : joints.names)
			known += (known.empty() ? "" : ", ") + name;
		for (const string& name : wanted)
			if (std::find(joints.names.begin(), joints.names.end(), name) == joints.names.end())
				throw std::invalid_argument(
					method + ": no joint has the name \"" + name + "\"; " + (known.empty() ? "none has a name" : "there are: " + known));
		vector<long> chosen;
		for (int i = 0; i < joints.count(); ++i)
			if (std::find(wanted.begin(), wanted.end(), joints.called(i)) != wanted.end()) chosen.push_back(i);
		return chosen;
	}

	/// The texts of a text or of a sequence of nothing but texts; empty if it is something else.
	vector<string> texts(const py::object& which)
	{
		vector<string>            out;
		const py::extract<string> one(which);
		if (one.check()) return { one() };
		if (!PyList_Check(which.ptr()) && !PyTuple_Check(which.ptr())) return {};
		for (long i = 0; i < py::len(which); ++i) {
			const py::extract<string> text(which[i]);
			if (!text.check()) return {};
			out.push_back(text());
		}
		return out;
	}

	/// Joints by their indices or by a name or several; None: all.
	vector<long> chosenJoints(const BlockModel& model, const py::object& which, const string& method)
	{
		const int count = model.assembly.joints.count();
		if (const auto wanted = texts(which); !wanted.empty()) return namedJoints(model, wanted, method);
		vector<long> chosen;
		if (which.is_none())
			for (int i = 0; i < count; ++i)
				chosen.push_back(i);
		else
			chosen = integers(which);
		for (long i : chosen)
			blocks::require(i >= 0 && i < count, method + ": no such joint; joints has indices of segments", Real(i));
		return chosen;
	}

	/// The index of a material that blocks of the model have.
	int knownMaterial(const BlockModel& model, const string& label, const string& method)
	{
		const auto& labels = model.materialLabels;
		const auto  found  = std::find(labels.begin(), labels.end(), label);
		string      known;
		for (const string& other : labels)
			known += (known.empty() ? "" : ", ") + other;
		if (found == labels.end())
			throw std::invalid_argument(method + ": no block is of the material \"" + label + "\"; there are: " + (known.empty() ? "none" : known));
		return int(found - labels.begin());
	}

	/// Those of some joints that are between two materials and within a region; None: wherever they are.
	vector<long> narrowed(const BlockModel& model, const vector<long>& joints, const py::object& pair, const py::object& region, const string& method)
	{
		const auto& a = model.assembly;
		vector<int> chosen(joints.begin(), joints.end());
		if (!pair.is_none()) {
			const auto labels = texts(pair);
			if (labels.size() != 2 || PyUnicode_Check(pair.ptr()))
				throw std::invalid_argument(
					method + ": pair must be the labels of two materials, (label, label), got "
					+ string(py::extract<string>(pair.attr("__repr__")())));
			const int first = knownMaterial(model, labels[0], method), second = knownMaterial(model, labels[1], method);
			chosen.erase(
				std::remove_if(chosen.begin(), chosen.end(), [&](int i) { return !blocks::isBetween(a, i, first, second); }), chosen.end());
		}
		if (!region.is_none()) {
			const blocks::Polygon outline = polygon(region, py::list());
			blocks::requireSimple(outline, method + ".region");
			chosen = blocks::jointsWithin(a, outline, chosen);
		}
		return { chosen.begin(), chosen.end() };
	}

	py::object jointsWhere(const BlockModel& model, const py::object& pair, const py::object& region, const py::object& joints)
	{
		const string method = "BlockModel.jointsWhere";
		if (model.assembly.joints.count() == 0) throw std::runtime_error(method + ": there are no joints yet; call bond() first");
		const auto  chosen = narrowed(model, chosenJoints(model, joints, method), pair, region, method);
		vector<int> list(chosen.begin(), chosen.end());
		return numpyOf(list, false).attr("copy")();
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

	void nameJoints(BlockModel& model, const string& name, const py::object& which)
	{
		if (model.assembly.joints.count() == 0) throw std::runtime_error("BlockModel.nameJoints: there are no joints yet; call bond() first");
		const auto chosen = chosenJoints(model, which, "BlockModel.nameJoints");
		model.assembly.nameJoints(name, { chosen.begin(), chosen.end() });
	}

	py::list jointNames(const BlockModel& model)
	{
		py::list out;
		for (const string& name : model.assembly.joints.names)
			out.append(name);
		return out;
	}

	py::object jointsNamed(const BlockModel& model, const py::object& name)
	{
		const auto wanted = texts(name);
		if (wanted.empty())
			throw std::invalid_argument(
				"BlockModel.jointsNamed.name must be a text or a list of texts, got " + string(py::extract<string>(py::str(name))));
		const auto  chosen = namedJoints(model, wanted, "BlockModel.jointsNamed");
		vector<int> list(chosen.begin(), chosen.end());
		return numpyOf(list, false).attr("copy")();
	}

	py::object segmentName(const BlockModel& model)
	{
		const auto& joints = model.assembly.joints;
		auto        column = joints.names.empty() ? vector<int>(joints.count(), blocks::Joints::unnamed) : joints.nameOf;
		return numpyOf(column, false).attr("copy")();
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
		.def("jointsWhere",
	             &jointsWhere,
	             (arg("pair") = py::object(), arg("region") = py::object(), arg("joints") = py::object()),
	             "Indices of joints for whatever takes joints, and for columns with one entry a segment "
	             "(``model.jointProperties['kn'][indices]``). pair: labels of two materials, in either order; twice the same: joints within it. region: "
	             "a polygon, counter-clockwise: joints whose middle lay within it, or on its outline, before anything moved. joints: indices or names, "
	             "only these, in their order; None: all, ascending. There may be none that fits. A copy. Errors: ValueError for "
	             "labels that no block has, and what is no polygon.")
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
	             "softens would snap back.")
		.def("nameJoints",
	             &nameJoints,
	             (arg("name"), arg("joints")),
	             "Gives a name to joints (indices of segments, or names that they have; None: all), after bond(). Parameters (setJoints), crack tables, "
	             "results, pictures and ParaView files go by it; it is saved with the model. A joint has one name: another that it had is gone, and so is "
	             "a "
	             "name that no joint has any more. Errors: ValueError for an empty name, no joints, and joints that are not there; nothing is changed "
	             "then.")
		.def("jointsNamed",
	             &jointsNamed,
	             (arg("name")),
	             "Indices of the joints that have a name, or one of a list of names, ascending. A copy. Error: ValueError if no joint has it.")
		.add_property("jointNames", &jointNames, "Names of joints, in the order in which they were given.")
		.add_property("segmentName", &segmentName, "Name of every joint, an index into jointNames; -1 for none, shape (segments). A copy.");
}

} // namespace yade
