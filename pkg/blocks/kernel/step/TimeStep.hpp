// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/model/BlockAssembly.hpp>

/// The limiting time step (paper, Eq. 10) with a stiffness per grid point that bounds the highest frequency from above.
namespace blocks {

/// K_n [N/m]: the sum over all grid points j of the norm of the 2x2 block K_nj of the stiffness matrix, zones and joints.
/// The largest eigenvalue of M^-1 K is at most max K_n / m_n (block Gershgorin), whatever way the blocks have turned, because
/// the spectral norm of a block does not change with rotation. The paper's sum of diagonal terms is no such bound:
/// it overestimates the stable step by 4-49 %. Dilation adds its normal force per slip to a joint's stiffness. Stresses in situ turn with their zones:
/// by R T with |dR| <= |dF| / sqrt(2), and by kappa (see zoneForcesOfAnyAxes) with as much again, so that they add at most 2 |T| V |g_n| |g_j|.
std::vector<Real> nodalStiffness(const BlockAssembly&);

/// The zones' share of it, which never changes, and all of it from that.
std::vector<Real> zoneStiffness(const BlockAssembly&);
std::vector<Real> nodalStiffness(const BlockAssembly&, std::vector<Real> ofZones);

/// The share of contacts, of those that touch and those that may, in the bound of nodalStiffness [N/m].
std::vector<Real> contactStiffness(const BlockAssembly&);

/// min 2 sqrt(m / K) over the grid points that can move, for the true masses or the scaled ones [s].
///
/// Viscous boundaries do not lower it. Their force is taken at the mean of the velocities before and after, so that
///   E = v.M v / 2 + u_n+1.K u_n / 2  falls by  dt w.C w,  w the mean velocity,
/// in every step, and E is positive as long as M - dt^2 K / 4 is.
///
/// Damping proportional to stiffness does. Its force is that of the velocity before, and C v_before = C w - C (v_after - v_before) / 2: it is a centred
/// damping with the masses M - dt C / 2. Stable is what leaves M - dt C / 2 - dt^2 K / 4 positive, with C <= beta K
///   dt^2 + 2 beta dt < limit^2,  so  dt < limit^2 / (sqrt(beta^2 + limit^2) + beta).
Real stableTimeStep(const BlockAssembly&, const std::vector<Real>& stiffness, const std::vector<Real>& inertia);

/// Stiffness for the step of a scene in which blocks collide: springs of free contacts count four times. A spring that is there from the start keeps
/// its energy up to the limit of the step; one that comes and goes within a step costs or gives a share of k dt^2 / m, up to 9 % at 0.7 of the limit.
/// At half of that, in which four times the stiffness results, it is below 1 %.
std::vector<Real> touchStiffness(const BlockAssembly&, const std::vector<Real>& stiffness);

/// inertia = K dt^2 / (4 safety^2): every grid point at the same fraction of its limit. For quasi-static runs.
void scaleInertia(BlockAssembly&, const std::vector<Real>& stiffness, Real dt, Real safety);

} // namespace blocks
