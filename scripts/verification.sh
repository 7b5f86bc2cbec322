#!/bin/bash
# Theory beside what is computed (tests/verification): scripts/verification.sh [case=NAME|quick|all] [tag=TEXT], about a minute.
# Prints the table and leaves it in out/verification/table.md and result.json; ends with 1 if a case is further off than it may be.
set -euo pipefail
cd "$(dirname "$0")/.."

case=all tag=""
for argument in "$@"; do
	case "$argument" in
		case=*) case="${argument#case=}" ;;
		tag=*) tag="-${argument#tag=}" ;;
		*) echo "verification has no parameter $argument; known: case tag" >&2; exit 2 ;;
	esac
done

scripts/setup.sh --brief python3-pytest

export OMP_NUM_THREADS=1 OMP_WAIT_POLICY=passive PYTHONPATH="$PWD/py${PYTHONPATH:+:$PYTHONPATH}"
[ -v HOME ] || export HOME=~ # YADE does not start without
python="$(head -1 "$(command -v yade)" | sed 's/^#! *//')"
"$python" tests/runInYade.py tests/verification -q --tb=short --case="$case" --report="out/verification$tag"
