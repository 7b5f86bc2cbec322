// yade-blocks, GPL-2.0-or-later
#include <blocks/engines/Rescue.hpp>
#include <blocks/views/PythonLock.hpp>
#include <cerrno>
#include <core/Omega.hpp>
#include <cstring>
#include <fstream>
#include <lib/serialization/Serializable.hpp>

namespace yade {

namespace {
	/// The sentence of the error that Python holds, which is cleared.
	string sentenceOfPython()
	{
		PyObject *type, *value, *trace;
		PyErr_Fetch(&type, &value, &trace);
		PyErr_NormalizeException(&type, &value, &trace);
		const py::handle<> kind { py::allow_null(type) }, error { py::allow_null(value) }, behind { py::allow_null(trace) };
		return error ? string(py::extract<string>(py::str(py::object(error)))) : "an error without words";
	}
}

string saveScene(const string& file)
{
	{
		const PythonLock lock;
		try {
			const py::object omega = py::import("yade.wrapper").attr("Omega");
			if (PyObject_HasAttrString(omega.ptr(), "unsealedSave")) {
				omega().attr("save")(file, true);
				return "";
			}
		} catch (const py::error_already_set&) {
			return sentenceOfPython();
		}
	}
	errno = 0;
	if (!std::ofstream(file, std::ios::app)) return file + ": " + std::strerror(errno);
	try {
		Omega::instance().saveSimulation(file, /*quiet*/ true);
	} catch (const std::exception& error) {
		return file + ": " + error.what();
	}
	return "";
}

} // namespace yade
