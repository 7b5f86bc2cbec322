// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/laws/JointLaw.hpp>
#include <blocks/kernel/model/ContactList.hpp>
#include <blocks/kernel/model/ContactMemory.hpp>
#include <blocks/kernel/model/LawColumns.hpp>
#include <blocks/kernel/model/Motion.hpp>
#include <blocks/kernel/model/RigidBlock.hpp>

namespace blocks {

/// Energies that are booked step by step [J].
struct Accounts {
	Real damping        = 0; ///< dissipated by damping, up to the last time of forces
	Real pendingDamping = 0; ///< dissipated by damping in the half step since
	Real friction       = 0; ///< dissipated by broken joints; dilation's work against the pressure is taken off
	Real fracture       = 0; ///< set free in the steps in which contact points broke
	Real scaling        = 0; ///< minus the kinetic energy that masses have brought which were scaled anew

	ReleasedWork released; ///< of groups that are no more
};

/// Energies of scenes that have what they are of; others keep the fingerprints that they had before. Booked as in Accounts [J].
struct FurtherAccounts {
	Real viscous = 0, pendingViscous = 0;     ///< that waves took out through viscous boundaries
	Real incoming = 0, pendingIncoming = 0;   ///< that incoming waves brought in there
	Real stiffness = 0, pendingStiffness = 0; ///< dissipated by damping proportional to stiffness
	Real removed = 0;                         ///< that blocks held when they were removed

	bool any() const { return viscous != 0 || incoming != 0 || stiffness != 0 || removed != 0 || pendingViscous != 0 || pendingStiffness != 0; }
};

/// What contact points of joints that soften remember besides, as columns; empty where all joints are brittle.
struct Softened {
	std::vector<Real> k, opening, slipLargest, crushing; ///< see SofteningState

	// ---- dissipated so far, booked as in Accounts [J]
	Real modeI = 0, modeII = 0, cap = 0;

	long snapped = 0; ///< how often a point snapped back: the pressure was too high for it to follow its softening curve

	bool           empty() const { return k.empty(); }
	SofteningState of(int point) const { return { k[point], opening[point], slipLargest[point], crushing[point] }; }
	void           set(int point, const SofteningState& s)
	{
		k[point] = s.k, opening[point] = s.opening, slipLargest[point] = s.slipLargest, crushing[point] = s.crushing;
	}
	/// All points as they are before anything happens.
	void start(int points)
	{
		for (auto* column : { &k, &opening, &slipLargest, &crushing })
			column->assign(points, 0);
	}
};

/// All that a step changes and the next one needs. It is saved, put back, compared and hashed as one.
struct State {
	// ---- grid points
	std::vector<Vec2> displacement; ///< since the reference positions [m]
	std::vector<Vec2> velocity;     ///< at the last half step [m/s]
	std::vector<Real> inertia;      ///< mass that resists motion: the true or the scaled one [kg]

	// ---- contact points, two a joint
	std::vector<Real>  opening, slip;       ///< relative displacement since bonding, in the frame [m]
	std::vector<Real>  sigma, tau;          ///< joint stresses [Pa]
	std::vector<Real>  slipPlastic, uplift; ///< see JointState [m]
	std::vector<Joint> status;
	Softened           softened;
	LawColumns         lawColumns;

	// ---- joints
	std::vector<char> released; ///< whether the joint's edges are a free contact by now

	// ---- what moves as one
	std::vector<MotionGroup> groups;
	std::vector<RigidBlock>  rigid; ///< in the order of the blocks

	// ---- blocks that touch without being bonded
	ContactList   contacts; ///< an index stays valid while its contact lives
	ContactMemory search;
	Real          lostFriction = 0; ///< dissipated by contacts that are no more [J]

	Real            viscosity = 0; ///< c of the adaptive damping, what it has come to [1/s]
	Accounts        accounts;
	FurtherAccounts further;

	JointState joint(int point) const { return { slipPlastic[point], uplift[point], status[point] }; }
	void       setJoint(int point, const JointState& s) { slipPlastic[point] = s.slipPlastic, uplift[point] = s.uplift, status[point] = s.status; }
};

} // namespace blocks
