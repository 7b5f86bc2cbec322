// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/laws/JointKinematics.hpp>
#include <blocks/kernel/step/Dissipation.hpp>
#include <blocks/kernel/step/JointBatch.hpp>
#include <blocks/kernel/step/Release.hpp>
#include <type_traits>

/// From the motion of the grid points to the forces of the joints.
namespace blocks {

/// A range of joints [first, last).
struct JointRange {
	int first, last;
};
inline JointRange allJoints(const BlockAssembly& a) { return { 0, a.joints.count() }; }
inline JointRange jointsOf(const BlockAssembly& a, int pair) { return { a.joints.pairs[pair].first, a.joints.pairs[pair].last }; }

/// Frame of a joint as its hosts are now.
JointFrame frameOf(const BlockAssembly&, int joint);

/// A contact point, midway between its two hosts [m].
Vec2 contactPosition(const BlockAssembly&, int point);

/// Of a contact point: 0 whole or never bonded, 1 nothing but residual strength is left; brittle ones have no other values.
Real damageOf(const BlockAssembly&, int point);

/// Opening and slip at all contact points of a range, into the state.
void updateKinematics(BlockAssembly&, JointRange);

/// The paper's law, and the shape of a law of one's own: a function of a point's properties, state, opening and slip. `plainlyElastic`
/// says that an intact point carries kn opening and ks slip until it is beyond tension or Mohr-Coulomb; then whole batches
/// need not ask the law.
struct Brittle {
	static constexpr bool plainlyElastic = true;
	JointStep             operator()(const JointParams& p, const JointState& s, Real opening, Real slip) const { return advance(p, s, opening, slip); }
};

/// The law of joints of which some soften; the others stay brittle. The points' softening is in the assembly's columns.
struct Softening {
	static constexpr bool plainlyElastic = true;
};

/// Calls work(law) with the law that the joints' properties ask for.
template <class Work> void withOwnLaw(const BlockAssembly& a, const Work& work)
{
	if (a.joints.anySoftens())
		work(Softening {});
	else
		work(Brittle {});
}

/// Works on a range of joints; one virtual call a range. What it remembers of contact points beyond their JointState are columns with names.
class JointLawOnRange {
public:
	virtual ~JointLawOnRange() = default;
	/// Stresses and states of the joints' contact points from openings and slips, all in a.state.
	virtual void advance(BlockAssembly&, JointRange) const = 0;
	/// Whether it wants all joints at once, from one thread.
	virtual bool serial() const { return false; }
	/// Names of its columns, a.state.lawColumns[name] in advance(): made of zeros when it first works, part of the state from then on.
	virtual const std::vector<std::string>& columns() const;
	/// What it is called where something is wrong with it.
	virtual std::string name() const { return "the joint law"; }
};

/// Motion and stresses of all joints by such a law, range by range.
void advanceByRanges(BlockAssembly&, const JointLawOnRange&, bool account, int threads);

namespace step {
	inline int jointsIn(const BlockAssembly& a, int batch) { return std::min(Joints::batch, a.joints.count() - batch * Joints::batch); }
	void       gatherProperties(const Joints&, int first, int count, JointBatch&);
	void       storeMotion(BlockAssembly&, int first, int count, const JointBatch&);
	void       loadStresses(const BlockAssembly&, int first, int count, JointBatch&);
	void       storeStresses(BlockAssembly&, int first, int count, const JointBatch&);

	template <class Law, class = void> struct IsPlainlyElastic : std::false_type {
	};
	template <class Law> struct IsPlainlyElastic<Law, std::enable_if_t<Law::plainlyElastic>> : std::true_type {
	};

	/// One contact point by a law.
	template <class Law> JointStep advancePoint(const Law& law, BlockAssembly& a, int point, Real opening, Real slip)
	{
		return law(a.joints.ofPoint(point), a.state.joint(point), opening, slip);
	}
	JointStep advancePoint(const Softening&, BlockAssembly&, int point, Real opening, Real slip);

	/// How many points are beyond a cap, which elasticStresses does not know.
	template <class Law> int beyondCaps(const Law&, const BlockAssembly&, int, int, const JointBatch&) { return 0; }
	int                      beyondCaps(const Softening&, const BlockAssembly&, int first, int count, const JointBatch&);

	/// Lists those joints of a batch that ask the law: all that are not released, or of these only those with a point that is not intact or beyond a
	/// strength. What is released carries nothing. Whether every contact point is intact and none asks.
	bool listAsking(const BlockAssembly&, int first, int count, bool all, JointBatch&);

	/// Stresses of joints first, first + 1, ... from their openings and slips in the batch; states change where joints break or slide. Where intact points
	/// are plainly elastic, only the others ask the law. Whether every contact point was intact and is.
	template <class Law> bool advanceBatch(BlockAssembly& a, int first, int count, const Law& law, JointBatch& b)
	{
		State&                s      = a.state;
		const Joint*          status = s.status.data() + 2 * first;
		[[maybe_unused]] bool yet    = false; // whether points that are intact and not beyond a strength have their stresses
		if constexpr (IsPlainlyElastic<Law>::value) {
			gatherProperties(a.joints, first, count, b);
			elasticStresses(count, b);
			yet = beyondCaps(law, a, first, count, b) == 0;
		}
		if (listAsking(a, first, count, !yet, b)) return true;
		// pairs of one batch may come from several threads
		auto tell = [&] { __atomic_store_n(&a.forces.broke[first / Joints::batch], char(true), __ATOMIC_RELAXED); };
		for (int n = 0; n < b.asking; ++n) {
			const int i = b.asks[n];
			for (int k = 0; k < 2; ++k) {
				const int p = 2 * (first + i) + k;
				if (yet && status[2 * i + k] == Joint::intact && !isBeyond(b, i, k)) continue;
				const JointStep now = advancePoint(law, a, p, b.opening[k][i], b.slip[k][i]);
				b.sigma[k][i]       = now.sigma;
				b.tau[k][i]         = now.tau;
				if (now.state.status != s.status[p]) tell();
				s.setJoint(p, now.state);
			}
			if (a.contacts.wanted && goesFree(a, first + i, { b.opening[0][i], b.opening[1][i] }, { b.slip[0][i], b.slip[1][i] })) tell();
		}
		return false;
	}

	/// Motion, stresses and forces of a batch of joints by a law. With `account`, what they dissipate is kept.
	template <class Law> void workOnBatch(BlockAssembly& a, int batch, const Law& law, bool account, JointBatch& b)
	{
		const int first = batch * Joints::batch, count = jointsIn(a, batch);
		gatherDisplacements(a, first, count, b);
		moveJoints(a.joints.columns, first, count, b);
		BatchBefore before;
		if (account) before.take(a.state, first, count);
		const bool elastic = advanceBatch(a, first, count, law, b);
		if (account) {
			a.forces.jointEnergy[batch] = elastic ? elasticEnergy(a.joints.columns, first, count, b) : heldIn(a, first, count, b);
			a.forces.dissipated[batch]  = elastic ? Dissipated() : dissipatedIn(a, first, count, before, b);
		}
		loadEdges(a.joints.columns, first, count, b);
		storeMotion(a, first, count, b);
		storeStresses(a, first, count, b);
	}

	/// Calls work(first, count) for the batches that hold the range, each within one batch of Joints.
	template <class Work> void forEachBatch(JointRange range, const Work& work)
	{
		for (int first = range.first; first < range.last;) {
			const int last = std::min(range.last, (first / Joints::batch + 1) * Joints::batch);
			work(first, last - first);
			first = last;
		}
	}
}

/// Stresses and states of a range from the openings and slips in the state. For loops that come pair by pair.
template <class Law> void advanceStresses(BlockAssembly& a, JointRange range, const Law& law)
{
	JointBatch b;
	step::forEachBatch(range, [&](int first, int count) {
		for (int i = 0; i < count; ++i)
			for (int k : { 0, 1 })
				b.opening[k][i] = a.state.opening[2 * (first + i) + k], b.slip[k][i] = a.state.slip[2 * (first + i) + k];
		step::advanceBatch(a, first, count, law, b);
		step::storeStresses(a, first, count, b);
	});
}

} // namespace blocks
