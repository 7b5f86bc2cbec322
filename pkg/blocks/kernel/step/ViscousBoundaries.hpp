// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/step/CentralDifference.hpp>

/// Viscous boundaries: dashpots of rho c_p A along the normal and rho c_s A along the boundary, on each grid point (Lysmer and Kuhlemeyer 1969,
/// J. Eng. Mech. Div. ASCE 95, 859-877). A wave that comes in at velocity w pulls with twice that: force = C (2 w - v). With v - w the wave that goes out,
/// the power is w.C w - (v - w).C (v - w): what comes in less what goes out.
namespace blocks {

/// Stresses by velocities: normal to the boundary, and along it [Pa s/m].
struct Impedance {
	Real normal = 0, tangential = 0;
};

/// Those of plane waves in a material: sqrt(rho (lambda + 2 mu)) and sqrt(rho mu), which are rho c_p and rho c_s.
Impedance impedanceOf(const Material&, Plane);

/// Makes the boundary edges between these grid points viscous; edges that have joints are none of the boundary. Impedance of each block's own material unless
/// one is given (positive). Dashpots act on what forces move: along the axes of a group there are none. Grid points of which no boundary edge is among
/// them, of rigid blocks or of groups that are pushed or move along both axes are refused.
void addViscous(BlockAssembly&, const std::string& name, std::vector<int> nodes, const Impedance& = {});

/// Index of a viscous boundary, or an error that says which there are.
int viscousOf(const BlockAssembly&, const std::string& name);

/// The velocity of the wave that comes in: linear between ascending times, zero outside.
void setIncoming(BlockAssembly&, int boundary, std::vector<Real> times, std::vector<Vec2> velocities);

/// Takes a boundary away; what went through it stays in the accounts.
void releaseViscous(BlockAssembly&, int boundary);

/// The force that a boundary puts on the blocks at the present velocities (of the last half step) [N].
Vec2 viscousForce(const BlockAssembly&, int boundary, Real time);

/// Power of all dashpots on the blocks at the present velocities [W].
Real viscousPower(const BlockAssembly&, Real time);

/// Lets the dashpots act in a step: begin() before, end() behind the motion without them.
///   m (v_after - v_before) / dt = other forces + C (2 w - (v_before + v_after) / 2)
class ViscousStep {
public:
	void begin(const BlockAssembly&);
	/// Corrects velocities, displacements and what the step turned over; the largest velocity of a grid point with a dashpot, along either axis [m/s].
	Real end(BlockAssembly&, Real dt, Real time, StepWork&) const;

private:
	std::vector<Vec2> before; ///< velocities of the dashpots' grid points
};

} // namespace blocks
