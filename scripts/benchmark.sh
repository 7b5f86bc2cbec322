#!/bin/bash
# Error against run time, of our blocks and of YADE's bonded spheres: scripts/benchmark.sh [mode=quick|full|calibrate] [key=value ...].
# Interrupted runs continue when it is called again. `scripts/benchmark.sh help` shows all keys; results are in out/benchmark/.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/setup.sh --brief python3-scipy python3-distributed

[ -v HOME ] || export HOME=~ # YADE does not start without
# Debian's own Python, for which setup.sh installs numpy, scipy, pandas and matplotlib
/usr/bin/python3 scripts/benchmark.py "$@"
