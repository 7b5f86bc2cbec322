// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/step/CentralDifference.hpp>
#include <blocks/kernel/step/ContactSearch.hpp>
#include <blocks/kernel/step/Contacts.hpp>
#include <blocks/kernel/step/Sweep.hpp>

/// A step: forces from where everything is (`BlockLoop` calls this half), then motion from the forces (`BlockMotion`). Tests, benchmarks, the fuzz and the
/// elastic jump call the same functions.
namespace blocks {

/// Forces of joints, whose stresses are in the state already, of contacts, zones and loads.
void sumForces(BlockAssembly&, bool account = false, int threads = 1);

/// Motion and stresses of joints by a law, and the same forces. With `account`, a.state.accounts gets what joints dissipated, and a.forces.zoneEnergy what the
/// zones hold.
template <class Law> void sweepForces(BlockAssembly& a, const Law& law, bool account = false, int threads = 1)
{
	if constexpr (std::is_base_of_v<JointLawOnRange, Law>) {
		advanceByRanges(a, law, account, threads);
		sumForces(a, account, threads);
	} else {
		if (account) a.forces.dissipated.resize(a.forces.broke.size()), a.forces.jointEnergy.resize(a.forces.broke.size());
		step::sweep(
			a, [&](int batch, JointBatch& b) { step::workOnBatch(a, batch, law, account, b); }, account, threads);
		if (account) bookDissipation(a);
	}
}

/// The unbalanced force of every grid point. dt: the step that led here, for the friction of free contacts [s].
template <class Law> void computeForces(BlockAssembly& a, const Law& law, Real dt, bool account = false, int threads = 1)
{
	if (a.contacts.wanted) prepareContacts(a, dt, account); // who may touch soon: only where something moved far or broke
	advanceContacts(a, dt, threads);                        // edges that are not bonded, or no more: motion -> slip -> forces
	sweepForces(a, law, account, threads);                  // block by block: loads, joints, contacts, zones -> force of every grid point
}

/// Forces -> velocities, displacements; groups first. What it turned over is complete only if `account` says so.
inline StepWork move(BlockAssembly& a, const Damping& damping, Real dt, Real time, bool account = false, int threads = 1)
{
	return integrate(a, damping, dt, time, account, threads);
}

} // namespace blocks
