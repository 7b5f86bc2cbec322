// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/analysis/ElasticJump.hpp>
#include <blocks/kernel/analysis/Follow.hpp>

namespace blocks {
namespace {

	void requireIntact(const BlockAssembly& a)
	{
		for (int i = 0; i < a.pointCount(); ++i)
			if (a.state.status[i] != Joint::intact && a.state.status[i] != Joint::softening && a.joints.kind[i / 2] != 0) { // see linearise()
				const auto& block = a.joints.segments[i / 2].block;
				throw std::runtime_error(
					"the joint between blocks " + std::to_string(block[0]) + " and " + std::to_string(block[1])
					+ " is not bonded, so the answer is not linear");
			}
	}

	/// The motion of a second at full speed, of driven groups and of rigid blocks along their prescribed directions.
	Growth motionOfOneSecond(const BlockAssembly& a)
	{
		Growth growth;
		bool   moves = false;
		for (const MotionGroup& g : a.state.groups) {
			growth.group.push_back(g.drive == MotionGroup::Drive::velocity ? g.target * g.throttle : 0);
			moves = moves || growth.group.back() != 0;
		}
		for (const RigidBlock& r : a.state.rigid) {
			growth.rigid.push_back(Vec3::Zero());
			for (int k : { 0, 1, 2 })
				if (!r.free[k]) growth.rigid.back()[k] = r.velocity[k];
			moves = moves || !growth.rigid.back().isZero(0);
		}
		if (!moves) throw std::runtime_error("no motion group is driven by a velocity, and no rigid block");
		return growth;
	}

	ElasticJump leap(BlockAssembly& a, Real fraction, Real time)
	{
		requireIntact(a);
		const LinearModel m = linearise(a, motionOfOneSecond(a));
		EventPath         path(m);
		if (!path.settle() || !path.cracks().empty()) throw std::runtime_error("the dead loads alone break a joint");
		const PathState   settled = path.state();
		std::vector<Real> before; // forces of the groups under the dead loads, for the work from there on
		{
			BlockAssembly loaded = a;
			handOver(loaded, m, path, time);
			for (const MotionGroup& g : loaded.state.groups)
				before.push_back(g.force);
		}
		if (!path.advance()) throw std::runtime_error("the answer is not linear up to the first failure: " + path.ended());
		const ElasticJump jump { fraction * path.now().lambda, path.now().point };
		if (!(jump.time > 0)) throw std::runtime_error("the dead loads alone break a joint");
		path.restore(settled);
		path.advance(jump.time);
		const std::vector<MotionGroup> old = a.state.groups;
		handOver(a, m, path, time);
		for (size_t i = 0; i < a.state.groups.size(); ++i)
			if (m.growth.group[i] != 0) { // linear: the mean of both ends
				const Real work                = (before[i] + a.state.groups[i].force) / 2 * (a.state.groups[i].travelled - old[i].travelled);
				a.state.groups[i].work         = old[i].work + work;
				a.state.groups[i].workTurnover = old[i].workTurnover + std::abs(work);
			}
		return jump;
	}

} // namespace

ElasticJump elasticJump(BlockAssembly& a, Real fraction, Real time)
{
	require(fraction > 0 && fraction < 1, "the fraction of an elastic jump must lie in (0, 1)", fraction);
	const State             before = a.state;
	const std::vector<Vec2> forces = a.forces.nodal;
	try {
		return leap(a, fraction, time);
	} catch (const std::runtime_error& e) {
		a.restore(before);
		a.forces.nodal = forces;
		throw std::runtime_error(std::string("no elastic jump: ") + e.what());
	}
}

} // namespace blocks
