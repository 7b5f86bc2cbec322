// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/Parallel.hpp>
#include <blocks/kernel/Wide.hpp>
#include <blocks/kernel/step/Joints.hpp>
#include <limits>

namespace blocks {
namespace {

	/// What a joint without properties, or one that is released, has: nothing, and no strength that it could exceed.
	JointParams neutral()
	{
		JointParams p;
		p.tension = p.cohesion = std::numeric_limits<Real>::infinity();
		return p;
	}

	/// Two columns, one for each contact point, into one that has them by turns.
	WIDE void interleave(int count, const Real* __restrict first, const Real* __restrict second, Real* __restrict out)
	{
		for (int i = 0; i < count; ++i)
			out[2 * i] = first[i], out[2 * i + 1] = second[i];
	}

} // namespace

JointFrame frameOf(const BlockAssembly& a, int joint)
{
	const auto&         node = a.joints.node[joint];
	const JointColumns& c    = a.joints.columns;
	const auto&         u    = a.state.displacement;
	const Vec2          u1 = u[node[1]] - u[node[0]], u2 = u[node[3]] - u[node[2]];
	return jointFrame(c.e1x[joint] + u1.x(), c.e1y[joint] + u1.y(), c.e2x[joint] + u2.x(), c.e2y[joint] + u2.y());
}

Vec2 contactPosition(const BlockAssembly& a, int point)
{
	const Segment& g = a.joints.segments[point / 2];
	const int      k = point % 2;
	return (a.position(g.node[0]) + g.s1[k] * a.between(g.node[0], g.node[1]) + a.position(g.node[2]) + g.s2[k] * a.between(g.node[2], g.node[3])) / 2;
}

void updateKinematics(BlockAssembly& a, JointRange range)
{
	JointBatch b;
	step::forEachBatch(range, [&](int first, int count) {
		gatherDisplacements(a, first, count, b);
		moveJoints(a.joints.columns, first, count, b);
		step::storeMotion(a, first, count, b);
	});
}

const std::vector<std::string>& JointLawOnRange::columns() const
{
	static const std::vector<std::string> none;
	return none;
}

void advanceByRanges(BlockAssembly& a, const JointLawOnRange& law, bool account, int threads)
{
	if (law.columns() != a.state.lawColumns.names) a.state.lawColumns.claim(law.name(), law.columns(), a.pointCount());
	if (account) a.forces.before.take(a.state);
	const int parts = law.serial() ? 1 : threads;
	forEachInParallel(parts, parts, [&](int part) {
		const int        batches = int(a.forces.broke.size());
		auto             begin   = [&](int p) { return std::min(a.joints.count(), int(long(batches) * p / parts) * Joints::batch); };
		const JointRange range { begin(part), part + 1 == parts ? a.joints.count() : begin(part + 1) };
		updateKinematics(a, range);
		law.advance(a, range);
	});
	for (auto& broke : a.forces.broke)
		broke = true; // the law does not say which
	if (account) bookDissipation(a, a.forces.before);
}

namespace step {

	void gatherProperties(const Joints& joints, int first, int count, JointBatch& b)
	{
		static const JointParams none   = neutral();
		auto                     params = [&](int kind) -> const JointParams& { return kind <= 0 ? none : joints.kinds[kind]; };
		const int                common = joints.kindOfBatch[first / Joints::batch];
		if (common != mixedKinds) {
			const JointParams& p = params(common);
			for (int i = 0; i < count; ++i)
				b.kn[i] = p.kn, b.ks[i] = p.ks, b.tension[i] = p.tension, b.cohesion[i] = p.cohesion, b.tanPhi[i] = p.tanPhi;
			return;
		}
		for (int i = 0; i < count; ++i) {
			const JointParams& p = params(joints.effective[first + i]);
			b.kn[i] = p.kn, b.ks[i] = p.ks, b.tension[i] = p.tension, b.cohesion[i] = p.cohesion, b.tanPhi[i] = p.tanPhi;
		}
	}

	bool listAsking(const BlockAssembly& a, int first, int count, bool all, JointBatch& b)
	{
		const int*   kind   = a.joints.effective.data() + first;
		const Joint* status = a.state.status.data() + 2 * first;
		std::uint8_t broken = 0;
		for (int p = 0; p < 2 * count; ++p)
			broken |= std::uint8_t(status[p]); // intact is 0
		b.asking = 0;
		if (broken == 0 && b.pointsBeyond == 0 && !all) return true;
		int released[JointBatch::size], gone = 0, asking = 0;
		for (int i = 0; i < count; ++i) { // without branches, which nobody could foretell
			const int isReleased = kind[i] == releasedKind;
			const int points     = std::uint8_t(status[2 * i]) | std::uint8_t(status[2 * i + 1]) | int(b.beyond[i]) | int(all);
			released[gone] = b.asks[asking] = i;
			gone += isReleased;
			asking += (points != 0) & (isReleased ^ 1);
		}
		b.asking = asking;
		for (int n = 0; n < gone; ++n)
			for (int k : { 0, 1 })
				b.sigma[k][released[n]] = b.tau[k][released[n]] = 0;
		return false;
	}

	void storeMotion(BlockAssembly& a, int first, int count, const JointBatch& b)
	{
		interleave(count, b.opening[0], b.opening[1], a.state.opening.data() + 2 * first);
		interleave(count, b.slip[0], b.slip[1], a.state.slip.data() + 2 * first);
	}

	void loadStresses(const BlockAssembly& a, int first, int count, JointBatch& b)
	{
		for (int i = 0; i < count; ++i)
			for (int k : { 0, 1 })
				b.sigma[k][i] = a.state.sigma[2 * (first + i) + k], b.tau[k][i] = a.state.tau[2 * (first + i) + k];
	}

	void storeStresses(BlockAssembly& a, int first, int count, const JointBatch& b)
	{
		interleave(count, b.sigma[0], b.sigma[1], a.state.sigma.data() + 2 * first);
		interleave(count, b.tau[0], b.tau[1], a.state.tau.data() + 2 * first);
	}

}

} // namespace blocks
