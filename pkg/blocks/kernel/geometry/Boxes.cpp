// yade-blocks, GPL-2.0-or-later
#include <CGAL/box_intersection_d.h>
#include <blocks/kernel/geometry/Boxes.hpp>

namespace blocks {
namespace {

	using Numbered = CGAL::Box_intersection_d::Box_with_handle_d<Real, 2, const Box*, CGAL::Box_intersection_d::ID_EXPLICIT>;

	std::vector<Numbered> numbered(const std::vector<Box>& boxes)
	{
		std::vector<Numbered> list;
		list.reserve(boxes.size());
		for (const Box& box : boxes) {
			if (!box.min().allFinite() || !box.max().allFinite()) continue;
			Real low[] = { box.min().x(), box.min().y() }, high[] = { box.max().x(), box.max().y() };
			list.emplace_back(low, high, &box);
		}
		return list;
	}

} // namespace

void forEachMeeting(const std::vector<Box>& boxes, const std::vector<Box>& others, const VisitBoxes& visit)
{
	std::vector<Numbered> some = numbered(boxes), all = numbered(others);
	CGAL::box_intersection_d(some.begin(), some.end(), all.begin(), all.end(), [&](const Numbered& p, const Numbered& q) {
		visit(int(p.handle() - boxes.data()), int(q.handle() - others.data()));
	});
}

void forEachMeeting(const std::vector<Box>& boxes, const VisitBoxes& visit)
{
	std::vector<Numbered> all = numbered(boxes);
	CGAL::box_self_intersection_d(
		all.begin(), all.end(), [&](const Numbered& p, const Numbered& q) { visit(int(p.handle() - boxes.data()), int(q.handle() - boxes.data())); });
}

} // namespace blocks
