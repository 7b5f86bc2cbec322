#!/bin/bash
# What every optional feature costs: scripts/price.sh [quick=false] [key=value ...], see scripts/price.py. Results are in out/price/.
# Counts instructions with valgrind, which is installed if it is missing, in a second build that knows its source lines (build/price,
# the same machine code; some minutes the first time).
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh valgrind

folder=out/price
mkdir -p build/price "$folder"
[ -f build/price/build.ninja ] || cmake -S . -B build/price -G Ninja -DBUILD_TESTING=OFF -DCMAKE_CXX_FLAGS=-g1
cmake --build build/price -j "$(nproc)" --target yadeblocks
rm -f "$folder"/*.callgrind* "$folder"/*.json
cc -shared -fPIC -O1 -x c - -o build/price/libmarks.so <<'EOF'
#include <valgrind/callgrind.h>
void startCounting(void) { CALLGRIND_ZERO_STATS; CALLGRIND_START_INSTRUMENTATION; }
void stopCounting(const char* name) { CALLGRIND_DUMP_STATS_AT(name); CALLGRIND_STOP_INSTRUMENTATION; }
EOF

export YADEBLOCKS_PLUGIN="$PWD/build/price/libyadeblocks.so" OMP_WAIT_POLICY=passive PYTHONPATH="$PWD/py${PYTHONPATH:+:$PYTHONPATH}"
[ -v HOME ] || export HOME=~ # YADE does not start without
yade="$(command -v yade)"
interpreter="$(head -1 "$yade" | sed 's/^#! *//')"

yade -n -x -j1 scripts/price.py part=states "$@"
for scene in tension compression crushed; do
	yade -n -x -j1 scripts/price.py part=times scene=$scene "$@"
	OMP_NUM_THREADS=1 valgrind -q --tool=callgrind --instr-atstart=no --compress-strings=no --compress-pos=no \
		--callgrind-out-file="$folder/$scene.callgrind" \
		"$interpreter" "$yade" -n -x -j1 scripts/price.py part=counts scene=$scene "$@"
done
[ "$(nproc)" = 1 ] || for scene in tension compression; do yade -n -x -j2 scripts/price.py part=threads scene=$scene "$@"; done
yade -n -x -j1 scripts/price.py part=table "$@"
