#!/bin/bash
# Random input, at scale: scripts/fuzz.sh part=geometry|scenes|softening [count=N] [seed=N]. Ends with the number of cases that nothing explains, and fails if
# there are any.
# Each part is a program of its own in tests/fuzz/: `part` is looked up in the list below.
set -euo pipefail
cd "$(dirname "$0")/.."

part= count=1000 seed=1
for argument in "$@"; do
	case "$argument" in
		part=*) part="${argument#part=}" ;;
		count=*) count="${argument#count=}" ;;
		seed=*) seed="${argument#seed=}" ;;
		*) echo "'$argument' is none of part=, count=, seed=" >&2; exit 2 ;;
	esac
done
for number in "$count" "$seed"; do
	[[ "$number" =~ ^[0-9]+$ ]] || { echo "count and seed must be whole numbers, got '$number'" >&2; exit 2; }
done

case "$part" in
	geometry) program=geometry_fuzz more= ;;
	scenes) program=scene_fuzz more= ;;
	softening) program=scene_fuzz more="0 soften" ;; # the same scenes with joints that soften
	*) echo "part must be geometry, scenes or softening, got '$part'" >&2; exit 2 ;;
esac

scripts/setup.sh --brief libgtest-dev
cmake -S . -B build -DBUILD_TESTING=ON > /dev/null # may have been built without tests
cmake --build build --target $program
exec build/tests/$program "$count" "$seed" $more
