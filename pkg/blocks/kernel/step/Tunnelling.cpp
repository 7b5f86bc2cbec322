// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/model/Outline.hpp>
#include <blocks/kernel/step/EdgeDetection.hpp>
#include <blocks/kernel/step/Tunnelling.hpp>

namespace blocks {
namespace {

	/// Mean velocity of a block's grid points [m/s].
	Vec2 meanVelocity(const BlockAssembly& a, int block)
	{
		Vec2 sum = Vec2::Zero();
		for (int n = a.mesh.firstNode[block]; n < a.mesh.firstNode[block + 1]; ++n)
			sum += a.state.velocity[n];
		return sum / (a.mesh.firstNode[block + 1] - a.mesh.firstNode[block]);
	}
	/// The most by which the velocity of one of a block's grid points differs from this one [m/s].
	Real fastest(const BlockAssembly& a, int block, const Vec2& against)
	{
		Real square = 0;
		for (int n = a.mesh.firstNode[block]; n < a.mesh.firstNode[block + 1]; ++n)
			square = std::max(square, (a.state.velocity[n] - against).squaredNorm());
		return std::sqrt(square);
	}

	/// Where a block was a step ago, is, and will be a step on, as seen from one that moves.
	Box sweptBox(const BlockAssembly& a, int block, const Vec2& against, Real dt)
	{
		Box box = boxOf(a, block);
		for (int e = a.mesh.firstEdge[block]; e < a.mesh.firstEdge[block + 1]; ++e) {
			const int  n    = a.mesh.edgeNodes[e][0];
			const Vec2 step = dt * (a.state.velocity[n] - against);
			box.extend(a.position(n) - step);
			box.extend(a.position(n) + step);
		}
		return box;
	}

	/// Which of `some` blocks may come near which other one within a step, in order. mean: velocities of all blocks [m/s].
	std::vector<std::array<int, 2>> onTheWay(const BlockAssembly& a, const std::vector<int>& some, const std::vector<Vec2>& mean, Real dt)
	{
		const std::vector<int> every = a.presentBlocks();
		std::vector<Box>       fast, all; // of what is not finite the watch will tell
		for (int block : some)
			fast.push_back(sweptBox(a, block, Vec2::Zero(), dt));
		for (int block : every) {
			const Box  box = boxOf(a, block);
			const Vec2 way = dt * mean[block].cwiseAbs();
			all.emplace_back(box.min() - way, box.max() + way);
		}
		std::vector<std::array<int, 2>> found;
		forEachMeeting(fast, all, [&](int i, int j) {
			if (some[i] != every[j]) found.push_back({ some[i], every[j] });
		});
		std::sort(found.begin(), found.end());
		found.erase(std::unique(found.begin(), found.end()), found.end());
		return found;
	}

} // namespace

void refuseTunnelling(const BlockAssembly& a, Real dt)
{
	const FreeContacts& f = a.contacts;
	std::vector<Vec2>   mean;
	std::vector<int>    fast;
	for (int b = 0; b < a.blockCount(); ++b) {
		mean.push_back(meanVelocity(a, b));
		if (fastest(a, b, Vec2::Zero()) * dt > f.mostAStep * f.leastDepth) fast.push_back(b);
	}
	for (const auto& [b, other] : onTheWay(a, fast, mean, dt)) {
		const Vec2& with  = mean[other];
		const Real  limit = f.mostAStep * std::min(f.depthLimit[b], f.depthLimit[other]);
		if (((mean[b] - with).norm() + fastest(a, b, mean[b])) * dt <= limit) continue; // they move along together: most do, and need no closer look
		const Real speed = fastest(a, b, with);
		if (speed * dt <= limit || !meet(sweptBox(a, b, with, dt), boxOf(a, other), 0)) continue;
		if (pairOf(a, ordered(b, other)) >= 0 && !edgesOfJoints(a, ordered(b, other), false).empty()) continue;
		throw std::runtime_error(
			"block " + std::to_string(b) + " nears block " + std::to_string(other) + " at " + shown(speed, 6) + " m/s, " + shown(speed * dt, 3)
			+ " m a step, and might pass through it: contacts need steps of at most " + shown(limit, 3) + " m, so O.dt must not exceed "
			+ shown(limit / speed, 3) + " s at this speed");
	}
}

} // namespace blocks
