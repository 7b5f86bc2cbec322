// yade-blocks, GPL-2.0-or-later
#include <blocks/engines/BlockLaw.hpp>
#include <blocks/views/Numpy.hpp>
#include <blocks/views/PythonLock.hpp>

namespace yade {

BlockLaw::~BlockLaw() = default;
NumpyLaw::~NumpyLaw() = default;

const vector<string>& BlockLaw::columns() const
{
	static const vector<string> none;
	return none;
}

void BlockLaw::advance(BlockModel&, blocks::JointRange) const
{
	throw std::runtime_error("BlockLoop.law: " + getClassName() + " has no law; derive from BlockLaw in C++, or use NumpyLaw(function)");
}

namespace {
	string shownInPython(const py::object& x) { return py::extract<string>(x.attr("__repr__")()); }

	[[noreturn]] void typeError(const string& sentence)
	{
		PyErr_SetString(PyExc_TypeError, sentence.c_str());
		throw py::error_already_set();
	}
}

void NumpyLaw::pyHandleCustomCtorArgs(py::tuple& args, py::dict& keywords)
{
	if (keywords.has_key("columns")) {
		setColumns(keywords["columns"]);
		keywords["columns"].del();
	}
	if (py::len(args) == 0) return;
	if (py::len(args) > 1)
		throw std::invalid_argument("NumpyLaw takes one function, got " + std::to_string(py::len(args)) + " arguments; columns is a keyword");
	if (!PyCallable_Check(py::object(args[0]).ptr())) typeError("NumpyLaw.function must be a function of the columns, got " + shownInPython(args[0]));
	function = args[0];
	args     = py::tuple();
}

py::list NumpyLaw::getColumns() const
{
	py::list list;
	for (const string& name : columnNames)
		list.append(name);
	return list;
}

void NumpyLaw::setColumns(const py::object& names)
{
	vector<string> list;
	const bool     isList = PyList_Check(names.ptr()) || PyTuple_Check(names.ptr());
	for (long i = 0; isList && i < py::len(names); ++i)
		if (const py::extract<string> name(names[i]); name.check()) list.push_back(name());
	if (!isList || long(list.size()) != py::len(names)) typeError("NumpyLaw.columns must be a list of names, got " + shownInPython(names));
	blocks::requireColumnNames("NumpyLaw.columns", list);
	columnNames = list;
}

void NumpyLaw::advance(BlockModel& model, blocks::JointRange) const
{
	const PythonLock lock;
	if (function.is_none()) throw std::runtime_error("NumpyLaw.function is None: functions are not saved, give it anew after O.load");
	auto&    s = model.assembly.state;
	py::dict columns;
	columns["opening"]     = numpyOf(s.opening, false);
	columns["slip"]        = numpyOf(s.slip, false);
	columns["sigma"]       = numpyOf(s.sigma, true);
	columns["tau"]         = numpyOf(s.tau, true);
	columns["slipPlastic"] = numpyOf(s.slipPlastic, true);
	columns["uplift"]      = numpyOf(s.uplift, true);
	columns["status"]      = numpyOf(s.status, true);
	for (const string& name : columnNames)
		columns[name] = numpyOf(s.lawColumns[name], true);
	try {
		function(columns);
	} catch (const py::error_already_set&) {
		PyErr_Print(); // YADE cannot show Python's own errors
		throw std::runtime_error("NumpyLaw.function has failed; its error is printed above");
	}
}

YADE_PLUGIN((BlockLaw)(NumpyLaw));

} // namespace yade
