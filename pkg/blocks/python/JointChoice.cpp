// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/geometry/PolygonRules.hpp>
#include <blocks/kernel/model/JointChoice.hpp>
#include <blocks/python/JointChoice.hpp>
#include <blocks/python/ModelPython.hpp>
#include <blocks/python/Polygons.hpp>
#include <blocks/python/Sequences.hpp>
#include <blocks/views/Numpy.hpp>

/// Joints by index, name, pair of materials and region, and the names that joints get.
namespace yade {

namespace {

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

} // namespace

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
		chosen.erase(std::remove_if(chosen.begin(), chosen.end(), [&](int i) { return !blocks::isBetween(a, i, first, second); }), chosen.end());
	}
	if (!region.is_none()) {
		const blocks::Polygon outline = polygon(region, py::list());
		blocks::requireSimple(outline, method + ".region");
		chosen = blocks::jointsWithin(a, outline, chosen);
	}
	return { chosen.begin(), chosen.end() };
}

namespace {

	py::object jointsWhere(const BlockModel& model, const py::object& pair, const py::object& region, const py::object& joints)
	{
		const string method = "BlockModel.jointsWhere";
		if (model.assembly.joints.count() == 0) throw std::runtime_error(method + ": there are no joints yet; call bond() first");
		const auto  chosen = narrowed(model, chosenJoints(model, joints, method), pair, region, method);
		vector<int> list(chosen.begin(), chosen.end());
		return numpyOf(list, false).attr("copy")();
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

} // namespace

void defineJointChoice(PythonModel& c)
{
	using py::arg;
	c.def("jointsWhere",
	      &jointsWhere,
	      (arg("pair") = py::object(), arg("region") = py::object(), arg("joints") = py::object()),
	      "Indices of joints for whatever takes joints, and for columns with one entry a segment "
	      "(``model.jointProperties['kn'][indices]``). pair: labels of two materials, in either order; twice the same: joints within it. region: "
	      "a polygon, counter-clockwise: joints whose middle lay within it, or on its outline, before anything moved. joints: indices or names, "
	      "only these, in their order; None: all, ascending. There may be none that fits. A copy. Errors: ValueError for "
	      "labels that no block has, and what is no polygon.")
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
