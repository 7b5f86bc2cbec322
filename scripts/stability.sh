#!/bin/bash
# Stability on stiff and extreme cases: scripts/stability.sh [case=NAME] (case=list names them). Leaves out/stability/table.md and result.json.
# Ends with 1 if a case failed.
set -euo pipefail
exec "$(dirname "$0")/run.sh" stability "$@"
