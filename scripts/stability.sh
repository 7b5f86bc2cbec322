#!/bin/bash
# Stability on stiff and extreme cases (tests/stability): scripts/stability.sh [case=NAME|quick|list] [tag=TEXT] [threads=N], about a minute.
# Leaves out/stability/table.md and result.json; ends with 1 if a case failed.
set -euo pipefail
cd "$(dirname "$0")/.."

case=all tag="" threads=1
for argument in "$@"; do
	case "$argument" in
		case=*) case="${argument#case=}" ;;
		tag=*) tag="-${argument#tag=}" ;;
		threads=*) threads="${argument#threads=}" ;;
		*) echo "stability has no parameter $argument; known: case tag threads" >&2; exit 2 ;;
	esac
done

scripts/setup.sh --brief python3-pytest

export OMP_NUM_THREADS="$threads" OMP_WAIT_POLICY=passive PYTHONPATH="$PWD/py${PYTHONPATH:+:$PYTHONPATH}"
[ -v HOME ] || export HOME=~ # YADE does not start without
python="$(head -1 "$(command -v yade)" | sed 's/^#! *//')"
"$python" tests/runInYade.py tests/stability -q --tb=short --case="$case" --report="out/stability$tag"
