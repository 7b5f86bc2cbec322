#!/bin/bash
# What a step costs, by size and feature: scripts/cost.sh [key=value ...], see scripts/cost.py. Results are in out/cost/.
# other=FOLDER also measures another checkout of this project with its own build/, in turn, on equal meshes.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh
[ -v HOME ] || export HOME=~ # YADE does not start without
/usr/bin/python3 scripts/cost.py "$@"
