// yade-blocks, GPL-2.0-or-later
#pragma once
#include <blocks/kernel/Types.hpp>

/// The constant-strain triangle: strain, stress and nodal forces of one zone, in total form.
namespace blocks {

enum class Plane { strain, stress };
enum class Strain {
	large, ///< F = R U, strain U - 1: no stress from rotation, however large
	small  ///< symmetric part of F - 1: cheaper; for scenes in which nothing turns
};

/// Isotropic elastic moduli as a zone uses them: sigma = lambda tr(e) 1 + 2 mu e [Pa].
struct Moduli {
	Real lambda;
	Real mu;
};

inline Moduli planeModuli(Real young, Real poisson, Plane plane)
{
	const Real mu = young / (2 * (1 + poisson));
	return { plane == Plane::strain ? young * poisson / ((1 + poisson) * (1 - 2 * poisson)) : young * poisson / (1 - poisson * poisson), mu };
}

/// Gradients of the shape functions of nodes 1 and 2 in the reference configuration [1/m]; node 0 has minus their sum.
struct ZoneGradients {
	Real g1x, g1y, g2x, g2y;
};

inline ZoneGradients zoneGradients(const Vec2& x0, const Vec2& x1, const Vec2& x2)
{
	const Vec2 a = x1 - x0, b = x2 - x0;
	const Real twiceArea = cross(a, b);
	return { b.y() / twiceArea, -b.x() / twiceArea, -a.y() / twiceArea, a.x() / twiceArea };
}

/// Symmetric strain or stress in the zone's own (unrotated) axes, and the rotation R = [c -s; s c].
struct ZoneStrain {
	Real exx, eyy, exy;
	Real c, s;
};

/// F = 1 + H, H = sum u_i (x) grad N_i, from the displacements p and q of nodes 1 and 2 less that of node 0; then F = R U with the closed
/// form of two dimensions. Displacements and not positions: so strains are as exact far from the origin as near it.
template <Strain kind> inline ZoneStrain zoneStrain(const ZoneGradients& g, Real px, Real py, Real qx, Real qy)
{
	const Real hxx = px * g.g1x + qx * g.g2x, hxy = px * g.g1y + qx * g.g2y;
	const Real hyx = py * g.g1x + qy * g.g2x, hyy = py * g.g1y + qy * g.g2y;
	if constexpr (kind == Strain::small) return { hxx, hyy, (hxy + hyx) / 2, 1, 0 };

	const Real fxx = 1 + hxx, fyy = 1 + hyy;
	const Real trace = fxx + fyy, skew = hyx - hxy;
	const Real inverse = 1 / std::sqrt(trace * trace + skew * skew);
	const Real c = trace * inverse, s = skew * inverse;
	return { c * fxx + s * hyx - 1, c * fyy - s * hxy - 1, (c * hxy + s * fyy + c * hyx - s * fxx) / 2, c, s };
}

struct ZoneStress {
	Real sxx, syy, sxy; ///< in the zone's own axes [Pa]
};

inline ZoneStress zoneStress(const Moduli& m, const ZoneStrain& e)
{
	const Real p = m.lambda * (e.exx + e.eyy);
	return { p + 2 * m.mu * e.exx, p + 2 * m.mu * e.eyy, 2 * m.mu * e.exy };
}

/// The elastic strain that a stress in the plane goes with.
inline ZoneStrain zoneStrainOf(const Moduli& m, const ZoneStress& t)
{
	const Real p = m.lambda * (t.sxx + t.syy) / (2 * (m.lambda + m.mu));
	return { (t.sxx - p) / (2 * m.mu), (t.syy - p) / (2 * m.mu), t.sxy / (2 * m.mu), 1, 0 };
}

/// Energy per volume [J/m3].
inline Real zoneEnergyDensity(const Moduli& m, const ZoneStrain& e)
{
	const Real trace = e.exx + e.eyy;
	return m.lambda / 2 * trace * trace + m.mu * (e.exx * e.exx + e.eyy * e.eyy + 2 * e.exy * e.exy);
}

/// Nodal forces of nodes 1 and 2, f_i = -V P grad N_i with P = R sigma; node 0 takes minus their sum.
struct ZoneForces {
	Real f1x, f1y, f2x, f2y;
};

template <Strain kind> inline ZoneForces zoneForces(const ZoneGradients& g, Real volume, const ZoneStress& t, const ZoneStrain& e)
{
	Real pxx = t.sxx, pxy = t.sxy, pyx = t.sxy, pyy = t.syy;
	if constexpr (kind == Strain::large) {
		pxx = e.c * t.sxx - e.s * t.sxy;
		pxy = e.c * t.sxy - e.s * t.syy;
		pyx = e.s * t.sxx + e.c * t.sxy;
		pyy = e.s * t.sxy + e.c * t.syy;
	}
	return { -volume * (pxx * g.g1x + pxy * g.g1y),
		 -volume * (pyx * g.g1x + pyy * g.g1y), //
		 -volume * (pxx * g.g2x + pxy * g.g2y),
		 -volume * (pyx * g.g2x + pyy * g.g2y) };
}

/// Forces of a zone for a stress whose axes need not be those of the strain: stresses in situ, or those of a rate. It is work-conjugate to the strain U - 1,
///   P = R (sigma + kappa J),  J = [0 -1; 1 0],  kappa = ((sxx - syy) exy - sxy (exx - eyy)) / tr U:
/// P:dF = sigma:dU for every dF, and P F^T is symmetric, so that a zone has no moment of its own.
template <Strain kind> inline ZoneForces zoneForcesOfAnyAxes(const ZoneGradients& g, Real volume, const ZoneStress& t, const ZoneStrain& e)
{
	Real pxx = t.sxx, pxy = t.sxy, pyx = t.sxy, pyy = t.syy;
	if constexpr (kind == Strain::large) {
		const Real kappa = ((t.sxx - t.syy) * e.exy - t.sxy * (e.exx - e.eyy)) / (2 + e.exx + e.eyy);
		const Real xy = t.sxy - kappa, yx = t.sxy + kappa;
		pxx = e.c * t.sxx - e.s * yx;
		pxy = e.c * xy - e.s * t.syy;
		pyx = e.s * t.sxx + e.c * yx;
		pyy = e.s * xy + e.c * t.syy;
	}
	return { -volume * (pxx * g.g1x + pxy * g.g1y),
		 -volume * (pyx * g.g1x + pyy * g.g1y), //
		 -volume * (pxx * g.g2x + pxy * g.g2y),
		 -volume * (pyx * g.g2x + pyy * g.g2y) };
}

/// Rate of the strain U - 1, from the velocities p and q of nodes 1 and 2 less that of node 0 [1/s]: dU/dt = R^T dF/dt - omega J U, where omega makes
/// it symmetric. A rigid rotation has none, whatever the strain.
template <Strain kind> inline ZoneStrain zoneStrainRate(const ZoneGradients& g, const ZoneStrain& e, Real px, Real py, Real qx, Real qy)
{
	const Real hxx = px * g.g1x + qx * g.g2x, hxy = px * g.g1y + qx * g.g2y;
	const Real hyx = py * g.g1x + qy * g.g2x, hyy = py * g.g1y + qy * g.g2y;
	if constexpr (kind == Strain::small) return { hxx, hyy, (hxy + hyx) / 2, 1, 0 };

	const Real axx = e.c * hxx + e.s * hyx, axy = e.c * hxy + e.s * hyy, ayx = e.c * hyx - e.s * hxx, ayy = e.c * hyy - e.s * hxy;
	const Real omega = (ayx - axy) / (2 + e.exx + e.eyy);
	return { axx + omega * e.exy, ayy - omega * e.exy, (axy + ayx + omega * (e.eyy - e.exx)) / 2, e.c, e.s };
}

} // namespace blocks
