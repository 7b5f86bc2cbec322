#!/bin/bash
# Runs a scenario: scripts/run.sh NAME [key=value ...]. Its results are in out/NAME/.
# threads=N is also YADE's number of threads.
set -euo pipefail
cd "$(dirname "$0")/.."

name="${1:-}"
if [ -z "$name" ] || [ ! -f "scripts/$name.py" ]; then
	{
		echo "usage: scripts/run.sh NAME [key=value ...]"
		[ -z "$name" ] || echo "there is no scenario '$name'"
		echo "scenarios:" $(cd scripts && ls *.py | grep -v '^benchmark\|^price' | sed 's/\.py$//')
	} >&2
	exit 2
fi
shift

threads=1
for argument in "$@"; do
	case "$argument" in
		threads=*) threads="${argument#threads=}" ;;
		*=*) ;;
		*) echo "'$argument' is not of the form key=value" >&2; exit 2 ;;
	esac
done
[[ "$threads" =~ ^[1-9][0-9]*$ ]] || { echo "threads must be a whole number > 0, got '$threads'" >&2; exit 2; }

more=""
[ "$name" != spheres ] || more="python3-scipy"
log="$(mktemp)"
trap 'rm -f "$log"' EXIT
scripts/setup.sh $more > "$log" 2>&1 || { cat "$log" >&2; exit 1; }

# passive: threads that wait must not eat the time of those that work
export OMP_WAIT_POLICY=passive PYTHONPATH="$PWD/py${PYTHONPATH:+:$PYTHONPATH}"
[ -v HOME ] || export HOME=~ # YADE does not start without
rm -f "$log"
exec yade -n -x -j "$threads" "scripts/$name.py" "$@" # signals reach YADE itself
