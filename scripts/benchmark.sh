#!/bin/bash
# Error against run time, of our blocks and of YADE's bonded spheres: scripts/benchmark.sh [mode=quick|full|calibrate] [key=value ...].
# Interrupted runs continue when it is called again. `scripts/benchmark.sh help` shows all keys; results are in out/benchmark/.
set -euo pipefail
cd "$(dirname "$0")/.."

log="$(mktemp)"
trap 'rm -f "$log"' EXIT
scripts/setup.sh python3-scipy python3-distributed > "$log" 2>&1 || { cat "$log" >&2; exit 1; }

[ -v HOME ] || export HOME=~ # YADE does not start without
# Debian's own Python, for which setup.sh installs numpy, scipy, pandas and matplotlib
/usr/bin/python3 scripts/benchmark.py "$@"
