// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/geometry/Polygon.hpp>
#include <blocks/python/Polygons.hpp>

namespace yade {

blocks::Ring ring(const py::object& points)
{
	py::object list;
	try {
		const py::object array = py::import("numpy").attr("asarray")(points, "float64");
		if (py::extract<long>(array.attr("size"))() == 0) return {};
		if (py::extract<int>(array.attr("ndim"))() == 2 && py::extract<int>(array.attr("shape")[1])() == 2) list = array.attr("tolist")();
	} catch (const py::error_already_set&) {
		PyErr_Clear();
	}
	if (list.is_none()) throw std::invalid_argument("a polygon must be a list of points (x, y), got " + string(py::extract<string>(py::str(points))));
	blocks::Ring out;
	for (long i = 0; i < py::len(list); ++i)
		out.push_back({ py::extract<Real>(list[i][0]), py::extract<Real>(list[i][1]) });
	return out;
}

blocks::Polygon polygon(const py::object& outer, const py::object& holes)
{
	blocks::Polygon out { ring(outer), {} };
	if (!PySequence_Check(holes.ptr())) throw std::invalid_argument("holes must be a list of polygons, got " + string(py::extract<string>(py::str(holes))));
	for (long i = 0; i < py::len(holes); ++i)
		out.holes.push_back(ring(holes[i]));
	return blocks::holesClockwise(out);
}

} // namespace yade
