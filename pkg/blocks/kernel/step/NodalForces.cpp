// yade-blocks, GPL-2.0-or-later
#include <algorithm>
#include <blocks/kernel/step/ContactKinematics.hpp>
#include <blocks/kernel/step/NodalForces.hpp>
#include <cassert>

namespace blocks {
namespace {

	/// So many zones at a time: their edge vectors are gathered, their forces computed side by side, then added node by node.
	constexpr int batch = 64;

	struct Batch {
		alignas(64) Real px[batch], py[batch], qx[batch], qy[batch];     ///< edge vectors x1 - x0 and x2 - x0 [m]
		alignas(64) Real f1x[batch], f1y[batch], f2x[batch], f2y[batch]; ///< on nodes 1 and 2 [N]
	};

	/// The arithmetic proper, without indirections. AVX2 only widens it; without fused operations the bits are the same.
	template <Strain kind>
	inline __attribute__((always_inline)) void forcesOfBatch(Batch& b, const ZoneGradients* g, const Real* volume, const Moduli& m, int count)
	{
		const Moduli moduli = m;
		for (int i = 0; i < count; ++i) {
			const ZoneStrain e = zoneStrain<kind>(g[i], b.px[i], b.py[i], b.qx[i], b.qy[i]);
			const ZoneForces f = zoneForces<kind>(g[i], volume[i], zoneStress(moduli, e), e);
			b.f1x[i]           = f.f1x;
			b.f1y[i]           = f.f1y;
			b.f2x[i]           = f.f2x;
			b.f2y[i]           = f.f2y;
		}
	}
	__attribute__((target_clones("avx2", "default"))) void largeStrain(Batch& b, const ZoneGradients* g, const Real* volume, const Moduli& m, int count)
	{
		forcesOfBatch<Strain::large>(b, g, volume, m, count);
	}
	__attribute__((target_clones("avx2", "default"))) void smallStrain(Batch& b, const ZoneGradients* g, const Real* volume, const Moduli& m, int count)
	{
		forcesOfBatch<Strain::small>(b, g, volume, m, count);
	}

	void addZoneForces(const Moduli& m, int first, int last, const BlockAssembly& a, Vec2* force)
	{
		const Real*               x     = a.position.data()->data();
		Real*                     f     = force->data();
		const std::array<int, 3>* nodes = a.zoneNodes.data();
		const auto                law   = a.strain == Strain::large ? largeStrain : smallStrain;
		Batch                     b;
		for (int start = first; start < last; start += batch) {
			const int count = std::min(batch, last - start);
			for (int i = 0; i < count; ++i) {
				const auto& node = nodes[start + i];
				const Real  x0 = x[2 * node[0]], y0 = x[2 * node[0] + 1];
				b.px[i] = x[2 * node[1]] - x0, b.py[i] = x[2 * node[1] + 1] - y0;
				b.qx[i] = x[2 * node[2]] - x0, b.qy[i] = x[2 * node[2] + 1] - y0;
			}
			law(b, &a.zoneGradient[start], &a.zoneVolume[start], m, count);
			for (int i = 0; i < count; ++i) {
				const auto& node = nodes[start + i];
				f[2 * node[0]] -= b.f1x[i] + b.f2x[i], f[2 * node[0] + 1] -= b.f1y[i] + b.f2y[i];
				f[2 * node[1]] += b.f1x[i], f[2 * node[1] + 1] += b.f1y[i];
				f[2 * node[2]] += b.f2x[i], f[2 * node[2] + 1] += b.f2y[i];
			}
		}
	}

	/// Blocks [first, last): loads, then joints, then free contacts, then zones; runs of blocks of one material share their batches.
	void gatherBlocks(BlockAssembly& a, int first, int last)
	{
		Vec2*     force = a.force.data();
		const int node = a.firstNode[first], nodeEnd = a.firstNode[last];
		if (a.load.empty())
			std::fill(force + node, force + nodeEnd, Vec2::Zero());
		else
			std::copy(a.load.begin() + node, a.load.begin() + nodeEnd, force + node);

		const int*     sides    = a.sides.data();
		const Segment* segments = a.segments.data();
		const auto*    forces   = a.segmentForce.data();
		for (int i = a.firstSide[first], end = a.firstSide[last]; i < end; ++i) {
			const int segment = sides[i] >> 1, corner = 2 * (sides[i] & 1);
			force[segments[segment].node[corner]] += forces[segment][corner];
			force[segments[segment].node[corner + 1]] += forces[segment][corner + 1];
		}
		if (!a.contacts.order.empty())
			for (int block = first; block < last; ++block)
				gatherContactForces(a, block, force);
		for (int run = first, next; run < last; run = next) {
			const int material = a.blockMaterial[run];
			for (next = run + 1; next < last && a.blockMaterial[next] == material; ++next) { }
			const Material& m = a.materials[material];
			addZoneForces(planeModuli(m.young, m.poisson, a.plane), a.firstZone[run], a.firstZone[next], a, force);
		}
	}

	Vec2* loads(BlockAssembly& a)
	{
		if (a.load.empty()) a.load.assign(a.nodeCount(), Vec2::Zero());
		return a.load.data();
	}

} // namespace

__attribute__((target_clones("avx2", "default"))) void updateKinematics(BlockAssembly& a, int first, int last, Which which)
{
	if (which == Which::all)
		for (int i = first; i < last; ++i)
			updateKinematics(a.segments[i], a.position.data(), a.frames[i], &a.points[2 * i]);
	else
		for (int i = first; i < last; ++i)
			if (a.segments[i].released() == (which == Which::released))
				updateKinematics(a.segments[i], a.position.data(), a.frames[i], &a.points[2 * i]);
}

void computeJointForces(BlockAssembly& a, [[maybe_unused]] int threads)
{
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
	for (int i = 0; i < int(a.segments.size()); ++i)
		segmentForces(a.segments[i], a.frames[i], &a.points[2 * i], a.segmentForce[i]);
}

void gatherForces(BlockAssembly& a, int threads)
{
	assert(threads >= 1);
	if (threads == 1) return gatherBlocks(a, 0, a.blockCount());
#pragma omp parallel for schedule(static) num_threads(threads)
	for (int part = 0; part < threads; ++part) { // blocks with about equal numbers of zones
		auto begin = [&](int p) {
			return p == threads
				? a.blockCount()
				: int(std::lower_bound(a.firstZone.begin(), a.firstZone.end() - 1, long(a.zoneCount()) * p / threads) - a.firstZone.begin());
		};
		gatherBlocks(a, begin(part), begin(part + 1));
	}
}

ZoneStress cauchyStress(const BlockAssembly& a, int block, int zone)
{
	const Material&  material = a.materials[a.blockMaterial[block]];
	const Moduli     moduli   = planeModuli(material.young, material.poisson, a.plane);
	const auto&      node     = a.zoneNodes[zone];
	const Vec2       p = a.position[node[1]] - a.position[node[0]], q = a.position[node[2]] - a.position[node[0]];
	const bool       large = a.strain == Strain::large;
	const ZoneStrain e     = large ? zoneStrain<Strain::large>(a.zoneGradient[zone], p.x(), p.y(), q.x(), q.y())
				       : zoneStrain<Strain::small>(a.zoneGradient[zone], p.x(), p.y(), q.x(), q.y());
	const ZoneStress t     = zoneStress(moduli, e);
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
	for (RigidBlock& r : a.rigid)
		r.load += r.mass * g;
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
