// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/step/Joints.hpp>

/// Contact points of joints that soften, between the columns and the law.
namespace blocks {

Real damageOf(const BlockAssembly& a, int point)
{
	const Joint status = a.state.status[point];
	if (status == Joint::intact || status == Joint::unbonded) return 0;
	return a.joints.softens(point / 2) ? damage(a.state.softened.of(point)) : 1;
}

namespace step {

	JointStep advancePoint(const Softening&, BlockAssembly& a, int point, Real opening, Real slip)
	{
		const int              kind      = a.joints.kind[point / 2];
		const SofteningParams& softening = a.joints.softening[kind];
		const JointParams&     params    = a.joints.kinds[kind];
		if (!softening.softens()) return advance(params, a.state.joint(point), opening, slip);
		const SofteningStep now = advanceSoftening(params, softening, a.state.joint(point), a.state.softened.of(point), opening, slip);
		a.state.softened.set(point, now.soft);
		if (now.snappedBack) __atomic_fetch_add(&a.state.softened.snapped, 1L, __ATOMIC_RELAXED);
		return { now.sigma, now.tau, now.joint };
	}

	int beyondCaps(const Softening&, const BlockAssembly& a, int first, int count, const JointBatch& b)
	{
		int beyond = 0;
		if (!a.joints.anyCap) return beyond;
		for (int i = 0; i < count; ++i) {
			const int kind = a.joints.effective[first + i];
			if (kind < 0) continue;
			for (int k : { 0, 1 })
				beyond += beyondCap(a.joints.softening[kind].cap, b.sigma[k][i], b.tau[k][i]);
		}
		return beyond;
	}

}
} // namespace blocks
