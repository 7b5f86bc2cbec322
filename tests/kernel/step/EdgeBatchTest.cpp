// yade-blocks, GPL-2.0-or-later
#include <blocks/kernel/step/EdgeBatch.hpp>

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>
#include <random>

using namespace blocks;

namespace {

constexpr Real thickness = 0.7, dt = 0.3;

/// What is known of the pairs of a batch, and what comes out.
struct Batch : EdgeColumns, EdgeBatch {
	static constexpr int size = EdgeColumns::size;
};

struct Dice {
	std::mt19937 random { 4 };
	Real         operator()(Real low, Real high) { return std::uniform_real_distribution<Real>(low, high)(random); }
};

/// One lane, worked on pair by pair with the law's plain functions.
struct Single {
	FourPoints          force;
	std::array<Real, 2> slip, sigma, tau;
	Real                area, friction = 0, potential;
	bool                touches;

	Single(const Batch& b, int i)
		: slip { b.slip[0][i], b.slip[1][i] }
	{
		FourPoints p, v;
		EdgeShape  shape;
		for (int n = 0; n < 4; ++n)
			p[n] = { b.px[n][i], b.py[n][i] }, v[n] = { b.vx[n][i], b.vy[n][i] }, shape.sharpness[n] = b.sharpness[n][i];
		for (int k : { 0, 1 })
			shape.rounding[k] = b.rounding[k][i], shape.farRounding[k] = b.farRounding[k][i];
		shape.depthLimit  = b.depthLimit[i];
		const Real uplift = b.uplift[i];
		if (uplift != 0) p = raised(p, uplift), v = raisedVelocity(p, uplift, v);
		const EdgeGeometry g = edgeGeometry(p, shape);
		touches              = g.active();
		area                 = thickness * g.area;
		potential            = edgePotential(g);
		force.fill(Vec2::Zero());
		addNormalForces(p, shape, g, b.kn[i] * thickness, force);
		const Real regrown = area > 0 ? std::sqrt(b.area[i] / area) : 0;
		for (int k : { 0, 1 }) {
			const Real pressure = b.kn[i] * g.depth[k], before = b.ks[i] * b.area[i] * slip[k] * slip[k] / 2;
			Real       work = 0;
			if (pressure > 0 && area > 0) {
				const EdgeEnd end = edgeEnd(p, g, k);
				Real          ds  = 0;
				for (int n = 0; n < 4; ++n)
					ds += dt * Vec2(end.slipGradient[n]).dot(v[n]);
				const Real old = slip[k] * regrown, limit = (b.cohesion[i] + pressure * b.tanPhi[i]) / b.ks[i];
				slip[k]         = std::clamp(old + ds, -limit, limit);
				const Real drag = b.ks[i] * area * slip[k];
				work            = (b.ks[i] * area * old + drag) / 2 * ds;
				for (int n = 0; n < 4; ++n)
					force[n] -= drag * Vec2(end.slipGradient[n]);
			} else
				slip[k] = 0;
			friction += work + before - b.ks[i] * area * slip[k] * slip[k] / 2;
			sigma[k] = -pressure, tau[k] = b.ks[i] * slip[k];
		}
		if (uplift != 0) lowerForces(p, uplift, force);
	}
};

/// Edges of length 0.4 to 1.4 that mostly overlap, with some slip that they remember. If wanted, half of them are raised or lowered.
void fill(Batch& b, int count, bool raised, Dice& dice)
{
	b.count = count, b.raised = raised;
	for (int i = 0; i < count; ++i) {
		const Real angle = dice(0, 2 * M_PI), tilt = dice(0, 1) < 0.3 ? 0 : dice(-1, 1);
		const Vec2 eA(std::cos(angle), std::sin(angle)), eB(-std::cos(angle + tilt), -std::sin(angle + tilt));
		const Vec2 a0(dice(-1, 1), dice(-1, 1)), a1 = a0 + dice(0.4, 1.4) * eA;
		const Vec2 onA = dice(0, 1) < 0.3 ? a1 : Vec2(a0 + dice(0, 1) * (a1 - a0)), onB = onA + dice(-0.01, 0.08) * Vec2(-eA.y(), eA.x());
		const Vec2 b0 = dice(0, 1) < 0.3 ? onB : Vec2(onB - dice(0, 1) * eB), b1 = b0 + dice(0.4, 1.4) * eB;
		const Vec2 p[4] { a0, a1, b0, b1 };
		for (int n = 0; n < 4; ++n) {
			b.px[n][i] = p[n].x(), b.py[n][i] = p[n].y(), b.vx[n][i] = dice(-0.1, 0.1), b.vy[n][i] = dice(-0.1, 0.1);
			b.sharpness[n][i] = dice(0, 1) < 0.2 ? 0 : dice(0.1, 5);
		}
		for (int k : { 0, 1 })
			b.rounding[k][i] = dice(0.003, 0.03), b.farRounding[k][i] = dice(0.003, 0.03), b.slip[k][i] = dice(-0.02, 0.02);
		b.depthLimit[i] = dice(0.1, 0.4), b.area[i] = dice(0, 1) < 0.2 ? 0 : dice(0, 1);
		b.kn[i] = dice(1, 10), b.ks[i] = dice(1, 10), b.cohesion[i] = dice(0, 1) < 0.5 ? 0 : dice(0, 0.1), b.tanPhi[i] = dice(0, 1);
		b.uplift[i] = raised && dice(0, 1) < 0.5 ? dice(-0.02, 0.02) : 0;
	}
}

}

TEST(EdgeBatch, LanesAgreeWithSinglePairsToTheBit)
{
	Dice dice;
	int  touching = 0, sliding = 0, raised = 0;
	auto batch = std::make_unique<Batch>();
	for (int round = 0; round < 400; ++round) {
		fill(*batch, 1 + round % Batch::size, round % 2 == 0, dice);
		std::vector<Single> expected;
		for (int i = 0; i < batch->count; ++i)
			expected.emplace_back(*batch, i);
		advanceEdges(*batch, *batch, thickness, dt);
		for (int i = 0; i < batch->count; ++i) {
			const Single& one = expected[i];
			ASSERT_EQ(batch->touches[i] > 0, one.touches) << round << ", " << i;
			if (!one.touches) continue;
			++touching, raised += batch->uplift[i] != 0;
			for (int k : { 0, 1 }) {
				ASSERT_EQ(batch->slip[k][i], one.slip[k]) << round << ", " << i;
				ASSERT_EQ(batch->sigma[k][i], one.sigma[k]) << round << ", " << i;
				ASSERT_EQ(batch->tau[k][i], one.tau[k]) << round << ", " << i;
				sliding += one.slip[k] != 0
					&& std::abs(one.slip[k]) * batch->ks[i] >= (batch->cohesion[i] - one.sigma[k] * batch->tanPhi[i]) * 0.999999;
			}
			ASSERT_EQ(batch->area[i], one.area) << round << ", " << i;
			ASSERT_EQ(batch->friction[i], one.friction) << round << ", " << i;
			ASSERT_EQ(batch->potential[i], one.potential) << round << ", " << i;
			for (int n = 0; n < 4; ++n) {
				ASSERT_EQ(batch->fx[n][i], one.force[n].x()) << round << ", " << i;
				ASSERT_EQ(batch->fy[n][i], one.force[n].y()) << round << ", " << i;
			}
		}
	}
	EXPECT_GT(touching, 1500);
	EXPECT_GT(raised, 300);
	EXPECT_GT(sliding, 300);
}
