// yade-blocks, GPL-2.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <blocks/kernel/Types.hpp>
#include <functional>

/// Boxes along the axes, and which of many meet.
namespace blocks {

using Box = Eigen::AlignedBox<Real, 2>; ///< [m]

inline Box boxOf(const Vec2& p, const Vec2& q) { return { p.cwiseMin(q), p.cwiseMax(q) }; }

inline Box boxOf(const Ring& ring)
{
	Box box;
	for (const Vec2& p : ring)
		box.extend(p);
	return box;
}

/// Larger by a margin on every side.
inline Box grown(const Box& box, Real margin) { return { box.min().array() - margin, box.max().array() + margin }; }

/// Whether two boxes are nowhere farther apart than a margin.
inline bool meet(const Box& a, const Box& b, Real margin)
{
	return ((a.min() - b.max()).array() <= margin).all() && ((b.min() - a.max()).array() <= margin).all();
}

using VisitBoxes = std::function<void(int, int)>; ///< takes the numbers of two boxes that have a point in common

/// Visits the pairs of one box of each list, in no particular order. Boxes without finite corners meet nothing. Works in n log n.
void forEachMeeting(const std::vector<Box>&, const std::vector<Box>& others, const VisitBoxes&);

/// Visits the pairs of two boxes of one list, each pair once.
void forEachMeeting(const std::vector<Box>&, const VisitBoxes&);

} // namespace blocks
