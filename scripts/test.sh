#!/bin/bash
# Builds and runs all tests; arguments go to ctest (e.g. -L kernel). Ends with ctest's summary.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh --tests
[ -v HOME ] || export HOME=~ # YADE does not start without
ctest --test-dir build --output-on-failure -j "$(($(nproc) > 1 ? 2 : 1))" "$@" # two at a time: their own clocks have room for that
