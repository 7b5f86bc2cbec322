// yade-blocks, GPL-2.0-or-later
#pragma once
#include <Python.h>

namespace yade {

/// As long as it lives its thread may use Python: a step runs without that.
struct PythonLock {
	PyGILState_STATE state = PyGILState_Ensure();

	PythonLock()                             = default;
	PythonLock(const PythonLock&)            = delete;
	PythonLock& operator=(const PythonLock&) = delete;
	~PythonLock() { PyGILState_Release(state); }
};

} // namespace yade
