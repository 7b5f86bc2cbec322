// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/laws/JointKinematics.hpp>
#include <blocks/kernel/model/BlockAssembly.hpp>
#include <cassert>

namespace blocks {

void BlockAssembly::bond(std::vector<Segment> found)
{
	std::stable_sort(found.begin(), found.end(), [](const Segment& a, const Segment& b) { return a.block < b.block; });
	joints.segments = std::move(found);
	joints.pairs.clear();
	for (int i = 0; i < joints.count(); ++i) {
		auto& pairs = joints.pairs;
		if (pairs.empty() || pairs.back().block != joints.segments[i].block) pairs.push_back({ joints.segments[i].block, i, i });
		pairs.back().last = i + 1;
	}
	joints.kinds.assign(1, JointParams());
	joints.ofMaterials.clear(); // its kinds are no more
	joints.softening.clear();
	joints.inSituOpening.clear(), joints.inSituSlip.clear();
	joints.names.clear(), joints.nameOf.clear();
	state.softened   = {};
	state.lawColumns = {};
	joints.kind.assign(joints.count(), 0);
	for (auto* column : { &state.opening, &state.slip, &state.sigma, &state.tau, &state.slipPlastic, &state.uplift })
		column->assign(pointCount(), 0);
	state.status.assign(pointCount(), Joint::intact);
	state.released.assign(joints.count(), false);
	rebuildJoints();
}

/// Whether the first edge is all that the columns say of a joint.
static bool isMatched(const JointColumns& c, int i)
{
	for (int k : { 0, 1 })
		if (c.s1[k][i] != k || c.s2[k][i] != 1 - k || c.bondOpening[k][i] != 0 || c.bondSlip[k][i] != 0) return false;
	return c.e2x[i] == -c.e1x[i] && c.e2y[i] == -c.e1y[i] && c.dx[i] == c.e1x[i] && c.dy[i] == c.e1y[i];
}

void BlockAssembly::rebuildJoints()
{
	const int     count = joints.count(), batches = (count + Joints::batch - 1) / Joints::batch;
	JointColumns& c = joints.columns;
	for (auto* column : { &c.e1x, &c.e1y, &c.e2x, &c.e2y, &c.dx, &c.dy, &c.area })
		column->resize(count);
	for (int k : { 0, 1 })
		for (auto* column : { &c.s1[k], &c.s2[k], &c.bondOpening[k], &c.bondSlip[k] })
			column->resize(count);
	assert(std::is_sorted(joints.segments.begin(), joints.segments.end(), [](const Segment& g, const Segment& h) { return g.block[0] < h.block[0]; }));
	joints.node.resize(count);
	joints.effective.resize(count);
	joints.kindOfBatch.resize(batches);
	c.matched.assign(batches, true);
	joints.anyCap = std::any_of(joints.softening.begin(), joints.softening.end(), [](const SofteningParams& s) { return s.cap.strength > 0; });
	forces.broke.assign(batches, false);
	for (int i = 0; i < count; ++i) {
		const Segment& g  = joints.segments[i];
		const Vec2     e1 = mesh.reference[g.node[1]] - mesh.reference[g.node[0]], e2 = mesh.reference[g.node[3]] - mesh.reference[g.node[2]];
		const Vec2     d = mesh.reference[g.node[2]] - mesh.reference[g.node[0]];
		joints.node[i]   = g.node;
		c.e1x[i] = e1.x(), c.e1y[i] = e1.y(), c.e2x[i] = e2.x(), c.e2y[i] = e2.y(), c.dx[i] = d.x(), c.dy[i] = d.y();
		const JointFrame f = jointFrame(e1.x(), e1.y(), e2.x(), e2.y());
		for (int k : { 0, 1 }) {
			const Vec2 gap      = d + g.s2[k] * e2 - g.s1[k] * e1;
			c.s1[k][i]          = g.s1[k];
			c.s2[k][i]          = g.s2[k];
			c.bondOpening[k][i] = gap.x() * f.nx + gap.y() * f.ny;
			c.bondSlip[k][i]    = gap.y() * f.nx - gap.x() * f.ny;
			if (joints.inSituOpening.empty()) continue;
			c.bondOpening[k][i] -= joints.inSituOpening[i][k];
			c.bondSlip[k][i] -= joints.inSituSlip[i][k];
		}
		if (!isMatched(c, i)) c.matched[i / Joints::batch] = false;
	}
	if (count > 0) noteKinds(0, count);
	forces.parts = {};
	joints.blocksOfBatch.resize(batches);
	for (int b = 0; b < batches; ++b) {
		BlockRange& blocks = joints.blocksOfBatch[b];
		blocks             = { joints.segments[b * Joints::batch].block[0], 0 };
		for (int i = b * Joints::batch; i < std::min(count, (b + 1) * Joints::batch); ++i)
			blocks.last = std::max(blocks.last, joints.segments[i].block[1]);
	}
}

int pairOf(const BlockAssembly& a, const std::array<int, 2>& blocks)
{
	const auto& pairs = a.joints.pairs;
	const auto  at    = std::lower_bound(pairs.begin(), pairs.end(), blocks, [](const Pair& p, const std::array<int, 2>& key) { return p.block < key; });
	return at == pairs.end() || at->block != blocks ? -1 : int(at - pairs.begin());
}

} // namespace blocks
