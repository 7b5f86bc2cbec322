// yade-blocks, GPL-2.0-or-later
#pragma once
#include "BlockAssembly.hpp"

/// Notices a run that has turned unstable, and keeps the last state that had not.
namespace blocks {

class StabilityWatch {
public:
	/// Energy that nobody put in is suspicious from this share of what is and was in the system; elastic steps, breaking joints
	/// and friction keep the balance far better.
	static constexpr Real tolerance = 0.1;
	/// Strain that is nothing but rounding (eps times specimen by zone is about 1e-14); its energy is no energy.
	static constexpr Real roundingStrain = 1e-12;
	/// ... and is an instability if it has grown by this factor since the last look: an unstable mode grows exponentially,
	/// a velocity that a script has set does not.
	static constexpr Real growth = 2;

	/// Steps between two looks that are compared: work is booked half a step late, which counts while a motion sets in.
	static constexpr long leastInterval = 20;

	struct Verdict {
		bool        stable = true;
		int         block  = -1; ///< the one that moves fastest, or the first that is not a number
		std::string reason;
	};

	/// To be called every so many steps, with forces and positions of the same or neighbouring steps.
	Verdict look(const BlockAssembly&, long step, Real time);

	/// Puts the last good state back; the step it belongs to, or -1 if there was none.
	long restore(BlockAssembly&) const;
	Real goodTime() const { return lastGood.time; }
	bool started() const { return begun; }

private:
	struct State {
		long                      step = -1;
		Real                      time = 0;
		std::vector<Vec2>         position, velocity;
		std::vector<ContactPoint> points;
		std::vector<MotionGroup>  groups;
		std::vector<RigidBlock>   rigid;
		FreeContacts              contacts; ///< and the segments, whose areas end with their release; if there are any contacts
		std::vector<Segment>      segments;
	};
	State lastGood;
	bool  begun      = false;
	Real  baseline   = 0; ///< energy at the first look less the work done by then [J]
	Real  lastExcess = 0;
	long  compared   = 0; ///< step of lastExcess
	Real  roundingEnergy = 0; ///< [J]
};

} // namespace blocks
