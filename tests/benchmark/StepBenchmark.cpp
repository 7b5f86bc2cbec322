// yade-blocks, GPL-2.0-or-later
#include "Specimens.hpp"
#include <benchmark/benchmark.h>

/// What the parts of a step cost, by size: scripts/cost.sh kernels. Arguments: cells along a side; threads. Times are of a call, "zone" and "point" of one of
/// them.
namespace {

using namespace specimens;

constexpr Real dt = 1e-9; ///< so short that nothing goes anywhere

/// A square of n x n Voronoi cells, every so many joints broken (0: none).
BlockAssembly square(int n, int everyBroken = 0)
{
	BlockAssembly a      = voronoi(1, 1, n, n, stone(), elasticJoint(1e12, 5e11), 1);
	a.contacts.strangers = false; // as in a scene of which no script holds an array
	if (everyBroken > 0) {
		JointParams loose = elasticJoint(1e12, 5e11);
		loose.cohesion = loose.tension = 0;
		loose.tanPhiResidual           = 0.7;
		for (int i = 0; i < a.joints.count(); i += everyBroken)
			a.setJoints(i, i + 1, loose, Joint::unbonded);
		setGeneralContact(a, true);
	}
	std::mt19937                         random(1);
	std::uniform_real_distribution<Real> anywhere(-1e-9, 1e-9);
	for (Vec2& u : a.state.displacement)
		u = { anywhere(random), anywhere(random) };
	blocks::computeForces(a, Brittle {}, dt);
	return a;
}

void perPart(benchmark::State& state, const BlockAssembly& a)
{
	using benchmark::Counter;
	const auto rate         = Counter::kIsIterationInvariantRate | Counter::kInvert;
	state.counters["zone"]  = Counter(a.zoneCount(), rate);
	state.counters["point"] = Counter(a.pointCount(), rate);
}

template <class Work> void repeat(benchmark::State& state, BlockAssembly a, const Work& work)
{
	for (int i = 0; i < 20; ++i) // the first steps look for neighbours
		work(a, int(state.range(1)));
	for (auto _ : state)
		work(a, int(state.range(1)));
	perPart(state, a);
}

void forces(benchmark::State& state)
{
	repeat(state, square(int(state.range(0))), [](BlockAssembly& a, int threads) { sweepForces(a, Brittle {}, false, threads); });
}
void motion(benchmark::State& state)
{
	repeat(state, square(int(state.range(0))), [](BlockAssembly& a, int threads) { move(a, { Damping::Kind::local, 0.8 }, dt, 0, false, threads); });
}
void wholeStep(BlockAssembly& a, int threads, bool account)
{
	blocks::computeForces(a, Brittle {}, dt, account, threads);
	move(a, { Damping::Kind::local, 0.8 }, dt, 0, account, threads);
}
void step(benchmark::State& state)
{
	repeat(state, square(int(state.range(0))), [](BlockAssembly& a, int threads) { wholeStep(a, threads, false); });
}
void stepWithAccounts(benchmark::State& state)
{
	repeat(state, square(int(state.range(0))), [](BlockAssembly& a, int threads) { wholeStep(a, threads, true); });
}
void stepWithContact(benchmark::State& state)
{
	BlockAssembly a = square(int(state.range(0)));
	setGeneralContact(a, true);
	repeat(state, std::move(a), [](BlockAssembly& b, int threads) { wholeStep(b, threads, false); });
}
void stepWithAFifthBroken(benchmark::State& state)
{
	repeat(state, square(int(state.range(0)), 5), [](BlockAssembly& a, int threads) { wholeStep(a, threads, false); });
}

void sizes(benchmark::internal::Benchmark* b)
{
	for (int threads : { 1, 2 })
		for (int n : { 20, 60, 180 })
			b->Args({ n, threads });
	b->ArgNames({ "cells", "threads" })->Unit(benchmark::kMicrosecond)->UseRealTime();
}

BENCHMARK(forces)->Apply(sizes);
BENCHMARK(motion)->Apply(sizes);
BENCHMARK(step)->Apply(sizes);
BENCHMARK(stepWithAccounts)->Apply(sizes);
BENCHMARK(stepWithContact)->Apply(sizes);
BENCHMARK(stepWithAFifthBroken)->Apply(sizes);

}

BENCHMARK_MAIN();
