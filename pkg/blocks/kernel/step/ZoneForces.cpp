// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/Wide.hpp>
#include <blocks/kernel/step/ZoneForces.hpp>

namespace blocks {
namespace {

	/// Zones in work.
	struct Batch {
		alignas(64) Real px[zoneBatch], py[zoneBatch], qx[zoneBatch], qy[zoneBatch];     ///< displacements of nodes 1 and 2 less that of node 0 [m]
		alignas(64) Real f1x[zoneBatch], f1y[zoneBatch], f2x[zoneBatch], f2y[zoneBatch]; ///< on nodes 1 and 2 [N]
		alignas(64) Real energy[zoneBatch];                                              ///< only if somebody asks [J]
	};

	/// The arithmetic proper, without indirections.
	template <Strain kind, bool energy, bool inSitu = false>
	inline __attribute__((always_inline)) void forcesOfBatch(Batch& b, const Mesh& mesh, int first, int count, const Moduli& m)
	{
		const Moduli                 moduli = m;
		const Real *                 g1x = mesh.zoneGradient.g1x.data() + first, *g1y = mesh.zoneGradient.g1y.data() + first;
		const Real *                 g2x = mesh.zoneGradient.g2x.data() + first, *g2y = mesh.zoneGradient.g2y.data() + first;
		const Real*                  volume  = mesh.zoneVolume.data() + first;
		[[maybe_unused]] const Real *startXX = nullptr, *startYY = nullptr, *startXY = nullptr;
		if constexpr (inSitu) startXX = mesh.inSitu.xx.data() + first, startYY = mesh.inSitu.yy.data() + first, startXY = mesh.inSitu.xy.data() + first;
#pragma GCC ivdep
		for (int i = 0; i < count; ++i) {
			const ZoneGradients g { g1x[i], g1y[i], g2x[i], g2y[i] };
			const ZoneStrain    e = zoneStrain<kind>(g, b.px[i], b.py[i], b.qx[i], b.qy[i]);
			if constexpr (inSitu) {
				const ZoneStrain all { e.exx + startXX[i], e.eyy + startYY[i], e.exy + startXY[i], e.c, e.s };
				const ZoneForces f = zoneForcesOfAnyAxes<kind>(g, volume[i], zoneStress(moduli, all), e);
				b.f1x[i] = f.f1x, b.f1y[i] = f.f1y, b.f2x[i] = f.f2x, b.f2y[i] = f.f2y;
				if constexpr (energy) b.energy[i] = volume[i] * zoneEnergyDensity(moduli, all);
			} else {
				const ZoneForces f = zoneForces<kind>(g, volume[i], zoneStress(moduli, e), e);
				b.f1x[i] = f.f1x, b.f1y[i] = f.f1y, b.f2x[i] = f.f2x, b.f2y[i] = f.f2y;
				if constexpr (energy) b.energy[i] = volume[i] * zoneEnergyDensity(moduli, e);
			}
		}
	}
	WIDE void largeStrain(Batch& b, const Mesh& mesh, int first, int count, const Moduli& m)
	{
		forcesOfBatch<Strain::large, false>(b, mesh, first, count, m);
	}
	WIDE void smallStrain(Batch& b, const Mesh& mesh, int first, int count, const Moduli& m)
	{
		forcesOfBatch<Strain::small, false>(b, mesh, first, count, m);
	}
	WIDE void largeWithEnergy(Batch& b, const Mesh& mesh, int first, int count, const Moduli& m)
	{
		forcesOfBatch<Strain::large, true>(b, mesh, first, count, m);
	}
	WIDE void smallWithEnergy(Batch& b, const Mesh& mesh, int first, int count, const Moduli& m)
	{
		forcesOfBatch<Strain::small, true>(b, mesh, first, count, m);
	}
	WIDE void largeInSitu(Batch& b, const Mesh& mesh, int first, int count, const Moduli& m)
	{
		forcesOfBatch<Strain::large, true, true>(b, mesh, first, count, m);
	}
	WIDE void smallInSitu(Batch& b, const Mesh& mesh, int first, int count, const Moduli& m)
	{
		forcesOfBatch<Strain::small, true, true>(b, mesh, first, count, m);
	}

	/// Energies alone; how many zones are inside out or not a number.
	template <Strain kind> inline __attribute__((always_inline)) int lookAtBatch(Batch& b, const Mesh& mesh, int first, int count, const Moduli& m)
	{
		const Moduli moduli = m;
		const Real * g1x = mesh.zoneGradient.g1x.data() + first, *g1y = mesh.zoneGradient.g1y.data() + first;
		const Real * g2x = mesh.zoneGradient.g2x.data() + first, *g2y = mesh.zoneGradient.g2y.data() + first;
		const Real*  volume = mesh.zoneVolume.data() + first;
		int          bad    = 0;
#pragma GCC ivdep
		for (int i = 0; i < count; ++i) {
			const ZoneGradients g { g1x[i], g1y[i], g2x[i], g2y[i] };
			const Real          determinant = (1 + b.px[i] * g.g1x + b.qx[i] * g.g2x) * (1 + b.py[i] * g.g1y + b.qy[i] * g.g2y)
				- (b.px[i] * g.g1y + b.qx[i] * g.g2y) * (b.py[i] * g.g1x + b.qy[i] * g.g2x);
			bad += determinant > 0 ? 0 : 1;
			b.energy[i] = volume[i] * zoneEnergyDensity(moduli, zoneStrain<kind>(g, b.px[i], b.py[i], b.qx[i], b.qy[i]));
		}
		return bad;
	}
	WIDE int lookAtLarge(Batch& b, const Mesh& mesh, int first, int count, const Moduli& m) { return lookAtBatch<Strain::large>(b, mesh, first, count, m); }
	WIDE int lookAtSmall(Batch& b, const Mesh& mesh, int first, int count, const Moduli& m) { return lookAtBatch<Strain::small>(b, mesh, first, count, m); }

	using Kernel = void (*)(Batch&, const Mesh&, int, int, const Moduli&);

	/// How far grid points 1 and 2 of zones have gone beside grid point 0.
	void gather(Batch& b, const std::array<int, 3>* nodes, int count, const Real* u)
	{
		for (int i = 0; i < count; ++i) {
			const auto& node = nodes[i];
			const Real  x0 = u[2 * node[0]], y0 = u[2 * node[0] + 1];
			b.px[i] = u[2 * node[1]] - x0, b.py[i] = u[2 * node[1] + 1] - y0;
			b.qx[i] = u[2 * node[2]] - x0, b.qy[i] = u[2 * node[2] + 1] - y0;
		}
	}

	/// Zones of any shape: edge by edge from their grid points, and back.
	void addAnyZones(const Mesh& mesh, const Real* u, Real* f, int block, const Moduli& m, Kernel law, Real* energy)
	{
		Batch     b;
		Real      sum     = 0;
		const int zoneEnd = mesh.firstZone[block + 1];
		for (int zone = mesh.firstZone[block]; zone < zoneEnd; zone += zoneBatch) {
			const std::array<int, 3>* nodes = mesh.zoneNodes.data() + zone;
			const int                 count = std::min(zoneBatch, zoneEnd - zone);
			gather(b, nodes, count, u);
			law(b, mesh, zone, count, m);
			if (energy)
				for (int i = 0; i < count; ++i)
					sum += b.energy[i];
			for (int i = 0; i < count; ++i) {
				const auto& node = nodes[i];
				f[2 * node[0]] -= b.f1x[i] + b.f2x[i], f[2 * node[0] + 1] -= b.f1y[i] + b.f2y[i];
				f[2 * node[1]] += b.f1x[i], f[2 * node[1] + 1] += b.f1y[i];
				f[2 * node[2]] += b.f2x[i], f[2 * node[2] + 1] += b.f2y[i];
			}
		}
		if (energy) energy[block] = sum;
	}

	/// Fans: zone k has corners k and k + 1 and the last grid point, so no zone needs to be asked for its grid points.
	WIDE void addFans(const Mesh& mesh, const Real* u, Real* f, int block, int blockEnd, const Moduli& m, Kernel law, Real* energy)
	{
		Batch b;
		while (block < blockEnd) {
			const int firstZone = mesh.firstZone[block], firstBlock = block;
			while (block < blockEnd && mesh.firstZone[block + 1] - firstZone <= zoneBatch)
				++block;
			for (int i = firstBlock; i < block; ++i) {
				const int   corners = mesh.firstZone[i + 1] - mesh.firstZone[i], slot = mesh.firstZone[i] - firstZone;
				const Real *x = u + 2 * mesh.firstNode[i], *centre = x + 2 * corners;
				Real *      px = b.px + slot, *py = b.py + slot, *qx = b.qx + slot, *qy = b.qy + slot;
				const Real  cx = centre[0], cy = centre[1];
				for (int k = 0; k < corners - 1; ++k)
					px[k] = x[2 * k + 2] - x[2 * k], py[k] = x[2 * k + 3] - x[2 * k + 1];
				px[corners - 1] = x[0] - x[2 * corners - 2], py[corners - 1] = x[1] - x[2 * corners - 1];
				for (int k = 0; k < corners; ++k)
					qx[k] = cx - x[2 * k], qy[k] = cy - x[2 * k + 1];
			}
			law(b, mesh, firstZone, mesh.firstZone[block] - firstZone, m);
			for (int i = firstBlock; i < block; ++i) {
				const int   corners = mesh.firstZone[i + 1] - mesh.firstZone[i], slot = mesh.firstZone[i] - firstZone;
				Real*       at  = f + 2 * mesh.firstNode[i];
				const Real *f1x = b.f1x + slot, *f1y = b.f1y + slot, *f2x = b.f2x + slot, *f2y = b.f2y + slot;
				Real        sumX = 0, sumY = 0, beforeX = f1x[corners - 1], beforeY = f1y[corners - 1];
				for (int k = 0; k < corners; ++k) {
					at[2 * k] += beforeX - (f1x[k] + f2x[k]), at[2 * k + 1] += beforeY - (f1y[k] + f2y[k]);
					sumX += f2x[k], sumY += f2y[k];
					beforeX = f1x[k], beforeY = f1y[k];
				}
				at[2 * corners] += sumX, at[2 * corners + 1] += sumY;
				if (!energy) continue;
				Real sum = 0;
				for (int k = 0; k < corners; ++k)
					sum += b.energy[slot + k];
				energy[i] = sum;
			}
		}
	}

} // namespace

void addZoneForces(const BlockAssembly& a, int first, int last, Vec2* force, Real* energy)
{
	const Mesh&  mesh  = a.mesh;
	const Moduli m     = moduliOf(a, first);
	const Real*  u     = a.state.displacement.data()->data();
	Real*        f     = force->data();
	const bool   large = a.strain == Strain::large;
	Kernel       law   = energy ? (large ? largeWithEnergy : smallWithEnergy) : (large ? largeStrain : smallStrain);
	if (!mesh.inSitu.empty()) law = large ? largeInSitu : smallInSitu;
	const auto isFan = [&](int block) { return mesh.isFan[block] && mesh.firstZone[block + 1] - mesh.firstZone[block] <= zoneBatch; };
	for (int next; first < last; first = next) {
		next = first + 1;
		if (isFan(first)) {
			while (next < last && isFan(next))
				++next;
			addFans(mesh, u, f, first, next, m, law, energy);
		} else
			addAnyZones(mesh, u, f, first, m, law, energy);
	}
}

ZoneLook lookAtZones(const BlockAssembly& a)
{
	const Mesh& mesh = a.mesh;
	const Real* u    = a.state.displacement.data()->data();
	ZoneLook    look;
	Batch       b;
	for (int block = 0, next; block < a.blockCount(); block = next) { // blocks of one material at a time
		next = block + 1;
		while (next < a.blockCount() && mesh.blockMaterial[next] == mesh.blockMaterial[block])
			++next;
		const Moduli m   = moduliOf(a, block);
		const int    end = mesh.firstZone[next];
		for (int zone = mesh.firstZone[block]; zone < end; zone += zoneBatch) {
			const int count = std::min(zoneBatch, end - zone);
			gather(b, mesh.zoneNodes.data() + zone, count, u);
			if ((a.strain == Strain::large ? lookAtLarge : lookAtSmall)(b, mesh, zone, count, m) > 0) look.sound = false;
			if (!mesh.inSitu.empty())
				for (int i = 0; i < count; ++i)
					b.energy[i] = mesh.zoneVolume[zone + i] * zoneEnergyDensity(m, elasticStrainOf(a, zone + i));
			for (int i = 0; i < count; ++i)
				look.energy += b.energy[i];
		}
	}
	return look;
}

ZoneStrain strainOf(const BlockAssembly& a, int zone)
{
	const auto& node = a.mesh.zoneNodes[zone];
	const auto& u    = a.state.displacement;
	const Vec2  p = u[node[1]] - u[node[0]], q = u[node[2]] - u[node[0]];
	const auto  g = a.mesh.zoneGradient[zone];
	return a.strain == Strain::large ? zoneStrain<Strain::large>(g, p.x(), p.y(), q.x(), q.y()) : zoneStrain<Strain::small>(g, p.x(), p.y(), q.x(), q.y());
}

ZoneStrain elasticStrainOf(const BlockAssembly& a, int zone)
{
	const ZoneStrain     e     = strainOf(a, zone);
	const StrainColumns& start = a.mesh.inSitu;
	if (start.empty()) return e;
	return { e.exx + start.xx[zone], e.eyy + start.yy[zone], e.exy + start.xy[zone], e.c, e.s };
}

ZoneStress cauchyStress(const BlockAssembly& a, int block, int zone)
{
	const ZoneStrain e = strainOf(a, zone);
	const ZoneStress t = zoneStress(moduliOf(a, block), elasticStrainOf(a, zone));
	if (a.strain == Strain::small) return t;
	// sigma = P F^T / J = R (t U) R^T / J, with U = 1 + e; t and U have the same principal axes, so t U is symmetric
	const Real uxx = 1 + e.exx, uyy = 1 + e.eyy, uxy = e.exy, jacobian = uxx * uyy - uxy * uxy;
	Real       kxx = (t.sxx * uxx + t.sxy * uxy) / jacobian, kyy = (t.sxy * uxy + t.syy * uyy) / jacobian, kxy = (t.sxx * uxy + t.sxy * uyy) / jacobian;
	if (!a.mesh.inSitu.empty()) { // other axes: see zoneForcesOfAnyAxes
		const Real kappa = ((t.sxx - t.syy) * uxy - t.sxy * (uxx - uyy)) / (uxx + uyy) / jacobian;
		kxx -= kappa * uxy, kyy += kappa * uxy, kxy -= kappa * uyy;
	}
	const Real c = e.c, s = e.s;
	return { c * c * kxx - 2 * c * s * kxy + s * s * kyy, s * s * kxx + 2 * c * s * kxy + c * c * kyy, c * s * (kxx - kyy) + (c * c - s * s) * kxy };
}

} // namespace blocks
