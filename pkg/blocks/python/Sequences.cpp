// yade-blocks, GPL-2.0-or-later
#include <blocks/python/Sequences.hpp>
#include <limits>

namespace yade {

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

int inRange(long index, const string& what)
{
	constexpr long most = std::numeric_limits<int>::max() / 2;
	if (index < -most || index > most) throw std::invalid_argument(what + " must be an index that exists, got " + std::to_string(index));
	return int(index);
}

} // namespace yade
