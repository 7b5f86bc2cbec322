// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/laws/JointLaw.hpp>
#include <boost/python/numpy.hpp>
#include <lib/serialization/Serializable.hpp>

/// The kernel's columns as numpy arrays, without a copy.
namespace yade {

inline void startNumpy()
{
	static const bool ready = (boost::python::numpy::initialize(), true);
	(void)ready;
}

/// One number an item. The array must not outlive the column; `owner` keeps it alive.
template <class Number> boost::python::numpy::ndarray numpyOf(std::vector<Number>& column, bool writable, const py::object& owner = py::object())
{
	namespace np = boost::python::numpy;
	using Shown  = std::conditional_t<std::is_same_v<Number, blocks::Joint>, std::uint8_t, Number>;
	startNumpy();
	static Number nothing {};
	np::ndarray   array = np::from_data(
                column.empty() ? &nothing : column.data(),
		np::dtype::get_builtin<Shown>(),
		py::make_tuple(column.size()),
		py::make_tuple(sizeof(Number)),
		owner);
	if (!writable) array.attr("setflags")(false);
	return array;
}

} // namespace yade
