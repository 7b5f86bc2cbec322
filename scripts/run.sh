#!/bin/bash
# Runs a scenario: scripts/run.sh NAME [key=value ...]. Its results are in out/NAME/.
# scripts/run.sh alone lists the scenarios, scripts/run.sh NAME help the keys of one. threads=N is also YADE's number of threads.
set -euo pipefail
cd "$(dirname "$0")/.."

about() { # needs Python alone, no YADE and no plugin
	scripts/install.sh python3-numpy >&2
	PYTHONPATH="$PWD/py${PYTHONPATH:+:$PYTHONPATH}" /usr/bin/python3 -m yadeblocks.help "$@"
}
usage() {
	echo "usage: scripts/run.sh NAME [key=value ...], or scripts/run.sh NAME help for its keys"
	about scripts
	echo "examples: scripts/run.sh examples/NAME, NAME one of $(cd scripts/examples && echo *.py | sed 's/\.py//g')"
}

name="${1:-}"
case "$name" in ""|help|--help|-h) usage; exit ;; esac
if [ ! -f "scripts/$name.py" ]; then
	{ echo "there is no scenario '$name'"; usage; } >&2
	exit 2
fi
shift

threads=1
for argument in "$@"; do
	case "$argument" in
		help|--help) about "scripts/$name.py"; exit ;;
		threads=*) threads="${argument#threads=}" ;;
		*=*) ;;
		*) echo "'$argument' is not of the form key=value" >&2; exit 2 ;;
	esac
done
[[ "$threads" =~ ^[1-9][0-9]*$ ]] || { echo "threads must be a whole number > 0, got '$threads'" >&2; exit 2; }

[ $# -eq 0 ] || about "scripts/$name.py" "$@" # what is wrong with the keys is said before minutes of building
more="$(sed -n 's/^# needs: //p' "scripts/$name.py")" # Debian packages that only this scenario wants
scripts/setup.sh --brief $more

# threads that wait for each other spin for some 50 microseconds, longer than what lies between two steps, and sleep then: on a busy machine they must not
# eat the time of those that work
export GOMP_SPINCOUNT=20000 PYTHONPATH="$PWD/py${PYTHONPATH:+:$PYTHONPATH}"
[ -v HOME ] || export HOME=~ # YADE does not start without
exec yade -n -x -j "$threads" "scripts/$name.py" "$@" # signals reach YADE itself
