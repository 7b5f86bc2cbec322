// yade-blocks, GPL-2.0-or-later
#include "NodalForces.hpp"
#include "ContactKinematics.hpp"

namespace blocks {
namespace {

	template <Strain kind> void addZoneForces(const Moduli& m, int first, int last, const BlockAssembly& a, Vec2* force)
	{
		const Vec2* x = a.position.data();
		for (int z = first; z < last; ++z) {
			const auto&         node = a.zoneNodes[z];
			const ZoneGradients& g   = a.zoneGradient[z];
			const Vec2           p = x[node[1]] - x[node[0]], q = x[node[2]] - x[node[0]];
			const ZoneStrain     e = zoneStrain<kind>(g, p.x(), p.y(), q.x(), q.y());
			const ZoneForces     f = zoneForces<kind>(g, a.zoneVolume[z], zoneStress(m, e), e);
			force[node[1]] += Vec2(f.f1x, f.f1y);
			force[node[2]] += Vec2(f.f2x, f.f2y);
			force[node[0]] -= Vec2(f.f1x + f.f2x, f.f1y + f.f2y);
		}
	}

	void gatherBlock(BlockAssembly& a, int block)
	{
		Vec2* force = a.force.data();
		const int first = a.firstNode[block], last = a.firstNode[block + 1];
		if (a.load.empty()) std::fill(force + first, force + last, Vec2::Zero());
		else std::copy(a.load.begin() + first, a.load.begin() + last, force + first);

		for (int i = a.firstSide[block]; i < a.firstSide[block + 1]; ++i) {
			const int segment = a.sides[i] >> 1, corner = 2 * (a.sides[i] & 1);
			for (int k : { corner, corner + 1 })
				force[a.segments[segment].node[k]] += a.segmentForce[segment][k];
		}
		const int zone = a.firstZone[block], end = a.firstZone[block + 1];
		if (zone == end) return;
		const Material& material = a.materials[a.blockMaterial[block]];
		const Moduli    moduli   = planeModuli(material.young, material.poisson, a.plane);
		if (a.strain == Strain::large) addZoneForces<Strain::large>(moduli, zone, end, a, force);
		else addZoneForces<Strain::small>(moduli, zone, end, a, force);
	}

	Vec2* loads(BlockAssembly& a)
	{
		if (a.load.empty()) a.load.assign(a.nodeCount(), Vec2::Zero());
		return a.load.data();
	}

} // namespace

void updateKinematics(BlockAssembly& a, int first, int last)
{
	for (int i = first; i < last; ++i)
		updateKinematics(a.segments[i], a.position.data(), a.frames[i], &a.points[2 * i]);
}

void computeJointForces(BlockAssembly& a, [[maybe_unused]] int threads)
{
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
	for (int i = 0; i < int(a.segments.size()); ++i)
		segmentForces(a.segments[i], a.frames[i], &a.points[2 * i], a.segmentForce[i]);
}

void gatherForces(BlockAssembly& a, [[maybe_unused]] int threads)
{
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
	for (int block = 0; block < a.blockCount(); ++block)
		gatherBlock(a, block);
}

ZoneStress cauchyStress(const BlockAssembly& a, int block, int zone)
{
	const Material& material = a.materials[a.blockMaterial[block]];
	const Moduli    moduli   = planeModuli(material.young, material.poisson, a.plane);
	const auto&     node     = a.zoneNodes[zone];
	const Vec2      p = a.position[node[1]] - a.position[node[0]], q = a.position[node[2]] - a.position[node[0]];
	const bool      large = a.strain == Strain::large;
	const ZoneStrain e    = large ? zoneStrain<Strain::large>(a.zoneGradient[zone], p.x(), p.y(), q.x(), q.y())
	                              : zoneStrain<Strain::small>(a.zoneGradient[zone], p.x(), p.y(), q.x(), q.y());
	const ZoneStress t = zoneStress(moduli, e);
	if (!large) return t;
	// sigma = P F^T / J = R (t U) R^T / J, with U = 1 + e; t and U have the same principal axes, so t U is symmetric
	const Real uxx = 1 + e.exx, uyy = 1 + e.eyy, uxy = e.exy, jacobian = uxx * uyy - uxy * uxy;
	const Real kxx = (t.sxx * uxx + t.sxy * uxy) / jacobian, kyy = (t.sxy * uxy + t.syy * uyy) / jacobian, kxy = (t.sxx * uxy + t.sxy * uyy) / jacobian;
	const Real c = e.c, s = e.s;
	return { c * c * kxx - 2 * c * s * kxy + s * s * kyy, s * s * kxx + 2 * c * s * kxy + c * c * kyy, c * s * (kxx - kyy) + (c * c - s * s) * kxy };
}

void addGravity(BlockAssembly& a, const Vec2& g)
{
	require(g.allFinite(), "gravity must be finite [m/s2]", g.allFinite() ? 0 : std::nan(""));
	Vec2* load = loads(a);
	for (int n = 0; n < a.nodeCount(); ++n)
		load[n] += a.mass[n] * g;
}

void addTraction(BlockAssembly& a, int edge, const Vec2& traction)
{
	require(edge >= 0 && edge < int(a.edgeNodes.size()), "a traction needs the index of a boundary edge", edge);
	require(traction.allFinite(), "a traction must be finite [Pa]", traction.allFinite() ? 0 : std::nan(""));
	Vec2*      load = loads(a);
	const auto n    = a.edgeNodes[edge];
	const Vec2 half = traction * ((a.reference[n[1]] - a.reference[n[0]]).norm() * a.thickness / 2);
	load[n[0]] += half;
	load[n[1]] += half;
}

} // namespace blocks
