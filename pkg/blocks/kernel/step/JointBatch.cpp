// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/Two.hpp>
#include <blocks/kernel/Wide.hpp>
#include <blocks/kernel/laws/JointKinematics.hpp>
#include <blocks/kernel/step/JointBatch.hpp>

namespace blocks {

void gatherDisplacements(const BlockAssembly& a, int first, int count, JointBatch& b)
{
	const Vec2* u = a.state.displacement.data();
	for (int i = 0; i < count; i += 2) { // an odd last one is taken twice; the columns have room for it
		const auto &node = a.joints.node[first + i], &next = a.joints.node[first + std::min(i + 1, count - 1)];
		const Two   a1 = loadTwo(u[node[0]]), a2 = loadTwo(u[node[2]]), u1 = loadTwo(u[node[1]]) - a1, u2 = loadTwo(u[node[3]]) - a2, apart = a2 - a1;
		const Two   nextA1 = loadTwo(u[next[0]]), nextA2 = loadTwo(u[next[2]]), nextU1 = loadTwo(u[next[1]]) - nextA1,
			  nextU2 = loadTwo(u[next[3]]) - nextA2, nextApart = nextA2 - nextA1;
		store(b.u1x + i, firsts(u1, nextU1)), store(b.u1y + i, seconds(u1, nextU1));
		store(b.u2x + i, firsts(u2, nextU2)), store(b.u2y + i, seconds(u2, nextU2));
		store(b.ux + i, firsts(apart, nextApart)), store(b.uy + i, seconds(apart, nextApart));
	}
}

namespace {

	/// Of a batch in which all edges match, most columns follow from the first edges: they need not be read.
	template <bool matched> inline __attribute__((always_inline)) void move(const JointColumns& columns, int first, int count, JointBatch& b)
	{
		const Real *                 e1x = columns.e1x.data() + first, *e1y = columns.e1y.data() + first;
		[[maybe_unused]] const Real *e2x = columns.e2x.data() + first, *e2y = columns.e2y.data() + first;
		[[maybe_unused]] const Real *dx = columns.dx.data() + first, *dy = columns.dy.data() + first;
		[[maybe_unused]] const Real *s1[2], *s2[2], *bondOpening[2], *bondSlip[2];
		for (int k : { 0, 1 }) {
			s1[k] = columns.s1[k].data() + first, s2[k] = columns.s2[k].data() + first;
			bondOpening[k] = columns.bondOpening[k].data() + first, bondSlip[k] = columns.bondSlip[k].data() + first;
		}
#pragma GCC ivdep
		for (int i = 0; i < count; ++i) {
			const Real       x1 = e1x[i] + b.u1x[i], y1 = e1y[i] + b.u1y[i];
			const Real       x2 = (matched ? -e1x[i] : e2x[i]) + b.u2x[i], y2 = (matched ? -e1y[i] : e2y[i]) + b.u2y[i];
			const JointFrame f = jointFrame(x1, y1, x2, y2);
			b.nx[i] = f.nx, b.ny[i] = f.ny;
			b.r1x[i] = f.r1x, b.r1y[i] = f.r1y, b.r2x[i] = f.r2x, b.r2y[i] = f.r2y;
			const Real x = (matched ? e1x[i] : dx[i]) + b.ux[i], y = (matched ? e1y[i] : dy[i]) + b.uy[i];
			for (int k = 0; k < 2; ++k) {
				Real gx, gy;
				if constexpr (matched)
					gx = k == 0 ? x + x2 : x - x1, gy = k == 0 ? y + y2 : y - y1;
				else
					gx = x + s2[k][i] * x2 - s1[k][i] * x1, gy = y + s2[k][i] * y2 - s1[k][i] * y1;
				b.dn[k][i]      = gx * f.nx + gy * f.ny;
				b.dt[k][i]      = gy * f.nx - gx * f.ny;
				b.opening[k][i] = matched ? b.dn[k][i] : b.dn[k][i] - bondOpening[k][i];
				b.slip[k][i]    = matched ? b.dt[k][i] : b.dt[k][i] - bondSlip[k][i];
			}
		}
	}
	WIDE void moveAny(const JointColumns& columns, int first, int count, JointBatch& b) { move<false>(columns, first, count, b); }
	WIDE void moveMatched(const JointColumns& columns, int first, int count, JointBatch& b) { move<true>(columns, first, count, b); }

	template <bool matched> inline __attribute__((always_inline)) void load(const JointColumns& columns, int first, int count, JointBatch& b)
	{
		const Real*                  area = columns.area.data() + first;
		[[maybe_unused]] const Real *s1[2], *s2[2];
		for (int k : { 0, 1 })
			s1[k] = columns.s1[k].data() + first, s2[k] = columns.s2[k].data() + first;
#pragma GCC ivdep
		for (int i = 0; i < count; ++i) {
			Real a1x = 0, a1y = 0, b1x = 0, b1y = 0, a2x = 0, a2y = 0, b2x = 0, b2y = 0, moment = 0;
			for (int k = 0; k < 2; ++k) {
				const Real n = area[i] * b.sigma[k][i], t = area[i] * b.tau[k][i];
				const Real fx = n * b.nx[i] - t * b.ny[i], fy = n * b.ny[i] + t * b.nx[i]; // on the first block
				if constexpr (matched) {
					if (k == 0)
						a1x += fx, a1y += fy, b2x -= fx, b2y -= fy;
					else
						b1x += fx, b1y += fy, a2x -= fx, a2y -= fy;
				} else {
					const Real w1 = s1[k][i], w2 = s2[k][i];
					a1x += (1 - w1) * fx, a1y += (1 - w1) * fy, b1x += w1 * fx, b1y += w1 * fy;
					a2x -= (1 - w2) * fx, a2y -= (1 - w2) * fy, b2x -= w2 * fx, b2y -= w2 * fy;
				}
				moment += n * b.dt[k][i] - t * b.dn[k][i];
			}
			const Real half = moment / 2; // each edge turns the frame by half its own rotation
			b.force.x[0][i] = a1x - half * b.r1x[i], b.force.y[0][i] = a1y - half * b.r1y[i];
			b.force.x[1][i] = b1x + half * b.r1x[i], b.force.y[1][i] = b1y + half * b.r1y[i];
			b.force.x[2][i] = a2x - half * b.r2x[i], b.force.y[2][i] = a2y - half * b.r2y[i];
			b.force.x[3][i] = b2x + half * b.r2x[i], b.force.y[3][i] = b2y + half * b.r2y[i];
		}
	}
	WIDE void loadAny(const JointColumns& columns, int first, int count, JointBatch& b) { load<false>(columns, first, count, b); }
	WIDE void loadMatched(const JointColumns& columns, int first, int count, JointBatch& b) { load<true>(columns, first, count, b); }

} // namespace

void moveJoints(const JointColumns& columns, int first, int count, JointBatch& b)
{
	(columns.matched[first / Joints::batch] ? moveMatched : moveAny)(columns, first, count, b);
}

void loadEdges(const JointColumns& columns, int first, int count, JointBatch& b)
{
	(columns.matched[first / Joints::batch] ? loadMatched : loadAny)(columns, first, count, b);
}

WIDE void elasticStresses(int count, JointBatch& b)
{
	std::int64_t sum = 0;
#pragma GCC ivdep
	for (int i = 0; i < count; ++i) {
		for (int k = 0; k < 2; ++k)
			b.sigma[k][i] = b.kn[i] * b.opening[k][i], b.tau[k][i] = b.ks[i] * b.slip[k][i];
		const std::int64_t points = isBeyond(b, i, 0) + isBeyond(b, i, 1);
		b.beyond[i]               = points;
		sum += points;
	}
	b.pointsBeyond = sum;
}

WIDE Real elasticEnergy(const JointColumns& columns, int first, int count, const JointBatch& b)
{
	const Real*   area       = columns.area.data() + first;
	constexpr int lanes      = 8; // sums are taken in so many parts, whatever the width of the processor
	Real          sum[lanes] = {}, energy[JointBatch::size];
#pragma GCC ivdep
	for (int i = 0; i < count; ++i)
		energy[i] = area[i]
			* (b.sigma[0][i] * b.opening[0][i] + b.tau[0][i] * b.slip[0][i] + b.sigma[1][i] * b.opening[1][i] + b.tau[1][i] * b.slip[1][i]);
	for (int i = count; i < JointBatch::size; ++i)
		energy[i] = 0;
	for (int i = 0; i < JointBatch::size; i += lanes)
		for (int lane = 0; lane < lanes; ++lane)
			sum[lane] += energy[i + lane];
	return (((sum[0] + sum[1]) + (sum[2] + sum[3])) + ((sum[4] + sum[5]) + (sum[6] + sum[7]))) / 2;
}

} // namespace blocks
