// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/Two.hpp>
#include <blocks/kernel/Wide.hpp>
#include <blocks/kernel/step/ZoneForces.hpp>

namespace blocks {
namespace {

	/// Zones in work. There is room beyond the last, for columns are written by two.
	struct Batch {
		using Lane = Real[zoneBatch + 8];
		alignas(64) Lane px, py, qx, qy;     ///< displacements of nodes 1 and 2 less that of node 0 [m]
		alignas(64) Lane f1x, f1y, f2x, f2y; ///< on nodes 1 and 2 [N]
		alignas(64) Lane energy;             ///< only if somebody asks [J]
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
		for (int i = 0; i < count; i += 2) { // an odd last one is taken twice
			const auto &node = nodes[i], &next = nodes[std::min(i + 1, count - 1)];
			const Two   start = loadTwo(u + 2 * node[0]), p = loadTwo(u + 2 * node[1]) - start, q = loadTwo(u + 2 * node[2]) - start;
			const Two   nextStart = loadTwo(u + 2 * next[0]), nextP = loadTwo(u + 2 * next[1]) - nextStart,
				  nextQ = loadTwo(u + 2 * next[2]) - nextStart;
			store(b.px + i, firsts(p, nextP)), store(b.py + i, seconds(p, nextP));
			store(b.qx + i, firsts(q, nextQ)), store(b.qy + i, seconds(q, nextQ));
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
			const auto add = [f](const std::array<int, 3>& node, Two f1, Two f2) {
				addTo(f + 2 * node[0], -(f1 + f2)), addTo(f + 2 * node[1], f1), addTo(f + 2 * node[2], f2);
			};
			for (int i = 0; i < count; i += 2) {
				const Two x1 = loadTwo(b.f1x + i), y1 = loadTwo(b.f1y + i), x2 = loadTwo(b.f2x + i), y2 = loadTwo(b.f2y + i);
				add(nodes[i], firsts(x1, y1), firsts(x2, y2));
				if (i + 1 < count) add(nodes[i + 1], seconds(x1, y1), seconds(x2, y2));
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
				const Real* x      = u + 2 * mesh.firstNode[i];
				const Two   centre = loadTwo(x + 2 * corners);
				const auto  corner = [=](int k) { return loadTwo(x + 2 * (k < corners ? k : 0)); }; // the first comes after the last
				for (int k = 0; k < corners; k += 2) { // what is written beyond the last corner is the next block's, or nobody's
					const Two here = corner(k), next = corner(k + 1), afterNext = corner(k + 2);
					const Two p0 = next - here, p1 = afterNext - next, q0 = centre - here, q1 = centre - next;
					store(b.px + slot + k, firsts(p0, p1)), store(b.py + slot + k, seconds(p0, p1));
					store(b.qx + slot + k, firsts(q0, q1)), store(b.qy + slot + k, seconds(q0, q1));
				}
			}
			law(b, mesh, firstZone, mesh.firstZone[block] - firstZone, m);
			for (int i = firstBlock; i < block; ++i) {
				const int corners = mesh.firstZone[i + 1] - mesh.firstZone[i], slot = mesh.firstZone[i] - firstZone;
				Real*     at = f + 2 * mesh.firstNode[i];
				Two       all { 0, 0 }, before { b.f1x[slot + corners - 1], b.f1y[slot + corners - 1] };
				for (int k = 0; k < corners; k += 2) {
					const Two x1 = loadTwo(b.f1x + slot + k), y1 = loadTwo(b.f1y + slot + k);
					const Two x2 = loadTwo(b.f2x + slot + k), y2 = loadTwo(b.f2y + slot + k);
					addTo(at + 2 * k, before - (firsts(x1, y1) + firsts(x2, y2)));
					all += firsts(x2, y2);
					if (k + 1 == corners) break;
					addTo(at + 2 * k + 2, firsts(x1, y1) - (seconds(x1, y1) + seconds(x2, y2)));
					all += seconds(x2, y2);
					before = seconds(x1, y1);
				}
				addTo(at + 2 * corners, all);
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
