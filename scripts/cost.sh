#!/bin/bash
# What a step costs, by size and feature: scripts/cost.sh [key=value ...], see scripts/cost.py. Results are in out/cost/.
# scripts/cost.sh kernels [OPTION ...]: the parts of a step by Google Benchmark, whose options may follow (--benchmark_filter=step).
# scripts/cost.sh events [key=value ...]: from event to event beside time steps, see scripts/laboratory/costevents.py.
# other=FOLDER also measures another checkout of this project with its own build/, in turn, on equal meshes.
set -euo pipefail
cd "$(dirname "$0")/.."
if [ "${1:-}" = kernels ]; then
	shift
	scripts/setup.sh --tests libbenchmark-dev
	cmake -S . -B build > /dev/null # may not have known it
	cmake --build build --target step_benchmark
	exec build/tests/step_benchmark "$@"
fi
scripts/setup.sh
script=scripts/cost.py
if [ "${1:-}" = events ]; then
	shift
	script=scripts/laboratory/costevents.py
fi
[ -v HOME ] || export HOME=~ # YADE does not start without
/usr/bin/python3 "$script" "$@"
