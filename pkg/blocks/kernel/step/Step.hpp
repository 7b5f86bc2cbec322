// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/step/CentralDifference.hpp>
#include <blocks/kernel/step/ContactSearch.hpp>
#include <blocks/kernel/step/Contacts.hpp>
#include <blocks/kernel/step/Joints.hpp>

/// A step: forces from where everything is, then motion from the forces. Engines, tests, benchmarks and the elastic jump all call this.
namespace blocks {

/// force = load + joints + contacts + zones, block by block in a fixed order: the same bits on any number of threads.
void sumForces(BlockAssembly&, bool account = false, int threads = 1);

/// The unbalanced force of every grid point. dt: the step that led here, for the friction of free contacts [s]. With `account`, a.state.accounts
/// gets what joints dissipated, and a.forces.zoneEnergy what the zones hold.
template <class Law> void computeForces(BlockAssembly& a, const Law& law, Real dt, bool account = false, int threads = 1)
{
	if (a.contacts.wanted) prepareContacts(a, dt, account); // who may touch soon: only where something moved far or broke
	advanceJoints(a, law, account, threads);                // motion -> opening, slip -> stresses, states -> forces on edges
	advanceContacts(a, dt, threads);                        // the same for edges that are not bonded, or no more
	sumForces(a, account, threads);                         // edges, zones, loads -> every grid point, in a fixed order
}

/// Forces -> velocities, displacements; groups first. What it turned over is complete only if `account` says so.
inline StepWork move(BlockAssembly& a, const Damping& damping, Real dt, Real time, bool account = false, int threads = 1)
{
	return integrate(a, damping, dt, time, account, threads);
}

} // namespace blocks
