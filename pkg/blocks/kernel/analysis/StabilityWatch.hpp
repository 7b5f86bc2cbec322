// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/analysis/OverlapWatch.hpp>
#include <blocks/kernel/model/BlockAssembly.hpp>

/// Notices a run that has turned unstable or blocks that go through each other, and keeps the last state that was good.
namespace blocks {

class StabilityWatch {
public:
	/// Energy that nobody put in is suspicious from this share of what is and was in the system; elastic steps, breaking joints
	/// and friction keep the balance far better.
	static constexpr Real tolerance = 0.1;
	/// Strain that is nothing but rounding (eps times specimen by zone is about 1e-14); its energy is no energy.
	static constexpr Real roundingStrain = 1e-12;
	/// Kinetic energy is taken at the time of the forces, m v_before v_after / 2: only so is the sum constant where modes swing
	/// near the limit of the time step. It also is where they grow beyond that limit; but m v_before^2 / 2 is at most this many
	/// times the sum, 2/(1 - s^2), as long as they are stable, with s the largest fraction of the limit that is allowed.
	static constexpr Real swing = 2 / (1 - 0.95 * 0.95);
	/// Energy from nowhere is an instability if it has grown by this factor since the last look: an unstable mode grows exponentially,
	/// a velocity that a script has set does not.
	static constexpr Real growth = 2;
	/// Blocks that have entered each other by more than half stop the run if they are more than this share of all. Single
	/// fragments of a crushed specimen are told, no more.
	static constexpr Real lostShare = 0.01;

	/// Steps between two looks that are compared: work is booked half a step late, which counts while a motion sets in.
	static constexpr long leastInterval = 20;

	struct Verdict {
		bool        stable = true;
		int         block  = -1; ///< the one that moves fastest, the first that is not a number, one of two that overlap
		std::string reason;
		std::string warning {}; ///< to be shown; empty if there is none, and after the first one of its kind
	};

	/// To be called every so many steps, between forces and motion.
	Verdict look(const BlockAssembly&, long step, Real time, Real dt);

	/// Behind the last motion of a run, so that nobody reads what no look has passed: whether all are numbers and no zone is inside out.
	static Verdict lookAtEnd(const BlockAssembly&);

	/// Puts the last good state back; the step it belongs to, or -1 if there was none.
	long restore(BlockAssembly&) const;
	Real goodTime() const { return when; }
	bool started() const { return begun; }

private:
	bool loadsChanged(const BlockAssembly&);
	Real energyOfNewMasses(const BlockAssembly&) const;

	long              goodAt = -1;
	Real              when   = 0; ///< of the last good state [s]
	State             lastGood;
	OverlapWatch      overlaps;
	bool              begun      = false;
	bool              warned     = false;
	bool              lossTold   = false;
	bool              excessTold = false;
	Real              baseline   = 0; ///< energy at the first look less the work done by then [J]
	Real              lastExcess = 0;
	Real              lastScale  = 0;     ///< what was and is in the system, at the last look [J]
	Real              earlier    = 0;     ///< what had been in the system before loads changed, the last time [J]
	long              compared   = 0;     ///< step of lastExcess
	std::vector<Vec2> loads, rigidLoads;  ///< at the last look [N]
	std::vector<Real> inertia;            ///< at the last look [kg]
	Real              roundingEnergy = 0; ///< [J]
};

} // namespace blocks
