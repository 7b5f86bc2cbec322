#!/bin/bash
# Studies of many runs: scripts/study.sh ensemble|sensitivity|calibrate|limit NAME [key=value ...]. Without arguments it says what they are,
# `scripts/study.sh KIND help` shows the keys. Interrupted studies continue when called again; results are in out/study-KIND-NAME/.
set -euo pipefail
cd "$(dirname "$0")/.."

more="python3-scipy python3-distributed"
case "${1:-}" in
	sensitivity) more+=" python3-openturns" ;;
	calibrate) more+=" python3-optuna" ;;
esac
log="$(mktemp)"
trap 'rm -f "$log"' EXIT
scripts/setup.sh $more > "$log" 2>&1 || { cat "$log" >&2; exit 1; }
rm -f "$log"

[ -v HOME ] || export HOME=~ # YADE does not start without
# Debian's own Python, for which setup.sh installs what is needed; one thread each: the runs are what works
export PYTHONPATH="$PWD/scripts:$PWD/py${PYTHONPATH:+:$PYTHONPATH}" OMP_NUM_THREADS=1
exec /usr/bin/python3 -m laboratory "$@"
